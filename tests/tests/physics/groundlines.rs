//! Groundlines and surface buoys against what was seen at sea (V11, V12; Jonesport).

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::{Linked, library, report, root};
use endline_gear::{Options, Scenario, Sources, assemble};

use endline_sim::model::BodyRole;
use endline_sim::statics::Settled;
use endline_sim::{Model, settle};

/// Half of 20 fathoms between traps [m].
const HALF_SPAN_M: f64 = 18.3;

/// Two traps 20 fathoms apart on gangions with a groundline of `rope`, `slack` longer than its span.
fn groundline(rope: &str, slack: f64, speed: f64, heading: f64) -> (Model, Settled) {
    let mut sources = Sources::from_folder(&root()).unwrap();
    let mut text = String::from("format = 1\nkind = \"assembly\"\nname = \"Groundline\"\n");
    for (end, x) in [("a", -HALF_SPAN_M), ("b", HALF_SPAN_M)] {
        text += &format!(
            "[[body]]\nid = \"trap-{end}\"\nkind = \"trap\"\nitem = \"wire-lobster-3ft\"\nposition = [\"{x} m\", \"0 m\"]\nheight = 0\n"
        );
    }
    let length = 2.0 * HALF_SPAN_M * (1.0 + slack);
    text += &format!(
        "[[line]]\nid = \"groundline\"\nrope = \"{rope}\"\nfrom = \"trap-a\"\nto = \"trap-b\"\nlength = \"{length} m\"\n"
    );
    sources.set("assemblies/groundline.toml", text);
    let (library, problems) = endline_gear::Library::read(&sources);
    assert!(problems.is_empty(), "{}", report(&problems));
    let scenario = format!(
        "format = 1\nkind = \"scenario\"\nname = \"Groundline\"\nduration = \"1 s\"\nrope_nodes = 150\n\
         [site]\nitem = \"jonesport\"\n[current]\nspeed = \"{speed} m/s\"\ntoward = \"90 deg\"\nexponent = 0.0\n\
         [[gear]]\nassembly = \"groundline\"\nheading = \"{} deg\"\n",
        90.0 + heading
    );
    let scenario = Scenario::read("groundline.toml", &scenario)
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let spec = assemble(&scenario, &library, &Linked, &Options::default())
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let model = Model::new(spec).unwrap();
    let settled = settle(&model);
    (model, settled)
}

/// Heights of the groundline's nodes above the seabed [m].
fn heights(model: &Model, settled: &Settled) -> Vec<f64> {
    settled.state.rope.position.iter().map(|place| place.z + model.spec.water.depth_m).collect()
}

/// Greatest height of the groundline away from its traps, a tenth of its length at each end left out [m].
fn arc(rope: &str, slack: f64, speed: f64, heading: f64) -> f64 {
    let (model, settled) = groundline(rope, slack, speed, heading);
    assert!(
        settled.converged,
        "{rope}, slack {slack}, {speed} m/s, {heading} deg: {} N",
        settled.residual_n
    );
    let heights = heights(&model, &settled);
    let end = heights.len() / 10;
    heights[end..heights.len() - end].iter().fold(0.0, |top, height| top.max(*height))
}

/// Jonesport: 20 fathoms of floating groundline between traps arc 2 m at most, in 0.30 m/s that hardly ever slacks.
#[test]
fn floating_groundline_across_the_tide_arcs_no_higher_than_seen() {
    for (slack, heading) in [(0.02, 45.0), (0.02, 90.0), (0.05, 45.0), (0.05, 90.0)] {
        let arc = arc("pp-3-8", slack, 0.3, heading);
        assert!(arc > 0.36 && arc <= 2.0, "slack {slack}, {heading} deg: {arc} m");
    }
}

