//! Lower bounds of the distance from rope to skin over metres, from the boxes of the tree's clusters.
//!
//! The gap between the box of a segment and that of a cluster is never greater than their distance.
//!
//! The box of a child may extend beyond that of its parent, because both are made of bounding spheres. The result of a search
//! that prunes by boxes therefore depends on its order; [`Approach::least`] is defined by the search in the order of the tree.
//! A faster search, of eight neighbouring places at once in the lanes of the processor, finds the minimum over all clusters. If the
//! search in order would reach that cluster, both results are equal; otherwise the search in order runs as well.
//! [`Approach::is_any_below`] ends the fast search at the first cluster below a limit.

use std::sync::Arc;

use endline_sdk::Region;
use glam::DAffine3;
use pulp::{Arch, Simd, WithSimd};

use super::tree::{Bounds, SkinTree};
use crate::simd::real::Real;
use crate::simd::rows::{LANES, Part, Row, Row3};

/// A function of the gap of a cluster to a place [m] and of whether the cluster contains a thin edge. It must not decrease with the
/// gap, nor be smaller without a thin edge than with one.
pub(crate) trait Size {
    /// Its value.
    fn at<R: Real>(&self, gap_m: R, thin: bool) -> R;
}

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
    arch: Arch,
    tree: Arc<SkinTree>,
    /// Whether each node of the tree contains a thin edge.
    thin: Vec<bool>,
    /// Parent of each node; `None` for the root.
    parent: Vec<Option<usize>>,
    boxes: Vec<Option<Bounds>>,
    /// Boxes around the clusters below each node; of a cluster its own box.
    around: Vec<Option<Bounds>>,
    radii: Vec<f64>,
    /// Whether the boxes of all ancestors of a cluster contain its own.
    is_within: Vec<Option<bool>>,
    /// Cluster of a previous minimum: the initial guess for the next, neighbouring places.
    guess: Option<usize>,
    todo: Vec<usize>,
    /// Pending nodes of the fast search, each with lower bounds of its descendants.
    bounded: Vec<(usize, Row)>,
}

/// The cluster with the minimum of all for each place, and the minima.
#[derive(Clone, Debug, Default)]
struct Least {
    cluster: [usize; LANES],
    value: Row,
}

/// End of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Until {
    /// The minima are found.
    Least,
    /// Any value is less than at the start.
    AnyLess,
}

