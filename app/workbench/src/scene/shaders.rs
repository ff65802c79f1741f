//! Shader programs of the scene, from `assets/shaders`.
//!
//! There is a program for each look of a part, measured and for films. In one program for all looks, software OpenGL
//! (Mesa before 24) computes every look for every pixel, because it does not skip branches.

use endline_session::scene::Look;
use endline_session::scene::colour::{CALLOSITY, SKIN, WHITE};
use endline_session::scene::mesh::Colour;
use three_d::{Context, CoreError, Program};

use super::draw::Pass;

/// Source of a shader in `assets/shaders`.
macro_rules! source {
    ($name:literal) => {
        include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/shaders/", $name, ".glsl"))
    };
}

/// Source of a shader that includes the light and colour of the sea.
macro_rules! sea_shader {
    ($name:literal) => {
        concat!(source!("sea"), source!($name))
    };
}

/// Number of values of `LOOK` in `part.fragment.glsl`.
const LOOKS: usize = 7;

/// Programs of the water behind everything and of parts.
pub(super) struct Shaders {
    /// Of the whole picture, behind everything.
    pub backdrop: Program,
    parts: [Program; LOOKS],
}

impl Shaders {
    /// The programs for pictures with instruments, or for films.
    /// Errors: shaders that this OpenGL refuses.
    pub fn new(context: &Context, film: bool) -> Result<Self, CoreError> {
        let film = format!("const bool FILM = {film};\n");
        let backdrop = Program::from_source(
            context,
            source!("backdrop.vertex"),
            &(film.clone() + sea_shader!("backdrop.fragment")),
        )?;
        let part = |look: usize| {
            let constants = format!("{film}const int LOOK = {look};\n{}", skin_colours());
            Program::from_source(
                context,
                sea_shader!("part.vertex"),
                &(constants + sea_shader!("part.fragment")),
            )
        };
        let parts = [part(0)?, part(1)?, part(2)?, part(3)?, part(4)?, part(5)?, part(6)?];
        Ok(Self { backdrop, parts })
    }

    /// The program of a part.
    pub fn of_part(&self, look: Look, pass: Pass) -> &Program {
        let index = match (pass, look) {
            (Pass::Edge, _) => 6,
            (Pass::Whole, Look::Solid) => 0,
            (Pass::Whole, Look::Own) => 1,
            (Pass::Whole, Look::Seabed { .. }) => 2,
            (Pass::Whole, Look::Surface { .. }) => 3,
            (Pass::Whole, Look::Skin) => 4,
            (Pass::Whole, Look::Rope) => 5,
        };
        &self.parts[index]
    }
}

/// The program of the particles of films.
/// Errors: shaders that this OpenGL refuses.
pub(super) fn of_snow(context: &Context) -> Result<Program, CoreError> {
    Program::from_source(context, sea_shader!("snow.vertex"), sea_shader!("snow.fragment"))
}

/// Colours of skin and its marks, as constants for the shader of parts.
fn skin_colours() -> String {
    let colours = [("SKIN", SKIN), ("CALLOSITY", CALLOSITY), ("WHITE", WHITE)];
    let line = |(name, [red, green, blue, _]): (&str, Colour)| {
        format!("const vec3 {name} = vec3({red:.5}, {green:.5}, {blue:.5});\n")
    };
    colours.map(line).concat()
}
