//! Validation of current and waves.

use super::Water;
use super::current::{Profile, Tide};
use super::waves::{WaveKind, Waves, breaking_height};

/// Greatest number of components of irregular waves.
pub const MOST_COMPONENTS: usize = 1000;

impl Water {
    /// Messages for all errors in current and waves.
    pub fn problems(&self) -> Vec<String> {
        let mut found = Problems(Vec::new());
        found
            .need(self.current.surface_m_s.is_finite(), || "current is not a finite number".into());
        found.check_profile(&self.current.profile);
        found.check_tide(&self.current.tide);
        let Problems(mut found) = found;
        if let Some(waves) = &self.waves {
            found.extend(self.problems_of_waves(waves));
        }
        found
    }

    fn problems_of_waves(&self, waves: &Waves) -> Option<String> {
        let (height, period) = waves.height_and_period();
        let level = waves.toward.is_normalized() && waves.toward.z == 0.0;
        let sound = match waves.kind {
            WaveKind::Regular { phase_rad, .. } => phase_rad.is_finite(),
            WaveKind::Jonswap { spectrum, components } => {
                (1.0..=20.0).contains(&spectrum.gamma)
                    && (1..=MOST_COMPONENTS).contains(&components)
            }
        };
        if !(level
            && sound
            && waves.ramp_s >= 0.0
            && waves.ramp_s.is_finite()
            && height.is_finite()
            && height >= 0.0)
        {
            return Some("waves have a direction that is not horizontal, or a height, ramp, phase, gamma or number of components out of range".into());
        }
        if !(period.is_finite() && period > 0.0 && self.gravity_m_s2 > 0.0) {
            return Some(format!(
                "waves have a period of {period} s and gravity is {} m/s2: both must be above zero",
                self.gravity_m_s2
            ));
        }
        let greatest = breaking_height(period, self.depth_m, self.gravity_m_s2);
        (height > greatest)
            .then(|| format!("waves of {height} m and {period} s break: the greatest height in this depth is {greatest:.2} m"))
    }
}

/// Error messages found so far.
struct Problems(Vec<String>);

impl Problems {
    fn need(&mut self, holds: bool, message: impl FnOnce() -> String) {
        if !holds {
            self.0.push(message());
        }
    }

    fn check_profile(&mut self, profile: &Profile) {
        match profile {
            Profile::Uniform => {}
            Profile::Power(exponent) => {
                let holds = exponent.is_finite() && *exponent > 0.0;
                self.need(holds, || {
                    format!("exponent of the current is {exponent}, expected a number above zero")
                });
            }
            Profile::Log(roughness) => {
                let holds = roughness.is_finite() && *roughness > 0.0;
                self.need(
                    holds,
                    || format!(
                        "roughness of the current is {roughness} of the depth, expected a number above zero"
                    ),
                );
            }
            Profile::Table(rows) => {
                let sound = rows.iter().all(|row| {
                    row.height.is_finite() && row.along.is_finite() && row.left.is_finite()
                });
                self.need(sound && !rows.is_empty(), || {
                    "profile of the current has no rows, or one that is not finite".into()
                });
                self.need(rows.windows(2).all(|pair| pair[0].height < pair[1].height), || {
                    "heights of the current's profile do not increase".into()
                });
            }
        }
    }

    fn check_tide(&mut self, tide: &Tide) {
        match tide {
            Tide::Steady => {}
            Tide::Constituent { period_s, peak_s, minor, residual_m_s } => {
                self.need(period_s.is_finite() && *period_s > 0.0, || {
                    format!("period of the tide is {period_s}, expected a number above zero")
                });
                self.need(
                    peak_s.is_finite() && minor.is_finite() && residual_m_s.is_finite(),
                    || "the tide has a number that is not finite".into(),
                );
            }
            Tide::Table(rows) => {
                let sound =
                    rows.iter().all(|(time, velocity)| time.is_finite() && velocity.is_finite());
                self.need(sound && !rows.is_empty(), || {
                    "table of the tide has no rows, or one that is not finite".into()
                });
                self.need(rows.windows(2).all(|pair| pair[0].0 < pair[1].0), || {
                    "times of the tide's table do not increase".into()
                });
            }
        }
    }
}
