//! Body maps of the whale as SVG, from above and from its left side: where rope was seen, and where it is at the end of a story.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use endline_gear::{Observation, PathPlace, Site};
use endline_sdk::Side;
use endline_sim::DVec3;
use endline_sim::whale::Skin;

use super::ending::Ending;

/// Length of the whale in a picture [user units].
const LENGTH: f64 = 1000.0;

/// Space around the whale [user units].
const MARGIN: f64 = 40.0;

/// Unit vectors to the right, up and towards the eye, in the whale's frame (x to the snout, y to port, z up).
type Axes = [DVec3; 3];

/// From above, and from the left side.
const FACES: [(&str, Axes); 2] =
    [("above", [DVec3::X, DVec3::Y, DVec3::Z]), ("left side", [DVec3::NEG_X, DVec3::Z, DVec3::Y])];

/// The state of a site.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// Rope is there, with this probability.
    Rope(f64),
    /// No rope is there, with this probability.
    NoRope(f64),
    /// Not reported, or hidden from view.
    Unknown,
}

impl State {
    /// Its fill colour. Certain states have the strongest colours.
    fn colour(self) -> String {
        let (end, sure) = match self {
            Self::Rope(sure) => ([217, 119, 6], sure),
            Self::NoRope(sure) => ([120, 170, 140], sure),
            Self::Unknown => ([205, 211, 217], 1.0),
        };
        let strength = 0.25 + 0.75 * (2.0 * sure - 1.0).clamp(0.0, 1.0);
        let part = |plain: f64, end: i32| (plain + (f64::from(end) - plain) * strength).round();
        let [red, green, blue] =
            [0, 1, 2].map(|index| part([205.0, 211.0, 217.0][index], end[index]));
        format!("rgb({red},{green},{blue})")
    }
}

/// A whale from one direction: the outline of each site, in order of their nearness to the eye.
struct View {
    name: &'static str,
    /// Site, outline as SVG path data.
    sites: Vec<(Site, String)>,
    /// Centroid of the visible part of each site: on both sides, to port, to starboard.
    middles: BTreeMap<Site, [Option<[f64; 2]>; 3]>,
    height: f64,
}

/// The maps of one whale.
pub(super) struct BodyMaps(Vec<View>);

impl BodyMaps {
    /// Makes the outlines of a whale at rest.
    pub(super) fn of(skin: &Skin) -> Self {
        Self(FACES.into_iter().map(|(name, axes)| View::of(skin, name, axes)).collect())
    }

    /// The outlines as definitions that every map of the page refers to.
    pub(super) fn definitions(&self) -> String {
        let mut text = String::from("<svg width=\"0\" height=\"0\" aria-hidden=\"true\"><defs>");
        for (face, view) in self.0.iter().enumerate() {
            for (site, path) in &view.sites {
                let _ = write!(text, "<path id=\"{}-{face}\" d=\"{path}\"/>", site.name());
            }
        }
        text + "</defs></svg>"
    }

    /// The map of an observation.
    pub(super) fn seen(&self, observation: &Observation) -> String {
        let state = |single: Site| {
            let seen = observation.sites.iter().find(|seen| seen.site.singles().contains(&single));
            match seen {
                Some(seen) if seen.present > 0.5 => State::Rope(seen.present),
                Some(seen) if seen.present < 0.5 => State::NoRope(1.0 - seen.present),
                _ => State::Unknown,
            }
        };
        let wraps = observation.sites.iter().filter(|seen| seen.present > 0.5).filter_map(|seen| {
            let [least, most] = seen.wraps?;
            let words = if least < most { format!("{least} to {most}") } else { least.to_string() };
            Some((seen.site.singles().first().copied()?, format!("{words} turns")))
        });
        let wraps: Vec<(Site, String)> = wraps.collect();
        self.map("seen", state, &wraps, &[&observation.path])
    }

    /// The map of the end of a story.
    pub(super) fn found(&self, ending: &Ending, mirrored: bool) -> String {
        let image = mirrored.then(|| ending.mirrored());
        let ending = image.as_ref().unwrap_or(ending);
        let is_there = |site: Site| ending.sites.iter().any(|at| at.site == site);
        let state = |site: Site| if is_there(site) { State::Rope(1.0) } else { State::NoRope(1.0) };
        let wraps: Vec<(Site, String)> = ending
            .sites
            .iter()
            .filter(|at| at.wraps >= 0.1)
            .map(|at| (at.site, format!("{:.1} turns", at.wraps)))
            .collect();
        let paths: Vec<&[PathPlace]> =
            ending.strands.iter().map(|strand| strand.places.as_slice()).collect();
        let name = if mirrored { "found, mirror image" } else { "found" };
        self.map(name, state, &wraps, &paths)
    }

