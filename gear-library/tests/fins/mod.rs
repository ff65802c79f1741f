//! Fast random encounters of rope with the edges of flippers and flukes: a short taut rope, and a piece of the right whale's
//! own skin about a place on an edge, sent through it.
//!
//! Every encounter is drawn from its number alone. The rope hangs in the sea between a fixture and a steady pull of 5 N to
//! 8 kN, on segments of 2.5 to 13 cm; the piece comes from any side, turned any way, at 2 to 20 m/s, turning as it goes.
#![allow(clippy::expect_used, reason = "a test says what it needs, in its helpers too")]

use std::sync::Arc;

use endline_friction_models::Coulomb;
use endline_gear::whale::{WhaleForm, build_skin};
use endline_sdk::{Descriptor, FrictionModel, HookError, MotionInput, MotionOutput, Region, WhaleMotion};
use endline_sim::contact::crossing::pierces;
use endline_sim::model::{Friction, Joint, JointKind, Line, Rope, Settings, Strength};
use endline_sim::water::{Current, Water};
use endline_sim::whale::{Bone, JointRanges, Measures, PilotProgram, Skin, Whale, pose, skin_all};
use endline_sim::{DQuat, DVec3, Input, Model, ModelSpec, State, Workspace, step};

/// Skin this near to the place on the edge is taken along [m].
const PIECE_M: f64 = 0.1;
/// Pieces reach no farther than this [m].
const REACH_M: f64 = 0.3;
/// The piece's skin starts and ends at least this far from the rope [m].
const CLEAR_M: f64 = 0.04;
const ROPE_M: f64 = 0.8;
const EA_N: f64 = 1e5;
/// Least sine of the angle between the way of the piece and the rope.
const ASLANT: f64 = 0.7;
/// Fewest pieces cut out of the whale.
const PIECES: usize = 256;

/// Repeatable numbers.
struct Dice(u64);

impl Dice {
    fn of(number: u64) -> Self {
        let mut dice = Self(number.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x2012);
        (0..4).for_each(|_| {
            dice.share();
        });
        dice
    }

    /// 0..1.
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (self.0 ^ (self.0 >> 32)).wrapping_mul(0xD6E8_FEB8_6659_FD93);
        ((mixed ^ (mixed >> 32)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share()
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let point = DVec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0));
            if (0.01..1.0).contains(&point.length_squared()) {
                return point.normalize();
            }
        }
    }

    fn turn(&mut self) -> DQuat {
        DQuat::from_axis_angle(self.direction(), self.between(0.0, std::f64::consts::TAU))
    }
}

/// A motion at one speed and turn rate.
struct Steady {
    descriptor: Descriptor,
    speed_m_s: f64,
    turn_rate: [f64; 3],
}

impl WhaleMotion for Steady {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn step(&self, _: &[f64], _: &MotionInput<'_>, _: &mut [f64]) -> Result<MotionOutput, HookError> {
        Ok(MotionOutput { speed_m_s: self.speed_m_s, turn_rate_rad_s: self.turn_rate, ..MotionOutput::default() })
    }
}

/// Pieces of fins, each about a place on an edge at its origin.
pub struct Fins(Vec<Skin>);

impl Fins {
    /// Cuts pieces out of a right whale of 13.7 m.
    pub fn new() -> Self {
        let whole = build_skin(&WhaleForm::right_whale(13.7));
        let thin = |region: &Region| ["leading", "trailing", "tip"].iter().any(|end| region.name().ends_with(end));
        let on_edges = whole.triangles.iter().zip(&whole.regions).filter(|(_, region)| thin(region));
        let mut edges: Vec<u32> = on_edges.flat_map(|(corners, _)| *corners).collect();
        edges.sort_unstable();
        edges.dedup();
        let pieces: Vec<Skin> = edges.iter().map(|vertex| piece(&whole, *vertex)).filter(|piece| reach(piece) < REACH_M).collect();
        assert!(pieces.len() > PIECES, "{} pieces of {} places on edges", pieces.len(), edges.len());
        Self(pieces)
    }

