//! Several numbers worked on at once, in the lanes of the processor.
//!
//! `real.rs` has the numbers, `space.rs` vectors and matrices of them, and `rows.rs` how these lie in memory. The bits of a result do not
//! depend on the processor.

pub(crate) mod real;
pub(crate) mod rows;
pub(crate) mod space;

/// The greater of two numbers; the first if they are equal or either is not a number. Unlike `f64::max`, it is one instruction of the
/// processor.
#[inline(always)]
pub(crate) fn greater(one: f64, other: f64) -> f64 {
    if other > one { other } else { one }
}

/// The lesser of two numbers; the first if they are equal or either is not a number.
#[inline(always)]
pub(crate) fn lesser(one: f64, other: f64) -> f64 {
    if other < one { other } else { one }
}