/// Boxes of neighbouring places, one in each lane.
struct Places {
    low: Row3,
    high: Row3,
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
            arch: Arch::new(),
            thin,
            radii: tree.radii_around_clusters(&parent),
            parent,
            boxes: vec![None; count],
            around: vec![None; count],
            is_within: vec![None; count],
            guess: None,
            todo: Vec::with_capacity(count),
            bounded: Vec::with_capacity(count),
            tree,
        }
    }

    /// Starts a new pose.
    pub fn begin(&mut self) {
        self.boxes.fill(None);
        self.around.fill(None);
        self.is_within.fill(None);
        self.guess = None;
    }

    /// Computes, for each of at most eight neighbouring places, the minimum of `size` over the clusters that a search in the order of
    /// the tree reaches, at most `most`. The search prunes the descendants of a node with no smaller value.
    pub fn least(
        &mut self,
        bones: &[DAffine3],
        places: &[Bounds],
        most: f64,
        size: &impl Size,
        out: &mut [f64],
    ) {
        debug_assert!(places.len() <= LANES && places.len() == out.len(), "{} places", out.len());
        out.fill(most);
        let around = places.iter().fold(Bounds::EMPTY, |all, place| all.join(*place));
        if self.is_far(bones, &around, most, size) {
            return;
        }
        let start = Row([most; LANES]);
        let Some(found) = self.least_of_all(bones, places, (start, Until::Least), size) else {
            return;
        };
        let Least { cluster, value } = found;
        for (lane, (place, out)) in places.iter().zip(out).enumerate() {
            let (cluster, least) = (cluster[lane], value.0[lane]);
            // The fast search finds a lower bound of the result of the search in order.
            if least >= most || self.is_far(bones, place, most, size) {
                continue;
            }
            self.guess = Some(cluster);
            *out = if self.is_reached(cluster, least, bones, place, size) {
                least
            } else {
                self.least_in_order(bones, place, most, size)
            };
        }
    }

    /// Whether [`Self::least`] is `most` for all places in a box, because the whole skin is far from it.
    pub fn is_far(
        &mut self,
        bones: &[DAffine3],
        around: &Bounds,
        most: f64,
        size: &impl Size,
    ) -> bool {
        self.boxes.is_empty() || size.at(self.bound(0, bones).gap(around), self.thin[0]) >= most
    }

    /// Whether a cluster has a `size` below the limit of one of at most eight neighbouring places. If not, no result of
    /// [`Self::least`] is below its limit.
    pub fn is_any_below(
        &mut self,
        bones: &[DAffine3],
        places: &[Bounds],
        limits: &[f64],
        size: &impl Size,
    ) -> bool {
        debug_assert!(places.len() <= LANES && places.len() == limits.len(), "{places:?}");
        let Some((first, _)) = limits.split_first().filter(|_| !self.boxes.is_empty()) else {
            return false;
        };
        let around = places.iter().fold(Bounds::EMPTY, |all, place| all.join(*place));
        let greatest = limits.iter().copied().fold(*first, f64::max);
        let Self { tree, radii, around: boxes, .. } = self;
        let root = Boxes { tree, radii, around: boxes, bones }.get(0);
        if size.at(root.gap(&around), self.thin[0]) >= greatest {
            return false;
        }
        // Lanes to spare repeat the first place.
        let start = Row(std::array::from_fn(|lane| *limits.get(lane).unwrap_or(first)));
        let found = self.least_of_all(bones, places, (start, Until::AnyLess), size);
        found.is_some_and(|found| found.value != start)
    }

    /// The search in the order of the tree.
    fn least_in_order(
        &mut self,
        bones: &[DAffine3],
        place: &Bounds,
        most: f64,
        size: &impl Size,
    ) -> f64 {
        let mut least = most;
        self.todo.clear();
        self.todo.extend((!self.boxes.is_empty()).then_some(0));
        while let Some(node) = self.todo.pop() {
            let here = size.at(self.bound(node, bones).gap(place), self.thin[node]);
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

    /// The clusters with the minima of all, where these are below `start`; `None` if there are no places.
    fn least_of_all(
        &mut self,
        bones: &[DAffine3],
        places: &[Bounds],
        (start, until): (Row, Until),
        size: &impl Size,
    ) -> Option<Least> {
        let (first, rest) = places.split_first()?;
        let mut rows = Places { low: Row3::default(), high: Row3::default() };
        // Lanes to spare repeat the first place.
        for lane in 0..LANES {
            let place = lane.checked_sub(1).and_then(|lane| rest.get(lane)).unwrap_or(first);
            rows.low.set(lane, place.low);
            rows.high.set(lane, place.high);
        }
        let mut least = Least { cluster: [0; LANES], value: start };
        let Self { arch, tree, thin, around, radii, bounded, guess, .. } = self;
        let (guess, least_of) = (*guess, &mut least);
        let boxes = Boxes { tree, radii, around, bones };
        let places = &rows;
        arch.dispatch(Search { boxes, thin, bounded, guess, places, size, until, least: least_of });
        Some(least)
    }

    /// Whether the search in order reaches a cluster or an equal value before it: no ancestor has a greater value.
    fn is_reached(
        &mut self,
        cluster: usize,
        least: f64,
        bones: &[DAffine3],
        place: &Bounds,
        size: &impl Size,
    ) -> bool {
        // The value of an ancestor whose box contains that of the cluster is not greater.
        self.is_within(cluster, bones) || {
            let mut node = cluster;
            while let Some(above) = self.parent[node] {
                if size.at(self.bound(above, bones).gap(place), self.thin[above]) > least {
                    return false;
                }
                node = above;
            }
            true
        }
    }

    fn is_within(&mut self, cluster: usize, bones: &[DAffine3]) -> bool {
        if let Some(known) = self.is_within[cluster] {
            return known;
        }
        let own = self.bound(cluster, bones);
        let mut above = self.parent[cluster];
        while let Some(node) = above
            && self.bound(node, bones).holds(&own)
        {
            above = self.parent[node];
        }
        *self.is_within[cluster].insert(above.is_none())
    }

    fn bound(&mut self, node: usize, bones: &[DAffine3]) -> Bounds {
        *self.boxes[node].get_or_insert_with(|| self.tree.bound_at(node, bones))
    }
}

/// Boxes around the clusters below nodes, computed on demand.
struct Boxes<'a> {
    tree: &'a SkinTree,
    radii: &'a [f64],
    around: &'a mut [Option<Bounds>],
    bones: &'a [DAffine3],
}

