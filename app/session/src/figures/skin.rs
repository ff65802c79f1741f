//! Figures of the whale's parts and of the patches of its skin.

use endline_sdk::BodyPart;
use endline_sim::ContactPoint;
use endline_sim::metrics::{PatchSummary, RegionSummary, WhaleSummary};

use super::View::{Compare, Entanglement, Summary, Table};
use super::{Figure, Quantity};

/// A part of the whale's body.
#[derive(Clone, Debug)]
pub struct Part {
    /// The measurements.
    pub summary: RegionSummary,
    /// Sum of the normal forces at the moment shown [N].
    pub normal_now_n: f64,
}

impl Part {
    /// Whether rope never touched it.
    pub fn is_untouched(&self) -> bool {
        self.summary.peak_contact_length_m <= 0.0
    }
}

/// The parts of a whale, with the contacts of the moment shown; of a finished run none are needed.
pub fn parts(whale: &WhaleSummary, contacts: &[ContactPoint]) -> Vec<Part> {
    let normal_now_n = |part: BodyPart| {
        let own = contacts.iter().filter(|contact| contact.region.part() == part);
        own.map(|contact| contact.normal_force_n.max(0.0)).sum()
    };
    let part = |summary: &RegionSummary| Part {
        summary: summary.clone(),
        normal_now_n: normal_now_n(summary.part),
    };
    whale.regions.iter().map(part).collect()
}

/// Figures of a part of the whale's body.
pub static PART: &[Figure<Part>] = &[
    Figure::new("region", "part", "Name of the part.", Quantity::Name, |part: &Part| {
        part.summary.part.name().into()
    })
    .shown(&[Table, Summary, Entanglement]),
    Figure::new(
        "touching",
        "rope touches it",
        "Whether rope touches the part at the end, or did less than a second before.",
        Quantity::Flag,
        |part: &Part| part.summary.touching.into(),
    ),
    Figure::new(
        "wraps",
        "wraps",
        "Turns of rope about the part at the end, loose loops included.",
        Quantity::Turns,
        |part: &Part| part.summary.wraps.into(),
    )
    .shown(&[Table, Summary, Entanglement])
    .column(0),
    Figure::new(
        "peak_wraps",
        "most wraps",
        "Greatest number of turns of rope about the part at any time.",
        Quantity::Turns,
        |part: &Part| part.summary.peak_wraps.into(),
    )
    .shown(&[Table, Entanglement, Compare])
    .column(1),
    Figure::new(
        "touching_wraps",
        "touching wraps",
        "Turns of touching rope at the end, from contact to contact.",
        Quantity::Turns,
        |part: &Part| part.summary.touching_wraps.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "peak_touching_wraps",
        "most touching wraps",
        "Greatest number of turns of touching rope at any time.",
        Quantity::Turns,
        |part: &Part| part.summary.peak_touching_wraps.into(),
    ),
    Figure::new(
        "across",
        "strands across",
        "Strands that lie across the part at the end without a turn, outside the mouth.",
        Quantity::Count,
        |part: &Part| part.summary.across.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "contact_length_m",
        "rope in contact",
        "Length of rope in contact at the end.",
        Quantity::Length,
        |part: &Part| part.summary.contact_length_m.into(),
    )
    .shown(&[Table, Summary, Entanglement])
    .column_named(2, "contact_m"),
    Figure::new(
        "peak_contact_length_m",
        "most rope in contact",
        "Greatest length of rope in contact at any time.",
        Quantity::Length,
        |part: &Part| part.summary.peak_contact_length_m.into(),
    )
    .column_named(3, "peak_contact_m"),
    Figure::new(
        "normal_now_N",
        "force now",
        "Sum of the normal forces at the moment shown.",
        Quantity::Force,
        |part: &Part| part.normal_now_n.into(),
    )
    .shown(&[Entanglement])
    .not_in_json(),
    Figure::new(
        "peak_normal_N",
        "peak force",
        "Greatest sum of the normal forces at any time.",
        Quantity::Force,
        |part: &Part| part.summary.peak_normal_n.into(),
    )
    .shown(&[Table, Summary, Entanglement, Compare])
    .column(4),
    Figure::new(
        "peak_pressure_Pa",
        "peak pressure",
        "Greatest pressure under the rope at any time.",
        Quantity::Pressure,
        |part: &Part| part.summary.peak_pressure_pa.into(),
    )
    .shown(&[Entanglement])
    .column(5),
    Figure::new(
        "friction_work_J",
        "friction work",
        "Work of friction over the run.",
        Quantity::Work,
        |part: &Part| part.summary.friction_work_j.into(),
    )
    .shown(&[Table, Summary, Entanglement]),
];

/// Figures of a labelled patch of skin; forces are sums over its contacts.
pub static PATCH: &[Figure<PatchSummary>] = &[
    Figure::new(
        "patch",
        "patch",
        "Name of the patch, such as `left_flipper_leading`.",
        Quantity::Name,
        |patch: &PatchSummary| patch.region.name().into(),
    )
    .shown(&[Table]),
    Figure::new(
        "contact_length_m",
        "rope in contact",
        "Length of rope in contact at the end.",
        Quantity::Length,
        |patch: &PatchSummary| patch.contact_length_m.into(),
    ),
    Figure::new(
        "normal_N",
        "normal force",
        "Sum of the normal forces at the end.",
        Quantity::Force,
        |patch: &PatchSummary| patch.normal_n.into(),
    ),
    Figure::new(
        "friction_N",
        "friction",
        "Sum of the magnitudes of the friction forces at the end.",
        Quantity::Force,
        |patch: &PatchSummary| patch.friction_n.into(),
    ),
    Figure::new(
        "force_N",
        "force of rope on skin",
        "Force of rope on skin at the end: normal forces and friction as vectors.",
        Quantity::ForceVector,
        |patch: &PatchSummary| patch.force_n.into(),
    ),
    Figure::new(
        "tension_N",
        "tension",
        "Greatest tension of rope that presses there at the end.",
        Quantity::Force,
        |patch: &PatchSummary| patch.tension_n.into(),
    ),
    Figure::new(
        "peak_contact_length_m",
        "most rope in contact",
        "Greatest length of rope in contact at any time.",
        Quantity::Length,
        |patch: &PatchSummary| patch.peak_contact_length_m.into(),
    ),
    Figure::new(
        "peak_normal_N",
        "peak normal force",
        "Greatest sum of the normal forces at any time.",
        Quantity::Force,
        |patch: &PatchSummary| patch.peak_normal_n.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "peak_friction_N",
        "peak friction",
        "Greatest sum of the friction forces at any time.",
        Quantity::Force,
        |patch: &PatchSummary| patch.peak_friction_n.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "peak_tension_N",
        "peak tension",
        "Greatest tension of rope that pressed there at any time.",
        Quantity::Force,
        |patch: &PatchSummary| patch.peak_tension_n.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "peak_line_load_N_m",
        "peak line load",
        "Greatest normal force of any contact divided by its length of rope.",
        Quantity::LineLoad,
        |patch: &PatchSummary| patch.peak_line_load_n_m.into(),
    ),
    Figure::new(
        "peak_pressure_Pa",
        "peak pressure",
        "Greatest line load divided by the rope's diameter.",
        Quantity::Pressure,
        |patch: &PatchSummary| patch.peak_pressure_pa.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "friction_work_J",
        "friction work",
        "Work of friction over the run.",
        Quantity::Work,
        |patch: &PatchSummary| patch.friction_work_j.into(),
    )
    .shown(&[Table]),
];
