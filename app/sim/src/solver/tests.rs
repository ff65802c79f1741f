//! Rope as lanes against rope as lines and against a dense system, and lanes of one width against another.

use glam::{DMat3, DQuat, DVec3};
use pulp::Arch;

use crate::matrix::outer;
use crate::model::{
    Body, BodyRole, Joint, JointKind, Line, Model, ModelSpec, PlacedShape, Rope, Seabed, Settings,
    Shape, Strength,
};
use crate::solver::Solver;
use crate::state::State;
use crate::system::LinearSystem;
use crate::system::coupled::ContactBlock;
use crate::system::tests::Method;
use crate::trial::StepContext;
use crate::trial::scheme::Scheme;
use crate::water::{Current, Water};

/// Number of iterations after which Newton has converged, although bending is only approximate in each.
const PASSES: usize = 40;

fn rope(id: &str, mass_kg_m: f64, bending_stiffness_n_m2: f64) -> Rope {
    Rope {
        id: id.into(),
        diameter_m: 0.01,
        mass_kg_m,
        displaced_m3_m: 6e-5,
        axial_stiffness_n: 5e4,
        axial_stiffening_n: 2e5,
        axial_damping_n_s: 4.0,
        bending_stiffness_n_m2,
        drag_normal: 1.2,
        drag_tangential: 0.015,
        drag_tangential_viscous: 0.4,
        ..Rope::default()
    }
}

fn buoy() -> Body {
    Body {
        id: "buoy".into(),
        item: String::new(),
        role: BodyRole::Buoy,
        parts: vec![PlacedShape::about_origin(Shape::Sphere(0.2))],
        mass_kg: 3.0,
        inertia_kg_m2: DVec3::splat(0.05),
        added_mass_kg: DVec3::splat(8.0),
        added_inertia_kg_m2: DVec3::ZERO,
        drag_area_m2: DVec3::splat(0.06),
        turn_drag_m5: DVec3::splat(1e-3),
        floats: vec![crate::model::Float::level(DVec3::ZERO, 0.03, 0.4)],
        wetted_drag: true,
        feet_m: Vec::new(),
        foot_radius_m: Vec::new(),
        start_friction: 0.0,
        slide_friction: 0.0,
        foot_break_out_n: 0.0,
        position_m: DVec3::new(12.0, 3.0, -8.0),
        orientation: DQuat::IDENTITY,
        spin_rad_s: DVec3::ZERO,
        held_until_s: None,
    }
}

/// Three lines of unlike length and rope from an anchor over a splice to a buoy, with a tail that may lie on the seabed.
pub(crate) fn model(depth_m: f64, current_m_s: f64) -> Model {
    let joint = |id: &str, kind, position_m| Joint { id: id.into(), kind, position_m };
    let line = |id: &str, rope, from, to, length_m: f64, segments: usize| Line {
        id: id.into(),
        rope,
        from,
        to,
        segments_m: (0..segments)
            .map(|k| length_m / segments as f64 * if k % 2 == 0 { 1.1 } else { 0.9 })
            .collect(),
        strength: Strength::default(),
        weak_places: Vec::new(),
        knots_m: [0.0; 2],
        start_m: Vec::new(),
    };
    let spec = ModelSpec {
        water: Water {
            density_kg_m3: 1025.0,
            gravity_m_s2: 9.81,
            depth_m,
            rope_dries: true,
            current: Current::uniform(DVec3::new(current_m_s, 0.2 * current_m_s, 0.0)),
            waves: None,
        },
        seabed: Some(Seabed {
            depth_m,
            normal: DVec3::Z,
            rope_stiffness_n_m2: 5e3,
            foot_stiffness_n_m: 1e5,
            rope_friction: 0.5,
        }),
        ropes: vec![rope("float", 0.05, 0.0), rope("sink", 0.08, 0.02)],
        joints: vec![
            joint("anchor", JointKind::Fixed, DVec3::new(0.0, 0.0, -20.0)),
            joint("splice", JointKind::Free, DVec3::new(6.0, 1.0, -14.0)),
            joint(
                "buoy",
                JointKind::Body { body: 0, offset_m: DVec3::new(0.0, 0.0, -0.2) },
                DVec3::ZERO,
            ),
            joint("tail", JointKind::Free, DVec3::new(9.0, -7.0, -19.0)),
        ],
        lines: vec![
            line("low", 0, 0, 1, 9.0, 60),
            line("high", 1, 1, 2, 11.0, 37),
            line("tail", 1, 1, 3, 12.0, 9),
        ],
        bodies: vec![buoy()],
        links: Vec::new(),
        gear: Vec::new(),
        whale: None,
        friction: None,
        obstacles: Vec::new(),
        probes: Vec::new(),
        settings: Settings::default(),
    };
    Model::new(spec).expect("a sound model")
}