impl Boxes<'_> {
    fn get(&mut self, node: usize) -> Bounds {
        match self.around[node] {
            Some(known) => known,
            None => self.compute(node),
        }
    }

    fn compute(&mut self, node: usize) -> Bounds {
        let Self { tree, radii, bones, .. } = self;
        let is_cluster = tree.nodes()[node].children.is_none();
        let bounds = if is_cluster {
            tree.bound_at(node, bones)
        } else {
            tree.bound_of_clusters(node, radii, bones)
        };
        *self.around[node].insert(bounds)
    }
}

/// The search for the minimum over all clusters.
struct Search<'a, F> {
    boxes: Boxes<'a>,
    thin: &'a [bool],
    bounded: &'a mut Vec<(usize, Row)>,
    guess: Option<usize>,
    places: &'a Places,
    size: &'a F,
    until: Until,
    least: &'a mut Least,
}

impl<F: Size> Search<'_, F> {
    /// Value of `size` for the box around the clusters below a node at each place.
    #[inline(always)]
    fn at<S: Simd>(&mut self, simd: S, node: usize) -> Row {
        let bounds = self.boxes.get(node);
        sizes(simd, &bounds, self.thin[node], self.places, self.size)
    }
}

impl<F: Size> WithSimd for Search<'_, F> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        if let Some(guess) = self.guess {
            let is_less = take(guess, &self.at(simd, guess), self.least);
            if is_less && self.until == Until::AnyLess {
                return;
            }
        }
        let root = self.at(simd, 0);
        self.bounded.clear();
        self.bounded.push((0, root));
        while let Some((node, here)) = self.bounded.pop() {
            if !is_any_less(simd, &here, &self.least.value) {
                continue;
            }
            let Some([one, other]) = self.boxes.tree.nodes()[node].children else {
                let is_less = take(node, &here, self.least);
                if is_less && self.until == Until::AnyLess {
                    return;
                }
                continue;
            };
            let (first, second) = ((one, self.at(simd, one)), (other, self.at(simd, other)));
            // The nearer child is searched first.
            let middle = LANES / 2;
            let is_nearer = first.1.0[middle] < second.1.0[middle];
            self.bounded.extend(if is_nearer { [second, first] } else { [first, second] });
        }
    }
}

/// Stores a cluster where its value is the least so far; returns whether it is at any place.
#[inline(always)]
fn take(cluster: usize, here: &Row, least: &mut Least) -> bool {
    let mut is_less = false;
    for lane in 0..LANES {
        if here.0[lane] < least.value.0[lane] {
            (least.cluster[lane], least.value.0[lane]) = (cluster, here.0[lane]);
            is_less = true;
        }
    }
    is_less
}

/// Whether a lane of the first row is less than that of the second.
#[inline(always)]
fn is_any_less<S: Simd>(simd: S, one: &Row, other: &Row) -> bool {
    let mut greatest = f64::NEG_INFINITY;
    for part in 0..Part::<S>::COUNT {
        let part = Part { simd, part };
        greatest = greatest.max(simd.reduce_max_f64s((part.get(other) - part.get(one)).value));
    }
    greatest > 0.0
}

/// Value of `size` for the gap of a box to each place, with the bits of [`Bounds::gap`].
#[inline(always)]
fn sizes<S: Simd>(simd: S, bounds: &Bounds, thin: bool, places: &Places, size: &impl Size) -> Row {
    let mut out = Row::default();
    for part in 0..Part::<S>::COUNT {
        let part = Part { simd, part };
        let (low, high) = (part.get3(&places.low), part.get3(&places.high));
        let x = apart([bounds.low.x, bounds.high.x], low.x, high.x);
        let y = apart([bounds.low.y, bounds.high.y], low.y, high.y);
        let z = apart([bounds.low.z, bounds.high.z], low.z, high.z);
        part.put(&mut out, size.at((x * x + y * y + z * z).sqrt(), thin));
    }
    out
}

