//! Posture: the joint angles of a whale.

/// Spine joints from the skull (0) to the peduncle's end (`SPINE_JOINTS - 1`).
pub const SPINE_JOINTS: usize = 8;

/// Place of each spine joint of a right whale, as a share of body length aft of the snout [1];
/// other bodies may differ a little.
pub const SPINE_STATIONS: [f64; SPINE_JOINTS] = [0.27, 0.36, 0.45, 0.55, 0.64, 0.73, 0.81, 0.885];

/// Place of the hinge of the flukes on the peduncle, as a share of body length aft of the snout [1].
pub const FLUKE_STATION: f64 = 0.93;

/// Joint angles of a whale [rad]; all zero is the rest posture.
///
/// The section at mid-body is fixed to the whale's frame: joints ahead of it move the head,
/// joints aft of it the tail. The documentation of each field states its sign.
///
/// Index 0 of a pair is the left (port) side, 1 the right.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Posture {
    /// Each spine joint about the whale's y axis; positive bends the part aft of it down.
    pub spine_pitch: [f64; SPINE_JOINTS],
    /// Each spine joint about the whale's z axis; positive swings the part aft of it to starboard.
    pub spine_yaw: [f64; SPINE_JOINTS],
    /// Each spine joint about the whale's x axis (torsion); positive turns the part aft of it starboard side down.
    pub spine_roll: [f64; SPINE_JOINTS],
    /// Flukes against the peduncle about y; positive turns the trailing edge down.
    pub fluke_pitch: f64,
    /// Bend of each fluke blade; positive lifts the tip.
    pub fluke_flex: [f64; 2],
    /// Flipper swept aft about the dorsal axis; 0 at rest, positive aft, negative forward.
    pub flipper_sweep: [f64; 2],
    /// Flipper raised (abducted) away from the body; positive lifts the tip.
    pub flipper_raise: [f64; 2],
    /// Flipper twisted about its long axis; positive pronates (leading edge down).
    pub flipper_twist: [f64; 2],
    /// Flipper blade bent; positive lifts the tip.
    pub flipper_flex: [f64; 2],
    /// Jaw drop; 0 closed, positive open.
    pub jaw: f64,
    /// Lower lips turned out; 0 closed against the rostrum, positive open.
    pub lips: [f64; 2],
}

impl Posture {
    /// Its angles by name, grouped by joints or sides.
    #[must_use]
    pub fn groups(&self) -> [(&'static str, &[f64]); 11] {
        let Self { spine_pitch, spine_yaw, spine_roll, fluke_pitch, fluke_flex, .. } = self;
        let Self { flipper_sweep, flipper_raise, flipper_twist, flipper_flex, jaw, lips, .. } =
            self;
        [
            ("spine_pitch", spine_pitch),
            ("spine_yaw", spine_yaw),
            ("spine_roll", spine_roll),
            ("fluke_pitch", std::slice::from_ref(fluke_pitch)),
            ("fluke_flex", fluke_flex),
            ("flipper_sweep", flipper_sweep),
            ("flipper_raise", flipper_raise),
            ("flipper_twist", flipper_twist),
            ("flipper_flex", flipper_flex),
            ("jaw", std::slice::from_ref(jaw)),
            ("lips", lips),
        ]
    }

    /// The places of its angles, in the order of [`groups`](Self::groups).
    pub fn angles_mut(&mut self) -> impl Iterator<Item = &mut f64> {
        let Self { spine_pitch, spine_yaw, spine_roll, fluke_pitch, fluke_flex, .. } = self;
        let Self { flipper_sweep, flipper_raise, flipper_twist, flipper_flex, jaw, lips, .. } =
            self;
        let spine = spine_pitch.iter_mut().chain(spine_yaw).chain(spine_roll);
        let flippers =
            flipper_sweep.iter_mut().chain(flipper_raise).chain(flipper_twist).chain(flipper_flex);
        spine.chain([fluke_pitch]).chain(fluke_flex).chain(flippers).chain([jaw]).chain(lips)
    }

    /// Its angles, in the order of [`groups`](Self::groups) [rad].
    pub fn angles(&self) -> impl Iterator<Item = f64> {
        self.groups().into_iter().flat_map(|(_, angles)| angles.iter().copied())
    }
}
