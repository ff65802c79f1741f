//! The summary of a run as JSON: schema `endline.run/1`. Scripts depend on it; keys may be added,
//! never renamed. Each key that carries a unit ends in it.

mod of;
mod validity;

use std::collections::BTreeMap;

use serde::Serialize;

use crate::recording::PluginUsed;

/// Name of the schema.
pub const SCHEMA: &str = "endline.run/1";

/// Summary of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Always [`SCHEMA`].
    pub schema: &'static str,
    /// The scenario's file as the user named it.
    pub scenario: String,
    /// Seed.
    pub seed: u64,
    /// Simulated time [s].
    pub simulated_s: f64,
    /// Real time of the steps, statics apart [s].
    pub wall_s: f64,
    /// Simulated seconds for each real one.
    pub times_real_time: f64,
    /// Step between inputs [s].
    pub dt_s: f64,
    /// Steps taken.
    pub steps: u64,
    /// Rope nodes.
    pub nodes: usize,
    /// Triangles of the whale's skin.
    pub triangles: usize,
    /// Hash of the last state.
    pub state_hash: String,
    /// Whether the numbers can be trusted: not stopped, nothing tunnelled, nothing not finite.
    pub valid: bool,
    /// Why not, in plain words; empty where it is valid.
    pub invalid_because: Vec<String>,
    /// Why the run stopped before its end.
    pub stopped: Option<String>,
    /// What the reader should know of the solver's work.
    pub audit: AuditReport,
    /// One for each line.
    pub lines: Vec<LineReport>,
    /// One for each weak link.
    pub links: Vec<LinkReport>,
    /// One for each body.
    pub bodies: Vec<BodyReport>,
    /// One for each probe.
    pub probes: Vec<ProbeReport>,
    /// The whale; `null` without one.
    pub whale: Option<WhaleReport>,
    /// Steps before rope first came near the whale.
    pub approach: PhaseReport,
    /// That step and all after it.
    pub contact: PhaseReport,
    /// The statics before the run.
    pub settled: SettledReport,
    /// Events in the order in which they were noticed.
    pub events: Vec<EventReport>,
    /// Version of Endline.
    pub version: &'static str,
    /// BLAKE3 of the scenario, the gear library and the options.
    pub model_hash: String,
    /// Plugins of the model.
    pub plugins: Vec<PluginUsed>,
}

/// See [`Audit`](endline_sim::Audit).
#[derive(Clone, Debug, Serialize)]
pub struct AuditReport {
    /// Times rope passed through skin.
    pub tunnelled: u64,
    /// Deepest the rope's surface sank into the skin [m].
    pub max_penetration_m: f64,
    /// Times rope passed through rope.
    pub ropes_crossed: u64,
    /// Most pairs of segments at a time that run through each other since the start, and are left alone.
    pub ropes_through: u64,
    /// Solver steps, away from the whale, with rope on rope.
    pub rope_steps: u64,
    /// Nearest that the rope's centre line came to skin it touched [m]; `null` where it never touched.
    pub least_distance_m: Option<f64>,
    /// Alarm: steps in which wraps jumped by more than 0.3 turns along unbroken contact.
    pub winding_jumps: u64,
    /// Numbers that were not finite.
    pub non_finite: u64,
    /// Solver steps.
    pub solver_steps: u64,
    /// Solver steps with rope near the whale.
    pub contact_steps: u64,
    /// Solver steps redone shorter.
    pub halved: u64,
    /// Solver steps accepted above the wanted residual.
    pub unconverged: u64,
    /// Newton passes.
    pub passes: u64,
    /// Segments split, each paid for by a merge, as resolution followed the whale.
    pub splits: u64,
    /// Steps in which the whale's posture was held at its joints' ranges.
    pub postures_held: u64,
    /// Solver steps by what kept them from being longer: `inputs`, `accuracy`, `snap`, `contact`, `parting`, `convergence`.
    pub steps_limited_by: BTreeMap<&'static str, u64>,
    /// What limited most of them, in plain words.
    pub steps_mostly_limited_by: String,
}

