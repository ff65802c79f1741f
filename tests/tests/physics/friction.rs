//! Laws of friction as files choose them: by surface, by rope, with the scenario's own figures before those of the material.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::{Linked, library, report, root};
use endline_gear::{Diagnostic, Library, Options, Scenario, Sources, assemble};
use endline_sdk::Region;
use endline_sim::model::{Friction, FrictionLaw};
use endline_sim::{Input, Model, State, Workspace, settle, step};

const COULOMB: &str = "org.endline.friction.coulomb";
const BALEEN: &str = "org.endline.friction.baleen";
const TISSUE: &str = "org.endline.friction.tissue";

fn text(name: &str) -> String {
    std::fs::read_to_string(root().join("scenarios").join(name)).unwrap()
}

fn assembled(library: &Library, text: &str) -> Result<endline_sim::ModelSpec, Vec<Diagnostic>> {
    assemble(&Scenario::read("test.toml", text)?, library, &Linked, &Options::default())
}

fn friction(text: &str) -> Friction {
    assembled(&library(), text)
        .unwrap_or_else(|problems| panic!("{}", report(&problems)))
        .friction
        .unwrap()
}

/// The law of a rope, by its place among the ropes, on a region.
fn law(friction: &Friction, rope: usize, region: Region) -> &FrictionLaw {
    &friction.laws[friction.law_of[rope][region as usize]]
}

fn value(law: &FrictionLaw, key: &str) -> f64 {
    law.attributes[law
        .model
        .descriptor()
        .attributes
        .iter()
        .position(|attribute| attribute.key == key)
        .unwrap()]
}

#[test]
fn each_surface_has_the_law_that_the_scenario_names() {
    let spec = assembled(&library(), &text("hello-friction.toml")).unwrap();
    let friction = spec.friction.unwrap();
    for rope in 0..spec.ropes.len() {
        for region in Region::ALL {
            let expected = match region {
                Region::Baleen => BALEEN,
                Region::LeftFlipperLeading
                | Region::RightFlipperTip
                | Region::LeftFlukeTrailing => TISSUE,
                Region::Body | Region::Lips | Region::LeftFlipper | Region::RightFluke => {
                    "org.endline.friction.stribeck"
                }
                _ => continue,
            };
            assert_eq!(law(&friction, rope, region).model.descriptor().id, expected, "{region:?}");
        }
    }
    // Figures of the materials: sinking rope is drawn out of baleen harder than polypropylene.
    let of = |id: &str| spec.ropes.iter().position(|rope| rope.id == id).unwrap();
    let pull_out = |rope: usize| value(law(&friction, rope, Region::Baleen), "pull_out");
    assert!(
        (pull_out(of("sink-3-8")) - 700.0).abs() < 1e-9
            && (pull_out(of("pp-3-8")) - 400.0).abs() < 1e-9
    );
    assert!((value(law(&friction, 0, Region::LeftFlukeLeading), "draw") - 0.05).abs() < 1e-12);
}

#[test]
fn a_scenarios_figures_come_before_those_of_the_material() {
    let changed = text("hello-friction.toml").replace(
        "model = \"org.endline.friction.baleen\"",
        "model = \"org.endline.friction.baleen\"\nattributes = { pull_out = \"1 kN/m\" }",
    );
    let friction = friction(&changed);
    assert!((value(law(&friction, 0, Region::Baleen), "pull_out") - 1000.0).abs() < 1e-9);
    assert!(
        (value(law(&friction, 0, Region::Baleen), "across_ratio") - 1.5).abs() < 1e-9,
        "the file's own stays"
    );
}

#[test]
fn the_later_of_two_tables_for_a_surface_counts() {
    let on = |surfaces: &str, model: &str| {
        format!("\n[[friction.on]]\nsurfaces = [{surfaces}]\nmodel = \"{model}\"\n")
    };
    let both =
        text("hello-endline.toml") + &on("\"skin\", \"head\"", TISSUE) + &on("\"flukes\"", BALEEN);
    let friction = friction(&both);
    for (region, id) in [
        (Region::Body, TISSUE),
        (Region::Head, TISSUE),
        (Region::LeftFlukeLeading, BALEEN),
        (Region::Rostrum, COULOMB),
    ] {
        assert_eq!(law(&friction, 0, region).model.descriptor().id, id, "{region:?}");
    }
    // Tissue of edges and of the body's flat parts differ by the material's file.
    assert!(
        value(law(&friction, 0, Region::Body), "stiffness")
            > value(law(&friction, 0, Region::LeftFlipperTip), "stiffness")
    );
}

