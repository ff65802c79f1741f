//! What bodies on skin leave behind at the end of a solver step: friction's floats in the state, and a report.

use crate::contact::body_on_skin::{BodyContact, BodyOnSkin};
use crate::contact::law::friction_arrays::Failed;
use crate::model::Friction;
use crate::state::{BodyGrip, BodyGrips};

impl BodyOnSkin {
    /// Keeps the grips of an accepted step, and tells where bodies press.
    pub fn advance_friction(
        &mut self,
        friction: &Friction,
        dt_s: f64,
        grips: &mut BodyGrips,
        contacts: &mut Vec<BodyContact>,
    ) -> Result<(), Failed> {
        contacts.clear();
        self.arrays.advance(friction, dt_s)?;
        grips.clear();
        for (place, touch) in self.touches.iter().enumerate() {
            grips.contacts.push(BodyGrip {
                part: touch.part,
                place: self.measured[touch.body].inward(touch.place),
                normal: touch.normal,
            });
            self.arrays.keep(friction, place, &mut grips.floats);
            contacts.push(BodyContact {
                body: touch.body,
                triangle: self.pairs[touch.pair].triangle as usize,
                region: touch.region,
                position: touch.place,
                normal: touch.normal,
                depth_m: touch.depth,
                normal_force_n: touch.push_n,
                friction_n: self.arrays.friction_of(place),
                slip_m: self.arrays.slip_of(place),
            });
        }
        Ok(())
    }
}
