//! Figures of the whale, of its fluke beat and of a kinetic whale.

use endline_sim::metrics::{BeatSummary, HOOKED_TURNS, KineticSummary, RopePlace, WhaleSummary};

use super::View::{Compare, Entanglement, Summary, Table};
use super::{Figure, PART, PATCH, Quantity, list, object, parts};

/// Figures of the whale.
pub static WHALE: &[Figure<WhaleSummary>] = &[
    Figure::new(
        "outcome",
        "outcome",
        "Outcome of the encounter: `no_contact`, `shed`, `entangled`, `parted_free` or \
         `parted_entangled`.",
        Quantity::Name,
        |whale: &WhaleSummary| whale.outcome.name().into(),
    )
    .shown(&[Table, Compare])
    .column(100),
    Figure::new(
        "decided",
        "outcome is decided",
        "Whether the run was long enough for the outcome to be final.",
        Quantity::Flag,
        |whale: &WhaleSummary| whale.decided.into(),
    )
    .shown(&[Table])
    .column(101),
    Figure::new(
        "first_contact_s",
        "first contact",
        "Time at which rope first touched; none without contact.",
        Quantity::Moment,
        |whale: &WhaleSummary| whale.first_contact_s.into(),
    )
    .shown(&[Table, Summary, Entanglement, Compare])
    .column(102),
    Figure::new(
        "last_contact_s",
        "last contact",
        "Time at which rope last touched; none without contact.",
        Quantity::Moment,
        |whale: &WhaleSummary| whale.last_contact_s.into(),
    )
    .column(103),
    Figure::new(
        "contact_time_s",
        "time in contact",
        "Total time with any rope in contact.",
        Quantity::Duration,
        |whale: &WhaleSummary| whale.contact_time_s.into(),
    )
    .shown(&[Table, Summary, Entanglement, Compare])
    .column(104),
    Figure::new(
        "regions",
        "parts",
        "One object for each part of the body.",
        Quantity::Group,
        |whale: &WhaleSummary| list(PART, &parts(whale, &[])),
    ),
    Figure::new(
        "patches",
        "patches",
        "One object for each labelled patch of skin.",
        Quantity::Group,
        |whale: &WhaleSummary| list(PATCH, &whale.patches),
    ),
    Figure::new(
        "hooked",
        "hooked",
        "Whether rope touches, and has half a turn or more about some part since the whale was \
         last free.",
        Quantity::Flag,
        |whale: &WhaleSummary| whale.hooked.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "lodged_in_mouth",
        "lodged in the mouth",
        "Whether rope is lodged in the mouth at the end.",
        Quantity::Flag,
        |whale: &WhaleSummary| whale.lodged_in_mouth.into(),
    )
    .shown(&[Table])
    .column(111),
    Figure::new(
        "was_lodged_in_mouth",
        "was lodged in the mouth",
        "Whether rope was lodged in the mouth at any time.",
        Quantity::Flag,
        |whale: &WhaleSummary| whale.was_lodged_in_mouth.into(),
    )
    .column(108),
    Figure::new(
        "was_body_caught",
        "buoy or trap was caught on it",
        "Whether a trap, buoy or anchor stayed on the whale for 5 s at any time.",
        Quantity::Flag,
        |whale: &WhaleSummary| whale.was_body_caught.into(),
    )
    .shown(&[Table])
    .column(109),
    Figure::new(
        "peak_body_push_N",
        "greatest push of a buoy or trap",
        "Greatest sum of the pushes of a trap, buoy or anchor on skin in any solver step.",
        Quantity::Force,
        |whale: &WhaleSummary| whale.peak_body_push_n.into(),
    )
    .if_any()
    .shown(&[Table, Summary, Entanglement, Compare])
    .column(110),
    Figure::new(
        "drag_added_N",
        "added drag",
        "Drag of rope and gear that the whale carries, mean of the last 5 s.",
        Quantity::Force,
        |whale: &WhaleSummary| whale.drag_added_n.into(),
    )
    .shown(&[Table, Summary, Entanglement, Compare])
    .column(105),
    Figure::new(
        "speed_made_good_m_s",
        "speed made good",
        "Net displacement of the whale over the ground in the last 30 s, divided by the time: \
         nearly zero if fixed gear holds it.",
        Quantity::Speed,
        |whale: &WhaleSummary| whale.speed_made_good_m_s.into(),
    )
    .shown(&[Table, Entanglement])
    .column(112),
    Figure::new(
        "unchanged_s",
        "time unchanged",
        "Time for which the state of a held whale has not changed: no rope took hold or let go, no \
         turn changed by a quarter, and nothing parted. No line exceeded its earlier tensions by 5 \
         %.",
        Quantity::Duration,
        |whale: &WhaleSummary| whale.unchanged_s.into(),
    )
    .shown(&[Table])
    .column(113),
    Figure::new(
        "trailing_m",
        "trailing rope",
        "Length of rope from the whale to loose ends.",
        Quantity::Length,
        |whale: &WhaleSummary| whale.trailing_m.into(),
    )
    .shown(&[Table, Summary, Entanglement, Compare])
    .column(106),
    Figure::new(
        "tethered_m",
        "tethered rope",
        "Length of rope from the whale to traps, anchors and fixtures.",
        Quantity::Length,
        |whale: &WhaleSummary| whale.tethered_m.into(),
    )
    .shown(&[Table, Entanglement, Compare])
    .column(107),
    Figure::new(
        "carried",
        "carried bodies",
        "Ids of the traps, buoys and other bodies on that rope.",
        Quantity::Ids,
        |whale: &WhaleSummary| (&whale.carried).into(),
    )
    .shown(&[Table]),
    Figure::new(
        "carried_traps",
        "traps attached",
        "Number of traps to which rope from the whale leads.",
        Quantity::Count,
        |whale: &WhaleSummary| whale.carried_traps.into(),
    )
    .column(114),
    Figure::new(
        "carried_buoys",
        "buoys attached",
        "Number of buoys to which rope from the whale leads.",
        Quantity::Count,
        |whale: &WhaleSummary| whale.carried_buoys.into(),
    )
    .column(115),
    Figure::new(
        "rope_on_head",
        "held by rope at mouth or head",
        "Whether the whale is held with rope at the mouth or head at the end: contact in the last second, half a turn, or lodged in the mouth.",
        Quantity::Flag,
        |whale: &WhaleSummary| whale.has_rope_on(RopePlace::Head).into(),
    )
    .shown(&[Table])
    .column(116),
    Figure::new(
        "rope_on_flipper",
        "held by rope at a flipper",
        "Whether the whale is held with rope at a flipper at the end: contact in the last second or half a turn.",
        Quantity::Flag,
        |whale: &WhaleSummary| whale.has_rope_on(RopePlace::Flipper).into(),
    )
    .shown(&[Table])
    .column(117),
    Figure::new(
        "rope_on_tail",
        "held by rope at the tail",
        "Whether the whale is held with rope at peduncle or flukes at the end: contact in the last second or half a turn.",
        Quantity::Flag,
        |whale: &WhaleSummary| whale.has_rope_on(RopePlace::Tail).into(),
    )
    .shown(&[Table])
    .column(118),
    Figure::new(
        "wraps_present",
        "held with a wrap",
        "Whether the whale is held with half a turn or more about some part at the end.",
        Quantity::Flag,
        |whale: &WhaleSummary| whale.has_wraps(HOOKED_TURNS).into(),
    )
    .shown(&[Table])
    .column(119),
    Figure::new(
        "constricting",
        "a part is constricted",
        "Whether the whale is held with three quarters of a turn of touching rope about some part at the end.",
        Quantity::Flag,
        |whale: &WhaleSummary| whale.is_constricted().into(),
    )
    .shown(&[Table])
    .column(120),
    Figure::new(
        "trailing",
        "trails gear",
        "Whether the whale is held with more than 1 m of rope to loose ends at the end.",
        Quantity::Flag,
        |whale: &WhaleSummary| whale.is_trailing().into(),
    )
    .shown(&[Table])
    .column(121),
    Figure::new(
        "anchored",
        "is anchored",
        "Whether the whale is held at the end by rope to a trap, anchor or fixture, and made good no more than 0.1 m/s.",
        Quantity::Flag,
        |whale: &WhaleSummary| whale.is_anchored().into(),
    )
    .shown(&[Table])
    .column(122),
    Figure::new(
        "beat",
        "fluke beat",
        "The fluke beat, mean over all whole beats; none before a whole beat.",
        Quantity::Group,
        |whale: &WhaleSummary| whale.beat.as_ref().map(|beat| object(BEAT, beat)).into(),
    ),
    Figure::new(
        "kinetic",
        "kinetic whale",
        "Figures of a kinetic whale; none for a kinematic one.",
        Quantity::Group,
        |whale: &WhaleSummary| {
            whale.kinetic.as_ref().map(|kinetic| object(KINETIC, kinetic)).into()
        },
    ),
];

