//! Mill tests: breaks of a product become its law of strength, and the probability that it is approved.
//!
//! Breaks are taken as draws from a normal law whose mean `μ` and deviation `σ` nobody knows. With `n` breaks of mean `x` and
//! deviation `s`, under the usual prior `1/σ`:
//!
//! | what | how |
//! |---|---|
//! | interval of `μ` | `x ± t · s / √n`, `t` of Student's law with `n − 1` degrees of freedom |
//! | interval of `σ` | `s √((n − 1) / χ²)` at the two ends of the χ² law with `n − 1` degrees of freedom |
//! | mean of ten more breaks | `x + s √(1/n + 1/10) · T` with `T` of the same Student's law |
//!
//! Two texts of NOAA say what approves a weak rope or insert, and they differ: the mean of ten consecutive breaks within 10 %
//! of 1,700 lbf (its page of approved weak inserts), or at most 1,700 lbf (bulletin 307460d). Both are told.

mod breaks;
mod entry;
mod law;

pub use breaks::read_breaks;
pub use entry::weak_link;
pub use law::{Approval, StrengthLaw};
