//! Lower bounds of the distance from rope to skin over metres, from the boxes of the tree's clusters.
//!
//! The gap between the box of a segment and that of a cluster is never greater than their distance.
//!
//! The box of a child may extend beyond that of its parent, because both are made of bounding spheres. The result of a search
//! that prunes by boxes therefore depends on its order; [`Approach::least`] is defined by the search in the order of the tree.
//! A faster search finds the minimum over all clusters. If the search in order would reach that cluster, both results are
//! equal; otherwise the search in order runs as well.

use std::sync::Arc;

use endline_sdk::Region;
use glam::DAffine3;

use super::tree::{Bounds, SkinTree};

/// Whether a region is a thin edge: edges and tips of flippers and flukes.
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

/// Boxes of one pose, computed on demand.
#[derive(Clone, Debug)]
pub(crate) struct Approach {
    tree: Arc<SkinTree>,
    /// Whether each node of the tree contains a thin edge.
    thin: Vec<bool>,
    /// Parent of each node; `None` for the root.
    parent: Vec<Option<usize>>,
    boxes: Vec<Option<Bounds>>,
    /// Boxes around each node and all its descendants, valid if `whole_known`.
    whole: Vec<Bounds>,
    whole_known: bool,
    /// Cluster of the previous minimum: the initial guess for the next, neighbouring box.
    guess: Option<usize>,
    todo: Vec<usize>,
    /// Pending nodes of the fast search, each with a lower bound of its descendants.
    bounded: Vec<(usize, f64)>,
}

impl Approach {
    pub fn new(tree: Arc<SkinTree>) -> Self {
        let is_thin_triangle = |triangle: &u32| is_thin(tree.skin().regions[*triangle as usize]);
        let count = tree.nodes().len();
        let thin = tree
            .nodes()
            .iter()
            .map(|node| tree.order()[node.triangles.clone()].iter().any(is_thin_triangle))
            .collect();
        let mut parent = vec![None; count];
        for (node, at) in tree.nodes().iter().enumerate() {
            at.children.into_iter().flatten().for_each(|child| parent[child] = Some(node));
        }
        Self {
            thin,
            parent,
            boxes: vec![None; count],
            whole: vec![Bounds::EMPTY; count],
            whole_known: false,
            guess: None,
            todo: Vec::with_capacity(count),
            bounded: Vec::with_capacity(count),
            tree,
        }
    }

    /// Starts a new pose.
    pub fn begin(&mut self) {
        self.boxes.fill(None);
        self.whole_known = false;
        self.guess = None;
    }

    /// Returns the minimum of `size` over the clusters that a search in the order of the tree reaches, at most `most`.
    ///
    /// `size` is a function of the gap of a cluster to `place` [m] and of whether it contains a thin edge. It must not decrease
    /// with the gap, nor be smaller without a thin edge than with one. The search prunes the descendants of a node with no
    /// smaller value.
    pub fn least(
        &mut self,
        bones: &[DAffine3],
        place: &Bounds,
        most: f64,
        size: impl Fn(f64, bool) -> f64,
    ) -> f64 {
        if self.boxes.is_empty() || size(self.bound(0, bones).gap(place), self.thin[0]) >= most {
            return most;
        }
        self.compute_whole(bones);
        // The fast search finds a lower bound of the result of the search in order.
        let Some((cluster, least)) = self.least_of_all(place, most, &size) else { return most };
        self.guess = Some(cluster);
        if self.is_reached(cluster, least, bones, place, &size) {
            least
        } else {
            self.least_in_order(bones, place, most, size)
        }
    }

