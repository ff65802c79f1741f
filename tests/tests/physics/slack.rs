//! An endline at slack water hangs in one plane: its sinking part and its floating part lie beside each other, not in each other.

use crate::linked::{Linked, library, report, root};
use endline_gear::{Options, Scenario, assemble};
use endline_sim::geometry::distance::segment_segment;
use endline_sim::{Input, Model, State, Workspace, settle, step};

/// The endline of the studies at slack water, both parts made to deliver a strength.
fn endline(lbf: u32, nodes: u32) -> Model {
    let text = std::fs::read_to_string(root().join("scenarios/study-endline-held.toml")).unwrap();
    let text = text.replace("speed = \"0.25 m/s\"\ntoward", "speed = \"0 m/s\"\ntoward");
    let text = text.replace("rope_nodes = 500", &format!("rope_nodes = {nodes}"));
    let made = format!("\ndelivered_strength = \"{lbf} lbf\"\nkeeps_stiffness = false\n");
    let text = ["pp-3-8", "sink-3-8"].iter().fold(text, |text, rope| {
        text.replace(&format!("rope = \"{rope}\"\n"), &format!("rope = \"{rope}\"{made}"))
    });
    assembled(&text)
}

/// The gear of `study-gear` at slack water, the whale far away.
fn gear(assembly: &str) -> Model {
    let text = std::fs::read_to_string(root().join("scenarios/study-gear.toml")).unwrap();
    let text = text
        .replace("speed = \"0.25 m/s\"\ntoward", "speed = \"0 m/s\"\ntoward")
        .replace("assembly = \"single\"", &format!("assembly = \"{assembly}\""))
        .replace("[\"0 m\", \"-12 m\"]", "[\"0 m\", \"-200 m\"]");
    assembled(&text)
}

fn assembled(text: &str) -> Model {
    let scenario =
        Scenario::read("slack.toml", text).unwrap_or_else(|found| panic!("{}", report(&found)));
    let spec = assemble(&scenario, &library(), &Linked, &Options::default())
        .unwrap_or_else(|found| panic!("{}", report(&found)));
    Model::new(spec).unwrap()
}

/// Least distance of the centre lines of the two parts, and of each with itself, away from the splice, over the sum of radii.
fn least_distance(model: &Model, state: &State) -> f64 {
    let at = &state.rope.position;
    let segments: Vec<usize> =
        model.line_nodes.iter().flat_map(|nodes| nodes.start..nodes.end - 1).collect();
    let (diameter, splice) = (model.spec.ropes[0].diameter_m, model.line_nodes[0].end);
    let mut least = f64::INFINITY;
    for (index, one) in segments.iter().enumerate() {
        for other in segments.iter().skip(index + 3) {
            // The splice is where the two parts meet.
            if *one + 3 > splice - 1 && *other < splice + 3 {
                continue;
            }
            let (first, second) = ([at[*one], at[one + 1]], [at[*other], at[other + 1]]);
            let (s, t) = segment_segment(first, second);
            let between = first[0].lerp(first[1], s) - second[0].lerp(second[1], t);
            least = least.min(between.length() / diameter);
        }
    }
    least
}

/// Steps gear from its rest: no tension is 5 N above the greatest at rest, and no rope goes through rope.
fn stays_at_rest(model: &Model, mut state: State, until_s: f64, what: &str) {
    let at_rest_n = state.rope.tension.iter().copied().fold(0.0, f64::max);
    let mut workspace = Workspace::new(model);
    let mut peak_n = 0.0_f64;
    while state.time_s < until_s {
        step(model, &Input::default(), &mut state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{what}: {stop:?}"));
        peak_n = workspace.peak_tension_n.iter().copied().fold(peak_n, f64::max);
    }
    assert_eq!(workspace.audit.ropes_through, 0, "{what}");
    assert!(peak_n < at_rest_n + 5.0, "{what}: {peak_n} N, at rest {at_rest_n} N");
}

#[test]
fn rope_at_rest_lies_beside_rope_and_stays_there_when_the_run_begins() {
    // On the finer mesh more than a hundred pairs of segments lie in each other before they are moved.
    for (lbf, nodes) in [(600, 500), (1700, 500), (2600, 500), (2600, 1000)] {
        let model = endline(lbf, nodes);
        let settled = settle(&model);
        assert!(settled.converged, "{lbf}");
        let apart = least_distance(&model, &settled.state);
        assert!(apart >= 1.0, "{lbf}: {apart} of the sum of radii");
        stays_at_rest(&model, settled.state, 2.0, &format!("{lbf} lbf, {nodes} nodes"));
    }
}

/// Gear with traps, on which rope lies: its endlines are parted too.
#[test]
fn gear_with_traps_begins_at_slack_water_as_it_rests() {
    for assembly in ["pair", "trawl-5", "trawl-10"] {
        let model = gear(assembly);
        let settled = settle(&model);
        assert!(settled.converged, "{assembly}");
        stays_at_rest(&model, settled.state, 1.0, assembly);
    }
}
