//! Summary of a run: plain numbers, in the order of the model.
//!
//! A field whose key in the run summary has a unit has it here in lower case:
//! `peak_tension_n` is the key `peak_tension_N`. Definitions: `docs/entanglement.md`.

use endline_sdk::{BodyPart, Limb, Region};
use glam::DVec3;
use strum::{IntoStaticStr, VariantArray};

use super::events::HOOKED_TURNS;
use super::lines::bin_at;
use super::whale_momentum::MomentumBalance;

/// Metrics of a run so far.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Lines, in the order of the model.
    pub lines: Vec<LineSummary>,
    /// Weak links, in the order of the model.
    pub links: Vec<LinkSummary>,
    /// Bodies, in the order of the model.
    pub bodies: Vec<BodySummary>,
    /// Probes, in the order of the model.
    pub probes: Vec<ProbeSummary>,
    /// The whale, where the model has one.
    pub whale: Option<WhaleSummary>,
}

/// Tension of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct LineSummary {
    /// Id of the line.
    pub id: String,
    /// Greatest tension of any segment in any converged solver step [N].
    pub peak_tension_n: f64,
    /// Time of that tension [s].
    pub peak_at_s: f64,
    /// Greatest tension of any segment in any unconverged solver step [N].
    pub unconverged_peak_n: f64,
    /// Tension at end A at the newest moment [N].
    pub end_a_tension_n: f64,
    /// Tension at end B at the newest moment [N].
    pub end_b_tension_n: f64,
    /// Time at which it parted [s].
    pub parted_at_s: Option<f64>,
    /// Drag of the water on its rope now [N].
    pub drag_n: DVec3,
    /// Sum of the normal forces between it and the whale now [N].
    pub whale_normal_n: f64,
    /// Sum of the friction forces between it and the whale now [N].
    pub whale_friction_n: f64,
    /// Greatest tension of its first segment, of all between, and of its last one, in any solver step [N]. Strengths differ there.
    pub place_peaks_n: [f64; 3],
    /// Greatest tension of each [`TENSION_BIN_M`](super::TENSION_BIN_M) of its unstretched length from end A, in any solver step [N].
    pub bin_peaks_n: Vec<f64>,
    /// Turns of the two legs of its strand about each other beyond the whale now; positive if right-handed [turns].
    pub twist: f64,
    /// Twist of the greatest magnitude at any time, signed [turns].
    pub peak_twist: f64,
}

impl LineSummary {
    /// Greatest tension of the bin of a place, by its unstretched length from end A [m]: at least that of the place itself [N].
    pub fn peak_near_n(&self, at_m: f64) -> f64 {
        self.bin_peaks_n[bin_at(at_m, self.bin_peaks_n.len())]
    }
}

/// Load of a weak link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkSummary {
    /// Id of the link.
    pub id: String,
    /// Tension above which it parts [N].
    pub rating_n: f64,
    /// Greatest tension of its segment in any converged solver step [N].
    pub peak_tension_n: f64,
    /// Greatest tension of its segment in any unconverged solver step [N].
    pub unconverged_peak_n: f64,
    /// Time at which it parted [s].
    pub parted_at_s: Option<f64>,
}

/// Position and speed of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySummary {
    /// Id of the body.
    pub id: String,
    /// Position of its origin now [m].
    pub position_m: DVec3,
    /// Greatest speed over ground [m/s].
    pub peak_speed_m_s: f64,
    /// Drag of the water on it now [N].
    pub drag_n: DVec3,
    /// Contact with the whale.
    pub on_whale: BodyOnWhale,
}

/// Contact of a body with the whale.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyOnWhale {
    /// Part with the greatest force now.
    pub whale_part: Option<BodyPart>,
    /// Start of the current contact, ignoring short gaps; `None` without contact [s].
    pub whale_since_s: Option<f64>,
    /// Total time in contact [s].
    pub whale_contact_time_s: f64,
    /// Whether it is caught on the whale.
    pub caught: bool,
    /// Whether it was caught at any time.
    pub was_caught: bool,
    /// Greatest force at the end of any solver step [N].
    pub peak_whale_push_n: f64,
    /// Part with the greatest force in that step.
    pub peak_whale_part: Option<BodyPart>,
    /// Work against friction [J].
    pub whale_friction_work_j: f64,
}

/// Readings of a probe.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeSummary {
    /// Id of the probe.
    pub id: String,
    /// Unit of the readings.
    pub unit: &'static str,
    /// Reading now.
    pub last: f64,
    /// Least reading.
    pub min: f64,
    /// Greatest reading.
    pub max: f64,
    /// Mean over time.
    pub mean: f64,
}

