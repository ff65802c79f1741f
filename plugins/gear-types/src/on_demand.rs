//! On-demand gear: no rope is in the water column until the gear is released.
//!
//! The endline is stowed at the trap, and an acoustic release holds its buoy down. At the commanded
//! time the release opens, and the buoy rises and pays the rope out.
//!
//! ```text
//!         buoy                            ~~~ buoy ~~~
//!          | hold, by the release   ->        |
//!   flakes | ties                             |  the whole endline
//!   ====  trap  ====                         trap
//! ```
//!
//! The stowage (bag, spool or cage) is modelled by its effect. The endline lies beside the trap in flakes, with a tie to the
//! trap between adjacent flakes. Release and ties open together, once, at the commanded time. The rope is sinking rope;
//! floating rope would form bights above the trap.
//!
//! Floats: one for each endline, 1 once it has been released.

use endline_sdk::{
    Attribute, BodyKind, Descriptor, GearAction, GearStep, HookError, LineEnd, Rig, RigEnd, Site,
};

use crate::lay::{FAR, Foot, Ground, Lay, Values, depth_of};
use crate::{Laid, Layout};

/// Greatest number of endlines: one at each end.
const MOST_ENDLINES: usize = 2;
/// Ends of the flakes relative to the foot of the trap: along the gear, to each side, and up [m].
const TIED_AT_M: [f64; 3] = [0.6, 0.4, 0.1];
/// Initial height of the buoy's middle above the end of its hold line [m].
const BUOY_UP_M: f64 = 0.5;

/// The gear type of traps with a stowed endline.
pub type OnDemand = Laid<Stowed>;

/// Layout of [`OnDemand`].
#[derive(Clone, Debug)]
pub struct Stowed;

impl Layout for Stowed {
    fn descriptor() -> Descriptor {
        let mut attributes = Ground::attributes(1, 0.0);
        attributes.extend(Stow::attributes());
        let help = "One trap or more whose endline lies stowed at the trap until an acoustic release \
         lets its buoy rise.";
        Descriptor::new("org.endline.gear.on-demand", "On-demand", help)
            .with_attributes(attributes)
            .with_state(MOST_ENDLINES)
    }

    fn build(values: &Values<'_>, site: &Site) -> Result<Rig, HookError> {
        let (ground, stow) = (Ground::read(values)?, Stow::read(values)?);
        let mut rig = Lay::default();
        let feet = ground.lay(&mut rig, site)?;
        for (foot, prefix) in feet.iter().zip(["", FAR]).take(stow.endlines) {
            stow.lay(&mut rig, foot, site, prefix)?;
        }
        Ok(rig.rig)
    }

    fn step(
        values: &Values<'_>,
        input: &GearStep<'_>,
        state: &mut [f64],
        actions: &mut Vec<GearAction>,
    ) -> Result<(), HookError> {
        let stow = Stow::read(values)?;
        for (endline, released) in state.iter_mut().take(stow.endlines).enumerate() {
            if *released > 0.0 || input.time_s < stow.release_at_s[endline] {
                continue;
            }
            *released = 1.0;
            let first = endline as u32 * stow.flakes;
            actions
                .extend((first..first + stow.flakes).map(|link| GearAction::ReleaseLink { link }));
        }
        Ok(())
    }
}

/// A stowed endline. Its links are the release and a tie between adjacent flakes: as many as flakes.
struct Stow<'a> {
    endlines: usize,
    buoy: &'a str,
    rope: &'a str,
    scope: f64,
    flakes: u32,
    hold_m: f64,
    release: &'a str,
    release_at_s: [f64; MOST_ENDLINES],
}

impl<'a> Stow<'a> {
    fn attributes() -> Vec<Attribute> {
        let mut attributes = stowed_attributes();
        attributes.extend(release_attributes());
        attributes
    }