    fn map(
        &self,
        name: &str,
        state: impl Fn(Site) -> State,
        wraps: &[(Site, String)],
        paths: &[&[PathPlace]],
    ) -> String {
        let width = LENGTH + 2.0 * MARGIN;
        let height: f64 = self.0.iter().map(|view| view.height + 2.0 * MARGIN).sum();
        let mut text = format!(
            "<svg class=\"body-map\" viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" aria-label=\"Rope {name}\">"
        );
        let mut top = 0.0;
        for (face, view) in self.0.iter().enumerate() {
            let _ = write!(text, "<g transform=\"translate({MARGIN},{:.0})\">", top + MARGIN);
            for (site, _) in &view.sites {
                let _ = write!(
                    text,
                    "<use href=\"#{}-{face}\" fill=\"{}\" stroke=\"#46505a\" stroke-width=\"2\"/>",
                    site.name(),
                    state(*site).colour()
                );
            }
            if face == 0 {
                text += &view.paths(paths);
                text += &view.words(wraps);
            }
            let _ = write!(
                text,
                "<text x=\"0\" y=\"-12\" font-size=\"26\" fill=\"currentColor\">{name}, {}</text></g>",
                view.name
            );
            top += view.height + 2.0 * MARGIN;
        }
        text + "</svg>"
    }
}

impl View {
    fn of(skin: &Skin, name: &'static str, [right, up, eye]: Axes) -> Self {
        let bounds = |axis: DVec3| {
            let along = skin.vertices.iter().map(|vertex| vertex.dot(axis));
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
                [low.min(at), high.max(at)]
            })
        };
        let ([left, most_right], [bottom, top]) = (bounds(right), bounds(up));
        let scale = LENGTH / (most_right - left).max(1e-9);
        let flat = |vertex: u32| {
            let vertex = skin.vertices[vertex as usize];
            [(vertex.dot(right) - left) * scale, (top - vertex.dot(up)) * scale]
        };
        let mut by_site: BTreeMap<Site, Vec<[u32; 3]>> = BTreeMap::new();
        for (triangle, region) in skin.triangles.iter().zip(&skin.regions) {
            let [a, b, c] = triangle.map(|vertex| skin.vertices[vertex as usize]);
            if (b - a).cross(c - a).dot(eye) > 0.0 {
                by_site.entry(Site::of_region(*region)).or_default().push(*triangle);
            }
        }
        let nearness = |triangles: &[[u32; 3]]| {
            let of = |vertex: &u32| skin.vertices[*vertex as usize].dot(eye);
            let sum: f64 = triangles.iter().flatten().map(of).sum();
            sum / (3 * triangles.len()).max(1) as f64
        };
        let is_to_port = |triangle: &[u32; 3]| {
            triangle.iter().map(|v| skin.vertices[*v as usize].y).sum::<f64>() > 0.0
        };
        let middles = by_site.iter().map(|(site, triangles)| {
            let on = |port: Option<bool>| {
                let own =
                    triangles.iter().filter(|own| port.is_none_or(|port| port == is_to_port(own)));
                centroid(own.map(|triangle| triangle.map(flat)))
            };
            (*site, [on(None), on(Some(true)), on(Some(false))])
        });
        let middles = middles.collect();
        let mut sites: Vec<(f64, Site, String)> = by_site
            .into_iter()
            .map(|(site, triangles)| (nearness(&triangles), site, outline(&triangles, flat)))
            .collect();
        sites.sort_by(|(one, ..), (other, ..)| one.total_cmp(other));
        Self {
            name,
            sites: sites.into_iter().map(|(_, site, path)| (site, path)).collect(),
            middles,
            height: (top - bottom) * scale,
        }
    }

    /// Middle of a site, on one side of it if that is given; `None` if it cannot be seen.
    fn middle(&self, site: Site, side: Option<Side>) -> Option<[f64; 2]> {
        let of = |single: &Site| {
            let [whole, port, starboard] = *self.middles.get(single)?;
            match side {
                None => whole,
                Some(Side::Left) => port,
                Some(_) => starboard,
            }
        };
        site.singles().iter().find_map(of)
    }

    /// The places along the rope, numbered in their order.
    fn paths(&self, paths: &[&[PathPlace]]) -> String {
        let mut text = String::new();
        for places in paths {
            let at: Vec<[f64; 2]> =
                places.iter().filter_map(|place| self.middle(place.site, place.side)).collect();
            let points: Vec<String> = at.iter().map(|[x, y]| format!("{x:.0},{y:.0}")).collect();
            let _ = write!(
                text,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"#b3261e\" stroke-width=\"5\"/>",
                points.join(" ")
            );
            for (number, [x, y]) in at.iter().enumerate() {
                let _ = write!(
                    text,
                    "<circle cx=\"{x:.0}\" cy=\"{y:.0}\" r=\"17\" fill=\"#b3261e\"/><text x=\"{x:.0}\" y=\"{:.0}\" font-size=\"24\" fill=\"#fff\" text-anchor=\"middle\">{}</text>",
                    y + 8.0,
                    number + 1
                );
            }
        }
        text
    }

    /// Words below the middles of sites.
    fn words(&self, words: &[(Site, String)]) -> String {
        let mut text = String::new();
        for (site, words) in words {
            let Some([x, y]) = self.middle(*site, None) else { continue };
            let _ = write!(
                text,
                "<text x=\"{x:.0}\" y=\"{:.0}\" font-size=\"24\" font-weight=\"bold\" fill=\"#111\" text-anchor=\"middle\" paint-order=\"stroke\" stroke=\"#fff\" stroke-width=\"6\">{words}</text>",
                y + 46.0
            );
        }
        text
    }
}

