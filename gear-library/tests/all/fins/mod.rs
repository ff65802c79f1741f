//! Fast random encounters of rope with the edges of flippers and flukes: a short taut rope, and a piece of the right whale's
//! own skin about a place on an edge, sent through it.
//!
//! An encounter is a function of its number. The rope is in the sea between a fixture and a constant pull of 5 N to 8 kN, with
//! segments of 1.25 to 13 cm. The piece approaches from any side in any attitude at 2 to 20 m/s, rotates, and strikes the
//! rope with an edge. A run begins one or two contact steps before that and ends when the piece has moved [`THROUGH_M`]
//! farther, after at least [`LEAST_STEPS`] steps.
#![allow(
    dead_code,
    clippy::expect_used,
    reason = "each test uses a part of this; a test says what it needs, in its helpers too"
)]

pub mod bodies;
mod dice;
mod piece;
pub mod rig;
mod ropes;
pub mod tally;

use dice::Dice;
use endline_gear::whale::{WhaleForm, build_skin};
use endline_sim::model::{Joint, Line, Settings, Whale};
use endline_sim::whale::Skin;
use endline_sim::{DQuat, DVec3, ModelSpec};
use piece::{Strike, is_edge, piece, reach, strike};

/// Greatest radius of a piece [m].
const REACH_M: f64 = 0.3;
/// Smallest sine of the angle between the direction of the piece and the rope.
const ASLANT: f64 = 0.7;
/// Smallest number of pieces.
const PIECES: usize = 256;
/// Smallest path of the piece after the strike [m].
const THROUGH_M: f64 = 0.04;
/// Smallest number of steps of the model.
const LEAST_STEPS: f64 = 1.0;
/// Largest distance from the rope at which a struck place of an edge passes [m].
const BESIDE_M: f64 = 0.02;
const ROPE_M: f64 = 0.8;
/// Shortest and longest segments [m].
const SHORTEST_M: f64 = 0.0125;
const LONGEST_M: f64 = 0.13;
/// Place of the strike.
const MET: DVec3 = DVec3::new(0.0, 0.0, -50.0);

/// Pieces of fins, each about a place on an edge at its origin.
pub struct Fins(Vec<Skin>);

/// One encounter, ready to run.
pub struct Encounter {
    pub speed_m_s: f64,
    pub pull_n: f64,
    /// Steps of the model.
    pub steps: u64,
    pub spec: ModelSpec,
}

/// A piece in a random attitude whose edge strikes a random rope.
struct Meeting {
    skin: Skin,
    heading: DQuat,
    along: DVec3,
    strike: Strike,
}

impl Fins {
    /// Cuts pieces out of a right whale of 13.7 m.
    pub fn new() -> Self {
        let whole = build_skin(&WhaleForm::right_whale(13.7));
        let on_edges =
            whole.triangles.iter().zip(&whole.regions).filter(|(_, region)| is_edge(**region));
        let mut edges: Vec<u32> = on_edges.flat_map(|(corners, _)| *corners).collect();
        edges.sort_unstable();
        edges.dedup();
        let pieces: Vec<Skin> = edges
            .iter()
            .map(|vertex| piece(&whole, *vertex))
            .filter(|piece| reach(piece) < REACH_M)
            .collect();
        assert!(
            pieces.len() > PIECES,
            "{} pieces of {} places on edges",
            pieces.len(),
            edges.len()
        );
        Self(pieces)
    }

    /// The encounter of a number, tested along every path, or only at the end of each step of the model.
    pub fn encounter(&self, number: u64, swept: bool) -> Encounter {
        let usual = Settings::default();
        let contact_step_s = if swept { usual.contact_step_s } else { usual.step_s };
        self.drawn(number, Settings { swept, contact_step_s, ..usual })
    }

