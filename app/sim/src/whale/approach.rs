//! How near rope is to skin, cheaply and over metres: by the boxes of the tree's clusters.
//!
//! The gap between a segment's box and a cluster's is never more than their distance, so what is taken for far is far.

use std::sync::Arc;

use endline_sdk::Region;
use glam::DAffine3;

use super::bounds::Bounds;
use super::tree::SkinTree;

/// Whether rope runs over a thin edge there: edges and tips of flippers and flukes.
fn is_thin(region: Region) -> bool {
    use Region as R;
    matches!(
        region,
        R::LeftFlipperLeading
            | R::LeftFlipperTrailing
            | R::LeftFlipperTip
            | R::RightFlipperLeading
            | R::RightFlipperTrailing
            | R::RightFlipperTip
            | R::LeftFlukeLeading
            | R::LeftFlukeTrailing
            | R::RightFlukeLeading
            | R::RightFlukeTrailing
    )
}

/// Boxes of one pose, worked out when first asked for.
#[derive(Clone, Debug)]
pub(crate) struct Approach {
    tree: Arc<SkinTree>,
    /// Whether each node of the tree holds a thin edge.
    thin: Vec<bool>,
    boxes: Vec<Option<Bounds>>,
    todo: Vec<usize>,
}

impl Approach {
    pub fn new(tree: Arc<SkinTree>) -> Self {
        let is_thin_triangle = |triangle: &u32| is_thin(tree.skin().regions[*triangle as usize]);
        let thin = tree
            .nodes()
            .iter()
            .map(|node| tree.order()[node.triangles.clone()].iter().any(is_thin_triangle))
            .collect();
        Self {
            thin,
            boxes: vec![None; tree.nodes().len()],
            todo: Vec::with_capacity(tree.nodes().len()),
            tree,
        }
    }

    /// Begins with the whale in a new pose.
    pub fn begin(&mut self) {
        self.boxes.fill(None);
    }

    /// The least that `size` gives for any cluster, from its gap to `place` [m] and whether it holds a thin edge; `most` where
    /// none gives less. `size` must not fall as the gap grows, nor be less for skin than for thin edges.
    pub fn least(
        &mut self,
        bones: &[DAffine3],
        place: &Bounds,
        most: f64,
        size: impl Fn(f64, bool) -> f64,
    ) -> f64 {
        let mut least = most;
        self.todo.clear();
        self.todo.extend((!self.boxes.is_empty()).then_some(0));
        while let Some(node) = self.todo.pop() {
            let bounds =
                *self.boxes[node].get_or_insert_with(|| self.tree.bound(node, bones, bones));
            let here = size(bounds.gap(place), self.thin[node]);
            if here >= least {
                continue;
            }
            match self.tree.nodes()[node].children {
                Some(children) => self.todo.extend(children),
                None => least = here,
            }
        }
        least
    }
}