/// A line.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct LineReport {
    /// Id.
    pub id: String,
    /// Greatest tension of any segment [N].
    pub peak_tension_N: f64,
    /// When that was [s].
    pub peak_at_s: f64,
    /// Tension at end A at the end [N].
    pub end_a_tension_N: f64,
    /// Tension at end B at the end [N].
    pub end_b_tension_N: f64,
    /// Greatest tension of any segment in the settled state [N].
    pub settled_tension_N: f64,
    /// When it parted [s].
    pub parted_at_s: Option<f64>,
    /// Drag of the water on its rope at the end: east, north, up [N].
    pub drag_N: [f64; 3],
    /// Sum of the normal forces between it and the whale at the end [N].
    pub whale_normal_N: f64,
    /// Sum of the friction forces between it and the whale at the end [N].
    pub whale_friction_N: f64,
}

/// A weak link.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct LinkReport {
    /// Id.
    pub id: String,
    /// Tension above which it parts [N].
    pub rating_N: f64,
    /// Greatest tension it bore [N].
    pub peak_tension_N: f64,
    /// When it parted [s].
    pub parted_at_s: Option<f64>,
}

/// A body.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct BodyReport {
    /// Id.
    pub id: String,
    /// Place at the end [m].
    pub position_m: [f64; 3],
    /// Greatest speed [m/s].
    pub peak_speed_m_s: f64,
    /// Drag of the water on it at the end: east, north, up [N].
    pub drag_N: [f64; 3],
}

/// A probe.
#[derive(Clone, Debug, Serialize)]
pub struct ProbeReport {
    /// Id.
    pub id: String,
    /// Unit of the numbers.
    pub unit: &'static str,
    /// Reading at the end.
    #[serde(rename = "final")]
    pub last: f64,
    /// Least.
    pub min: f64,
    /// Greatest.
    pub max: f64,
    /// Mean over time.
    pub mean: f64,
}

/// The whale.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct WhaleReport {
    /// `no_contact`, `shed`, `entangled`, `parted_free` or `parted_entangled`.
    pub outcome: &'static str,
    /// Whether the run was long enough for that to stand.
    pub decided: bool,
    /// When rope first touched [s].
    pub first_contact_s: Option<f64>,
    /// When rope last touched [s].
    pub last_contact_s: Option<f64>,
    /// Time with rope touching [s].
    pub contact_time_s: f64,
    /// One for each body part.
    pub regions: Vec<RegionReport>,
    /// One for each labelled patch of skin, finer than the parts.
    pub patches: Vec<PatchReport>,
    /// Whether rope touches, and has gone half a turn or more about some part since the whale last was free.
    pub hooked: bool,
    /// Whether rope is lodged in the mouth at the end.
    pub lodged_in_mouth: bool,
    /// Whether it ever was.
    pub was_lodged_in_mouth: bool,
    /// Drag of rope and gear the whale carries [N].
    pub drag_added_N: f64,
    /// Rope from the whale to loose ends [m].
    pub trailing_m: f64,
    /// Rope from the whale to what holds it [m].
    pub tethered_m: f64,
    /// Ids of the traps, buoys and other bodies that hang on the whale by that rope.
    pub carried: Vec<String>,
    /// The fluke beat, mean over all whole beats; null before one.
    pub beat: Option<BeatReport>,
    /// What a kinetic whale did; `null` for a kinematic one.
    pub kinetic: Option<KineticReport>,
}

/// What a kinetic whale did; all but the peaks are means of the last 5 s.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct KineticReport {
    /// Thrust [N].
    pub thrust_N: f64,
    /// Power put in: that of the thrust over the efficiency [W].
    pub power_W: f64,
    /// Drag of its own body [N].
    pub body_drag_N: f64,
    /// Speed through the water [m/s].
    pub speed_m_s: f64,
    /// Speed asked of it, less the speed it had [m/s].
    pub speed_lost_m_s: f64,
    /// Greatest thrust [N].
    pub peak_thrust_N: f64,
    /// Greatest pull of all rope on it [N].
    pub peak_rope_pull_N: f64,
}

