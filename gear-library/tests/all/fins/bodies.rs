//! Fast random meetings of a buoy or trap with a piece of the right whale's skin: fins, jaws, lips and trunk.
//!
//! Every meeting is drawn from its number alone. A ball, a buoy with rounded ends or a box, of 2 to 100 kg, hangs in
//! the sea; the piece approaches from any side in any attitude at 2 to 20 m/s, rotates, and its middle is aimed at the body. A run begins one step or two
//! before they can touch and continues until the piece would have passed.

use std::sync::Arc;

use endline_friction_models::Coulomb;
use endline_gear::whale::{WhaleForm, build_skin};
use endline_sdk::FrictionModel;
use endline_sim::model::{Body, BodyRole, Friction, PlacedShape, Settings, Shape, Whale};
use endline_sim::water::{Current, Water};
use endline_sim::whale::Skin;
use endline_sim::{DQuat, DVec3, Input, Model, ModelSpec, State, Workspace, step};

use super::dice::Dice;
use super::piece::{piece, reach};
use super::{MET, REACH_M, rig};

/// Interval of the skin's vertices about which pieces are cut out.
const STRIDE: usize = 7;

/// Pieces of skin, each about a vertex at its origin.
pub struct Pieces(Vec<Skin>);

/// Counts of meetings.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    pub meetings: u64,
    /// With contact.
    pub met: u64,
    /// With the body's core across skin.
    pub crossed: u64,
    /// Ended for another reason.
    pub ended: u64,
    pub solver_steps: u64,
    pub unconverged: u64,
    /// Numbers of the first that crossed or ended, with the message.
    pub reported: Vec<String>,
}

impl Pieces {
    /// Cuts pieces out of a right whale of 13.7 m, evenly over its skin.
    pub fn new() -> Self {
        let whole = build_skin(&WhaleForm::right_whale(13.7));
        let all = (0..whole.vertices.len()).step_by(STRIDE);
        let about = |vertex: usize| piece(&whole, u32::try_from(vertex).expect("few vertices"));
        Self(all.map(about).filter(|piece| reach(piece) < REACH_M).collect())
    }

    /// The meeting of a number: its model, its steps and the random values.
    pub fn meeting(&self, number: u64, swept: bool) -> (ModelSpec, u64, String) {
        self.meeting_of(number, swept, None)
    }

    /// The meeting of a number with a body of a kind, or of one of the first three as drawn.
    pub fn meeting_of(
        &self,
        number: u64,
        swept: bool,
        kind: Option<u32>,
    ) -> (ModelSpec, u64, String) {
        let mut dice = Dice::of(number);
        let usual = Settings::default();
        let contact_step_s = if swept { usual.contact_step_s } else { usual.step_s };
        let settings = Settings { swept, contact_step_s, ..usual };
        let mut skin = self.0[(dice.share() * self.0.len() as f64) as usize % self.0.len()].clone();
        let (turned, heading) = (dice.turn(), dice.turn());
        skin.vertices.iter_mut().for_each(|place| *place = turned * *place);
        let speed_m_s = dice.between(2.0, 20.0);
        let turn_rate = (dice.direction() * (0.5 * speed_m_s * dice.share())).to_array();
        let body = body(&mut dice, kind);
        let size = size_of(&body.parts);
        let forward = heading * DVec3::X;
        // A body of several parts is met anywhere along its staff, any other near its middle. The path to the former is long, so the piece rotates less on it.
        let is_long = body.parts.len() > 1;
        let turn_rate = if is_long { turn_rate.map(|rate| 0.1 * rate) } else { turn_rate };
        let along_m = if is_long { dice.between(-0.9, 0.9) * size } else { 0.0 };
        let aimed = MET + body.orientation * (DVec3::Z * along_m);
        let aside_m = if is_long { 0.02 } else { 0.5 * size };
        let beside = dice.direction();
        let beside = (beside - forward * beside.dot(forward)) * aside_m;
        let before_m =
            reach(&skin) + size + speed_m_s * usual.contact_step_s * dice.between(0.5, 2.0);
        let whale = Whale {
            position_m: aimed + beside - forward * before_m,
            orientation: heading,
            speed_m_s,
            ..rig::whale(skin.clone(), speed_m_s, turn_rate)
        };
        let past_m = before_m + reach(&skin) + size;
        let steps = (past_m / speed_m_s / settings.step_s).ceil() as u64;
        let reported = format!("{speed_m_s:.1} m/s, {:?} of {:.1} kg", body.parts, body.mass_kg);
        (spec(whale, body, dice.between(0.05, 0.6), settings), steps, reported)
    }
}

/// Half of the longest side of a body [m].
fn size_of(parts: &[PlacedShape]) -> f64 {
    let size = |part: &PlacedShape| {
        let own = match &part.shape {
            Shape::Sphere(radius_m) => *radius_m,
            Shape::Capsule { half_length_m, .. } => *half_length_m,
            Shape::Box(half) => half.length(),
            Shape::Cylinder { radius_m, half_length_m } => radius_m.max(*half_length_m),
            Shape::Spheroid { across_m, along_m } => across_m.max(*along_m),
        };
        part.middle_m.length() + own
    };
    parts.iter().map(size).fold(0.0, f64::max)
}

