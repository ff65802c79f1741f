//! The way that statics has come, pass by pass, and how far it may go.
//!
//! A pass costs what the gear has nodes, so what is counted is nodes and passes together: gear without an answer is given
//! up after some seconds, whatever its size, and after as long again from weaker currents.

use crate::model::Model;

/// Nodes times passes after which statics gives up: eight seconds of a core at 0.4 µs each.
const MOST_NODE_PASSES: usize = 20_000_000;

/// Residuals pass by pass.
#[derive(Debug)]
pub(super) struct Trail {
    /// Residual after each pass [N].
    pub residual_n: Vec<f64>,
    node_passes: usize,
    /// Node-passes after which it is time to give up.
    most: usize,
}

impl Default for Trail {
    fn default() -> Self {
        Self { residual_n: Vec::new(), node_passes: 0, most: MOST_NODE_PASSES }
    }
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

    /// A trail of a quarter of the way.
    pub fn short() -> Self {
        Self { most: MOST_NODE_PASSES / 4, ..Self::default() }
    }

    /// Adds the passes of another trail.
    pub fn add(&mut self, other: Self) {
        self.residual_n.extend(other.residual_n);
        self.node_passes += other.node_passes;
    }

    /// Whether it is time to give up.
    pub fn is_spent(&self) -> bool {
        self.node_passes >= self.most
    }
}
