//! Size of a scenario's whale: by length, by age, lean or robust, pregnant; and impossible sizes, reported with their place.

use endline_gear::whale::gltf::{About, Form, write};
use endline_gear::{Library, Options, Scenario, Sources, assemble};
use endline_sim::ModelSpec;

use crate::linked::{Linked, library, report, root};

const WHALE: &str = "whales/right-whale.toml";

/// The first scenario with its whale's length replaced.
fn scenario(size: &str) -> String {
    let text = std::fs::read_to_string(root().join("scenarios/hello-endline.toml")).unwrap();
    assert!(text.contains("length = \"13.7 m\""));
    text.replacen("length = \"13.7 m\"", size, 1)
}

fn made(size: &str, library: &Library) -> Result<ModelSpec, String> {
    let scenario =
        Scenario::read("test.toml", &scenario(size)).map_err(|problems| report(&problems))?;
    assemble(&scenario, library, &Linked, &Options::default()).map_err(|problems| report(&problems))
}

/// Length and mass of the whale a scenario asks for.
fn sized(size: &str) -> [f64; 2] {
    let whale =
        made(size, &library()).unwrap_or_else(|message| panic!("{size}: {message}")).whale.unwrap();
    [whale.length_m, whale.measures.mass_kg]
}

/// Moore et al. 2005: 11.08 m at two years. Condition is volume over volume: twice the number, twice the mass.
#[test]
fn age_and_condition_make_the_whale() {
    let [length_m, mass_kg] = sized("age = \"2 yr\"");
    assert!((length_m - 11.08).abs() < 0.01, "{length_m} m");
    let [_, same_kg] = sized("length = \"11.075 m\"");
    assert!((mass_kg / same_kg - 1.0).abs() < 0.01, "{mass_kg} and {same_kg} kg");
    let [_, lean_kg] = sized("age = \"2 yr\"\ncondition = 0.72");
    assert!(
        (lean_kg / mass_kg - 0.72).abs() < 0.01,
        "28 % of its mass is what an emaciated whale lost: {lean_kg} of {mass_kg} kg"
    );
    let [_, pregnant_kg] = sized("length = \"13.7 m\"\npregnant = true");
    assert!((1.01..1.10).contains(&(pregnant_kg / sized("length = \"13.7 m\"")[1])));
}

#[test]
fn an_impossible_size_is_reported_with_its_place() {
    for (size, parts) in [
        (
            "length = \"11 m\"\nage = \"2 yr\"",
            ["both `length` and `age` are present", "remove one of them"],
        ),
        ("length = \"60 m\"", ["`length` is 60", "between 1 m and 35 m"]),
        ("age = \"300 yr\"", ["`age` is", "between"]),
        ("age = 2", ["without a unit", "expected a time"]),
        ("condition = 0.3", ["`condition` is 0.3", "between 0.65 and 1.5"]),
        ("condition = 1.7", ["`condition` is 1.7", "between 0.65 and 1.5"]),
        ("pregnant = \"yes\"", ["`pregnant` is", "true or false"]),
    ] {
        let message = made(size, &library()).err().unwrap_or_else(|| panic!("{size} is taken"));
        let whole = scenario(size);
        let first = whole.lines().position(|line| size.starts_with(line) && !line.is_empty());
        let last = first.unwrap() + size.lines().count();
        let place = format!("test.toml:{last}:");
        assert!(
            parts.iter().all(|part| message.contains(part)) && message.contains(&place),
            "{size}: {message}"
        );
    }
}

/// A library whose right whale's file is changed.
fn changed(from: &str, to: &str) -> (Library, String) {
    let mut sources = Sources::from_folder(&root()).unwrap();
    let text = sources.get(WHALE).unwrap().to_owned();
    assert!(text.contains(from), "{from}");
    sources.set(WHALE, text.replacen(from, to, 1));
    let (library, problems) = Library::read(&sources);
    (library, report(&problems))
}

#[test]
fn a_whale_without_a_law_of_age_has_no_age() {
    let text = Sources::from_folder(&root()).unwrap().get(WHALE).unwrap().to_owned();
    let law = &text[text.find("[age]").unwrap()..text.find("[head]").unwrap()];
    let (library, problems) = changed(law, "");
    assert_eq!(problems, "", "the law may be left out");
    assert!(made("length = \"11 m\"", &library).is_ok());
    let message = made("age = \"2 yr\"", &library).err().unwrap();
    assert!(
        message.contains("has no law of length by age") && message.contains("[age] with `birth`"),
        "{message}"
    );
}

#[test]
fn a_whales_file_says_how_wide_it_is() {
    let text = Sources::from_folder(&root()).unwrap().get(WHALE).unwrap().to_owned();
    let law = &text[text.find("[mass]").unwrap()..text.find("[age]").unwrap()];
    let (_, problems) = changed(law, "");
    assert!(
        problems.contains("both `mass` and `breadth_scale` are missing")
            && problems.contains("write [mass]"),
        "{problems}"
    );
    let (_, problems) = changed("exponent = { value = 3.1026, ", "exponents = { value = 3.1026, ");
    assert!(
        problems.contains("`mass.exponent` is missing")
            || problems.contains("`exponent` is missing"),
        "half a law is none: {problems}"
    );
}

/// A whale with a mesh of its own is as wide as that mesh.
#[test]
fn a_mesh_has_the_condition_it_was_made_with() {
    let mut sources = Sources::from_folder(&root()).unwrap();
    let whale = library().whales.into_iter().find(|whale| whale.entry.id == "right-whale").unwrap();
    let about = About {
        id: "right-whale",
        name: "Right whale",
        length_m: 13.7,
        joints: &whale.joints.ranges,
    };
    sources.set_mesh("whales/mine.glb", write(&whale.skin_at(13.7), &about, Form::Binary));
    let text = sources.get(WHALE).unwrap().to_owned();
    sources.set(WHALE, text.replacen("[spine]", "mesh = \"mine.glb\"\n\n[spine]", 1));
    let (library, problems) = Library::read(&sources);
    assert!(problems.is_empty(), "{}", report(&problems));
    assert!(made("age = \"2 yr\"", &library).is_ok(), "its length may follow from its age");
    for size in ["condition = 0.8", "pregnant = true"] {
        let message = made(size, &library).err().unwrap_or_else(|| panic!("{size} is taken"));
        assert!(
            message.contains("has its own mesh")
                && message.contains("remove `condition` and `pregnant`"),
            "{message}"
        );
    }
}
