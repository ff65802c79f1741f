//! Once its scratch memory has grown, a step allocates nothing.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

mod linked;

use std::sync::LazyLock;
use std::time::Instant;

use allocation_counter::{AllocationInfo, measure};
use endline_sim::geometry::shape::SolidShape;
use endline_sim::model::{Obstacle, ROPE_ON_HARD_N_M2, Resolution};
use endline_sim::{DQuat, DVec3, Input, Model, State, Workspace, settle, step};
use linked::{built, spec};

/// Steps before counting begins.
const WARM_STEPS: u64 = 10;
/// Steps counted.
const STEPS: u64 = 200;
/// Allocations allowed while rope slides over skin: lists of pairs, slots and grips double as they meet
/// more than they ever held, a few times each; a single list allocated in each step would count 200.
const GROWTH: u64 = 100;

/// The shipped encounter on segments that keep their lengths, with the whale set down here.
fn encounter(place: DVec3) -> Model {
    let mut spec = spec("hello-endline", &[]);
    spec.whale.as_mut().unwrap().position_m = place;
    spec.settings.resolution = None;
    spec.settings.balance = true;
    built(spec)
}

/// A clock for the costs, as the session lends it.
fn clock_ns() -> u64 {
    static BEGAN: LazyLock<Instant> = LazyLock::new(Instant::now);
    BEGAN.elapsed().as_nanos() as u64
}

/// A run under way.
struct Run {
    model: Model,
    state: State,
    workspace: Workspace,
}

impl Run {
    fn new(model: Model) -> Self {
        let mut workspace = Workspace::new(&model);
        workspace.lend_clock(clock_ns);
        Self { state: settle(&model).state, workspace, model }
    }

    fn steps(&mut self, count: u64) {
        let pilot = &self.model.spec.whale.as_ref().unwrap().pilot;
        for _ in 0..count {
            let input = Input { controls: pilot.at(&self.state) };
            step(&self.model, &input, &mut self.state, &mut self.workspace).unwrap();
        }
    }
}

/// Asserts that no more was allocated than lists that grow need.
fn assert_only_grew(counted: &AllocationInfo) {
    let AllocationInfo { count_total, bytes_total, .. } = counted;
    assert!(*count_total < GROWTH, "{count_total} allocations, {bytes_total} bytes");
}

#[test]
fn free_rope_allocates_nothing() {
    let mut run = Run::new(encounter(DVec3::new(11.4, -60.0, -12.0)));
    run.steps(WARM_STEPS);
    let counted = measure(|| run.steps(STEPS));
    assert_eq!(run.workspace.audit.contact_steps, 0, "the whale was to stay far away");
    assert_eq!(counted.count_total, 0, "{} bytes", counted.bytes_total);
}

#[test]
fn resolution_that_follows_allocates_nothing() {
    let mut spec = encounter(DVec3::new(11.4, -9.0, -12.0)).spec;
    spec.settings.resolution = Some(Resolution { near_m: 0.02, edge_m: 0.01, far_m: 2.0 });
    let mut run = Run::new(Model::new(spec).unwrap_or_else(|errors| panic!("{errors:?}")));
    while run.workspace.audit.splits == 0 {
        run.steps(1);
    }
    let before = run.workspace.audit.splits;
    let counted = measure(|| run.steps(15));
    assert_eq!(run.workspace.audit.contact_steps, 0, "the whale was to stay away");
    assert!(run.workspace.audit.splits > before, "rope was to be split");
    assert_eq!(counted.count_total, 0, "{} bytes", counted.bytes_total);
}

/// The buoy that is drawn to a flipper, on segments that keep their lengths.
#[test]
fn a_body_on_skin_allocates_only_as_its_lists_grow() {
    let mut spec = spec("buoy-jams", &[]);
    spec.settings.resolution = None;
    spec.whale.as_mut().unwrap().position_m = DVec3::new(15.3, -7.0, -5.0);
    let mut run = Run::new(Model::new(spec).unwrap_or_else(|errors| panic!("{errors:?}")));
    while run.workspace.body_contacts.is_empty() {
        run.steps(1);
    }
    run.steps(WARM_STEPS);
    let counted = measure(|| run.steps(STEPS));
    assert!(!run.workspace.body_contacts.is_empty(), "the buoy was to stay on the skin");
    assert_only_grew(&counted);
}

/// The trap of the encounter on a plane in place of the seabed.
#[test]
fn a_body_on_an_obstacle_allocates_only_as_its_lists_grow() {
    let settled = encounter(DVec3::new(11.4, -60.0, -12.0));
    let mut spec = settled.spec.clone();
    spec.seabed = None;
    spec.obstacles.push(Obstacle {
        id: "plane".into(),
        shape: SolidShape::Plane,
        position_m: DVec3::NEG_Z * (spec.water.depth_m + 0.02),
        orientation: DQuat::from_rotation_y(0.01),
        friction: 0.5,
        stiffness_n_m2: ROPE_ON_HARD_N_M2,
    });
    let mut run = Run { state: settle(&settled).state, ..Run::new(built(spec)) };
    while run.state.pair_grips.is_empty() {
        run.steps(1);
    }
    run.steps(5 * WARM_STEPS);
    let counted = measure(|| run.steps(STEPS));
    assert!(!run.state.pair_grips.is_empty(), "the trap was to stay on the plane");
    assert_only_grew(&counted);
}

#[test]
fn rope_on_skin_allocates_only_as_its_lists_grow() {
    let mut run = Run::new(encounter(DVec3::new(13.9, -7.0, -12.0)));
    while run.workspace.contacts.is_empty() {
        run.steps(1);
    }
    run.steps(WARM_STEPS);
    let before = run.workspace.audit.contact_steps;
    let counted = measure(|| run.steps(STEPS));
    assert!(run.workspace.audit.contact_steps - before > STEPS, "rope was to stay on the skin");
    println!("{} allocations, {} bytes", counted.count_total, counted.bytes_total);
    assert_only_grew(&counted);
}

/// A dead whale with rope wound about it, which touches itself in most steps.
#[test]
fn rope_on_rope_allocates_only_as_its_lists_grow() {
    let mut spec = spec("dead-whale-wraps", &[]);
    spec.settings.resolution = None;
    let mut run = Run::new(built(spec));
    run.state = State::start(&run.model);
    run.steps(WARM_STEPS);
    let mut touching = 0;
    let counted = measure(|| {
        for _ in 0..STEPS {
            run.steps(1);
            touching += u64::from(!run.workspace.rope_touches.is_empty());
        }
    });
    assert!(touching > STEPS / 2, "rope was to touch rope, not only in {touching} steps");
    println!("{} allocations, {} bytes", counted.count_total, counted.bytes_total);
    assert_only_grew(&counted);
}
