//! Results and gear written to files for other programs.
//!
//! | module | content | endings |
//! |---|---|---|
//! | [`chart`] | charts of a run, as data; as a table of points | `csv` |
//! | [`picture`] | charts drawn, with the font of all of them | `svg`, `png` |
//! | [`animation`] | a run in motion | `glb` |
//! | [`model`] | gear and whale as 3-D models | `stl`, `glb` |
//! | [`tables`] | the moments of a run as tables | `parquet`, `arrow`, `csv` |
//!
//! Tables of the library are read and written by [`edit::library_table`](crate::edit::library_table).

pub mod animation;
pub mod chart;
pub mod model;
pub mod picture;
pub mod tables;

use std::path::Path;
use std::sync::Arc;

use endline_sim::{Frame, Model};

use crate::save;
use crate::scene::Scene;

pub use chart::Chart;

/// Endings of files that charts are written to.
pub const CHART_ENDINGS: [&str; 3] = ["svg", "png", "csv"];

/// Endings of files that 3-D models are written to.
pub const MODEL_ENDINGS: [&str; 2] = ["stl", "glb"];

/// Writes charts to a file in the format of its ending, one of [`CHART_ENDINGS`]; `origin` names the run and the program.
pub fn charts(path: &Path, charts: &[Chart], origin: &str) -> Result<(), String> {
    let bytes = match ending(path, &CHART_ENDINGS)? {
        "csv" => chart::csv(charts, origin).into_bytes(),
        "png" => picture::png(charts, origin)?,
        _ => picture::svg(charts, origin)?.into_bytes(),
    };
    write(path, &bytes)
}

/// Writes the solid parts of a scene to a file in the format of its ending, one of
/// [`MODEL_ENDINGS`].
pub fn model(path: &Path, scene: &Scene) -> Result<(), String> {
    let bytes = match ending(path, &MODEL_ENDINGS)? {
        "stl" => model::stl(scene),
        _ => model::glb(scene),
    };
    write(path, &bytes)
}

/// Writes frames of a run, `step_s` apart, as an animated 3-D model to a file that ends in `.glb`.
pub fn animation(
    path: &Path,
    model: &Model,
    frames: &[Arc<Frame>],
    step_s: f64,
) -> Result<(), String> {
    let bytes = animation::glb(model, frames, step_s)?;
    write(path, &bytes).map_err(|error| format!("{}: {error}", path.display()))
}

/// Writes a file whole or not at all.
fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    save::atomically(path, bytes).map_err(|error| error.to_string())
}

/// The known ending of a file, in lower case.
fn ending(path: &Path, known: &[&'static str]) -> Result<&'static str, String> {
    let own = path.extension().map(|own| own.to_string_lossy().to_lowercase());
    let found = known.iter().find(|known| own.as_deref() == Some(**known));
    found.copied().ok_or_else(|| {
        let endings: Vec<String> = known.iter().map(|known| format!(".{known}")).collect();
        format!("the name of the file must end in {}", endings.join(" or "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_ending_is_an_error_that_names_the_endings() {
        let known = |name: &str| ending(Path::new(name), &MODEL_ENDINGS);
        assert_eq!([known("a.STL"), known("b.c/rig.glb")], [Ok("stl"), Ok("glb")]);
        for name in ["rig.obj", "rig", "rig."] {
            let error = known(name).unwrap_err();
            assert!(error.contains(".stl or .glb"), "{name}: {error}");
        }
        let error = charts(Path::new("plots.jpg"), &[], "").unwrap_err();
        assert!(error.contains(".svg or .png or .csv"), "{error}");
        assert!(!Path::new("plots.jpg").exists());
    }
}