    /// The search in the order of the tree.
    fn least_in_order(
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
            let here = size(self.bound(node, bones).gap(place), self.thin[node]);
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

    /// Returns the cluster with the minimum of all and its value; `None` if no value is below `most`.
    fn least_of_all(
        &mut self,
        place: &Bounds,
        most: f64,
        size: impl Fn(f64, bool) -> f64,
    ) -> Option<(usize, f64)> {
        let Self { tree, thin, whole, bounded, .. } = self;
        let at = |node: usize| (node, size(whole[node].gap(place), thin[node]));
        let mut found = self.guess.map(at).filter(|(_, least)| *least < most);
        bounded.clear();
        bounded.push(at(0));
        while let Some((node, here)) = bounded.pop() {
            if here >= found.map_or(most, |(_, least)| least) {
                continue;
            }
            match tree.nodes()[node].children {
                Some(children) => {
                    let [one, other] = children.map(at);
                    // The nearer child is searched first.
                    bounded.extend(if one.1 < other.1 { [other, one] } else { [one, other] });
                }
                None => found = Some((node, here)),
            }
        }
        found
    }

    /// Whether the search in order reaches a cluster or an equal value before it: no ancestor has a greater value.
    fn is_reached(
        &mut self,
        cluster: usize,
        least: f64,
        bones: &[DAffine3],
        place: &Bounds,
        size: impl Fn(f64, bool) -> f64,
    ) -> bool {
        let mut node = cluster;
        while let Some(above) = self.parent[node] {
            if size(self.bound(above, bones).gap(place), self.thin[above]) > least {
                return false;
            }
            node = above;
        }
        true
    }

    /// Computes the boxes around nodes and all their descendants.
    fn compute_whole(&mut self, bones: &[DAffine3]) {
        if self.whole_known {
            return;
        }
        self.whole_known = true;
        // Children come after their parent.
        for node in (0..self.boxes.len()).rev() {
            let children = self.tree.nodes()[node].children.into_iter().flatten();
            self.whole[node] = children
                .fold(self.bound(node, bones), |whole, child| whole.join(self.whole[child]));
        }
    }

    fn bound(&mut self, node: usize, bones: &[DAffine3]) -> Bounds {
        *self.boxes[node].get_or_insert_with(|| self.tree.bound_at(node, bones))
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::surface::tests::{Dice, random_bones, tube};
    use super::*;

    /// Like target lengths of segments: a minimum, a slope, a maximum, and smaller at thin edges.
    fn size(gap_m: f64, thin: bool) -> f64 {
        let at = |least: f64, within: f64| (least + 0.3 * (gap_m - within).max(0.0)).min(MOST);
        if thin { at(0.02, 0.2) } else { at(0.05, 0.3) }
    }

    const MOST: f64 = 1.0;

    /// Along rope in random postures the result is bit-equal to that of the search in order. The minimum over all clusters is
    /// smaller only where boxes that extend beyond their parent hide it; both cases occur.
    #[test]
    fn the_least_is_that_of_the_search_in_order() {
        let mut skin = tube();
        skin.regions.iter_mut().skip(900).take(60).for_each(|it| *it = Region::LeftFlukeTrailing);
        let tree = Arc::new(SkinTree::new(Arc::new(skin)));
        let mut approach = Approach::new(Arc::clone(&tree));
        let (mut dice, mut counts) = (Dice(11), [0; 3]);
        for _ in 0..60 {
            let bones = random_bones(tree.skin(), &mut dice);
            let mut at = dice.point() * 7.0;
            approach.begin();
            for _ in 0..100 {
                let next = at + dice.point() * 0.3;
                let place = Bounds::around(&[at, next]);
                at = next;
                let found = approach.least(&bones, &place, MOST, size);
                let expected =
                    Approach::new(Arc::clone(&tree)).least_in_order(&bones, &place, MOST, size);
                assert_eq!(found.to_bits(), expected.to_bits());
                let of_cluster = |(index, thin): (usize, &bool)| {
                    let is_leaf = tree.nodes()[index].children.is_none();
                    is_leaf.then(|| size(tree.bound_at(index, &bones).gap(&place), *thin))
                };
                let all = approach.thin.iter().enumerate().filter_map(of_cluster);
                let least = all.fold(MOST, f64::min);
                assert!(least <= found);
                counts[0] += usize::from(found < MOST);
                counts[1] += usize::from(found < 0.06);
                counts[2] += usize::from(least < found);
            }
        }
        assert!(
            counts[0] > 1000 && counts[1] > 100 && counts[2] > 100 && counts[2] < counts[0] / 2,
            "{counts:?}: both searches must determine results often"
        );
    }

    #[test]
    fn a_whale_without_skin_has_no_distance() {
        let mut approach = Approach::new(Arc::new(SkinTree::new(Arc::default())));
        approach.begin();
        let place = Bounds::around(&[DVec3::ZERO]);
        assert!((approach.least(&[], &place, MOST, size) - MOST).abs() < 1e-15);
    }
}
