//! The two sweeps over a group of eight pieces: forces, matrix and elimination in one go forward, moves backward.
//!
//! Forward, node `k` is met with its block `D`, force `f` and its coupling `F` to the piece's end A:
//! `step_k = g - W step_A + X step_(k+1)` with `X = D⁻¹B`, `g = D⁻¹f`, `W = D⁻¹F` and `B` the block of segment `k`;
//! node `k + 1` then has `D' = D - B X`, `f' = f + B g`, `F' = B W`. What is left couples the piece's ends (`rows::EndRows`).
//! At a kept node, on which other rope presses, a span ends in this way and the next begins (`kept.rs`).
//! Here all is symmetric; rope that touches skin, obstacles or bodies, whose blocks are not, has a sweep of its own (`contact.rs`).

mod backward;
mod contact;
mod forward;

use crate::forces::laws::{PerMetre, Shared};
use crate::simd::rows::Row;
use crate::system::lanes::rows::{GroundRow, NodeRow, SegmentRow, Solved};
pub(crate) use backward::Backward;
pub(crate) use contact::ForwardContact;
pub(crate) use forward::Forward;

/// The rows of a group.
pub(crate) struct GroupRows<'a> {
    /// Node rows with one ghost row before and one behind.
    pub nodes: &'a mut [NodeRow],
    pub segments: &'a mut [SegmentRow],
    pub solved: &'a mut [Solved],
    /// Seabed, in the layout of `nodes`, or empty.
    pub ground: &'a [GroundRow],
    /// Segments of the shortest piece.
    pub shortest: usize,
    /// For each segment from `shortest` on: 1 in lanes whose piece has it.
    pub live: &'a [Row],
    /// Whether end A of every piece is fixed: nothing couples to it then.
    pub anchored: bool,
    /// Whether any of it resists bending.
    pub bends: bool,
    pub rope: &'a PerMetre<Row>,
    pub shared: &'a Shared<f64>,
}
