//! Lines that start wrapped about the whale, just outside the posed skin.
//!
//! A wrap is taut about the sections of a body part; its azimuth is found by a search (`helix.rs`). Rope between wraps is
//! straight, or leads over the trunk if it would pass through it. Each path section is cut into segments of its own length,
//! with the rope laid evenly along it. Finally nodes are shifted outward until all segments are outside the skin (`skin.rs`).

mod helix;
mod skin;

use endline_sdk::{BodyPart, Limb};
use endline_sim::DVec3;
use endline_sim::model::Rope;

use crate::limits;
use crate::scenario::WrapOf;

use super::builder::Builder;
use super::line_shapes::{along, length};
use helix::Helix;
use skin::PosedSkin;

/// Initial gap between rope and skin [m]: the rope touches as soon as it moves.
const OFF_SKIN_M: f64 = 1e-5;
/// Tolerance of a path longer than its rope, as a share, for rounding.
const TAUT: f64 = 1e-6;

impl Builder<'_> {
    /// Lays a line in its wraps and cuts it, with segments of at most `coarse_m`.
    pub fn lay_wrapped(&mut self, index: usize, wraps: &[WrapOf], coarse_m: f64) {
        let place = self.uncut[index].place.clone();
        if !self.spec.settings.as_placed {
            let help = "write start = \"placed\" at the top of the scenario: statics does not include the whale";
            return self.problems.push(place.error("a wrapped line starts where it is laid", help));
        }
        let Some(whale) = &self.spec.whale else {
            // A failed whale has been reported.
            if self.scenario.whale.is_none() {
                self.problems.push(place.error(
                    "the scenario has no whale to wrap rope about",
                    "add a [whale], or write another start",
                ));
            }
            return;
        };
        let line = &self.spec.lines[index];
        let rope = &self.spec.ropes[line.rope];
        let mut skin = PosedSkin::of(whale, 0.5 * rope.diameter_m + OFF_SKIN_M);
        let ends = [self.joint_place(line.from), self.joint_place(line.to)];
        let line = WrappedLine {
            rope,
            ends,
            helices: wraps.iter().map(|wrap| Helix::of(wrap, rope)).collect(),
            length_m: self.uncut[index].length_m,
            coarse_m,
        };
        match line.lay(&mut skin) {
            Ok(laid) => {
                self.spec.lines[index].segments_m = laid.segments_m;
                self.spec.lines[index].start_m = laid.nodes;
            }
            Err(wrong) => {
                let at = wrong.wrap.map_or(&place, |wrap| &wraps[wrap].place);
                let message = format!("line `{}`: {}", self.spec.lines[index].id, wrong.what);
                self.problems.push(at.error(message, wrong.help));
            }
        }
    }
}

/// Why a line cannot be wrapped.
pub(super) struct Wrong {
    /// The wrap, or `None` for the whole line.
    pub wrap: Option<usize>,
    /// What is wrong.
    pub what: String,
    /// What to change.
    pub help: &'static str,
}

/// A line to be wrapped.
struct WrappedLine<'a> {
    rope: &'a Rope,
    /// Its ends [m].
    ends: [DVec3; 2],
    /// Its wraps, from end A.
    helices: Vec<Helix<'a>>,
    /// Unstretched length [m].
    length_m: f64,
    /// Longest segment [m].
    coarse_m: f64,
}