/// Distance between a range and the range in each lane.
#[inline(always)]
fn apart<R: Real>([own_low, own_high]: [f64; 2], low: R, high: R) -> R {
    (low.splat(own_low) - high).max(low - low.splat(own_high)).max(low.splat(0.0))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::surface::tests::{Dice, random_bones, tube};
    use super::*;

    /// Like target lengths of segments: a minimum, a slope, a maximum, and smaller at thin edges.
    struct Target;

    impl Size for Target {
        fn at<R: Real>(&self, gap_m: R, thin: bool) -> R {
            let all = |value: f64| gap_m.splat(value);
            let at = |least: f64, within: f64| {
                (all(least) + all(0.3) * (gap_m - all(within)).max(all(0.0))).min(all(MOST))
            };
            if thin { at(0.02, 0.2) } else { at(0.05, 0.3) }
        }
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
        let (mut dice, mut counts) = (Dice(11), [0; 5]);
        for _ in 0..60 {
            let bones = random_bones(tree.skin(), &mut dice);
            let mut at = dice.point() * 7.0;
            approach.begin();
            for count in 0..25 {
                // Runs of one to eight places.
                let places: Vec<Bounds> = (0..1 + count % LANES)
                    .map(|_| {
                        let next = at + dice.point() * 0.3;
                        Bounds::around(&[std::mem::replace(&mut at, next), next])
                    })
                    .collect();
                let mut all_found = vec![0.0; places.len()];
                approach.least(&bones, &places, MOST, &Target, &mut all_found);
                let limits: Vec<f64> =
                    all_found.iter().map(|found| found * (1.0 + 0.2 * dice.point().x)).collect();
                let is_below = approach.is_any_below(&bones, &places, &limits, &Target);
                let is_expected = all_found.iter().zip(&limits).any(|(found, limit)| found < limit);
                assert!(is_below || !is_expected, "{all_found:?} m, {limits:?} m");
                counts[3] += usize::from(is_expected);
                counts[4] += usize::from(!is_below);
                for (place, found) in places.iter().zip(all_found) {
                    let expected = Approach::new(Arc::clone(&tree))
                        .least_in_order(&bones, place, MOST, &Target);
                    assert_eq!(found.to_bits(), expected.to_bits());
                    let of_cluster = |(index, thin): (usize, &bool)| {
                        let is_leaf = tree.nodes()[index].children.is_none();
                        let gap_m = || tree.bound_at(index, &bones).gap(place);
                        is_leaf.then(|| Target.at(gap_m(), *thin))
                    };
                    let all = approach.thin.iter().enumerate().filter_map(of_cluster);
                    let least = all.fold(MOST, f64::min);
                    assert!(least <= found);
                    counts[0] += usize::from(found < MOST);
                    counts[1] += usize::from(found < 0.06);
                    counts[2] += usize::from(least < found);
                }
            }
        }
        assert!(
            counts[0] > 1000 && counts[1] > 100 && counts[2] > 100 && counts[2] < counts[0] / 2,
            "{counts:?}: both searches must determine results often"
        );
        assert!(counts[3] > 100 && counts[4] > 100, "{counts:?}: some are below a limit, some not");
    }

    /// The box of every node contains those of all clusters below it, in random postures.
    #[test]
    fn boxes_contain_the_clusters_below_them() {
        let tree = SkinTree::new(Arc::new(tube()));
        let approach = Approach::new(Arc::new(tree.clone()));
        let mut dice = Dice(5);
        for _ in 0..10 {
            let bones = random_bones(tree.skin(), &mut dice);
            let clusters =
                (0..tree.nodes().len()).filter(|node| tree.nodes()[*node].children.is_none());
            for cluster in clusters {
                let own = tree.bound_at(cluster, &bones);
                let mut above = approach.parent[cluster];
                while let Some(node) = above {
                    let around = tree.bound_of_clusters(node, &approach.radii, &bones);
                    assert!(around.holds(&own), "cluster {cluster} in node {node}");
                    above = approach.parent[node];
                }
            }
        }
    }

    #[test]
    fn a_whale_without_skin_has_no_distance() {
        let mut approach = Approach::new(Arc::new(SkinTree::new(Arc::default())));
        approach.begin();
        let mut found = [0.0];
        approach.least(&[], &[Bounds::around(&[DVec3::ZERO])], MOST, &Target, &mut found);
        assert!((found[0] - MOST).abs() < 1e-15);
    }
}
