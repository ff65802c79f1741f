//! What a run came to: plain numbers, in the order of the model.
//!
//! Fields whose key in the run summary carries a unit carry it here in lower case:
//! `peak_tension_n` is the key `peak_tension_N`. Definitions: `docs/entanglement.md`.

use endline_sdk::{BodyPart, Region};
use glam::DVec3;

use super::books::WhaleBooks;

/// The measures of a run so far.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// One for each line.
    pub lines: Vec<LineSummary>,
    /// One for each weak link.
    pub links: Vec<LinkSummary>,
    /// One for each body.
    pub bodies: Vec<BodySummary>,
    /// One for each probe.
    pub probes: Vec<ProbeSummary>,
    /// The whale, where the model has one.
    pub whale: Option<WhaleSummary>,
}

/// Tension of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct LineSummary {
    /// Id of the line.
    pub id: String,
    /// Greatest tension of any segment in any solver step that converged [N].
    pub peak_tension_n: f64,
    /// When that was [s].
    pub peak_at_s: f64,
    /// Greatest tension of any segment in any solver step that did not converge [N].
    pub unconverged_peak_n: f64,
    /// Tension at end A now [N].
    pub end_a_tension_n: f64,
    /// Tension at end B now [N].
    pub end_b_tension_n: f64,
    /// When it parted [s].
    pub parted_at_s: Option<f64>,
    /// Drag of the water on its rope now [N].
    pub drag_n: DVec3,
    /// Sum of the normal forces between it and the whale now [N].
    pub whale_normal_n: f64,
    /// Sum of the friction forces between it and the whale now [N].
    pub whale_friction_n: f64,
    /// Turns that the two legs of its strand make about each other beyond the whale now, above zero right-handed [turns].
    pub twist: f64,
    /// The most of those at any time, with their sign [turns].
    pub peak_twist: f64,
}

/// What a weak link bore.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkSummary {
    /// Id of the link.
    pub id: String,
    /// Tension above which it parts [N].
    pub rating_n: f64,
    /// Greatest tension of the segment it sits in, in any solver step that converged [N].
    pub peak_tension_n: f64,
    /// The same, in any solver step that did not converge [N].
    pub unconverged_peak_n: f64,
    /// When it parted [s].
    pub parted_at_s: Option<f64>,
}

/// Where a body is and how fast it went.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySummary {
    /// Id of the body.
    pub id: String,
    /// Place of its origin now [m].
    pub position_m: DVec3,
    /// Greatest speed over ground [m/s].
    pub peak_speed_m_s: f64,
    /// Drag of the water on it now [N].
    pub drag_n: DVec3,
    /// What it did to the whale.
    pub on_whale: BodyOnWhale,
}

/// What a body did to the whale.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyOnWhale {
    /// The part that it presses on most now.
    pub whale_part: Option<BodyPart>,
    /// Since when it has touched the whale, short gaps left out; `None` where it does not now [s].
    pub whale_since_s: Option<f64>,
    /// Time with it touching, in all [s].
    pub whale_contact_time_s: f64,
    /// Whether it has stayed on the whale long enough to count as caught there.
    pub caught: bool,
    /// Whether it ever was.
    pub was_caught: bool,
    /// Greatest push at the end of any solver step [N].
    pub peak_whale_push_n: f64,
    /// The part that it pressed on most in that step.
    pub peak_whale_part: Option<BodyPart>,
    /// Work done against friction [J].
    pub whale_friction_work_j: f64,
}

/// What a probe read.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeSummary {
    /// Id of the probe.
    pub id: String,
    /// Unit of the numbers: `N`, `m` or `J`.
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

/// How the whale came out of it.
#[derive(Clone, Debug, PartialEq)]
pub struct WhaleSummary {
    /// How it ended.
    pub outcome: Outcome,
    /// Whether the run was long enough for that outcome to stand.
    pub decided: bool,
    /// When rope first touched [s].
    pub first_contact_s: Option<f64>,
    /// When rope last touched [s].
    pub last_contact_s: Option<f64>,
    /// Time with any rope touching, in all [s].
    pub contact_time_s: f64,
    /// One for each [`BodyPart`], in the order of its number.
    pub regions: Vec<RegionSummary>,
    /// One for each labelled patch of skin, in the order of [`Region::ALL`].
    pub patches: Vec<PatchSummary>,
    /// Whether rope touches with half a turn or more about some part, or did since it last was free.
    pub hooked: bool,
    /// Whether rope is lodged in the mouth.
    pub lodged_in_mouth: bool,
    /// Whether it ever was.
    pub was_lodged_in_mouth: bool,
    /// Whether a trap, buoy or anchor was caught on it at any time.
    pub was_body_caught: bool,
    /// Greatest push of a trap, buoy or anchor on it at the end of any solver step [N].
    pub peak_body_push_n: f64,
    /// Drag of rope and gear that the whale carries, mean of the last 5 s [N].
    pub drag_added_n: f64,
    /// Drag of rope and gear that the whale carries at this moment [N].
    pub drag_added_now_n: f64,
    /// Straight way over the ground in the last 30 s, by time [m/s].
    pub speed_made_good_m_s: f64,
    /// Time for which nothing about a held whale has changed [s]; 0 for one that is not held.
    pub unchanged_s: f64,
    /// Rope from the whale to loose ends [m].
    pub trailing_m: f64,
    /// Rope from the whale to traps, anchors and fixtures [m].
    pub tethered_m: f64,
    /// Ids of the bodies that hang on the whale by that rope.
    pub carried: Vec<String>,
    /// Its fluke beat; `None` before a whole one.
    pub beat: Option<BeatSummary>,
    /// What it did, where it is kinetic.
    pub kinetic: Option<KineticSummary>,
    /// Alarm: steps in which a winding jumped by more than 0.3 turns along unbroken contact.
    pub winding_jumps: u64,
    /// Share of the normal force on it, over time, that is beyond what rope can press.
    pub beyond_rope_share: f64,
}