    /// The encounter of a number, tested along every path or at the end of each step alone.
    pub fn encounter(&self, number: u64, swept: bool) -> Encounter {
        let mut dice = Dice::of(number);
        let mut skin = self.0[(dice.share() * self.0.len() as f64) as usize % self.0.len()].clone();
        let away_m = (reach(&skin) + CLEAR_M) / ASLANT;
        let turned = dice.turn();
        skin.vertices.iter_mut().for_each(|place| *place = turned * *place);
        let along = dice.direction();
        let heading = loop {
            let heading = dice.turn();
            if (heading * DVec3::X).cross(along).length() > ASLANT {
                break heading;
            }
        };
        let speed_m_s = dice.between(2.0, 20.0);
        let pull_n = 5.0 * libm::pow(1600.0, dice.share());
        let met = DVec3::new(0.0, 0.0, -50.0);
        let forward = heading * DVec3::X;
        let turn_rate = (dice.direction() * (0.5 * speed_m_s * dice.share())).to_array();
        let friction = dice.between(0.05, 0.6);
        let whale = Whale {
            position_m: met - forward * away_m + dice.direction() * 0.02,
            orientation: heading,
            speed_m_s,
            ..whale(skin, speed_m_s, turn_rate)
        };
        let settings = Settings { swept, ..Settings::default() };
        let spec = rig(&mut dice, (met, along), pull_n, whale, friction, settings);
        Encounter { speed_m_s, pull_n, until_s: 2.0 * away_m / speed_m_s, spec }
    }
}

/// The triangles of a skin about a vertex, which becomes the origin; rigid, and closed where it was cut.
fn piece(whole: &Skin, about: u32) -> Skin {
    let middle = whole.vertices[about as usize];
    let near = |vertex: &u32| whole.vertices[*vertex as usize].distance(middle) < PIECE_M;
    let mut skin =
        Skin { bones: vec![Bone { name: "control".into(), parent: None, origin: DVec3::ZERO, turns: Vec::new() }], ..Skin::default() };
    let mut renumbered = vec![None; whole.vertices.len()];
    for (corners, region) in whole.triangles.iter().zip(&whole.regions).filter(|(corners, _)| corners.iter().any(near)) {
        let corners = corners.map(|vertex| {
            *renumbered[vertex as usize].get_or_insert_with(|| {
                skin.vertices.push(whole.vertices[vertex as usize] - middle);
                skin.weights.push([(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]);
                u32::try_from(skin.vertices.len() - 1).expect("few vertices")
            })
        });
        skin.triangles.push(corners);
        skin.regions.push(*region);
    }
    close(&mut skin);
    skin
}

/// Farthest vertex from the origin [m].
fn reach(skin: &Skin) -> f64 {
    skin.vertices.iter().map(|place| place.length()).fold(0.0, f64::max)
}

/// Closes every hole by a fan about the middle of its rim.
fn close(skin: &mut Skin) {
    let edges: Vec<[u32; 2]> = skin.triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]).collect();
    let mut rims: Vec<[u32; 2]> = edges.iter().filter(|[a, b]| !edges.contains(&[*b, *a])).copied().collect();
    while let Some(first) = rims.pop() {
        let mut rim = vec![first];
        while let Some(next) = rims.iter().position(|edge| rim.iter().any(|[a, b]| edge.contains(a) || edge.contains(b))) {
            rim.push(rims.swap_remove(next));
        }
        let middle = rim.iter().map(|[a, _]| skin.vertices[*a as usize]).sum::<DVec3>() / rim.len() as f64;
        let tip = u32::try_from(skin.vertices.len()).expect("few vertices");
        skin.vertices.push(middle);
        skin.weights.push([(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]);
        skin.triangles.extend(rim.iter().map(|[a, b]| [*b, *a, tip]));
        skin.regions.extend(rim.iter().map(|_| Region::Body));
    }
}

fn whale(skin: Skin, speed_m_s: f64, turn_rate: [f64; 3]) -> Whale {
    let (id, name, help) = ("test.steady".into(), "Steady".into(), "Always the same.".into());
    let descriptor = Descriptor { id, version: "1".into(), name, help, attributes: Vec::new(), state_len: 0, acts: Vec::new() };
    Whale {
        skin: Arc::new(skin),
        joints: JointRanges::unbounded(),
        length_m: 1.0,
        measures: Measures::default(),
        burst_speed_m_s: speed_m_s,
        position_m: DVec3::ZERO,
        orientation: DQuat::IDENTITY,
        speed_m_s,
        motion: Arc::new(Steady { descriptor, speed_m_s, turn_rate }),
        motion_attributes: Vec::new(),
        pilot: PilotProgram::default(),
        contact_stiffness_n_m2: 4e5,
        kinetic: None,
    }
}

