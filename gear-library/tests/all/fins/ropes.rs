//! Fast random encounters of two ropes at once, or of one rope with itself, with the edges of flippers and flukes.
//!
//! A first strand is met as in `mod.rs`; a second one crosses it within 5 cm of that place, at a distance of one to four
//! thicknesses before or behind it in the direction of the piece, at 20 to 90 degrees. In every other encounter the two are one rope
//! that forms a loop. The piece drives the strands into each other while it presses on them.

use endline_sim::DVec3;
use endline_sim::model::{RopeOnRope, Settings, Whale};

use super::dice::Dice;
use super::piece::strike;
use super::rig::{self, Strand};
use super::{ASLANT, Encounter, Fins, MET, Meeting, SHORTEST_M};

/// Distance that the piece moves after the first strike, at least [m].
const THROUGH_M: f64 = 0.12;
/// Half of each strand [m].
const HALF_M: f64 = 0.4;
/// Longest segments [m].
const LONGEST_M: f64 = 0.05;
/// Pieces of a loop between its strands, at least.
const LOOP_PIECES: f64 = 12.0;

/// Two straight strands, each with its fixture and direction.
struct Strands {
    middles: [DVec3; 2],
    ways: [DVec3; 2],
    segment_m: f64,
}

impl Fins {
    /// The encounter of a number with two strands of rope.
    pub fn encounter_of_two(&self, number: u64) -> Encounter {
        let mut dice = Dice::of(number);
        let Meeting { skin, heading, along, strike: first } = self.meeting(&mut dice);
        let forward = heading * DVec3::X;
        let (speed_m_s, radius_m) = (dice.between(2.0, 20.0), dice.between(0.004, 0.007));
        let looped = number.is_multiple_of(2);
        let (beside, across) = second(&mut dice, along, forward, radius_m, looped);
        let ways = [across, forward];
        let other = strike(&skin, |place| heading * place - beside, ways).map(|other| other.way_m);
        let segment_m = SHORTEST_M * libm::pow(LONGEST_M / SHORTEST_M, dice.share());
        let strands = Strands { middles: [MET, MET + beside], ways: [along, across], segment_m };
        let pull_n = 5.0 * libm::pow(if looped { 20.0 } else { 400.0 }, dice.share());
        let ropes = if looped { vec![strands.looped(pull_n)] } else { strands.apart(pull_n) };
        let law = RopeOnRope { friction: dice.between(0.05, 0.4), ..RopeOnRope::default() };
        let settings = Settings { rope_on_rope: Some(law), as_placed: true, ..Settings::default() };
        let before_m =
            2.0 * radius_m / ASLANT + speed_m_s * settings.contact_step_s * dice.between(0.5, 2.0);
        let way_m = other.map_or(first.way_m, |other| first.way_m.min(other)) - before_m;
        let turn_rate = (dice.direction() * (0.5 * speed_m_s * dice.share())).to_array();
        let whale = Whale {
            position_m: MET + forward * way_m,
            orientation: heading,
            speed_m_s,
            ..rig::whale(skin, speed_m_s, turn_rate)
        };
        let way_on_m = before_m + THROUGH_M + beside.length();
        let steps = (way_on_m / speed_m_s / settings.step_s).ceil() as u64;
        let spec = rig::sea(whale, &ropes, radius_m, dice.between(0.05, 0.6), settings);
        Encounter { speed_m_s, pull_n, steps, spec }
    }
}

/// Where the second strand passes the first, from the place of the strike, and its direction: across the way of the piece
/// as far as the first is. A loop's comes back.
fn second(
    dice: &mut Dice,
    along: DVec3,
    forward: DVec3,
    radius_m: f64,
    looped: bool,
) -> (DVec3, DVec3) {
    let ahead = (forward - along * forward.dot(along)).normalize();
    let aside = along.cross(ahead);
    let side = if dice.share() < 0.5 { -1.0 } else { 1.0 };
    let off_m = side * 2.0 * radius_m * dice.between(1.05, 4.0);
    let turn = dice.between(0.35, std::f64::consts::FRAC_PI_2);
    let turn = if dice.share() < 0.5 { -turn } else { turn };
    let across = along * libm::cos(turn) + aside * libm::sin(turn);
    let beside = along * dice.between(-0.05, 0.05) + ahead * off_m;
    (beside, if looped { -across } else { across })
}

impl Strands {
    /// Two ropes, each held where it begins and pulled at its end.
    fn apart(&self, pull_n: f64) -> Vec<Strand> {
        let strand = |index: usize| Strand { nodes: self.straight(index), pull_n };
        vec![strand(0), strand(1)]
    }

    /// One rope along both, with a loop between them.
    fn looped(&self, pull_n: f64) -> Strand {
        let mut nodes = self.straight(0);
        let next = self.straight(1);
        let (from, to) = (nodes[nodes.len() - 1], next[0]);
        let reach_m = 2.0 * from.distance(to).max(HALF_M);
        let count = (1.3 * reach_m / self.segment_m).max(LOOP_PIECES).ceil() as usize;
        let bend = [self.ways[0] * reach_m, self.ways[1] * reach_m];
        nodes.extend((1..count).map(|k| hermite([from, to], bend, k as f64 / count as f64)));
        nodes.extend(next);
        Strand { nodes, pull_n }
    }

    fn straight(&self, index: usize) -> Vec<DVec3> {
        let count = (2.0 * HALF_M / self.segment_m).round();
        let place = |k: usize| {
            self.middles[index] + self.ways[index] * (HALF_M * (2.0 * k as f64 / count - 1.0))
        };
        (0..=count as usize).map(place).collect()
    }
}

/// The cubic between two places with given derivatives there, at a share of its way.
fn hermite([from, to]: [DVec3; 2], [leaves, comes]: [DVec3; 2], at: f64) -> DVec3 {
    let (square, cube) = (at * at, at * at * at);
    from * (2.0 * cube - 3.0 * square + 1.0)
        + leaves * (cube - 2.0 * square + at)
        + to * (3.0 * square - 2.0 * cube)
        + comes * (cube - square)
}