/// Metrics of the whale.
#[derive(Clone, Debug, PartialEq)]
pub struct WhaleSummary {
    /// Outcome.
    pub outcome: Outcome,
    /// Whether the run was long enough to decide the outcome.
    pub decided: bool,
    /// Time of the first contact [s].
    pub first_contact_s: Option<f64>,
    /// Time of the last contact [s].
    pub last_contact_s: Option<f64>,
    /// Total time with any rope in contact [s].
    pub contact_time_s: f64,
    /// Parts, in the order of [`BodyPart::ALL`].
    pub regions: Vec<RegionSummary>,
    /// Labelled patches of skin, in the order of [`Region::ALL`].
    pub patches: Vec<PatchSummary>,
    /// Whether rope has hooked in the current episode of contact: half a turn or more about a part while in contact.
    pub hooked: bool,
    /// Whether rope is lodged in the mouth.
    pub lodged_in_mouth: bool,
    /// Whether rope was lodged in the mouth at any time.
    pub was_lodged_in_mouth: bool,
    /// Whether a trap, buoy or anchor was caught on it at any time.
    pub was_body_caught: bool,
    /// Greatest force of a trap, buoy or anchor on it at the end of any solver step [N].
    pub peak_body_push_n: f64,
    /// Force of rope and gear against the whale's heading, mean of the last 5 s [N].
    pub drag_added_n: f64,
    /// Force of rope and gear against the whale's heading now [N].
    pub drag_added_now_n: f64,
    /// Speed made good over the ground in the last 30 s [m/s].
    pub speed_made_good_m_s: f64,
    /// Time since the last change of the hold on the whale; 0 for a whale that is not held [s].
    pub unchanged_s: f64,
    /// Rope from the whale to loose ends [m].
    pub trailing_m: f64,
    /// Rope from the whale to traps, anchors and fixtures [m].
    pub tethered_m: f64,
    /// Ids of the bodies attached to the whale by that rope.
    pub carried: Vec<String>,
    /// Number of traps among these.
    pub carried_traps: u64,
    /// Number of buoys among these.
    pub carried_buoys: u64,
    /// Fluke beat; `None` before the first whole beat.
    pub beat: Option<BeatSummary>,
    /// Effort of a kinetic whale.
    pub kinetic: Option<KineticSummary>,
    /// Alarm: number of steps in which a winding changed by more than 0.3 turns along unbroken contact.
    pub winding_jumps: u64,
    /// Share of the normal force on it over time that exceeds the force that rope can exert.
    pub beyond_rope_share: f64,
}

/// Greatest speed made good of a whale that is anchored by tethered rope; estimate [m/s].
pub const ANCHORED_M_S: f64 = 0.1;

/// Length of rope to loose ends above which a whale trails gear: the shortest that accounts of whales state is 0.9 m; estimate [m].
pub const TRAILING_M: f64 = 1.0;

/// Turns of touching rope about a part that constrict it; estimate [turns].
pub const CONSTRICTING_TURNS: f64 = 0.75;

/// Places at which accounts of entangled whales name rope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RopePlace {
    /// Mouth or head.
    Head,
    /// Either flipper.
    Flipper,
    /// Peduncle or flukes.
    Tail,
}

impl RopePlace {
    /// Whether a part of the body belongs to the place.
    pub fn has(self, part: BodyPart) -> bool {
        match self {
            Self::Head => part == BodyPart::Head,
            Self::Flipper => part.limb() == Limb::Flipper,
            Self::Tail => part == BodyPart::Peduncle || part.limb() == Limb::Fluke,
        }
    }
}

/// The state of a held whale in the terms of accounts of real whales. All are false of a whale that is not held.
impl WhaleSummary {
    /// Whether rope holds the whale.
    pub fn is_held(&self) -> bool {
        matches!(self.outcome, Outcome::Entangled | Outcome::PartedEntangled)
    }

    /// Whether it is held with rope at a place: rope touches there, makes [`HOOKED_TURNS`] or is lodged in the mouth.
    pub fn has_rope_on(&self, place: RopePlace) -> bool {
        let is_on = |part: &RegionSummary| part.touching || part.wraps >= HOOKED_TURNS;
        let mut own = self.regions.iter().filter(|part| place.has(part.part));
        self.is_held() && (own.any(is_on) || (place == RopePlace::Head && self.lodged_in_mouth))
    }

    /// Whether it is held with at least this many turns about some part [turns].
    pub fn has_wraps(&self, least: f64) -> bool {
        self.is_held() && self.regions.iter().any(|part| part.wraps >= least)
    }

    /// Whether it is held with [`CONSTRICTING_TURNS`] of touching rope about some part.
    pub fn is_constricted(&self) -> bool {
        let is_tight = |part: &RegionSummary| part.touching_wraps >= CONSTRICTING_TURNS;
        self.is_held() && self.regions.iter().any(is_tight)
    }