impl WrappedLine<'_> {
    /// Nodes and segments of the first path outside the skin.
    fn lay(&self, skin: &mut PosedSkin) -> Result<Laid, Wrong> {
        self.check_reach()?;
        let ways = helix::azimuths(skin, &self.helices, self.ends)
            .map_err(|(wrap, what)| no_place(wrap, what))?;
        let mut first_wrong = None;
        for azimuths in ways {
            match self.lay_from(&azimuths, skin) {
                Ok(laid) => return Ok(laid),
                Err(wrong) => first_wrong = first_wrong.or(Some(wrong)),
            }
        }
        Err(first_wrong.unwrap_or_else(|| no_place(0, "there is no path round it".into())))
    }

    /// Checks that the distance of the ends is at most the length of the rope, before the search.
    fn check_reach(&self) -> Result<(), Wrong> {
        let (needs_m, has_m) = (self.ends[0].distance(self.ends[1]), self.length_m);
        if needs_m <= has_m {
            return Ok(());
        }
        Err(too_short(needs_m, has_m))
    }

    /// Nodes and segments for the azimuths of the wraps [rad].
    fn lay_from(&self, azimuths: &[f64], skin: &mut PosedSkin) -> Result<Laid, Wrong> {
        let mut sections = self.sections(azimuths, skin)?;
        share_out(&mut sections, self.length_m)
            .map_err(|(needs_m, has_m)| too_short(needs_m, has_m))?;
        limits::check_nodes(most_segments(&sections, self.coarse_m)).map_err(|beyond| Wrong {
            wrap: None,
            what: beyond.message,
            help: "write a longer `segment` for its wraps",
        })?;
        let mut laid = cut(&sections, self.coarse_m);
        skin::shift_off(skin, &mut laid).map_err(|region| Wrong {
            wrap: None,
            what: format!("its path passes through the whale's {region}"),
            help: "choose another `azimuth` or `station`, or move its ends",
        })?;
        Ok(laid)
    }

    /// The path sections: wraps, and the sections before, between and after them.
    fn sections(&self, azimuths: &[f64], skin: &PosedSkin) -> Result<Vec<PathSection>, Wrong> {
        let mut sections = Vec::with_capacity(2 * self.helices.len() + 1);
        let mut at = self.ends[0];
        for (number, (helix, azimuth)) in self.helices.iter().zip(azimuths).enumerate() {
            let way = helix.lay(skin, *azimuth).map_err(|what| no_place(number, what))?;
            let begin = way.first().copied().unwrap_or(at);
            sections.push(between(skin, [at, begin], helix.wrap.before_m));
            at = way.last().copied().unwrap_or(at);
            sections.push(helix.section_of(way, self.rope));
        }
        sections.push(between(skin, [at, self.ends[1]], None));
        Ok(sections)
    }
}

fn too_short(needs_m: f64, has_m: f64) -> Wrong {
    Wrong {
        wrap: None,
        what: format!("its path needs {needs_m:.2} m of rope, and it has {has_m:.2} m"),
        help: "write a greater length, move its ends closer, or remove `before`",
    }
}

fn no_place(wrap: usize, what: String) -> Wrong {
    Wrong {
        wrap: Some(wrap),
        what,
        help: "move `station` towards the middle of the part, or write a smaller `pitch` or `turns`",
    }
}

/// A section of the path of a wrapped line: a wrap, or the way between wraps and ends.
struct PathSection {
    /// Its places [m].
    pub way: Vec<DVec3>,
    /// Unstretched rope along it [m]; `None` until it is distributed.
    pub rope_m: Option<f64>,
    /// Longest segment of a wrap [m]; `None` for a section between wraps.
    pub fine_m: Option<f64>,
}

/// Distance of sample places [m].
const EACH_M: f64 = 0.05;
/// Upper bound of the distance of the trunk's skin from its axis over the half diagonal of its section.
const WIDEST: f64 = 1.2;

/// The section between two places, with its rope if that is set.
fn between(skin: &PosedSkin, ends: [DVec3; 2], rope_m: Option<f64>) -> PathSection {
    PathSection { way: way(skin, ends, EACH_M), rope_m, fine_m: None }
}

/// Straight path between two places, led over the trunk, sampled every `each_m`.
fn way(skin: &PosedSkin, [from, to]: [DVec3; 2], each_m: f64) -> Vec<DVec3> {
    let steps = (from.distance(to) / each_m).ceil().max(1.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "metres in steps of centimetres"
    )]
    let steps = steps as u32;
    let over = |step: u32| {
        let place = from.lerp(to, f64::from(step) / f64::from(steps));
        if step == 0 || step == steps { place } else { over_trunk(skin, place) }
    };
    (0..=steps).map(over).collect()
}

/// A place, shifted outward from the trunk's axis if it is inside the trunk.
fn over_trunk(skin: &PosedSkin, place: DVec3) -> DVec3 {
    let trunk = Limb::Trunk.parts().find_map(|part| skin.axis(part));
    let Some(spot) = trunk.and_then(|(axis, _)| axis.locate(place)) else { return place };
    let toward = place - spot.middle;
    if toward.length() > WIDEST * libm::hypot(spot.half_m[0], spot.half_m[1]) + skin.off_m {
        return place;
    }
    let Some(out) = toward.try_normalize() else { return place };
    let along = spot.along();
    let Some(across) = (along - out * along.dot(out)).try_normalize() else { return place };
    match skin.outline(BodyPart::Body, spot.middle, across).radius(out) {
        Some(radius) if toward.length() < radius + skin.off_m => {
            spot.middle + out * (radius + skin.off_m)
        }
        _ => place,
    }
}

