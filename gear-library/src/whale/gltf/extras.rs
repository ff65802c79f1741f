//! What a glTF file carries beyond glTF: how bones turn, how far, and what whale it is. For readers and other programs;
//! Endline itself goes by the bones' names.

use endline_sim::whale::{Bone, Channel, JointRanges};
use glam::DVec3;
use serde_json::{Value, json};

/// What a file says of its whale besides the skin.
#[derive(Clone, Copy, Debug)]
pub struct About<'a> {
    /// Id of the library's whale.
    pub id: &'a str,
    /// Its name.
    pub name: &'a str,
    /// Body length [m].
    pub length_m: f64,
    /// How far its joints turn.
    pub joints: &'a JointRanges,
}

/// On a bone: each angle of the posture that turns it, its share, its axis in the bone's own axes (those of the whale's frame),
/// and the angle's whole range.
pub(super) fn bone_extras(bone: &Bone, ranges: &JointRanges) -> Value {
    let turn = |(channel, axis): &(Channel, DVec3)| {
        let (angle, of) = channel.angle.name();
        let [least, most] = ranges.of(channel.angle).map(degrees);
        json!({ "angle": angle, "of": of, "share": channel.share, "axis": axis.to_array(), "least_deg": least, "most_deg": most })
    };
    json!({ "turns": bone.turns.iter().map(turn).collect::<Vec<_>>() })
}

/// On the root: the whale, and the bounds of the whole spine.
pub(super) fn whale_extras(about: &About<'_>) -> Value {
    let [pitch, yaw, roll] = about.joints.spine_total.map(degrees);
    json!({
        "endline": 1,
        "whale": about.id,
        "length_m": about.length_m,
        "axes": "bones: x to the snout, y to port, z to the back",
        "spine_total_deg": { "pitch": pitch, "yaw": yaw, "roll": roll },
    })
}

/// Degrees without the last digits of a conversion; none for an angle without bound.
fn degrees(angle: f64) -> Option<f64> {
    angle.is_finite().then(|| (angle.to_degrees() * 1e9).round() / 1e9)
}
