//! An assembly at a site, made ready to be hauled.

use endline_gear::{
    Assembled, Diagnostic, Library, Options, Scenario, Setting, StrengthBudget, assemble_traced,
};
use endline_sim::Model;
use endline_sim::model::BodyRole;

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::assembly::written;

use super::HaulRequest;

/// Peak period of a fully developed sea over the root of its significant height: `H = 0.21 U²/g` and `ω = 0.877 g/U` (Pierson
/// and Moskowitz 1964, doi:10.1029/JZ069i024p05181) [s/√m].
const PERIOD_OF_ROOT_HEIGHT: f64 = 4.99;
/// Segments that the depth is cut into, at the least.
const SEGMENTS: f64 = 40.0;

/// Assembled gear.
pub(super) struct Made {
    /// The model, with its strengths at their means.
    pub model: Model,
    /// What each piece and link holds, and why.
    pub strengths: Vec<StrengthBudget>,
    /// Peak period of the waves, where there are any [s].
    pub period_s: Option<f64>,
}

impl Made {
    /// Assembles an assembly as it is asked for.
    pub fn of(
        id: &str,
        request: &HaulRequest,
        library: &Library,
        host: &PluginHost,
    ) -> Result<Self, Error> {
        let site =
            library.sites.iter().find(|site| site.entry.id == request.site).ok_or_else(|| {
                let known: Vec<&str> =
                    library.sites.iter().map(|site| site.entry.id.as_str()).collect();
                Error::Message(format!(
                    "no site `{}`; there are {}",
                    request.site,
                    known.join(", ")
                ))
            })?;
        let depth_m = request.depth_m.unwrap_or(site.depth_m);
        let period_s = request
            .sea_m
            .map(|height| request.period_s.unwrap_or(PERIOD_OF_ROOT_HEIGHT * height.sqrt()));
        let text = text(id, request, depth_m, period_s)?;
        let scenario = Scenario::read("scenario", &text).map_err(Error::Diagnostics)?;
        let options = Options { step_s: Some(request.step_s), ..Options::default() };
        let Assembled { mut spec, strengths, .. } =
            assemble_traced(&scenario, library, host, &options).map_err(Error::Diagnostics)?;
        for body in &mut spec.bodies {
            body.foot_break_out_n *= request.break_out;
        }
        let model = Model::new(spec).map_err(|errors| {
            let told = errors.into_iter().map(|error| {
                let message = format!("{}: {}", error.part, error.message);
                Diagnostic::of_file("scenario", message, "")
            });
            Error::Diagnostics(told.collect())
        })?;
        Ok(Self { model, strengths, period_s })
    }

    /// Rope in all, and the depth [m].
    pub fn rope_m(&self) -> f64 {
        let lines = self.model.spec.lines.iter();
        lines.flat_map(|line| &line.segments_m).sum::<f64>() + self.model.spec.water.depth_m
    }

    /// Traps of the gear.
    pub fn traps(&self) -> usize {
        self.model.spec.bodies.iter().filter(|body| body.role == BodyRole::Trap).count()
    }

    /// The budget of a part.
    pub fn budget(&self, part: &str) -> Option<&StrengthBudget> {
        self.strengths.iter().find(|budget| budget.part == part)
    }
}

/// The text of the scenario.
fn text(
    id: &str,
    request: &HaulRequest,
    depth_m: f64,
    period_s: Option<f64>,
) -> Result<String, Error> {
    let head = "format = 1\nkind = \"scenario\"\nname = \"haul\"\nduration = \"1 s\"\nstrength_scatter = false\nrope_on_rope = false\nrope_on_bodies = false\nbodies_on_bodies = false\nweak_links = false\n";
    let segment_m = request.segment_m.unwrap_or((depth_m / SEGMENTS).clamp(0.5, 2.0));
    let metres = |length: f64| Setting::text(&format!("{length} m"));
    let mut settings = vec![
        ("seed", Setting::plain(&request.seed.to_string())),
        ("segment", metres(segment_m)),
        ("site.item", Setting::text(&request.site)),
        ("site.depth", metres(depth_m)),
        ("gear.0.assembly", Setting::text(id)),
        ("gear.0.heading", Setting::text("90 deg")),
    ];
    if let Some(tide) = request.tide_m_s {
        settings.push(("current.speed", Setting::text(&format!("{tide} m/s"))));
    }
    if let Some(traps) = request.traps {
        settings.push(("gear.0.attributes.traps", Setting::plain(&traps.to_string())));
    }
    if let (Some(height), Some(period)) = (request.sea_m, period_s) {
        settings.extend([
            ("waves.spectrum", Setting::text("jonswap")),
            ("waves.height", metres(height)),
            ("waves.period", Setting::text(&format!("{period} s"))),
            ("waves.toward", Setting::text("270 deg")),
        ]);
    }
    written(head, &settings)
}