    fn read(values: &Values<'a>) -> Result<Self, HookError> {
        Ok(Self {
            endlines: values.count("endlines")? as usize,
            buoy: values.needed("buoy")?,
            rope: values.needed("rope")?,
            scope: values.number("scope")?,
            flakes: values.count("flakes")?,
            hold_m: values.number("hold_length")?,
            release: values.needed("release")?,
            release_at_s: [values.number("release_at")?, values.number("far_release_at")?],
        })
    }

    /// Adds the endline beside the body at a foot; `prefix` is put before its ids.
    fn lay(&self, into: &mut Lay, foot: &Foot, site: &Site, prefix: &str) -> Result<(), HookError> {
        let flake_m = self.scope * depth_of(site)? / f64::from(self.flakes);
        let at = |x: f64, y: f64, z: f64| {
            [foot.body_at_m[0] + x, foot.body_at_m[1] + y, foot.body_at_m[2] + z]
        };
        let buoy = into.body(
            &format!("{prefix}buoy"),
            BodyKind::Buoy,
            self.buoy,
            at(TIED_AT_M[0], 0.0, self.hold_m + BUOY_UP_M),
        );
        self.hold(into, &format!("{prefix}release"), [foot.body.clone(), buoy.clone()]);
        let mut from = foot.body.clone();
        for flake in 1..=self.flakes {
            // Flakes lie alternately on both sides; each leads out and back.
            let side = if flake.is_multiple_of(2) { 1.0 } else { -1.0 };
            let [x, y, z] = TIED_AT_M;
            let (start, turn, end) =
                (at(x, side * y, z), at(x, side * (y + flake_m / 2.0), 0.05), at(x, side * y, z));
            let to = if flake == self.flakes {
                buoy.clone()
            } else {
                into.joint(&format!("{prefix}flake-{flake}"), end)
            };
            into.line_along(
                &format!("{prefix}endline-{flake}"),
                self.rope,
                [from, to.clone()],
                flake_m,
                vec![start, turn, end],
            );
            if flake < self.flakes {
                self.hold(into, &format!("{prefix}tie-{flake}"), [foot.body.clone(), to.clone()]);
            }
            from = to;
        }
        Ok(())
    }

    /// A line from the trap that opens at its other end.
    fn hold(&self, into: &mut Lay, id: &str, ends: [RigEnd; 2]) {
        into.line(&format!("{id}-line"), self.rope, ends, self.hold_m);
        into.link(id, self.release, &format!("{id}-line"), LineEnd::B);
    }
}

/// The stowed endline and its buoy.
fn stowed_attributes() -> Vec<Attribute> {
    vec![
        Attribute::count(
            "endlines",
            [1, 2],
            1,
            "Number of stowed endlines: 1 at the near end, 2 at both.",
        ),
        Attribute::item(
            "buoy",
            "buoys",
            "bullet-7x16",
            "The buoy; its lift must be less than the trap's weight in water.",
        ),
        Attribute::item(
            "rope",
            "ropes",
            "sink-3-8",
            "Rope of the stowed endline; sinking rope, or it floats out of the stow.",
        ),
        Attribute::number(
            "scope",
            "1",
            [1.0, 5.0],
            1.3,
            "Length of the endline as a multiple of water depth.",
        ),
        Attribute::count("flakes", [2, 60], 8, "Number of flakes of the stowed endline."),
        Attribute::number(
            "hold_length",
            "m",
            [0.6, 5.0],
            1.0,
            "Length of the line that holds the buoy down, and of the flakes' ties.",
        ),
    ]
}

/// The acoustic release and its times.
fn release_attributes() -> Vec<Attribute> {
    vec![
        Attribute::item(
            "release",
            "weak-links",
            "acoustic-release",
            "The acoustic release; above its rating it parts by itself.",
        ),
        Attribute::number(
            "release_at",
            "s",
            [0.0, 1e7],
            60.0,
            "Time of the call of the near endline's release.",
        ),
        Attribute::number(
            "far_release_at",
            "s",
            [0.0, 1e7],
            1e7,
            "Time of the call of the far endline's release, if there is one.",
        ),
    ]
}