/// Figures of the fluke beat.
pub static BEAT: &[Figure<BeatSummary>] = &[
    Figure::new(
        "beats",
        "fluke beats",
        "Number of whole beats.",
        Quantity::Count,
        |beat: &BeatSummary| beat.beats.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "frequency_Hz",
        "beat frequency",
        "Beats divided by their time.",
        Quantity::Frequency,
        |beat: &BeatSummary| beat.frequency_hz.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "excursion_m",
        "beat excursion",
        "Distance of the fluke tips from top to bottom.",
        Quantity::Length,
        |beat: &BeatSummary| beat.excursion_m.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "speed_m_s",
        "speed while beating",
        "Speed through the water during the beats.",
        Quantity::Speed,
        |beat: &BeatSummary| beat.speed_m_s.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "strouhal",
        "Strouhal number",
        "Frequency times excursion divided by speed; none at rest.",
        Quantity::Number,
        |beat: &BeatSummary| beat.strouhal.into(),
    )
    .shown(&[Table]),
];

/// Figures of a kinetic whale; all down to the peaks are means of the last 5 s, all after them are of the whole run.
pub static KINETIC: &[Figure<KineticSummary>] = &[
    Figure::new(
        "thrust_N",
        "thrust",
        "Thrust of the flukes.",
        Quantity::Force,
        |kinetic: &KineticSummary| kinetic.thrust_n.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "power_W",
        "power",
        "Power input: that of the thrust divided by the efficiency.",
        Quantity::Power,
        |kinetic: &KineticSummary| kinetic.power_w.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "body_drag_N",
        "drag of its own body",
        "Drag of the whale's own body.",
        Quantity::Force,
        |kinetic: &KineticSummary| kinetic.body_drag_n.into(),
    ),
    Figure::new(
        "speed_m_s",
        "speed",
        "Speed through the water.",
        Quantity::Speed,
        |kinetic: &KineticSummary| kinetic.speed_m_s.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "speed_lost_m_s",
        "speed lost",
        "Speed that its motion requests, minus its speed.",
        Quantity::Speed,
        |kinetic: &KineticSummary| kinetic.speed_lost_m_s.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "peak_thrust_N",
        "peak thrust",
        "Greatest thrust of any step.",
        Quantity::Force,
        |kinetic: &KineticSummary| kinetic.peak_thrust_n.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "peak_rope_pull_N",
        "peak pull of rope",
        "Greatest pull of all rope on the whale, mean over any step.",
        Quantity::Force,
        |kinetic: &KineticSummary| kinetic.peak_rope_pull_n.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "velocity_m_s",
        "velocity through the water",
        "Velocity through the water at the end: east, north, up.",
        Quantity::Speed,
        |kinetic: &KineticSummary| kinetic.velocity_m_s.into(),
    ),
    Figure::new(
        "momentum_Ns",
        "momentum",
        "Momentum with added mass at the end: east, north, up.",
        Quantity::Impulse,
        |kinetic: &KineticSummary| kinetic.momentum_ns.into(),
    ),
    Figure::new(
        "momentum_change_Ns",
        "change of momentum ahead",
        "Change of momentum along its own axis, with added mass.",
        Quantity::Impulse,
        |kinetic: &KineticSummary| kinetic.balance.momentum_change_ns.into(),
    ),
    Figure::new(
        "thrust_impulse_Ns",
        "impulse of thrust",
        "Impulse of thrust.",
        Quantity::Impulse,
        |kinetic: &KineticSummary| kinetic.balance.thrust_impulse_ns.into(),
    ),
    Figure::new(
        "drag_impulse_Ns",
        "impulse of its drag",
        "Impulse of the drag of its own body; negative.",
        Quantity::Impulse,
        |kinetic: &KineticSummary| kinetic.balance.drag_impulse_ns.into(),
    ),
    Figure::new(
        "gear_impulse_Ns",
        "impulse of the gear ahead",
        "Impulse of the gear along its own axis; negative if it retards the whale.",
        Quantity::Impulse,
        |kinetic: &KineticSummary| kinetic.balance.gear_impulse_ns.into(),
    ),
    Figure::new(
        "residual_Ns",
        "momentum missed",
        "Change of momentum minus the three impulses: the error of the time steps, and the weight \
         of the body out of the water.",
        Quantity::Impulse,
        |kinetic: &KineticSummary| kinetic.balance.residual_ns().into(),
    ),
    Figure::new(
        "kinetic_J",
        "change of kinetic energy ahead",
        "Change of kinetic energy along its own axis, with added mass.",
        Quantity::Work,
        |kinetic: &KineticSummary| kinetic.balance.kinetic_j.into(),
    ),
    Figure::new(
        "thrust_work_J",
        "work of thrust",
        "Work of thrust.",
        Quantity::Work,
        |kinetic: &KineticSummary| kinetic.balance.thrust_work_j.into(),
    ),
    Figure::new(
        "drag_work_J",
        "work of its drag",
        "Work of the drag of its own body; negative.",
        Quantity::Work,
        |kinetic: &KineticSummary| kinetic.balance.drag_work_j.into(),
    ),
    Figure::new(
        "gear_work_J",
        "work of the gear",
        "Work of the gear along its own axis; negative if it retards the whale.",
        Quantity::Work,
        |kinetic: &KineticSummary| kinetic.balance.gear_work_j.into(),
    ),
    Figure::new(
        "residual_J",
        "energy missed",
        "Change of kinetic energy minus the three works.",
        Quantity::Work,
        |kinetic: &KineticSummary| kinetic.balance.residual_j().into(),
    ),
];