    /// The encounter of a number with rope of neutral weight, from farther off and without rotation: the rope is held before the piece comes
    /// near.
    pub fn approach(&self, number: u64) -> Encounter {
        let mut encounter =
            self.drawn(number, Settings { holds_still: true, ..Settings::default() });
        let density_kg_m3 = encounter.spec.water.density_kg_m3;
        for rope in &mut encounter.spec.ropes {
            rope.mass_kg_m = density_kg_m3 * rope.displaced_m3_m;
        }
        encounter
    }

    /// The approach of a number, with another rope far from it, so that the ropes are held apart from each other.
    pub fn approach_in_field(&self, number: u64) -> Encounter {
        let mut encounter = self.approach(number);
        let spec = &mut encounter.spec;
        let aside = DVec3::new(400.0, 0.0, 0.0);
        let joints = spec.joints.len();
        let others = spec.joints.iter().map(|joint| Joint {
            id: format!("other {}", joint.id),
            position_m: joint.position_m + aside,
            ..joint.clone()
        });
        let others: Vec<Joint> = others.collect();
        spec.joints.extend(others);
        let line = &spec.lines[0];
        let start_m = line.start_m.iter().map(|place| *place + aside).collect();
        let (from, to) = (line.from + joints, line.to + joints);
        spec.lines.push(Line { id: "other".into(), from, to, start_m, ..line.clone() });
        encounter
    }

    fn drawn(&self, number: u64, settings: Settings) -> Encounter {
        let mut dice = Dice::of(number);
        let Meeting { skin, heading, along, strike } = self.meeting(&mut dice);
        let (speed_m_s, radius_m) = (dice.between(2.0, 20.0), dice.between(0.004, 0.007));
        let pull_n = 5.0 * libm::pow(1600.0, dice.share());
        let turn_rate = (dice.direction() * (0.5 * speed_m_s * dice.share())).to_array();
        let friction = dice.between(0.05, 0.6);
        let forward = heading * DVec3::X;
        let (turn_rate, before_s) = if settings.holds_still {
            ([0.0; 3], dice.between(0.3, 1.0))
        } else {
            (turn_rate, Settings::default().contact_step_s * dice.between(0.5, 2.0))
        };
        let before_m = radius_m / ASLANT + speed_m_s * before_s;
        let whale = Whale {
            position_m: MET + forward * (strike.way_m - before_m),
            orientation: heading,
            speed_m_s,
            ..rig::whale(skin, speed_m_s, turn_rate)
        };
        let steps =
            ((before_m + THROUGH_M) / speed_m_s / settings.step_s).ceil().max(LEAST_STEPS) as u64;
        let held = MET + along * (strike.least_along_m - dice.between(0.1, 0.3));
        let segments = (ROPE_M / (SHORTEST_M * libm::pow(LONGEST_M / SHORTEST_M, dice.share())))
            .round() as usize;
        let rope = rig::Taut { held, along, pull_n, radius_m, length_m: ROPE_M, segments };
        Encounter { speed_m_s, pull_n, steps, spec: rope.rig(whale, friction, settings) }
    }

    /// Draws pieces and paths until an edge strikes. The rope is directed so that the piece drifts away from its fixture.
    fn meeting(&self, dice: &mut Dice) -> Meeting {
        loop {
            let piece = &self.0[(dice.share() * self.0.len() as f64) as usize % self.0.len()];
            let (turned, heading, beside, along) =
                (dice.turn(), dice.turn(), dice.direction() * BESIDE_M, dice.direction());
            let forward = heading * DVec3::X;
            let along = if along.dot(forward) < 0.0 { -along } else { along };
            if forward.cross(along).length() < ASLANT {
                continue;
            }
            let strike =
                strike(piece, |place| heading * (turned * place + beside), [along, forward]);
            if let Some(strike) = strike.filter(|strike| is_edge(strike.region)) {
                let mut skin = piece.clone();
                skin.vertices.iter_mut().for_each(|place| *place = turned * *place + beside);
                return Meeting { skin, heading, along, strike };
            }
        }
    }
}