/// Places after `passes` passes of one step from a rig that has begun to move.
fn in_lanes(
    model: &Model,
    state: &State,
    scheme: &Scheme,
    passes: usize,
    arch: Option<Arch>,
) -> Vec<DVec3> {
    let mut solver = Solver::new(model);
    if let Some(arch) = arch {
        solver.system.lanes.set_arch(arch);
    }
    solver.begin_in_lanes(model, state, scheme, |_| ());
    for _ in 0..passes {
        assert!(solver.pass_in_lanes(&StepContext { model, state, scheme }, 1.0).finite);
    }
    let mut after = state.clone();
    solver.store(model, scheme, &mut after);
    after.rope.position
}

pub(crate) fn moving(model: &Model) -> State {
    let mut state = State::start(model);
    let mut workspace = crate::Workspace::new(model);
    for _ in 0..5 {
        crate::step(model, &crate::Input::default(), &mut state, &mut workspace)
            .expect("a rig that moves");
    }
    state
}

/// Eight of the rig in one model: a group of pieces that all begin at an anchor.
fn eight(model: &Model) -> Model {
    let (mut spec, one) = (model.spec.clone(), &model.spec);
    for rig in 1..8 {
        let (joints, bodies) = (spec.joints.len(), spec.bodies.len());
        spec.bodies.extend(
            one.bodies.iter().map(|body| Body { id: format!("{}-{rig}", body.id), ..body.clone() }),
        );
        spec.joints.extend(one.joints.iter().map(|joint| {
            let kind = match &joint.kind {
                JointKind::Body { body, offset_m } => {
                    JointKind::Body { body: body + bodies, offset_m: *offset_m }
                }
                kind => kind.clone(),
            };
            Joint { id: format!("{}-{rig}", joint.id), kind, ..joint.clone() }
        }));
        let line = |line: &Line| Line {
            id: format!("{}-{rig}", line.id),
            from: line.from + joints,
            to: line.to + joints,
            ..line.clone()
        };
        spec.lines.extend(one.lines.iter().map(line));
    }
    Model::new(spec).expect("eight sound models")
}

#[test]
fn lanes_solve_what_the_lines_solve() {
    let one = model(60.0, 0.7);
    for model in [eight(&one), one, model(19.05, 0.3)] {
        let (state, scheme) = (moving(&model), Scheme::bdf2(0.01, 0.01));
        let context = StepContext { model: &model, state: &state, scheme: &scheme };
        let mut solver = Solver::new(&model);
        solver.begin(&model, &state, &scheme);
        for _ in 0..PASSES {
            solver.assemble(&context);
            solver.solve(&model);
            solver.advance(&model, 1.0);
        }
        let lanes = in_lanes(&model, &state, &scheme, PASSES, None);
        let apart = solver
            .trial
            .place
            .iter()
            .zip(&lanes)
            .map(|(one, other)| one.distance(*other))
            .fold(0.0, f64::max);
        let moved = state
            .rope
            .position
            .iter()
            .zip(&lanes)
            .map(|(one, other)| one.distance(*other))
            .fold(0.0, f64::max);
        assert!(
            moved > 1e-3 && apart < 1e-9,
            "{} nodes: {apart} m apart after a move of {moved} m",
            model.node_count
        );
    }
}

/// Forces and unsymmetric blocks, as friction has them, on every third segment: piece ends and line ends are among them.
fn contacts(model: &Model) -> Vec<(usize, f64, DVec3, DMat3)> {
    let contact = |segment: usize| {
        let phase = segment as f64;
        let (sin, cos) = (libm::sin(phase), libm::cos(1.7 * phase));
        let normal = DVec3::new(sin, cos, 0.4).normalize();
        let across = normal.any_orthonormal_vector();
        let block = outer(normal, normal) * (2e4 + 1e4 * sin) + outer(across, normal) * (6e3 * cos);
        (segment, 0.5 + 0.45 * sin, (normal + across * 0.3) * (20.0 * cos), block)
    };
    (0..model.segment_count).step_by(3).chain([1, 0]).map(contact).collect()
}

/// Adds forces on rope; `coupled` adds couplings of ropes, at ends of lines, inside and across piece ends, several on one node.
fn add_contacts(model: &Model, system: &mut LinearSystem, coupled: bool) {
    for (segment, fraction, force, block) in contacts(model) {
        let node = segment + model.segment_line[segment];
        system.add_on_rope([segment, node], fraction, force, &block);
    }
    if !coupled {
        return;
    }
    let last = model.segment_count - 1;
    let pairs = (0..last).step_by(7).map(|segment| [segment, last - segment]);
    for (at, segments) in pairs.chain([[0, 1], [3, 9], [4, 9], [last / 2, last]]).enumerate() {
        let block = DMat3::from_cols_array(&[3.0, 0.2, -0.4, 0.9, 2.0, 0.1, -0.3, 0.5, 1.0]);
        let coupling = ContactBlock {
            segments,
            nodes: segments.map(|segment| segment + model.segment_line[segment]),
            fractions: [0.3, 0.8],
            block: block * (2e3 * (1 + at % 5) as f64),
        };
        assert!(system.couple_ropes(coupling, DVec3::new(5.0, -3.0, 8.0)));
    }
}

