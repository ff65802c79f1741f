//! The flukes: two blades from the halves of the trunk's last row.
//!
//! The root of a blade is half the last row and the outline of the midline from there over the notch and back. The rings of
//! the blade are plain sections of a fluke plus the difference between root and plain section, which decreases outward.

use std::f64::consts::PI;

use endline_sdk::Region;
use endline_sim::whale::Mark;
use glam::{DVec2, DVec3};

use super::Builder;
use super::bones::{FLUKE_BENDS, Skeleton, Weights};
use super::fin::{Section, fillet, spans, tip_bluntness, tip_rounding};
use super::flipper::EDGE;
use super::form::WhaleForm;
use super::mesh::Corner;
use super::trunk::{HALF_AROUND, flukes_at, smooth_step};

/// Rings between midline and tip.
const RINGS: usize = 18;
/// Vertices of the midline on each side of the notch.
const MIDLINE: usize = 7;
/// Vertices around a section.
const AROUND: usize = HALF_AROUND + 2 * MIDLINE + 2;
/// Share of the half span over which the base blends into the body.
const FILLET: f64 = 0.42;
/// Rounding of the notch's bottom [share of half span].
const NOTCH_ROUNDING: f64 = 0.02;

/// Adds the left fluke to the trunk's last row.
pub fn add(build: &mut Builder, back: &[u32]) {
    let midline: Vec<Corner> = (0..2 * MIDLINE + 1).map(|vertex| midline(build, vertex)).collect();
    let midline = build.half.row(midline);
    let root: Vec<u32> = back.iter().chain(&midline).copied().collect();
    let places: Vec<DVec3> = root.iter().map(|&vertex| build.half.place(vertex)).collect();
    let (mut before, mut inner) = (root, 0.0);
    for s in spans(RINGS) {
        let ring: Vec<Corner> = places
            .iter()
            .enumerate()
            .map(|(vertex, &root)| corner(build, s, vertex, root))
            .collect();
        let ring = build.half.row(ring);
        let section = section(build.form, (s + inner) / 2.0);
        let regions: Vec<Region> = (0..AROUND)
            .map(|patch| region(&section, patch_x(build, &[&before, &ring], patch)))
            .collect();
        build.half.ring(&before, &ring, |patch| regions.get(patch).copied());
        (before, inner) = (ring, s);
    }
    let end = section(build.form, 1.0);
    let place = plain(build, 1.0, (end.lead + end.trail) / 2.0, 0.0);
    let tip = Corner { place, weights: weights(build, &place, 1.0), mark: Mark::Skin };
    let tip = build.half.add(tip);
    build.half.fan_in(&before, tip, |_| Region::LeftFluke);
}

/// Share of the outline of a vertex of the root, from the leading edge over the upper side. The middle of the half row is
/// the leading edge, the notch the trailing edge.
fn share(vertex: f64) -> f64 {
    (HALF_AROUND as f64 / 2.0 - vertex) / AROUND as f64
}

/// Outline of the midline from the belly over the notch to the back, without its ends on the trunk's last row.
fn midline(build: &Builder, vertex: usize) -> Corner {
    let from = flukes_at(build.form);
    let steps = (MIDLINE + 1) as f64;
    let off = (vertex as f64 + 1.0 - steps) / steps;
    // `at` from the row (|off| = 1) to the notch (0), denser at the notch.
    let at = from + (1.0 - from) * (1.0 - off * off * (0.55 + 0.45 * off.abs()));
    let round = tip_rounding((at - from) / (1.0 - from), 20.0);
    let (middle, half) = (build.sections.height(at), build.sections.halves(at).y * round);
    let height = if off == 0.0 { middle } else { middle + half.copysign(off) };
    let mut place = build.sections.place(at, DVec2::Y * height);
    place.y = 0.0;
    Corner { place, weights: build.skeleton.along_body(at), mark: Mark::Skin }
}