    /// Whether it is held with more than [`TRAILING_M`] of rope to loose ends.
    pub fn is_trailing(&self) -> bool {
        self.is_held() && self.trailing_m > TRAILING_M
    }

    /// Whether it is held by gear that is fast, and made good no more than [`ANCHORED_M_S`].
    pub fn is_anchored(&self) -> bool {
        self.is_held() && self.tethered_m > 0.0 && self.speed_made_good_m_s <= ANCHORED_M_S
    }
}

/// Fluke beat, mean over all whole beats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeatSummary {
    /// Number of whole beats.
    pub beats: u32,
    /// Frequency [Hz].
    pub frequency_hz: f64,
    /// Excursion of the fluke tips from top to bottom [m].
    pub excursion_m: f64,
    /// Speed through the water during these beats [m/s].
    pub speed_m_s: f64,
    /// Strouhal number, frequency times excursion over speed [1]; `None` at rest.
    pub strouhal: Option<f64>,
}

/// Effort of a kinetic whale; values before the peaks are means of the last 5 s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KineticSummary {
    /// Thrust [N].
    pub thrust_n: f64,
    /// Muscle power [W].
    pub power_w: f64,
    /// Drag of its own body [N].
    pub body_drag_n: f64,
    /// Speed through the water [m/s].
    pub speed_m_s: f64,
    /// Speed that its motion requested, minus the actual speed [m/s].
    pub speed_lost_m_s: f64,
    /// Greatest thrust of any step [N].
    pub peak_thrust_n: f64,
    /// Greatest force of all rope on it, mean over any step [N].
    pub peak_rope_pull_n: f64,
    /// Velocity through the water at the end: east, north, up [m/s].
    pub velocity_m_s: DVec3,
    /// Momentum with added mass at the end: east, north, up [N s].
    pub momentum_ns: DVec3,
    /// Momentum and energy along its axis by source.
    pub balance: MomentumBalance,
}

/// Rope on one part of the whale.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionSummary {
    /// Part.
    pub part: BodyPart,
    /// Whether rope touches it now, or did less than [`LOST_S`](super::LOST_S) ago.
    pub touching: bool,
    /// Wraps now, including loose loops [turns].
    pub wraps: f64,
    /// Greatest wraps at any time [turns].
    pub peak_wraps: f64,
    /// Turns of rope in contact now, from contact to contact [turns].
    pub touching_wraps: f64,
    /// Greatest turns of rope in contact at any time [turns].
    pub peak_touching_wraps: f64,
    /// Number of strands that lie across it now without a turn, outside the mouth.
    pub across: usize,
    /// Length of rope in contact now [m].
    pub contact_length_m: f64,
    /// Greatest length of rope in contact at any time [m].
    pub peak_contact_length_m: f64,
    /// Greatest sum of normal forces at any time [N].
    pub peak_normal_n: f64,
    /// Greatest pressure under the rope at any time [Pa].
    pub peak_pressure_pa: f64,
    /// Work of friction [J].
    pub friction_work_j: f64,
}

/// Rope on one labelled patch of skin; forces are sums over its contacts.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchSummary {
    /// The patch.
    pub region: Region,
    /// Length of rope in contact now [m].
    pub contact_length_m: f64,
    /// Sum of normal forces now [N].
    pub normal_n: f64,
    /// Sum of the magnitudes of friction forces now [N].
    pub friction_n: f64,
    /// Vector sum of the forces of rope on skin now [N].
    pub force_n: DVec3,
    /// Greatest tension of rope in contact there now [N].
    pub tension_n: f64,
    /// Greatest length of rope in contact at any time [m].
    pub peak_contact_length_m: f64,
    /// Greatest sum of normal forces at any time [N].
    pub peak_normal_n: f64,
    /// Greatest sum of friction forces at any time [N].
    pub peak_friction_n: f64,
    /// Greatest tension of rope in contact there at any time [N].
    pub peak_tension_n: f64,
    /// Greatest normal force of any contact per length [N/m].
    pub peak_line_load_n_m: f64,
    /// Greatest pressure: normal force of any contact per length and diameter of the rope [Pa].
    pub peak_pressure_pa: f64,
    /// Work of friction [J].
    pub friction_work_j: f64,
}

/// Outcome of an encounter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "snake_case")]
pub enum Outcome {
    /// Rope never touched the whale.
    NoContact,
    /// Rope touched and was shed.
    Shed,
    /// Rope still holds the whale.
    Entangled,
    /// A link or line parted and the whale is free.
    PartedFree,
    /// A link or line parted and rope still holds the whale.
    PartedEntangled,
}

impl Outcome {
    /// All outcomes.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Name in results, such as `parted_free`.
    pub fn name(self) -> &'static str {
        self.into()
    }
}
