//! Where rope touches the whale, and which act answers it.

use endline_sdk::{BodyPart, MotionInput, Side};

/// Rope must stay away this long for the next touch to count as a new one [s].
pub const NEW_TOUCH_S: f64 = 1.0;

/// The whale's own answer to touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// Which act, counted from 1.
    pub act: usize,
    /// Normal force on any one part above which it feels a touch [N].
    pub above_n: f64,
    /// It answers again after this long while the touch lasts [s]; infinite for never.
    pub again_s: f64,
}

/// What the whale feels of the last step's forces.
#[derive(Clone, Copy, Debug)]
pub struct Felt {
    /// Which parts are touched.
    pub parts: [bool; BodyPart::ALL.len()],
    /// Whether any is.
    pub any: bool,
    /// Whether nothing was for a while before.
    pub is_new: bool,
}

/// Which parts are touched with more than a force [N].
#[must_use]
pub fn touched(input: &MotionInput<'_>, above_n: f64) -> [bool; BodyPart::ALL.len()] {
    input.contact_force_n.map(|force| force > above_n)
}

/// How far from the midplane a touch of head, body or peduncle has a whole side [share of length]: half the breadth of the head.
const WHOLE_SIDE: f64 = 0.07;
/// Below this share of all the force the touch is in the middle.
const MIDDLE: f64 = 0.1;

/// The side of a touch: 1 left (port), -1 right, 0 where no force is on either side more than the other.
///
/// Flippers and flukes are on their own side; on head, body and peduncle it is where the touch lies.
#[must_use]
pub fn side(input: &MotionInput<'_>) -> f64 {
    let (mut sided, mut all) = (0.0, 0.0);
    for (part, (force, port_m)) in
        BodyPart::ALL.iter().zip(input.contact_force_n.iter().zip(input.contact_port_m))
    {
        all += force;
        sided += force
            * part.side().map_or_else(
                || (port_m / (WHOLE_SIDE * input.length_m)).clamp(-1.0, 1.0),
                Side::sign,
            );
    }
    if sided > MIDDLE * all {
        1.0
    } else if sided < -MIDDLE * all {
        -1.0
    } else {
        0.0
    }
}