/// The fluke beat as swum, mean over all whole beats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeatSummary {
    /// How many whole beats.
    pub beats: u32,
    /// Beats by time [Hz].
    pub frequency_hz: f64,
    /// Way of the fluke tips from top to bottom [m].
    pub excursion_m: f64,
    /// Speed through the water meanwhile [m/s].
    pub speed_m_s: f64,
    /// Strouhal number, frequency times excursion over speed [1]; `None` at rest.
    pub strouhal: Option<f64>,
}

/// What a kinetic whale did; all down to the peaks are means of the last 5 s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KineticSummary {
    /// Thrust [N].
    pub thrust_n: f64,
    /// Power put in [W].
    pub power_w: f64,
    /// Drag of its own body [N].
    pub body_drag_n: f64,
    /// Speed through the water [m/s].
    pub speed_m_s: f64,
    /// Speed that its motion asked for, less the speed it had [m/s].
    pub speed_lost_m_s: f64,
    /// Greatest thrust of any step [N].
    pub peak_thrust_n: f64,
    /// Greatest pull of all rope on it, mean over any step [N].
    pub peak_rope_pull_n: f64,
    /// Velocity through the water at the end: east, north, up [m/s].
    pub velocity_m_s: DVec3,
    /// Momentum with added mass at the end: east, north, up [N s].
    pub momentum_ns: DVec3,
    /// Momentum and energy ahead by source.
    pub books: WhaleBooks,
}

/// Rope on one part of the whale.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionSummary {
    /// The part.
    pub part: BodyPart,
    /// Wraps now, loose loops included [turns].
    pub wraps: f64,
    /// Most wraps at any time [turns].
    pub peak_wraps: f64,
    /// Turns of touching rope now, from contact to contact [turns].
    pub touching_wraps: f64,
    /// Most of those at any time [turns].
    pub peak_touching_wraps: f64,
    /// Rope in contact now [m].
    pub contact_length_m: f64,
    /// Most rope in contact at any time [m].
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
    /// Rope in contact now [m].
    pub contact_length_m: f64,
    /// Normal forces now [N].
    pub normal_n: f64,
    /// Friction forces now, however they point [N].
    pub friction_n: f64,
    /// Force of rope on skin now, normal and friction as vectors [N].
    pub force_n: DVec3,
    /// Greatest tension of rope that presses there now [N].
    pub tension_n: f64,
    /// Most rope in contact at any time [m].
    pub peak_contact_length_m: f64,
    /// Greatest normal forces at any time [N].
    pub peak_normal_n: f64,
    /// Greatest friction forces at any time [N].
    pub peak_friction_n: f64,
    /// Greatest tension of rope that pressed there [N].
    pub peak_tension_n: f64,
    /// Greatest normal force of any contact by its length [N/m].
    pub peak_line_load_n_m: f64,
    /// Greatest normal force of any contact by its length and the rope's diameter: pressure [Pa].
    pub peak_pressure_pa: f64,
    /// Work of friction [J].
    pub friction_work_j: f64,
}

/// How an encounter ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Rope never touched the whale.
    NoContact,
    /// Rope touched and let go.
    Shed,
    /// Rope still holds.
    Entangled,
    /// A link or line parted and the whale came free.
    PartedFree,
    /// A link or line parted and rope still holds.
    PartedEntangled,
}

impl Outcome {
    /// Every outcome.
    pub const ALL: [Self; 5] =
        [Self::NoContact, Self::Shed, Self::Entangled, Self::PartedFree, Self::PartedEntangled];

    /// Its name in results, such as `parted_free`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::NoContact => "no_contact",
            Self::Shed => "shed",
            Self::Entangled => "entangled",
            Self::PartedFree => "parted_free",
            Self::PartedEntangled => "parted_entangled",
        }
    }
}
