//! What laws ask of an assembly: rule packs of the library checked on assembled gear.
//!
//! | module | what |
//! |---|---|
//! | [`facts`] | what expressions may use, declared once |
//! | `gear`, `walk`, `measure` | endlines and groundlines of an assembled model, and the facts measured on them |
//! | `fishing` | where, when and how gear is fished |
//! | `expression`, `operators`, [`value`], `makeup` | expressions over values with units, on the library `exmex` |
//! | [`packs`] | packs read, with every mistake at its place |
//! | `listing` | rules and areas as JSON |
//! | [`remedy`] | edits by which gear comes to comply, each tried |
//! | `verdict` | one rule on one assembly |
//! | [`study`] | a study of an assembly edited for each of several rules |
//! | [`sheet`] | an assembly with the verdict on every rule |
//!
//! The format is described in `docs/rules.md`.

mod expression;
pub mod facts;
mod fishing;
mod gear;
pub(crate) mod listing;
mod makeup;
mod measure;
mod operators;
pub mod packs;
pub mod remedy;
pub mod sheet;
pub mod study;
#[cfg(test)]
mod tests;
pub mod value;
mod verdict;
mod walk;

pub use fishing::Fishing;
pub use makeup::{MadeUp, Places, Stretch};
pub use packs::Packs;
pub use sheet::{Counts, EndlineMakeUp, RuleGear, RuleSheet, assembly, check, of_library};
pub use verdict::{Measured, RuleResult, Verdict};
