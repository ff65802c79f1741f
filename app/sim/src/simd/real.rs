//! Numbers the rope's laws are written in: one `f64`, or several in the lanes of the processor.
//!
//! Every operation acts on each lane alike (IEEE 754, rounded once; a product is added fused, where the processor cannot by
//! software), so that a rope gives the same bits whatever the width of the processor's lanes. One `f64` alone rounds a product
//! before it adds it: its code is compiled for any processor, and fusing by software would cost tens of times as much.

use core::ops::{Add, Div, Mul, Neg, Sub};

use pulp::Simd;

/// A number, or a row of numbers worked on together.
pub(crate) trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// This value in every lane.
    fn splat(self, value: f64) -> Self;
    /// `self + one · other`, in lanes rounded once.
    fn plus(self, one: Self, other: Self) -> Self;
    /// `self - one · other`, in lanes rounded once.
    fn less(self, one: Self, other: Self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// The greater, of numbers that are finite; the other of equal numbers, so that the sign of a zero does not depend on the processor.
    fn max(self, other: Self) -> Self;
    /// The lesser, of numbers that are finite.
    fn min(self, other: Self) -> Self;
    /// `yes` where this is above zero, else `no`.
    fn positive(self, yes: Self, no: Self) -> Self;
}

impl Real for f64 {
    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn plus(self, one: Self, other: Self) -> Self {
        self + one * other
    }
    #[inline(always)]
    fn less(self, one: Self, other: Self) -> Self {
        self - one * other
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        (self - other).positive(self, other)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        (other - self).positive(self, other)
    }
    #[inline(always)]
    fn positive(self, yes: Self, no: Self) -> Self {
        if self > 0.0 { yes } else { no }
    }
}

/// As many numbers as the processor's registers hold.
#[derive(Clone, Copy)]
pub(crate) struct Lane<S: Simd> {
    pub simd: S,
    pub value: S::f64s,
}

impl<S: Simd> Lane<S> {
    /// This value in every lane.
    #[inline(always)]
    pub fn new(simd: S, value: f64) -> Self {
        Self { simd, value: simd.splat_f64s(value) }
    }
}

macro_rules! each_lane {
    ($($trait:ident $method:ident $op:ident),*) => {
        $(impl<S: Simd> $trait for Lane<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self { simd: self.simd, value: self.simd.$op(self.value, other.value) }
            }
        })*
    };
}

each_lane!(Add add add_f64s, Sub sub sub_f64s, Mul mul mul_f64s, Div div div_f64s);

impl<S: Simd> Neg for Lane<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { simd: self.simd, value: self.simd.neg_f64s(self.value) }
    }
}

impl<S: Simd> Real for Lane<S> {
    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        Self::new(self.simd, value)
    }
    #[inline(always)]
    fn plus(self, one: Self, other: Self) -> Self {
        Self { simd: self.simd, value: self.simd.mul_add_f64s(one.value, other.value, self.value) }
    }
    #[inline(always)]
    fn less(self, one: Self, other: Self) -> Self {
        Self {
            simd: self.simd,
            value: self.simd.negate_mul_add_f64s(one.value, other.value, self.value),
        }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self { simd: self.simd, value: self.simd.sqrt_f64s(self.value) }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self { simd: self.simd, value: self.simd.abs_f64s(self.value) }
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        let is_greater = self.simd.greater_than_f64s(self.value, other.value);
        let value = self.simd.select_f64s(is_greater, self.value, other.value);
        Self { simd: self.simd, value }
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        let is_less = self.simd.greater_than_f64s(other.value, self.value);
        let value = self.simd.select_f64s(is_less, self.value, other.value);
        Self { simd: self.simd, value }
    }
    #[inline(always)]
    fn positive(self, yes: Self, no: Self) -> Self {
        let mask = self.simd.greater_than_f64s(self.value, self.simd.splat_f64s(0.0));
        Self { simd: self.simd, value: self.simd.select_f64s(mask, yes.value, no.value) }
    }
}
