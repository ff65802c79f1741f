//! How near rope is to skin, cheaply and over metres: by the boxes of the tree's clusters.
//!
//! The gap between a segment's box and a cluster's is never more than their distance, so what is taken for far is far.
//!
//! A child's box may stick out of its parent's: both are made of bounding spheres. What a search that trusts the boxes finds
//! therefore depends on its order, and [`Approach::least`] means the search in the tree's order. A quicker one finds the least
//! of all clusters; where the search in order is sure to reach that cluster, both give the same.

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
    /// The node above each; none above the root.
    parent: Vec<Option<usize>>,
    boxes: Vec<Option<Bounds>>,
    /// Boxes around each node and all below it, where they are known.
    whole: Vec<Bounds>,
    whole_known: bool,
    /// The cluster that was least for the place before: a first guess for the next, which lies beside it.
    guess: Option<usize>,
    todo: Vec<usize>,
    /// Nodes to be looked at by the quick search, each with a lower bound of what is below it.
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

    /// Begins with the whale in a new pose.
    pub fn begin(&mut self) {
        self.boxes.fill(None);
        self.whole_known = false;
        self.guess = None;
    }

    /// The least that `size` gives for any cluster that a search in the tree's order reaches, from its gap to `place` [m] and
    /// whether it holds a thin edge; `most` where none gives less. The search leaves out what is below a node that gives no less.
    /// `size` must not fall as the gap grows, nor be less for skin than for thin edges.
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
        self.know_whole(bones);
        // No cluster gives less than the quick search finds, so the search in order finds no less either.
        let Some((cluster, least)) = self.least_of_all(place, most, &size) else { return most };
        self.guess = Some(cluster);
        if self.is_reached(cluster, least, bones, place, &size) {
            least
        } else {
            self.least_in_order(bones, place, most, size)
        }
    }

    /// The search in the tree's order.
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

    /// The cluster that gives the least of all, and what it gives; none where none gives less than `most`.
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
                    // The nearer one is looked at first.
                    bounded.extend(if one.1 < other.1 { [other, one] } else { [one, other] });
                }
                None => found = Some((node, here)),
            }
        }
        found
    }

    /// Whether the search in order comes to a cluster, or finds as little before: none of the nodes above it gives more.
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

    /// Works out the boxes around nodes and all below them.
    fn know_whole(&mut self, bones: &[DAffine3]) {
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

    /// Like the lengths of a mesh: a floor, a slope, a ceiling, and finer at thin edges.
    fn size(gap_m: f64, thin: bool) -> f64 {
        let at = |least: f64, within: f64| (least + 0.3 * (gap_m - within).max(0.0)).min(MOST);
        if thin { at(0.02, 0.2) } else { at(0.05, 0.3) }
    }

    const MOST: f64 = 1.0;

    /// Along rope in random postures the least has the bits of the search in order, and no cluster gives less but where boxes
    /// that stick out hide it; both happen.
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
            "{counts:?}: both searches are to decide often"
        );
    }

    #[test]
    fn a_whale_without_skin_is_near_nothing() {
        let mut approach = Approach::new(Arc::new(SkinTree::new(Arc::default())));
        approach.begin();
        let place = Bounds::around(&[DVec3::ZERO]);
        assert!((approach.least(&[], &place, MOST, size) - MOST).abs() < 1e-15);
    }
}