/// Growth of segments with the distance from a wrap.
const GROWTH: f64 = 0.4;

/// Nodes of a line and the unstretched lengths between them.
struct Laid {
    /// Places of the nodes, one more than segments [m].
    pub nodes: Vec<DVec3>,
    /// Unstretched length of each segment [m].
    pub segments_m: Vec<f64>,
}

/// Distributes the remaining rope to sections without rope, in proportion to their length. `Err`: needed and available
/// rope [m].
fn share_out(sections: &mut [PathSection], length_m: f64) -> Result<(), (f64, f64)> {
    let fixed: f64 = sections.iter().filter_map(|section| section.rope_m).sum();
    let open: f64 = sections
        .iter()
        .filter(|section| section.rope_m.is_none())
        .map(|section| length(&section.way))
        .sum();
    let left = length_m - fixed;
    let legs = sections.iter().filter(|section| section.fine_m.is_none());
    let short: f64 = legs.filter_map(|leg| Some((length(&leg.way) - leg.rope_m?).max(0.0))).sum();
    if left < open * (1.0 - TAUT) || short > TAUT * length_m {
        return Err((fixed + open + short, length_m));
    }
    let share = if open > 0.0 { left / open } else { 0.0 };
    for section in sections.iter_mut().filter(|section| section.rope_m.is_none()) {
        section.rope_m = Some(share * length(&section.way));
    }
    Ok(())
}

/// Upper bound of the segments that [`cut`] creates, checked before memory is allocated.
fn most_segments(sections: &[PathSection], coarse_m: f64) -> f64 {
    let of = |section: &PathSection| {
        let whole = section.rope_m.unwrap_or_default();
        let grown = sections.iter().filter_map(|other| other.fine_m).fold(coarse_m, f64::min);
        let growing = 2.0 * (1.0 + libm::log(coarse_m / grown) / libm::log1p(GROWTH));
        whole / section.fine_m.unwrap_or(coarse_m) + growing + 1.0
    };
    sections.iter().map(of).sum()
}

/// Cuts the sections: wraps into segments of their own length, others into segments that grow with the distance from a wrap.
fn cut(sections: &[PathSection], coarse_m: f64) -> Laid {
    let mut laid = Laid { nodes: vec![sections[0].way[0]], segments_m: Vec::new() };
    for (number, section) in sections.iter().enumerate() {
        let fine = |other: Option<usize>| other.and_then(|other| sections.get(other)?.fine_m);
        let beside = [fine(number.checked_sub(1)), fine(Some(number + 1))];
        let whole = section.rope_m.unwrap_or_default();
        let lengths = match section.fine_m {
            Some(fine_m) => graded(whole, [None, None], fine_m),
            None => graded(whole, beside, coarse_m),
        };
        let mut passed = 0.0;
        for length_m in lengths {
            passed += length_m;
            laid.nodes.push(along(&section.way, passed / whole));
            laid.segments_m.push(length_m);
        }
    }
    laid
}

/// Lengths with the sum `whole`, at most `coarse`, and graded by the distance from fine neighbours.
fn graded(whole: f64, beside: [Option<f64>; 2], coarse: f64) -> Vec<f64> {
    if whole <= 0.0 {
        return Vec::new();
    }
    let longest = |at: f64| {
        let by =
            |fine: Option<f64>, away: f64| fine.map_or(f64::INFINITY, |fine| fine + GROWTH * away);
        coarse.min(by(beside[0], at)).min(by(beside[1], whole - at))
    };
    let (mut lengths, mut at) = (Vec::new(), 0.0);
    while at < whole {
        let next = longest(at).min(longest((at + longest(at)).min(whole)));
        lengths.push(next);
        at += next;
    }
    lengths.iter_mut().for_each(|length| *length *= whole / at);
    lengths
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn graded_segments_add_up_and_grow_slowly() {
        for (whole, beside, coarse) in [
            (7.3, [Some(0.02), None], 0.5),
            (2.0, [Some(0.05), Some(0.02)], 0.4),
            (0.01, [None, None], 0.4),
        ] {
            let lengths = graded(whole, beside, coarse);
            assert!((lengths.iter().sum::<f64>() - whole).abs() < 1e-12);
            assert!(lengths.iter().all(|length| *length <= coarse + 1e-12), "{lengths:?}");
            assert!(
                lengths.windows(2).all(|pair| pair[1] / pair[0] < 1.9 && pair[0] / pair[1] < 1.9),
                "{lengths:?}"
            );
        }
    }
}