#[test]
fn mistakes_in_a_scenarios_friction_are_reported_with_their_place() {
    let good = text("hello-friction.toml");
    for (from, to, part) in [
        ("surfaces = [\"baleen\"]", "surfaces = [\"balene\"]", "did you mean `baleen`?"),
        ("surfaces = [\"baleen\"]", "surfaces = \"baleen\"", "not a list of surfaces"),
        ("surfaces = [\"baleen\"]", "surfaces = []", "`surfaces` is empty"),
        (
            "org.endline.friction.tissue",
            "org.endline.friction.tisue",
            "did you mean `org.endline.friction.tissue`?",
        ),
        ("surfaces = [\"edges\"]", "surface = [\"edges\"]", "surface"),
        (
            "model = \"org.endline.friction.baleen\"",
            "model = \"org.endline.friction.baleen\"\nattributes = { pull_out = \"9 s\" }",
            "pull_out",
        ),
        (
            "model = \"org.endline.friction.baleen\"",
            "model = \"org.endline.friction.baleen\"\nattributes = { pul_out = 1 }",
            "did you mean `pull_out`?",
        ),
    ] {
        let changed = good.replacen(from, to, 1);
        assert_ne!(changed, good);
        let problems =
            assembled(&library(), &changed).err().unwrap_or_else(|| panic!("{to} passes"));
        let line = 1 + changed
            .lines()
            .position(|line| to.lines().last().unwrap() == line || line.contains(to))
            .unwrap();
        assert!(problems[0].to_string().contains(part), "{}", report(&problems));
        assert!(
            problems.iter().any(|problem| problem.line.abs_diff(line) <= 1),
            "line {line}: {}",
            report(&problems)
        );
    }
}

#[test]
fn mistakes_in_a_materials_file_are_reported_in_that_file() {
    let sources = Sources::from_folder(&root()).unwrap();
    let good = std::fs::read_to_string(root().join("friction/pp.toml")).unwrap();
    let with = |from: &str, to: &str| {
        let (mut sources, changed) = (sources.clone(), good.replacen(from, to, 1));
        assert_ne!(changed, good);
        sources.set("friction/pp.toml", changed);
        let (library, problems) = Library::read(&sources);
        if problems.is_empty() {
            assembled(&library, &text("hello-friction.toml")).err().unwrap_or_default()
        } else {
            problems
        }
    };
    for (from, to, part) in [
        (
            "pull_out = { value = \"400 N/m\"",
            "pull_out = { value = \"400 N\"",
            "a unit of a force, not of a force by length",
        ),
        ("pull_out = {", "pullout = {", "did you mean `pull_out`?"),
        ("across_ratio = { value = 1.5", "across_ratio = { value = 15", "between 0.2 and 3"),
        ("[\"edges\"]", "[\"edge\"]", "did you mean `edges`?"),
        ("\nid = \"org.endline.friction.baleen\"", "", "`id` is missing"),
    ] {
        let problems = with(from, to);
        assert!(
            problems[0].file == "friction/pp.toml" && problems[0].line > 14,
            "{to}: {}",
            report(&problems)
        );
        assert!(problems[0].to_string().contains(part), "{}", report(&problems));
    }
    // A figure without a source of its own has that of the file; without either it is refused.
    let bare = good.replace(", confidence = \"estimate\" }", " }").replacen(
        "confidence = \"estimate\"\n",
        "",
        1,
    );
    let problems = Library::check_file("friction/pp.toml", &bare);
    assert!(
        problems.iter().any(|problem| problem.to_string().contains("has no confidence")),
        "{}",
        report(&problems)
    );
}

/// Every figure for a model that the shipped files give is one that the model takes, in its unit and range.
#[test]
fn figures_of_every_material_are_those_that_the_models_take() {
    let library = library();
    let ids: Vec<String> = endline_friction_models::all()
        .iter()
        .map(|model| model.descriptor().id.to_string())
        .collect();
    for file in &library.frictions {
        assert!(
            file.models.iter().all(|figures| ids.contains(&figures.model.value)),
            "{}",
            file.entry.id
        );
        assert!(
            ids.iter()
                .filter(|id| *id != COULOMB)
                .all(|id| file.models.iter().any(|figures| figures.model.value == **id))
        );
    }
    for rope in ["pp-3-8", "polysteel-3-8", "sink-3-8"] {
        let gear = format!("assembly = \"single\"\n[gear.ropes]\nendline-top = \"{rope}\"");
        for id in &ids {
            let chosen = text("hello-endline.toml")
                .replace("assembly = \"single\"", &gear)
                .replace(COULOMB, id);
            friction(&chosen);
        }
    }
}

/// The scenario with a law for each surface runs into its encounter: rope touches, grips have the floats of all laws, and nothing crosses.
#[test]
fn the_scenario_with_several_laws_runs() {
    let model = Model::new(
        assembled(
            &library(),
            &text("hello-friction.toml").replace("rope_nodes = 300", "rope_nodes = 120"),
        )
        .unwrap(),
    )
    .unwrap();
    let settled = settle(&model);
    assert!(settled.converged);
    let (mut state, mut workspace): (State, Workspace) = (settled.state, Workspace::new(&model));
    let input = Input {
        controls: endline_sdk::Controls { speed: 1.0, ..endline_sdk::Controls::default() },
    };
    let mut touched = 0;
    while state.time_s < 20.0 {
        step(&model, &input, &mut state, &mut workspace).unwrap_or_else(|stop| panic!("{stop:?}"));
        touched += usize::from(!state.rope.friction.sites.is_empty());
    }
    assert!(touched > 50, "touched in {touched} steps");
    assert_eq!(workspace.audit.tunnelled, 0);
}