fn corner(build: &Builder, s: f64, vertex: usize, root: DVec3) -> Corner {
    let part = share(vertex as f64);
    let at_middle = section(build.form, 0.0).corner(part);
    let off = root - plain(build, 0.0, at_middle.0, at_middle.1);
    let (x, z, _) = section(build.form, s).corner(part);
    let left = 1.0 - smooth_step(0.0, FILLET, s);
    let place = plain(build, s, x, z) + off * DVec3::new(fillet(s, FILLET), left, left);
    Corner { place, weights: weights(build, &place, s), mark: Mark::Skin }
}

/// A place on the plain fluke: share of the half span, `x` relative to the snout (negative) and height [m].
fn plain(build: &Builder, s: f64, x: f64, z: f64) -> DVec3 {
    let form = build.form;
    let height = form.flukes.height * build.sections.breadth() * form.length_m;
    DVec3::new(form.length_m / 2.0 + x, s * form.flukes.span / 2.0 * form.length_m, height + z)
}

/// Section of the flukes; `x` is relative to the snout and negative [m].
fn section(form: &WhaleForm, out: f64) -> Section {
    let flukes = &form.flukes;
    let reach = libm::tan(flukes.sweep) * flukes.span / 2.0;
    let lead = 1.0 - flukes.root_chord + reach * libm::pow(out, 1.3);
    let tip_trail = 1.0 - flukes.root_chord + reach + flukes.tip_chord;
    let off = libm::sqrt(out * out + NOTCH_ROUNDING * NOTCH_ROUNDING) - NOTCH_ROUNDING;
    let lobe = 1.0 + flukes.notch * (1.0 - libm::exp(-off / 0.05));
    let trail = lobe + (tip_trail - 1.0 - flukes.notch) * out * out - 0.006 * libm::sin(PI * out);
    let chord = (trail - lead).max(0.2 * flukes.tip_chord) * form.length_m;
    let middle = -(lead + trail) / 2.0 * form.length_m;
    let half_chord = chord / 2.0 * tip_rounding(out, 16.0);
    let half_thickness =
        chord / 2.0 * (flukes.thickness + (flukes.tip_thickness - flukes.thickness) * out);
    let blunt =
        tip_bluntness(flukes.edge_radius_m, flukes.span / 2.0 * form.length_m, half_thickness);
    Section {
        lead: middle + half_chord,
        trail: middle - half_chord,
        half_thickness: half_thickness * tip_rounding(out, blunt),
        edge_radius: flukes.edge_radius_m,
    }
}

/// Weights: the middle follows the end of the peduncle, the rest blade and tip.
fn weights(build: &Builder, place: &DVec3, s: f64) -> Weights {
    let [blade, tip] = build.skeleton.fluke;
    let to_blade = smooth_step(FLUKE_BENDS[0] - 0.18, FLUKE_BENDS[0] + 0.18, s);
    let to_tip = smooth_step(FLUKE_BENDS[1] - 0.2, FLUKE_BENDS[1] + 0.2, s);
    let body = build.skeleton.along_body(0.5 - place.x / build.form.length_m);
    Skeleton::hand_over(Skeleton::hand_over(body, blade, to_blade), tip, to_tip)
}

/// Region by the place of a patch along the chord, which differs from its number at the root.
fn region(section: &Section, x: f64) -> Region {
    let along = (2.0 * x - section.lead - section.trail) / (section.lead - section.trail);
    match along {
        along if along > EDGE => Region::LeftFlukeLeading,
        along if along < -EDGE => Region::LeftFlukeTrailing,
        _ => Region::LeftFluke,
    }
}

/// Middle of a patch between two rings, relative to the snout [m].
fn patch_x(build: &Builder, rings: &[&[u32]; 2], patch: usize) -> f64 {
    let places = rings.iter().flat_map(|ring| [ring[patch], ring[(patch + 1) % AROUND]]);
    places.map(|vertex| build.half.place(vertex).x).sum::<f64>() / 4.0 - build.form.length_m / 2.0
}
