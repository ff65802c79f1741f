//! Lines that start wrapped about the whale: from end to wrap to wrap to end, just outside the posed skin.
//!
//! A wrap is taut about the sections of a part, going along it (`helix.rs`); where it begins, if it does not say so itself,
//! is found by trying (`choose.rs`). Rope between wraps goes straight, or over the trunk where that would go through it
//! (`leg.rs`). Each stretch is cut into segments by its own length and the rope laid evenly along it (`cut.rs`); last,
//! nodes are moved outward until every segment is clear of the skin (`clear.rs`).

mod choose;
mod clear;
mod cut;
mod helix;
mod leg;
mod skin;
mod stretch;

use endline_sim::DVec3;
use endline_sim::model::Rope;

use crate::limits;
use crate::scenario::WrapOf;

use super::builder::Builder;
use cut::Laid;
use helix::Helix;
use skin::PosedSkin;
use stretch::Stretch;

/// Rope's centre line starts this far from the skin, over its radius [m]: it touches as soon as it moves.
const OFF_SKIN_M: f64 = 1e-5;
/// Way that may be longer than its rope, as a share: rounding.
const TAUT: f64 = 1e-6;

impl Builder<'_> {
    /// Lays a line in its wraps and cuts it: finer in them than `coarse_m`.
    pub fn lay_wrapped(&mut self, index: usize, wraps: &[WrapOf], coarse_m: f64) {
        let place = self.uncut[index].place.clone();
        if !self.spec.settings.as_placed {
            let help =
                "write start = \"placed\" at the top of the scenario: statics knows of no whale";
            return self.problems.push(place.error("a wrapped line starts where it is laid", help));
        }
        let Some(whale) = &self.spec.whale else {
            // A whale that could not be built is reported already.
            if self.scenario.whale.is_none() {
                self.problems.push(place.error(
                    "there is no whale to wrap rope about",
                    "write a [whale], or another start",
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

/// Why a line cannot be wrapped as asked.
pub(super) struct Wrong {
    /// The wrap it is about; the whole line where none.
    pub wrap: Option<usize>,
    /// What is wrong, for the user.
    pub what: String,
    /// What to change, for the user.
    pub help: &'static str,
}

/// A line to be wrapped.
struct WrappedLine<'a> {
    rope: &'a Rope,
    /// Where it begins and ends [m].
    ends: [DVec3; 2],
    /// Its wraps, from end A.
    helices: Vec<Helix<'a>>,
    /// Unstretched length [m].
    length_m: f64,
    /// Longest segment [m].
    coarse_m: f64,
}

impl WrappedLine<'_> {
    /// Nodes and segments between its ends, through its wraps: the first way found that is free.
    fn lay(&self, skin: &mut PosedSkin) -> Result<Laid, Wrong> {
        self.check_reach()?;
        let ways = choose::azimuths(skin, &self.helices, self.ends)
            .map_err(|(wrap, what)| none_there(wrap, what))?;
        let mut first_wrong = None;
        for azimuths in ways {
            match self.lay_from(&azimuths, skin) {
                Ok(laid) => return Ok(laid),
                Err(wrong) => first_wrong = first_wrong.or(Some(wrong)),
            }
        }
        Err(first_wrong.unwrap_or_else(|| none_there(0, "there is no way round it".into())))
    }

    /// Refuses ends that lie farther apart than the rope is long, before ways between them are looked at.
    fn check_reach(&self) -> Result<(), Wrong> {
        let (needs_m, has_m) = (self.ends[0].distance(self.ends[1]), self.length_m);
        if needs_m <= has_m {
            return Ok(());
        }
        Err(too_short(needs_m, has_m))
    }

    /// Nodes and segments, each wrap beginning at its azimuth [rad].
    fn lay_from(&self, azimuths: &[f64], skin: &mut PosedSkin) -> Result<Laid, Wrong> {
        let mut stretches = self.stretches(azimuths, skin)?;
        cut::share_out(&mut stretches, self.length_m)
            .map_err(|(needs_m, has_m)| too_short(needs_m, has_m))?;
        limits::check_nodes(cut::most_segments(&stretches, self.coarse_m)).map_err(|beyond| {
            Wrong {
                wrap: None,
                what: beyond.message,
                help: "write a longer `segment` for its wraps",
            }
        })?;
        let mut laid = cut::cut(&stretches, self.coarse_m);
        clear::clear(skin, &mut laid).map_err(|region| Wrong {
            wrap: None,
            what: format!("its way goes through the whale's {region}"),
            help: "choose another `azimuth` or `station`, or move its ends",
        })?;
        Ok(laid)
    }

    /// Wraps, and the ways to them, between them and on from them.
    fn stretches(&self, azimuths: &[f64], skin: &PosedSkin) -> Result<Vec<Stretch>, Wrong> {
        let mut stretches = Vec::with_capacity(2 * self.helices.len() + 1);
        let mut at = self.ends[0];
        for (number, (helix, azimuth)) in self.helices.iter().zip(azimuths).enumerate() {
            let way = helix.lay(skin, *azimuth).map_err(|what| none_there(number, what))?;
            let begin = way.first().copied().unwrap_or(at);
            stretches.push(leg::lay(skin, [at, begin], helix.wrap.before_m));
            at = way.last().copied().unwrap_or(at);
            stretches.push(helix.stretch(way, self.rope));
        }
        stretches.push(leg::lay(skin, [at, self.ends[1]], None));
        Ok(stretches)
    }
}

fn too_short(needs_m: f64, has_m: f64) -> Wrong {
    Wrong {
        wrap: None,
        what: format!(
            "its way round the whale takes {needs_m:.2} m of rope, and it has {has_m:.2} m"
        ),
        help: "make it longer, bring its ends nearer, or leave `before` out",
    }
}

fn none_there(wrap: usize, what: String) -> Wrong {
    Wrong {
        wrap: Some(wrap),
        what,
        help: "move `station` towards the middle of the part, or make `pitch` or `turns` less",
    }
}