/// A float with a staff through it and a counterweight at its foot.
fn high_flyer(dice: &mut Dice) -> Vec<PlacedShape> {
    let part = |radius_m: f64, half_length_m: f64, height: f64| PlacedShape {
        shape: Shape::Cylinder { radius_m, half_length_m },
        middle_m: DVec3::Z * height,
    };
    let (half_length_m, float_m) = (dice.between(0.6, 1.8), dice.between(-0.2, 0.2));
    vec![
        part(dice.between(0.1, 0.2), dice.between(0.1, 0.25), float_m),
        part(dice.between(0.012, 0.03), half_length_m, 0.0),
        part(0.05, 0.075, 0.08 - half_length_m),
    ]
}

/// A body of a kind: ball, rounded buoy, box; flat-ended buoy, spheroid, high-flyer.
fn parts(dice: &mut Dice, kind: u32) -> Vec<PlacedShape> {
    let shape = match kind {
        0 => Shape::Sphere(dice.between(0.03, 0.2)),
        1 => {
            let radius_m = dice.between(0.03, 0.12);
            Shape::Capsule { radius_m, half_length_m: radius_m * dice.between(1.2, 4.0) }
        }
        2 => Shape::Box(DVec3::new(
            dice.between(0.2, 0.6),
            dice.between(0.15, 0.4),
            dice.between(0.1, 0.25),
        )),
        3 => Shape::Cylinder {
            radius_m: dice.between(0.05, 0.2),
            half_length_m: dice.between(0.05, 0.4),
        },
        4 => {
            Shape::Spheroid { across_m: dice.between(0.08, 0.2), along_m: dice.between(0.08, 0.4) }
        }
        _ => return high_flyer(dice),
    };
    vec![PlacedShape::about_origin(shape)]
}

fn body(dice: &mut Dice, kind: Option<u32>) -> Body {
    let drawn = (3.0 * dice.share()) as u32;
    let parts = parts(dice, kind.unwrap_or(drawn));
    let mass_kg = 2.0 * libm::pow(50.0, dice.share());
    let orientation = dice.turn();
    Body { orientation, ..adrift(parts, mass_kg, MET) }
}

/// A body without buoyancy, weight or support.
pub fn adrift(parts: Vec<PlacedShape>, mass_kg: f64, position_m: DVec3) -> Body {
    let size = size_of(&parts);
    Body {
        id: "body".into(),
        item: String::new(),
        role: BodyRole::Buoy,
        parts,
        mass_kg,
        inertia_kg_m2: DVec3::splat(0.3 * mass_kg * size * size),
        added_mass_kg: DVec3::ZERO,
        added_inertia_kg_m2: DVec3::ZERO,
        drag_area_m2: DVec3::splat(0.05),
        turn_drag_m5: DVec3::splat(1e-4),
        floats: Vec::new(),
        wetted_drag: false,
        feet_m: Vec::new(),
        foot_radius_m: Vec::new(),
        start_friction: 0.0,
        slide_friction: 0.0,
        foot_break_out_n: 0.0,
        position_m,
        orientation: DQuat::IDENTITY,
        spin_rad_s: DVec3::ZERO,
        held_until_s: None,
    }
}

fn spec(whale: Whale, body: Body, friction: f64, settings: Settings) -> ModelSpec {
    let coulomb = Coulomb::new();
    let defaults = coulomb.descriptor().attributes.iter();
    let attributes = defaults.filter_map(|attribute| attribute.default_value().number()).collect();
    let mut law = Friction::of_one(Arc::new(coulomb), attributes, Vec::new());
    law.coefficients_of_bodies.fill(friction);
    ModelSpec {
        water: Water {
            density_kg_m3: 1025.0,
            gravity_m_s2: 0.0,
            depth_m: 100.0,
            rope_dries: false,
            current: Current::uniform(DVec3::ZERO),
            waves: None,
        },
        seabed: None,
        ropes: Vec::new(),
        joints: Vec::new(),
        lines: Vec::new(),
        bodies: vec![body],
        links: Vec::new(),
        gear: Vec::new(),
        whale: Some(whale),
        friction: Some(law),
        obstacles: Vec::new(),
        probes: Vec::new(),
        settings,
    }
}

impl Tally {
    /// The sum of two counts.
    pub fn with(mut self, other: Self) -> Self {
        self.meetings += other.meetings;
        self.met += other.met;
        self.crossed += other.crossed;
        self.ended += other.ended;
        self.solver_steps += other.solver_steps;
        self.unconverged += other.unconverged;
        self.reported.extend(other.reported);
        self
    }

    /// Runs a meeting and counts it.
    pub fn add(&mut self, number: u64, (spec, steps, drawn): (ModelSpec, u64, String)) {
        let model = Model::new(spec).expect("a sound model");
        let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
        let (mut met, mut crossed, mut ended) = (false, false, None);
        while state.step < steps && !crossed && ended.is_none() {
            ended = step(&model, &Input::default(), &mut state, &mut workspace).err();
            met |= workspace.audit.touching_steps > 0;
            crossed = workspace.audit.bodies_crossed > 0;
        }
        self.meetings += 1;
        self.met += u64::from(met);
        self.crossed += u64::from(crossed);
        self.ended += u64::from(ended.is_some() && !crossed);
        self.solver_steps += workspace.audit.solver_steps;
        self.unconverged += workspace.audit.unconverged;
        if (crossed || ended.is_some()) && self.reported.len() < 10 {
            self.reported.push(format!("meeting {number}, {drawn}: crossed {crossed}, {ended:?}"));
        }
    }
}
