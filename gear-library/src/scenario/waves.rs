//! The waves of a scenario.

use endline_sim::water::waves::Spectrum;
use endline_sim::water::waves::{WaveKind, Waves};

use crate::compass::direction;
use crate::diagnostic::{At, Place};
use crate::fields::{Fields, Range};
use crate::limits;
use crate::units::Quantity;

use super::bearing::bearing;

/// Peak enhancement where none is given: the mean of JONSWAP.
const USUAL_GAMMA: f64 = 3.3;
/// Components where no number is given.
const USUAL_COMPONENTS: usize = 64;
/// Periods over which waves grow where no ramp is given.
const USUAL_RAMP: f64 = 2.0;

/// `[waves]`, with the place of their height; `None` where something needed is missing, which is reported.
pub(super) fn read(fields: &Fields<'_>) -> Option<At<Waves>> {
    let spectrum = fields.word("spectrum", &["jonswap"]);
    let height = fields.need_value("height", Quantity::Length, Range::Between(0.0, 40.0));
    let period = fields.need_value("period", Quantity::Time, Range::Between(0.2, 1e5));
    let toward = bearing(fields, "toward");
    let ramp = fields.value("ramp", Quantity::Time, Range::NotNegative);
    let phase = fields.value("phase", Quantity::Angle, Range::Any);
    let gamma = fields.value("gamma", Quantity::Ratio, Range::Between(1.0, 20.0));
    let components = fields.count("components", &limits::WAVE_COMPONENTS);
    check_shape(
        fields,
        spectrum.is_some(),
        phase.as_ref(),
        gamma_or_components(&gamma, &components),
    );
    fields.finish();
    let (height, period_s) = (height?, period?.value);
    let kind = match spectrum {
        None => WaveKind::Regular {
            height_m: height.value,
            period_s,
            phase_rad: phase.map_or(0.0, |phase| phase.value),
        },
        Some(_) => WaveKind::Jonswap {
            spectrum: Spectrum {
                significant_height_m: height.value,
                peak_period_s: period_s,
                gamma: gamma.map_or(USUAL_GAMMA, |gamma| gamma.value),
            },
            components: components.map_or(USUAL_COMPONENTS, |components| components.value as usize),
        },
    };
    let ramp_s = ramp.map_or(USUAL_RAMP * period_s, |ramp| ramp.value);
    Some(At { value: Waves { toward: direction(toward), ramp_s, kind }, place: height.place })
}

/// Place of the first figure that only a spectrum has.
fn gamma_or_components<'a>(
    gamma: &'a Option<At<f64>>,
    components: &'a Option<At<u64>>,
) -> Option<&'a Place> {
    let components = || components.as_ref().map(|components| &components.place);
    gamma.as_ref().map(|gamma| &gamma.place).or_else(components)
}

/// Reports a phase beside a spectrum, and a figure of a spectrum without one.
fn check_shape(
    fields: &Fields<'_>,
    irregular: bool,
    phase: Option<&At<f64>>,
    of_spectrum: Option<&Place>,
) {
    if let (true, Some(phase)) = (irregular, phase) {
        fields.problems().push(phase.place.error(
            "a `phase` with a spectrum",
            "phases of irregular waves are drawn from the seed",
        ));
    }
    if let (false, Some(place)) = (irregular, of_spectrum) {
        fields.problems().push(place.error(
            "a figure of a spectrum with regular waves",
            "write spectrum = \"jonswap\" for irregular waves, or take it out",
        ));
    }
}
