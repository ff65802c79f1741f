//! Rule packs of fishing law, checked on assembled gear.
//!
//! | module | content |
//! |---|---|
//! | [`facts`] | the facts that expressions may use, declared once and measured on gear |
//! | `gear` | endlines and groundlines of an assembled model |
//! | `expression`, [`value`] | expressions over values with units, on the library `exmex` |
//! | [`packs`] | packs read, with every mistake at its place; rules and areas as JSON |
//! | [`remedy`] | edits by which gear complies, each tried |
//! | `verdict` | one rule on one assembly |
//! | [`study`] | a study of an assembly edited for each of several rules |
//! | [`sheet`] | an assembly, where and when it is fished, and the verdict on every rule |
//!
//! The format is described in `docs/rules.md`.

mod expression;
pub mod facts;
mod gear;
pub mod packs;
pub mod remedy;
pub mod sheet;
pub mod study;
#[cfg(test)]
mod tests;
pub mod value;
mod verdict;

pub use packs::Packs;
pub use sheet::{Counts, EndlineMakeUp, Fishing, RuleGear, RuleSheet, assembly, check, of_library};
pub use value::{MadeUp, Places, Stretch};
pub use verdict::{Measured, RuleResult, Verdict};