/// Without current the arc is that of a chain turned over: `sinh` catenary of the same length between the traps' tops.
#[test]
fn floating_groundline_at_slack_tide_is_a_catenary() {
    for slack in [0.02, 0.05] {
        let (model, settled) = groundline("pp-3-8", slack, 0.0, 0.0);
        assert!(settled.converged);
        let place = &settled.state.rope.position;
        let span = (place[place.len() - 1] - place[0]).length();
        let length = 2.0 * HALF_SPAN_M * (1.0 + slack);
        // 2 a sinh(span / 2a) = length, by bisection on the parameter a.
        let (mut low, mut high) = (span / 20.0, span * 100.0);
        for _ in 0..200 {
            let a = 0.5 * (low + high);
            if 2.0 * a * (span / (2.0 * a)).sinh() > length { low = a } else { high = a }
        }
        let rise = low * ((span / (2.0 * low)).cosh() - 1.0);
        let top = heights(&model, &settled).iter().fold(0.0_f64, |top, height| top.max(*height));
        let foot = place[0].z + model.spec.water.depth_m;
        assert!(
            (top - foot - rise).abs() < 0.02,
            "slack {slack}: {top} over {foot}, catenary {rise}"
        );
    }
}

/// Specific gravity 1.03 and 1.17: on the bottom away from the traps, at slack tide; the heavier along the tide too.
#[test]
fn sinking_groundline_lies_on_the_bottom() {
    for (rope, slack, speed) in [
        ("sink-103-3-8", 0.02, 0.0),
        ("sink-103-3-8", 0.05, 0.0),
        ("sink-3-8", 0.02, 0.0),
        ("sink-3-8", 0.05, 0.0),
        ("sink-3-8", 0.02, 0.3),
        ("sink-3-8", 0.05, 0.3),
    ] {
        let arc = arc(rope, slack, speed, 0.0);
        assert!(arc < 0.01, "{rope}, slack {slack}, {speed} m/s: {arc} m");
    }
}

/// A poly ball of 601 N on 3/8 in rope at Jonesport with its anchor held: where it floats [m] and what pulls it [N].
fn ball(speed: f64) -> (f64, f64) {
    let scenario = format!(
        "format = 1\nkind = \"scenario\"\nname = \"Buoy\"\nduration = \"1 s\"\nrope_nodes = 150\n\
         [site]\nitem = \"jonesport\"\n[current]\nspeed = \"{speed} m/s\"\ntoward = \"90 deg\"\n\
         [[gear]]\nassembly = \"single\"\n[gear.attributes]\nbuoy = \"polyball-60\"\n"
    );
    let scenario = Scenario::read("ball.toml", &scenario)
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let mut spec = assemble(&scenario, &library(), &Linked, &Options::default())
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    for body in spec.bodies.iter_mut().filter(|body| body.role == BodyRole::Trap) {
        body.held_until_s = Some(0.0);
    }
    let model = Model::new(spec).unwrap();
    let settled = settle(&model);
    assert!(settled.converged, "{speed} m/s: {} N", settled.residual_n);
    let buoy = model.spec.bodies.iter().position(|body| body.role == BodyRole::Buoy).unwrap();
    let pull = settled.state.rope.tension.iter().fold(0.0_f64, |most, pull| most.max(*pull));
    (settled.state.bodies[buoy].position.z, pull)
}

/// It goes under where the rope pulls it down with all that its buoyancy leaves after its own weight, not before:
/// at rest a floating ball bears less than that, a drowned one all of it.
#[test]
fn a_poly_ball_goes_under_when_the_line_pulls_with_its_net_buoyancy() {
    let net = (1025.0 * 0.0597 - 3.3) * 9.81;
    for speed in [0.3, 0.46, 1.0, 1.4] {
        let (height, pull) = ball(speed);
        assert!(height > -0.1 && pull < net, "{speed} m/s: {height} m, {pull} N of {net} N");
    }
    for speed in [2.2, 2.6] {
        let (height, pull) = ball(speed);
        assert!(height < -0.485 && pull > net, "{speed} m/s: {height} m, {pull} N of {net} N");
    }
}
