//! `endline whale`: a whale's mesh as a file.

use std::path::Path;
use std::process::ExitCode;

use endline_gear::whale::fin::smallest_radius;
use endline_gear::whale::gltf::{About, Form, write};
use endline_gear::{Diagnostic, Library, Sources};
use endline_sdk::Limb;
use endline_session::{locate, save};

use super::args::{WhaleBuildArgs, WhaleCommand};
use super::{Failure, output};

pub(super) fn whale(what: &WhaleCommand, library: Option<&Path>) -> Result<ExitCode, Failure> {
    match what {
        WhaleCommand::Build(args) => build(args, library),
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

fn failure(problems: &[Diagnostic]) -> Failure {
    Failure::failed(problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
}
