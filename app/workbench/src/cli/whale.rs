//! `endline whale`: a whale's mesh as a file, and the start from which it meets a line.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::ExitCode;

use endline_gear::whale::fin::smallest_radius;
use endline_gear::whale::gltf::{About, Form, write};
use endline_gear::{Diagnostic, Library, Sources};
use endline_sdk::Limb;
use endline_session::encounters::meet::{Meeting, meet};
use endline_session::{json, locate, save};
use endline_sim::{Frame, settle};
use schemars::JsonSchema;
use serde::Serialize;

use super::args::{AimArgs, WhaleBuildArgs, WhaleCommand};
use super::{Failure, host, output, player};

pub(super) fn whale(what: &WhaleCommand, library: Option<&Path>) -> Result<ExitCode, Failure> {
    match what {
        WhaleCommand::Build(args) => build(args, library),
        WhaleCommand::Aim(args) => aim(args, library),
    }
}

/// Writes the skinned mesh of a whale of the library.
fn build(args: &WhaleBuildArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let name = args.out.to_string_lossy();
    let form = Form::of_file(&name).ok_or_else(|| {
        Failure::usage(format!("{name}: expected a file that ends in .glb or .gltf"))
    })?;
    let root = locate::library(None, library).map_err(Failure::failed)?;
    let (library, problems) = Sources::from_folder(&root)
        .map(|sources| Library::read(&sources))
        .map_err(|problems| failure(&problems))?;
    let Some(whale) = library.whales.iter().find(|whale| whale.entry.id == args.whale) else {
        let own = format!("whales/{}.", args.whale);
        let faults: Vec<Diagnostic> = problems
            .into_iter()
            .filter(|problem| problem.is_error() && problem.file.contains(&own))
            .collect();
        let known: Vec<&str> = library.whales.iter().map(|whale| whale.entry.id.as_str()).collect();
        let unknown = || {
            Failure::failed(format!(
                "no whale `{}` in the library; there are {}",
                args.whale,
                known.join(", ")
            ))
        };
        return Err(if faults.is_empty() { unknown() } else { failure(&faults) });
    };
    let length_m = args.length.unwrap_or(whale.form.length_m);
    let skin = whale.skin_at(length_m);
    let about = About {
        id: &whale.entry.id,
        name: &whale.entry.name,
        length_m,
        joints: &whale.joints.ranges,
    };
    let bytes = write(&skin, &about, form);
    save::atomically(&args.out, &bytes)
        .map_err(|error| Failure::failed(format!("{name}: cannot be written: {error}")))?;
    let (vertices, triangles, bones) =
        (skin.vertices.len(), skin.triangles.len(), skin.bones.len());
    let edge = |of: Limb| {
        let least = smallest_radius(&skin, |region| region.part().limb() == of);
        least.map_or_else(
            || "none".to_owned(),
            |(radius_m, _)| format!("{:.1} mm", 1000.0 * radius_m),
        )
    };
    output::print(&format!(
        "{name}: {length_m} m, {triangles} triangles, {vertices} vertices, {bones} bones, {} bytes\nsmallest edge radius: flippers {}, flukes {}\n",
        bytes.len(),
        edge(Limb::Flipper),
        edge(Limb::Fluke)
    ))?;
    Ok(ExitCode::SUCCESS)
}

/// Name of the schema of a computed start.
pub(super) const AIM: &str = "endline.aim/1";

/// The start from which a whale meets a line.
#[derive(Debug, JsonSchema, Serialize)]
pub(super) struct AimedStart {
    /// Name and version of this form.
    #[schemars(extend("const" = AIM))]
    schema: &'static str,
    /// The part of the body that meets the line.
    part: &'static str,
    /// The line.
    line: String,
    /// Place on the line: east, north, up [m].
    place_m: [f64; 3],
    /// Start of mid-body: east, north, up [m].
    start_m: [f64; 3],
    /// Time from the start to the contact [s].
    after_s: f64,
    /// Fields of the scenario that make the whale start there, by name, with values as in its file.
    set: BTreeMap<String, serde_json::Value>,
}

/// Prints the start from which the whale of a scenario meets a line.
fn aim(args: &AimArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let over = (args.over.overrides(), &args.over.set[..]);
    let prepared = player::prepared(&args.scenario, library, &host::load(), over)?;
    let settled = settle(&prepared.model);
    if !settled.converged {
        return Err(Failure::failed(format!("the gear is not at rest: {}", settled.why())));
    }
    let meeting =
        Meeting { line: args.line.clone(), depth_m: args.depth, part: args.part, gap_m: args.gap };
    let met = meet(&prepared.model, &Frame::of(&settled.state, &[], &[]), &meeting)?;
    let aimed = AimedStart {
        schema: AIM,
        part: args.part.name(),
        line: args.line.clone(),
        place_m: met.place_m.to_array(),
        start_m: met.start_m.to_array(),
        after_s: met.after_s,
        set: met.fields().into_iter().collect(),
    };
    output::print(&if args.json { json::line(&aimed) + "\n" } else { in_words(args, &aimed) })?;
    Ok(ExitCode::SUCCESS)
}

/// The start in words, with the command that runs the scenario from it.
fn in_words(args: &AimArgs, aimed: &AimedStart) -> String {
    let [east, north, up] = aimed.start_m;
    let set: Vec<String> =
        aimed.set.iter().map(|(field, value)| format!(" --set '{field}={value}'")).collect();
    format!(
        "The whale starts at east {east:.2} m, north {north:.2} m, depth {:.2} m.\nIts {} meets {} at a depth of {:.1} m after {:.1} s.\nendline run {}{}\n",
        -up,
        aimed.part.replace('_', " "),
        aimed.line,
        -aimed.place_m[2],
        aimed.after_s,
        args.scenario.display(),
        set.concat()
    )
}

fn failure(problems: &[Diagnostic]) -> Failure {
    Failure::failed(problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
}