/// Centroid of triangles; `None` if they have no area.
fn centroid(triangles: impl Iterator<Item = [[f64; 2]; 3]>) -> Option<[f64; 2]> {
    let (mut sum, mut whole) = ([0.0; 2], 0.0);
    for [a, b, c] in triangles {
        let area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs();
        for axis in 0..2 {
            sum[axis] += area * (a[axis] + b[axis] + c[axis]) / 3.0;
        }
        whole += area;
    }
    (whole > 0.0).then(|| sum.map(|sum| sum / whole))
}

/// Outline of triangles as SVG path data: closed loops of the edges that only one of them has.
fn outline(triangles: &[[u32; 3]], flat: impl Fn(u32) -> [f64; 2]) -> String {
    let edges = triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    let all: std::collections::BTreeSet<[u32; 2]> = edges.collect();
    let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for [from, to] in all.iter().filter(|[from, to]| !all.contains(&[*to, *from])) {
        next.entry(*from).or_default().push(*to);
    }
    let mut path = String::new();
    while let Some((first, _)) = next.first_key_value().map(|(from, to)| (*from, to)) {
        let mut at = first;
        let mut command = 'M';
        while let Some(to) = next.get_mut(&at).and_then(Vec::pop) {
            let [x, y] = flat(at);
            let _ = write!(path, "{command}{x:.0} {y:.0}");
            command = 'L';
            if next.get(&at).is_some_and(Vec::is_empty) {
                next.remove(&at);
            }
            at = to;
        }
        path.push('Z');
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles that share an edge have the outline of their square; a third beside them has its own loop.
    #[test]
    fn an_outline_leaves_out_shared_edges_and_closes_each_loop() {
        let flat = |vertex: u32| {
            [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0], [20.0, 0.0], [29.0, 0.0], [20.0, 9.0]]
                [vertex as usize]
        };
        let path = outline(&[[0, 1, 2], [0, 2, 3], [4, 5, 6]], flat);
        assert_eq!(path, "M0 0L9 0L9 9L0 9ZM20 0L29 0L20 9Z");
    }

    #[test]
    fn the_centroid_is_that_of_the_area() {
        let square = [[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]], [[0.0, 0.0], [2.0, 2.0], [0.0, 2.0]]];
        let middle = centroid(square.into_iter()).unwrap();
        assert!((middle[0] - 1.0).abs() < 1e-12 && (middle[1] - 1.0).abs() < 1e-12);
        assert_eq!(centroid(std::iter::empty()), None);
    }
}