/// A taut rope through a place, along a direction.
fn rig(dice: &mut Dice, (met, along): (DVec3, DVec3), pull_n: f64, whale: Whale, friction: f64, settings: Settings) -> ModelSpec {
    let count = dice.between(6.0, 32.0) as usize;
    let segment_m = ROPE_M / count as f64;
    let stretched = segment_m * (1.0 + pull_n / EA_N);
    let first = met - along * (stretched * count as f64 * dice.between(0.25, 0.75));
    let start_m: Vec<DVec3> = (0..=count).map(|node| first + along * (stretched * node as f64)).collect();
    let joint = |id: &str, kind, position_m| Joint { id: id.into(), kind, position_m };
    let pulled = JointKind::Pulled { force_n: along * pull_n, from_s: -1.0 };
    let joints = vec![joint("held", JointKind::Fixed, start_m[0]), joint("pulled", pulled, start_m[count])];
    let line =
        Line { id: "rope".into(), rope: 0, from: 0, to: 1, segments_m: vec![segment_m; count], strength: Strength::default(), start_m };
    let coulomb = Coulomb::new();
    let attributes = coulomb.descriptor().attributes.iter().filter_map(|attribute| attribute.default_value().number()).collect();
    let current = Current::uniform(DVec3::ZERO);
    ModelSpec {
        water: Water { density_kg_m3: 1025.0, gravity_m_s2: 9.81, depth_m: 100.0, rope_dries: false, current, waves: None },
        seabed: None,
        ropes: vec![rope(dice.between(0.008, 0.014))],
        joints,
        lines: vec![line],
        bodies: Vec::new(),
        links: Vec::new(),
        gear: Vec::new(),
        whale: Some(whale),
        friction: Some(Friction::of_one(Arc::new(coulomb), attributes, vec![[friction; Region::ALL.len()]])),
        obstacles: Vec::new(),
        probes: Vec::new(),
        settings,
    }
}

fn rope(diameter_m: f64) -> Rope {
    Rope {
        id: "rope".into(),
        diameter_m,
        mass_kg_m: 600.0 * diameter_m * diameter_m,
        displaced_m3_m: 0.6 * diameter_m * diameter_m,
        axial_stiffness_n: EA_N,
        axial_stiffening_n: 0.0,
        axial_damping_n_s: 5.0,
        axial_damping_ratio: 0.0,
        bending_stiffness_n_m2: 0.0,
        drag_normal: 1.2,
        drag_tangential: 0.015,
        added_mass_normal: 1.0,
        added_mass_tangential: 0.0,
        strength_n: f64::INFINITY,
    }
}

/// One encounter, ready to run.
pub struct Encounter {
    pub speed_m_s: f64,
    pub pull_n: f64,
    until_s: f64,
    spec: ModelSpec,
}

/// What came of encounters.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    pub encounters: u64,
    /// In which rope was pressed on.
    pub met: u64,
    /// In which rope crossed skin, by the exact test of the paths or by a look at each end of a step.
    pub crossed: u64,
    /// That ended for another reason.
    pub ended: u64,
    pub solver_steps: u64,
    pub passes: u64,
    pub unconverged: u64,
    /// Numbers of the first that crossed or ended, with what was said.
    pub told: Vec<String>,
}

impl Tally {
    /// Runs an encounter and counts it.
    pub fn add(&mut self, number: u64, encounter: Encounter) {
        let Encounter { speed_m_s, pull_n, until_s, spec } = encounter;
        let model = Model::new(spec).expect("a sound model");
        let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
        let (mut met, mut crossed, mut ended) = (false, false, None);
        while state.time_s < until_s && !crossed && ended.is_none() {
            ended = step(&model, &Input::default(), &mut state, &mut workspace).err();
            met |= !workspace.contacts.is_empty();
            crossed = workspace.audit.tunnelled > 0 || is_pierced(&model, &state);
        }
        self.encounters += 1;
        self.met += u64::from(met);
        self.crossed += u64::from(crossed);
        self.ended += u64::from(ended.is_some() && !crossed);
        self.solver_steps += workspace.audit.solver_steps;
        self.passes += workspace.audit.passes;
        self.unconverged += workspace.audit.unconverged;
        if (crossed || ended.is_some()) && self.told.len() < 10 {
            self.told.push(format!("encounter {number}, {speed_m_s:.1} m/s, {pull_n:.0} N: crossed {crossed}, {ended:?}"));
        }
    }
}

/// Whether any segment passes through any triangle where they stand.
fn is_pierced(model: &Model, state: &State) -> bool {
    let (Some(whale), Some(now)) = (&model.spec.whale, &state.whale) else { return false };
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(&whale.skin, now.position, now.orientation, &now.posture, &mut bones);
    skin_all(&whale.skin, &bones, &mut places);
    let skin = || whale.skin.triangles.iter().map(|corners| corners.map(|corner| places[corner as usize]));
    state.rope.position.windows(2).any(|ends| skin().any(|triangle| pierces([ends[0], ends[1]], triangle)))
}
