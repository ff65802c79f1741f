//! Head, body and peduncle: one closed piece.

use std::f64::consts::TAU;

use endline_sdk::Region;
use endline_sim::whale::Mark;

use super::bones::Skeleton;
use super::curve::smooth_step;
use super::form::WhaleForm;
use super::part::{Corner, Part, Rings, Weights};
use super::section::{CAP, SLIT, Sections};

/// Columns around the body, so that no two facets turn by more than 5.6 degrees.
const AROUND: usize = 64;
/// Rings in the rounded snout.
const SNOUT: usize = 5;
/// Rings in the tail's rounded end, hidden in the flukes.
const TAIL: usize = 2;
/// Rings between the rounded ends.
const ALONG: usize = 56;
/// Angle from the back below which the lips are chin and throat [rad].
const CHIN: f64 = 1.95;

/// The body of a whale.
#[must_use]
pub fn body(form: &WhaleForm, sections: &Sections, skeleton: &Skeleton) -> Part {
    let places = ring_places();
    let corner = |at: f64, column: usize| {
        let angle = TAU * count(column) / count(AROUND);
        let mark = mark(form, sections, at, angle.min(TAU - angle));
        Corner { place: sections.surface(at, angle), weights: weights(form, sections, skeleton, at, angle), mark }
    };
    let pole = |at: f64| Corner { place: sections.axis(at), weights: skeleton.along_body(at), mark: Mark::Skin };
    let rings = places.iter().map(|&at| (0..AROUND).map(|column| corner(at, column)).collect()).collect();
    let rings = Rings { first_pole: pole(0.0), rings, last_pole: pole(1.0) };
    Part::closed(&rings, |ring, column| {
        let before = if ring == 0 { 0.0 } else { places[ring - 1] };
        let after = places.get(ring).copied().unwrap_or(1.0);
        let column = column.min(AROUND - 1 - column);
        let from_back = TAU * (count(column) + 0.5) / count(AROUND);
        match region(form, sections, (before + after) / 2.0, from_back) {
            // The front of the mouth: it opens between the snout's tip and the jaw.
            Region::Lips | Region::Head if ring == 0 => Region::Baleen,
            own => own,
        }
    })
}

/// Where the rings stand [share of length from the snout].
fn ring_places() -> Vec<f64> {
    let round = |ring: usize, of: usize| CAP * (1.0 - libm::cos(TAU / 4.0 * count(ring) / count(of)));
    let snout = (1..SNOUT).map(|ring| round(ring, SNOUT));
    let middle = (0..=ALONG).map(|ring| CAP + (1.0 - 2.0 * CAP) * count(ring) / count(ALONG));
    let tail = (1..TAIL).rev().map(|ring| 1.0 - round(ring, TAIL));
    snout.chain(middle).chain(tail).collect()
}

/// The spine's weights; the lower jaw takes the lips and the throat, ending at the mouth's corner.
fn weights(form: &WhaleForm, sections: &Sections, skeleton: &Skeleton, at: f64, angle: f64) -> Weights {
    let from_back = angle.min(TAU - angle);
    let below = smooth_step(sections.rostrum_angle(), sections.rostrum_angle() + SLIT, from_back);
    let ahead = 1.0 - smooth_step(0.75 * form.head.mouth, 1.15 * form.head.mouth, at);
    Skeleton::hand_over(skeleton.along_body(at), skeleton.jaw, below * ahead)
}

fn region(form: &WhaleForm, sections: &Sections, at: f64, from_back: f64) -> Region {
    let rostrum = sections.rostrum_angle();
    if at > form.peduncle_start {
        Region::Peduncle
    } else if at > form.head.share {
        Region::Body
    } else if at > form.head.mouth || from_back > CHIN {
        Region::Head
    } else if from_back < rostrum {
        Region::Rostrum
    } else if from_back < rostrum + SLIT {
        Region::Baleen
    } else {
        Region::Lips
    }
}

/// Callosities on the bonnet, the rostrum's ridge and the chin; baleen in the slit; a white patch on the belly.
fn mark(form: &WhaleForm, sections: &Sections, at: f64, from_back: f64) -> Mark {
    let rostrum = sections.rostrum_angle();
    let in_mouth = (0.01..form.head.mouth).contains(&at);
    let on_rostrum = from_back < 0.7 * rostrum && (at < 0.04 || libm::sin(at * 400.0) > 0.2);
    let on_chin = at < 0.06 && from_back > 2.6;
    match from_back {
        angle if in_mouth && angle > rostrum && angle < rostrum + SLIT => Mark::Baleen,
        _ if in_mouth && (on_rostrum || on_chin) => Mark::Callosity,
        angle if (0.48..0.58).contains(&at) && angle > 2.7 => Mark::White,
        _ => Mark::Skin,
    }
}

fn count(number: usize) -> f64 {
    number as f64
}
