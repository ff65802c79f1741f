//! Every figure that Endline reports of a run, declared once.
//!
//! A [`Figure`] has a key, a label, an explanation, a quantity, and a plain function that reads its
//! value. Everything that shows results iterates these lists: the JSON summary, the rows of a
//! study, the tables of the command line, the panels of the workbench, the comparison of two runs
//! and the tables of the documents. Which of them show a figure is declared with the figure.
//!
//! | list | source | one for each |
//! |---|---|---|
//! | [`ATTEMPT`] | [`Attempt`] | run that a study asked for |
//! | [`RUN`], [`AUDIT`], [`SETTLED`] | [`Report`](crate::Report) | run |
//! | [`BALANCE`] | [`BalanceSummary`](endline_sim::balance::BalanceSummary) | run |
//! | [`PHASE`] | [`Phase`](crate::timing::Phase) | phase of a run |
//! | [`COST`] | [`Cost`](endline_sim::Cost) | run |
//! | [`EVENT`] | [`Event`](endline_sim::metrics::Event) | event |
//! | [`PLUGIN`] | [`PluginUsed`](crate::plugins::PluginUsed) | plugin of the model |
//! | [`LINE`] | [`Line`] | line |
//! | [`LINK`], [`BODY`], [`PROBE`] | summaries of [`endline_sim::metrics`] | weak link, body, probe |
//! | [`WHALE`], [`BEAT`], [`KINETIC`] | summaries of [`endline_sim::metrics`] | whale |
//! | [`PART`] | [`Part`] | part of the whale's body |
//! | [`PATCH`] | [`PatchSummary`](endline_sim::metrics::PatchSummary) | patch of skin |
//! | [`MOMENT`] | [`LiveView`](crate::live::LiveView) | moment shown |
//!
//! To add a figure: a field of the summary in `app/sim/src/metrics`, and one entry here.

mod audit;
mod balance;
pub mod compare;
mod figure;
mod gear;
mod run;
pub(crate) mod schema;
mod skin;
#[cfg(test)]
pub(crate) mod tests;
mod value;
mod whale;

pub use audit::{AUDIT, COST, shares};
pub use balance::BALANCE;
pub use figure::{Column, Figure, MOMENT, View, list, object, shown};
pub use gear::{BODY, LINE, LINK, Line, PLUGIN, PROBE, lines};
pub use run::{ATTEMPT, Attempt, EVENT, PHASE, RUN, SETTLED};
pub use skin::{PART, PATCH, Part, parts};
pub use value::{Quantity, Value};
pub use whale::{BEAT, KINETIC, WHALE};
