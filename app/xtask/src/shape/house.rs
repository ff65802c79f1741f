//! The shape that the workspace keeps.
//!
//! Each list names what does not keep it yet. A list only ever becomes shorter: an entry that is no
//! longer true fails its test too.

use std::collections::BTreeSet;
use std::path::Path;

use super::sizes::{Measured, Sizes, over, quantile};
use super::tree::Crate;
use super::{ARGUMENTS_MAX, FILE_MAX, FILE_MEDIAN, FUNCTION_MAX, FUNCTION_MEDIAN, FUNCTION_P95};

/// Files that stand in a circle.
const IN_CIRCLES: [&str; 90] = [
    "app/session/src/cases/curves.rs",
    "app/session/src/cases/judge.rs",
    "app/session/src/plugins/check.rs",
    "app/session/src/plugins/host.rs",
    "app/session/src/plugins/loader.rs",
    "app/session/src/recording/mod.rs",
    "app/session/src/source.rs",
    "app/session/src/study/batch.rs",
    "app/session/src/study/encounter.rs",
    "app/session/src/study/merge.rs",
    "app/session/src/study/open.rs",
    "app/session/src/study/report/changed.rs",
    "app/session/src/study/report/html.rs",
    "app/session/src/study/rest.rs",
    "app/session/src/study/same.rs",
    "app/sim/src/check.rs",
    "app/sim/src/contact/crease.rs",
    "app/sim/src/contact/grip.rs",
    "app/sim/src/contact/near.rs",
    "app/sim/src/contact/ropes/mod.rs",
    "app/sim/src/contact/slots.rs",
    "app/sim/src/gear_hook.rs",
    "app/sim/src/model.rs",
    "app/sim/src/pace.rs",
    "app/sim/src/rope_step.rs",
    "app/sim/src/solids/broad.rs",
    "app/sim/src/solids/mod.rs",
    "app/sim/src/solids/work.rs",
    "app/sim/src/solver/coupled.rs",
    "app/sim/src/solver/hubs.rs",
    "app/sim/src/state.rs",
    "app/sim/src/step.rs",
    "app/sim/src/substep.rs",
    "app/sim/src/water/jonswap.rs",
    "app/sim/src/water/mod.rs",
    "app/sim/src/water/waves.rs",
    "app/sim/src/whale/drive.rs",
    "app/sim/src/whale/hitch.rs",
    "app/sim/src/whale/pilot/mod.rs",
    "app/workbench/src/gui/app.rs",
    "app/workbench/src/gui/desk.rs",
    "app/workbench/src/gui/menus.rs",
    "app/workbench/src/gui/panels/assembly/mod.rs",
    "app/workbench/src/gui/panels/entanglement.rs",
    "app/workbench/src/gui/panels/library.rs",
    "app/workbench/src/gui/panels/pad.rs",
    "app/workbench/src/gui/panels/pilot/mod.rs",
    "app/workbench/src/gui/panels/plots.rs",
    "app/workbench/src/gui/panels/problems.rs",
    "app/workbench/src/gui/panels/recordings.rs",
    "app/workbench/src/gui/panels/results/mod.rs",
    "app/workbench/src/gui/panels/results/runs.rs",
    "app/workbench/src/gui/panels/results/spread.rs",
    "app/workbench/src/gui/panels/run.rs",
    "app/workbench/src/gui/panels/scenario/mod.rs",
    "app/workbench/src/gui/panels/start.rs",
    "app/workbench/src/gui/panels/summary.rs",
    "app/workbench/src/gui/panels/view/state.rs",
    "app/workbench/src/gui/picking.rs",
    "app/workbench/src/gui/pose.rs",
    "app/workbench/src/gui/questions.rs",
    "app/workbench/src/gui/reading.rs",
    "app/workbench/src/gui/studies/mod.rs",
    "app/workbench/src/gui/studies/results.rs",
    "app/workbench/src/scene/build.rs",
    "app/workbench/src/scene/rope.rs",
    "app/workbench/src/scene/sea.rs",
    "app/workbench/src/scene/whale.rs",
    "app/xtask/src/shape/names.rs",
    "app/xtask/src/shape/resolve.rs",
    "gear-library/src/assemble/sea.rs",
    "gear-library/src/assemble/wound/cut.rs",
    "gear-library/src/assemble/wound/helix.rs",
    "gear-library/src/assembly.rs",
    "gear-library/src/attributes.rs",
    "gear-library/src/items/act.rs",
    "gear-library/src/items/animation.rs",
    "gear-library/src/items/friction.rs",
    "gear-library/src/items/growth.rs",
    "gear-library/src/items/mesh.rs",
    "gear-library/src/items/whale.rs",
    "gear-library/src/library.rs",
    "gear-library/src/scenario/current.rs",
    "gear-library/src/scenario/sea.rs",
    "gear-library/src/scenario/waves.rs",
    "gear-library/src/whale/bones.rs",
    "gear-library/src/whale/form.rs",
    "gear-library/src/whale/gltf/extras.rs",
    "gear-library/src/whale/gltf/write.rs",
    "gear-library/src/whale/mesh.rs",
];
/// Files that are too long.
const LONG_FILES: [&str; 3] = [
    "app/session/src/plugins/load.rs",
    "gear-library/src/schema.rs",
    "plugins/sdk/src/abi/export.rs",
];
/// Functions that are too long: file and name.
const LONG_FUNCTIONS: [&str; 1] = ["plugins/whale-motions/src/swim/settings.rs attributes"];
/// Functions with too many arguments: file and name.
const MANY_ARGUMENTS: [&str; 10] = [
    "app/sim/src/solids/work.rs add_pair",
    "app/sim/src/solver/ground.rs foot_grip",
    "app/sim/src/solver/lanes/mod.rs group_rows",
    "app/sim/src/solver/lanes/mod.rs take_hinges",
    "app/sim/src/substep.rs step_by_lines",
    "app/sim/src/whale/kinetic/swim.rs ahead",
    "app/workbench/src/gui/fields.rs edit_as",
    "app/workbench/src/gui/fields.rs edit_in",
    "app/workbench/src/gui/panels/assembly/parts.rs head",
    "gear-library/src/assemble/wound/mod.rs lay",
];