/// How the whale beat its flukes; see [`BeatSummary`](endline_sim::metrics::BeatSummary).
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct BeatReport {
    /// Whole beats.
    pub beats: u32,
    /// Beats by time [Hz].
    pub frequency_Hz: f64,
    /// Way of the fluke tips from top to bottom [m].
    pub excursion_m: f64,
    /// Speed through the water meanwhile [m/s].
    pub speed_m_s: f64,
    /// Frequency times excursion over speed; null at rest.
    pub strouhal: Option<f64>,
}

/// Rope on a body part.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct RegionReport {
    /// Name of the part.
    pub region: &'static str,
    /// Wraps at the end, loose loops included [turns].
    pub wraps: f64,
    /// Most wraps [turns].
    pub peak_wraps: f64,
    /// Turns of touching rope at the end, from contact to contact [turns].
    pub touching_wraps: f64,
    /// Most of those [turns].
    pub peak_touching_wraps: f64,
    /// Rope in contact at the end [m].
    pub contact_length_m: f64,
    /// Most rope in contact [m].
    pub peak_contact_length_m: f64,
    /// Greatest sum of normal forces [N].
    pub peak_normal_N: f64,
    /// Greatest pressure under the rope [Pa].
    pub peak_pressure_Pa: f64,
    /// Work of friction [J].
    pub friction_work_J: f64,
}

/// Rope on a labelled patch of skin; forces are sums over its contacts.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct PatchReport {
    /// Name of the patch, such as `left_flipper_leading`.
    pub patch: &'static str,
    /// Rope in contact at the end [m].
    pub contact_length_m: f64,
    /// Normal forces at the end [N].
    pub normal_N: f64,
    /// Friction forces at the end [N].
    pub friction_N: f64,
    /// Force of rope on skin at the end: east, north, up [N].
    pub force_N: [f64; 3],
    /// Greatest tension of rope that presses there at the end [N].
    pub tension_N: f64,
    /// Most rope in contact [m].
    pub peak_contact_length_m: f64,
    /// Greatest normal forces [N].
    pub peak_normal_N: f64,
    /// Greatest friction forces [N].
    pub peak_friction_N: f64,
    /// Greatest tension of rope that pressed there [N].
    pub peak_tension_N: f64,
    /// Greatest normal force by length of rope [N/m].
    pub peak_line_load_N_m: f64,
    /// The same by the rope's diameter: pressure [Pa].
    pub peak_pressure_Pa: f64,
    /// Work of friction [J].
    pub friction_work_J: f64,
}

/// A phase of a run.
#[derive(Clone, Debug, Serialize)]
pub struct PhaseReport {
    /// Simulated time [s].
    pub simulated_s: f64,
    /// Real time [s].
    pub wall_s: f64,
    /// Simulated seconds for each real one; 0 where the phase is empty.
    pub times_real_time: f64,
}

/// The statics before a run.
#[derive(Clone, Debug, Serialize)]
#[allow(non_snake_case, reason = "keys of the JSON contract carry their units")]
pub struct SettledReport {
    /// Whether the run began from rest.
    pub settled: bool,
    /// What statics found, in words.
    pub outcome: String,
    /// Greatest force out of balance [N].
    pub residual_N: f64,
    /// Real time [s].
    pub wall_s: f64,
}

/// Something that happened.
#[derive(Clone, Debug, Serialize)]
pub struct EventReport {
    /// When [s].
    pub time_s: f64,
    /// What, such as `link_parted`.
    pub kind: &'static str,
    /// Of what.
    pub subject: String,
    /// The number that goes with it.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
}

impl Report {
    /// One line of JSON.
    #[must_use]
    pub fn json(&self) -> String {
        // Structs of numbers and strings always serialise; the empty string would fail every reader at once.
        serde_json::to_string(self).unwrap_or_default()
    }
}
