//! The time-tension cutter: a device in each endline that cuts it after the tension has exceeded `T0` for a time `t0`.
//!
//! ```text
//! t(k+1) = t(k) + dt  where T >= T0, else 0        cut when t >= t0
//! ```
//!
//! Hauling and jerks are short, but a whale pulls for a long time. The device is at the endline's foot (the whale takes the whole
//! line without a trap), at the splice or at the buoy. Floats: for each endline the time `t` [s] and whether it was cut.

use endline_sdk::{Attribute, Descriptor, GearAction, GearStep, HookError, LineEnd, Rig, Site};

use crate::lay::Values;
use crate::trawl::Set;
use crate::{Laid, Layout};

/// Floats of each endline: time above the tension, and 1 once cut.
const FLOATS: usize = 2;

/// The gear type of one trap or more with a cutter in each endline.
pub type TimeTensionCutter = Laid<WithCutters>;

/// Layout of [`TimeTensionCutter`].
#[derive(Clone, Debug)]
pub struct WithCutters;

impl Layout for WithCutters {
    fn descriptor() -> Descriptor {
        let mut attributes = Set::attributes(1, 0.0, "polyball-a1");
        attributes.extend(Cutter::attributes());
        let help = "One trap or more with a cutter in each endline that parts it when the tension has \
         stayed high for a time.";
        Descriptor::new("org.endline.gear.time-tension-cutter", "Time-tension cutter", help)
            .with_attributes(attributes)
            .with_state(2 * FLOATS)
    }

    fn build(values: &Values<'_>, site: &Site) -> Result<Rig, HookError> {
        Set::read(values)?.build(site)
    }

    fn step(
        values: &Values<'_>,
        input: &GearStep<'_>,
        state: &mut [f64],
        actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        let (set, cutter) = (Set::read(values)?, Cutter::read(values)?);
        for (endline, floats) in state.chunks_exact_mut(FLOATS).take(set.endlines).enumerate() {
            let (line, end) = cutter.seat(&set, endline);
            let tension = input.end_tension_n.get(line).map_or(0.0, |ends| ends[end as usize]);
            if cutter.parts(tension, input.dt_s, floats) {
                let line = u32::try_from(line)
                    .map_err(|_| HookError::new("the gear has too many lines"))?;
                actions.push(GearAction::CutLine { line, end });
            }
        }
        Ok(())
    }
}

/// Place of the device in its endline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Seat {
    Foot,
    Splice,
    Buoy,
}

/// The device.
struct Cutter {
    tension_n: f64,
    hold_s: f64,
    at: Seat,
}

impl Cutter {
    fn attributes() -> Vec<Attribute> {
        vec![
            Attribute::number(
                "cutter_tension",
                "N",
                [1.0, 100_000.0],
                2200.0,
                "Tension above which the cutter's time is counted; about 500 lbf.",
            ),
            Attribute::number(
                "cutter_hold",
                "s",
                [0.0, 86_400.0],
                60.0,
                "Time above that tension after which the cutter parts the line.",
            ),
            Attribute::choice(
                "cutter_at",
                &["foot", "splice", "buoy"],
                "Position of the cutter along the endline.",
            ),
        ]
    }

    fn read(values: &Values<'_>) -> Result<Self, HookError> {
        let at = match values.word("cutter_at")? {
            "splice" => Seat::Splice,
            "buoy" => Seat::Buoy,
            _ => Seat::Foot,
        };
        Ok(Self {
            tension_n: values.number("cutter_tension")?,
            hold_s: values.number("cutter_hold")?,
            at,
        })
    }

    /// Index of the line, and its end, at which the device of an endline cuts.
    fn seat(&self, set: &Set<'_>, endline: usize) -> (usize, LineEnd) {
        let foot = set.first_line(endline);
        match self.at {
            Seat::Foot => (foot, LineEnd::A),
            Seat::Splice => (foot + 1, LineEnd::A),
            Seat::Buoy => (foot + set.endline.topmost(), LineEnd::B),
        }
    }

    /// Advances the time by one step; returns whether the device cuts now.
    fn parts(&self, tension_n: f64, dt_s: f64, floats: &mut [f64]) -> bool {
        let [above_s, done] = floats else { return false };
        if *done > 0.0 {
            return false;
        }
        *above_s = if tension_n >= self.tension_n { *above_s + dt_s } else { 0.0 };
        // Tolerance of half a step for rounding of the sum of steps.
        let parts = *above_s > 0.0 && *above_s >= self.hold_s - 0.5 * dt_s;
        *done = f64::from(u8::from(parts));
        parts
    }
}