fn house() -> Vec<Crate> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap();
    super::read(root, None).unwrap()
}

/// Fails where what breaks a rule is not exactly what is known to.
fn same(found: BTreeSet<String>, known: &[&str], rule: &str) {
    let known: BTreeSet<String> = known.iter().map(|name| (*name).to_owned()).collect();
    let list = |of: &BTreeSet<String>, without: &BTreeSet<String>| {
        of.difference(without).cloned().collect::<Vec<String>>().join("\n  ")
    };
    let (new, gone) = (list(&found, &known), list(&known, &found));
    assert!(new.is_empty(), "{rule} (`cargo xtask shape` shows more):\n  {new}");
    assert!(gone.is_empty(), "no longer so: take it off the list:\n  {gone}");
}

/// Places without the number of the line, which changes with each edit.
fn without_line(measured: &[Measured]) -> BTreeSet<String> {
    let name = |place: &str| {
        let (file, rest) = place.split_once(':')?;
        Some(format!("{file} {}", rest.split_once(' ')?.1))
    };
    let all = measured.iter();
    all.map(|one| name(&one.place).unwrap_or_else(|| one.place.clone())).collect()
}

#[test]
fn files_that_name_each_other_are_parent_and_child() {
    let crates = house();
    let circles = crates.iter().flat_map(super::circles::circles);
    let files = circles.flat_map(|circle| circle.files).collect();
    same(files, &IN_CIRCLES, "files must not name each other in circles");
}

#[test]
fn files_are_short() {
    let sizes = Sizes::of(&house());
    assert!(sizes.files.len() > 400, "the whole workspace is read");
    assert!(quantile(&sizes.files, 0.5) <= FILE_MEDIAN, "half the files are short");
    same(without_line(over(&sizes.files, FILE_MAX)), &LONG_FILES, "a file is too long");
}

#[test]
fn functions_are_short() {
    let sizes = Sizes::of(&house());
    assert!(sizes.functions.len() > 3000, "the whole workspace is read");
    assert!(quantile(&sizes.functions, 0.5) <= FUNCTION_MEDIAN, "half the functions are short");
    assert!(quantile(&sizes.functions, 0.95) <= FUNCTION_P95, "few functions are long");
    let long = without_line(over(&sizes.functions, FUNCTION_MAX));
    same(long, &LONG_FUNCTIONS, "a function is too long");
}

#[test]
fn functions_take_few_arguments() {
    let many = without_line(over(&Sizes::of(&house()).arguments, ARGUMENTS_MAX));
    same(many, &MANY_ARGUMENTS, "a function takes too many arguments: give it a small struct");
}