/// One pass with contact, line by line and in lanes of two widths.
#[test]
fn lanes_solve_contact_as_the_lines_do() {
    let one = model(60.0, 0.7);
    for (model, coupled) in [(eight(&one), false), (eight(&one), true), (one, true)] {
        let (state, scheme) = (moving(&model), Scheme::backward_euler(0.002));
        let context = StepContext { model: &model, state: &state, scheme: &scheme };
        let mut lines = Solver::new(&model);
        lines.begin(&model, &state, &scheme);
        lines.assemble(&context);
        add_contacts(&model, &mut lines.system, coupled);
        lines.solve(&model);
        lines.advance(&model, 1.0);
        let in_lanes = |arch: Option<Arch>| {
            let mut solver = Solver::new(&model);
            if let Some(arch) = arch {
                solver.system.lanes.set_arch(arch);
            }
            solver.begin_in_lanes(&model, &state, &scheme, |_| ());
            add_contacts(&model, &mut solver.system, coupled);
            assert!(solver.pass_in_lanes(&context, 1.0).finite);
            solver.take_places();
            solver.trial.place
        };
        let (wide, narrow) = (in_lanes(None), in_lanes(Some(Arch::Scalar)));
        let greatest =
            |of: &dyn Fn(usize) -> f64| (0..model.node_count).map(of).fold(0.0, f64::max);
        let apart = greatest(&|node| lines.trial.place[node].distance(wide[node]));
        let moved = greatest(&|node| state.rope.position[node].distance(wide[node]));
        assert!(moved > 1e-3 && apart < 1e-9, "{apart} m apart after a move of {moved} m");
        assert_eq!(wide, narrow);
    }
}

/// One iteration with contact and with couplings of rope on rope, as lines and as one dense matrix.
#[test]
fn elimination_solves_what_a_dense_system_solves() {
    for model in [model(60.0, 0.7), model(19.05, 0.3)] {
        let (state, scheme) = (moving(&model), Scheme::backward_euler(0.002));
        let context = StepContext { model: &model, state: &state, scheme: &scheme };
        let steps = [Method::Elimination, Method::Dense].map(|method| {
            let mut solver = Solver::new(&model);
            solver.system.method = method;
            solver.begin(&model, &state, &scheme);
            solver.assemble(&context);
            for (segment, fraction, force, block) in contacts(&model) {
                let node = segment + model.segment_line[segment];
                solver.system.add_on_rope([segment, node], fraction, force, &block);
            }
            for (nodes, fractions) in [([3, 40], [0.2, 0.9]), ([10, 70], [0.5, 0.1])] {
                let block = DMat3::from_diagonal(DVec3::new(1e4, 2e4, 3e4));
                let segments = nodes
                    .map(|node| node - model.line_nodes.partition_point(|nodes| nodes.end <= node));
                let coupling = ContactBlock { segments, nodes, fractions, block };
                assert!(solver.system.couple_ropes(coupling, DVec3::new(5.0, -3.0, 8.0)));
            }
            solver.solve(&model);
            (solver.system.rope.step.clone(), solver.system.interface.step.clone())
        });
        let [(rope, interface), (dense_rope, dense_interface)] = &steps;
        let pairs = rope.iter().zip(dense_rope).chain(interface.iter().zip(dense_interface));
        let (mut apart, mut moved) = (0.0_f64, 0.0_f64);
        for (one, other) in pairs {
            apart = apart.max(one.distance(*other));
            moved = moved.max(other.length());
        }
        assert!(moved > 1e-4 && apart < 1e-9 * moved.max(1.0), "{apart} of {moved} m");
    }
}

/// A whole run with the dense system ends where the run of the program ends.
#[test]
fn a_run_with_a_dense_system_is_the_same_run() {
    let model = model(19.05, 0.3);
    let ends = [Method::Elimination, Method::Dense].map(|method| {
        let (mut state, mut workspace) = (moving(&model), crate::Workspace::new(&model));
        workspace.solver.system.method = method;
        for _ in 0..5 {
            crate::step(&model, &crate::Input::default(), &mut state, &mut workspace)
                .expect("a rig that moves");
        }
        state.rope.position
    });
    let apart = ends[0].iter().zip(&ends[1]).map(|(one, other)| one.distance(*other));
    let apart = apart.fold(0.0, f64::max);
    // Both end within the tolerance of Newton, which is 1 mm of move.
    assert!(apart < 1e-3, "{apart} m");
}

#[test]
fn the_width_of_the_lanes_changes_no_bit() {
    let model = model(19.05, 0.7);
    let (state, scheme) = (moving(&model), Scheme::bdf2(0.01, 0.01));
    let wide = in_lanes(&model, &state, &scheme, 3, None);
    let narrow = in_lanes(&model, &state, &scheme, 3, Some(Arch::Scalar));
    assert!(
        wide.iter()
            .zip(&narrow)
            .all(|(one, other)| one.to_array().map(f64::to_bits)
                == other.to_array().map(f64::to_bits))
    );
}
