//! The way that statics has come, pass by pass, and how far it may go.
//!
//! A pass costs what the gear has nodes, so what is counted is nodes and passes together: gear without an answer is given
//! up after some seconds, whatever its size.

use crate::model::Model;

/// Nodes times passes after which statics gives up: eight seconds of a core at 0.4 µs each.
const MOST_NODE_PASSES: usize = 20_000_000;

/// Residuals pass by pass.
#[derive(Debug, Default)]
pub(super) struct Trail {
    /// Residual after each pass [N].
    pub residual_n: Vec<f64>,
    node_passes: usize,
    /// Node-passes made when this trail began.
    begun_at: usize,
}

impl Trail {
    /// Adds a pass over a model.
    pub fn pass(&mut self, model: &Model, residual_n: f64) {
        self.residual_n.push(residual_n);
        self.node_passes += model.node_count;
    }

    /// Passes made.
    pub fn passes(&self) -> usize {
        self.residual_n.len()
    }

    /// A trail with a quarter of the way before it.
    pub fn shorter(&self) -> Self {
        let begun_at = MOST_NODE_PASSES - MOST_NODE_PASSES / 4;
        Self { residual_n: Vec::new(), node_passes: begun_at, begun_at }
    }

    /// Adds the passes of another trail.
    pub fn add(&mut self, other: Self) {
        self.residual_n.extend(other.residual_n);
        self.node_passes += other.node_passes - other.begun_at;
    }

    /// Whether it is time to give up.
    pub fn is_spent(&self) -> bool {
        self.node_passes >= MOST_NODE_PASSES
    }
}
