//! Momentum and energy of the gear by source.

use endline_sim::balance::{BalanceSummary, Source};

use super::View::Table;
use super::{Figure, Quantity};

/// Impulse of a source.
const fn impulse(
    key: &'static str,
    label: &'static str,
    help: &'static str,
    read: fn(&BalanceSummary) -> super::Value,
) -> Figure<BalanceSummary> {
    Figure::new(key, label, help, Quantity::Impulse, read)
}

/// Work of a source.
const fn work(
    key: &'static str,
    label: &'static str,
    help: &'static str,
    read: fn(&BalanceSummary) -> super::Value,
) -> Figure<BalanceSummary> {
    Figure::new(key, label, help, Quantity::Work, read).shown(&[Table])
}

/// Momentum and energy of rope and bodies together since the run began.
pub static BALANCE: &[Figure<BalanceSummary>] = &[
    Figure::new(
        "greatest_Ns",
        "greatest impulse on the gear",
        "Greatest magnitude of the impulse of any source on the gear.",
        Quantity::Impulse,
        |balance: &BalanceSummary| balance.greatest_ns.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "residual_Ns",
        "momentum missed",
        "Greatest magnitude of the sum of all impulses minus the change of momentum: the error of \
         the solver.",
        Quantity::Impulse,
        |balance: &BalanceSummary| balance.residual_ns.into(),
    ),
    Figure::new(
        "residual_share",
        "momentum missed over greatest impulse",
        "`residual_Ns` as a share of `greatest_Ns`.",
        Quantity::Share,
        |balance: &BalanceSummary| balance.residual_share().into(),
    )
    .shown(&[Table]),
    Figure::new(
        "momentum_Ns",
        "change of momentum",
        "Change of the momentum of rope and bodies: east, north, up.",
        Quantity::Impulse,
        |balance: &BalanceSummary| balance.momentum_ns.into(),
    ),
    impulse(
        "weight_impulse_Ns",
        "impulse of weight",
        "Impulse of the weight of rope and bodies.",
        |balance| balance.impulse_ns[Source::Weight as usize].into(),
    ),
    impulse(
        "water_impulse_Ns",
        "impulse of water",
        "Impulse of the water: buoyancy, drag, added mass and the water's acceleration.",
        |balance| balance.impulse_ns[Source::Water as usize].into(),
    ),
    impulse(
        "skin_impulse_Ns",
        "impulse of the whale",
        "Impulse of skin on rope and bodies, and of lines made fast to the whale.",
        |balance| balance.impulse_ns[Source::Skin as usize].into(),
    ),
    impulse(
        "seabed_impulse_Ns",
        "impulse of the seabed",
        "Impulse of the seabed on rope and feet, with suction.",
        |balance| balance.impulse_ns[Source::Seabed as usize].into(),
    ),
    impulse(
        "obstacles_impulse_Ns",
        "impulse of obstacles",
        "Impulse of obstacles on rope and bodies.",
        |balance| balance.impulse_ns[Source::Obstacles as usize].into(),
    ),
    impulse(
        "fixtures_impulse_Ns",
        "impulse of fixtures",
        "Impulse of fixed, driven and pulled ends and of held bodies.",
        |balance| balance.impulse_ns[Source::Fixtures as usize].into(),
    ),
    work("weight_work_J", "work of weight on the gear", "Work of the weight.", |balance| {
        balance.work_j[Source::Weight as usize].into()
    }),
    work("water_work_J", "work of water on the gear", "Work of the water.", |balance| {
        balance.work_j[Source::Water as usize].into()
    }),
    work("skin_work_J", "work of the whale on the gear", "Work of the whale.", |balance| {
        balance.work_j[Source::Skin as usize].into()
    }),
    work("seabed_work_J", "work of the seabed on the gear", "Work of the seabed.", |balance| {
        balance.work_j[Source::Seabed as usize].into()
    }),
    work("obstacles_work_J", "work of obstacles on the gear", "Work of obstacles.", |balance| {
        balance.work_j[Source::Obstacles as usize].into()
    }),
    work("fixtures_work_J", "work of fixtures on the gear", "Work of fixtures.", |balance| {
        balance.work_j[Source::Fixtures as usize].into()
    }),
    work(
        "damping_J",
        "work of damping in rope",
        "Work of the axial damping of rope; negative if energy is dissipated.",
        |balance| balance.damping_j.into(),
    ),
    work(
        "contact_J",
        "work of the gear on itself",
        "Work of normal force and friction of rope on rope, rope on bodies and bodies on each \
         other; negative if energy is dissipated.",
        |balance| balance.contact_j.into(),
    ),
    work(
        "kinetic_J",
        "change of kinetic energy of the gear",
        "Change of the kinetic energy of rope and bodies.",
        |balance| balance.kinetic_j.into(),
    ),
    work(
        "elastic_J",
        "change of elastic energy of the gear",
        "Change of the energy of stretch and bending of rope.",
        |balance| balance.elastic_j.into(),
    ),
    work(
        "numerical_damping_J",
        "numerical damping",
        "Work of all sources minus material damping, gear-gear dissipation and the change of \
         energy. It includes the energy of parted lines and merged segments; negative if energy \
         was gained.",
        |balance| balance.numerical_damping_j().into(),
    ),
    Figure::new(
        "whale_missed_Ns",
        "impulse between whale and gear missed",
        "Magnitude of the sum of the impulse of the gear on a kinetic whale and that of the whale \
         on the gear; none if the whale is not kinetic.",
        Quantity::Impulse,
        |balance: &BalanceSummary| balance.whale_missed_ns.into(),
    ),
];
