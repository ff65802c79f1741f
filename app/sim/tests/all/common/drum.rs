//! A drum of triangles as a whale that stands still, and a rope drawn round it: the capstan on the contact of skin.
#![allow(dead_code, reason = "each test file uses a part of it")]
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test says what it needs, in its helpers too"
)]

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use endline_friction_models::Coulomb;
use endline_sdk::{
    Descriptor, FrictionModel, HookError, MotionInput, MotionOutput, Region, WhaleMotion,
};
use endline_sim::model::{
    Friction, Joint, JointKind, Line, Model, ModelSpec, PilotProgram, Resolution, Settings,
    Strength, Whale,
};
use endline_sim::whale::{Bone, JointRanges, Measures, Skin};
use endline_sim::{Audit, DQuat, DVec3, Input, State, Workspace, step};

/// A motion that stays where it is.
pub struct Still(Descriptor);

impl Still {
    pub fn shared() -> Arc<Self> {
        let (id, version, name, help) = ("still".into(), "1".into(), "still".into(), "".into());
        Arc::new(Self(Descriptor {
            id,
            version,
            name,
            help,
            attributes: Vec::new(),
            state_len: 0,
            acts: Vec::new(),
        }))
    }
}

impl WhaleMotion for Still {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    fn step(
        &self,
        _: &[f64],
        _: &MotionInput<'_>,
        _: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        Ok(MotionOutput::default())
    }
}

/// A closed drum along y with so many facets round it.
pub fn drum(radius: f64, half_length: f64, region: Region, facets: u32) -> Skin {
    let angle = |k: u32| f64::from(k) / f64::from(facets) * TAU;
    let rim =
        |k: u32, y: f64| DVec3::new(radius * libm::cos(angle(k)), y, radius * libm::sin(angle(k)));
    let mut vertices: Vec<DVec3> =
        (0..facets).flat_map(|k| [rim(k, -half_length), rim(k, half_length)]).collect();
    vertices.extend([DVec3::Y * -half_length, DVec3::Y * half_length]);
    let (left, right) = (2 * facets, 2 * facets + 1);
    let triangles: Vec<[u32; 3]> = (0..facets)
        .flat_map(|k| {
            let (a, b, c, d) =
                (2 * k, 2 * k + 1, 2 * ((k + 1) % facets), 2 * ((k + 1) % facets) + 1);
            [[a, c, b], [b, c, d], [a, left, c], [b, d, right]]
        })
        .collect();
    Skin {
        weights: vec![[(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]; vertices.len()],
        marks: Vec::new(),
        regions: vec![region; triangles.len()],
        bones: vec![Bone {
            name: "control".into(),
            parent: None,
            origin: DVec3::ZERO,
            turns: Vec::new(),
        }],
        vertices,
        triangles,
    }
}

/// A drum along y whose sides rise by an angle from a fold round its middle, as those of a sheave.
pub fn sheave(radius: f64, rise: f64, half_length: f64, region: Region, facets: u32) -> Skin {
    let mut skin = drum(radius + half_length * libm::tan(rise), half_length, region, facets);
    let fold = skin.vertices.len() as u32;
    let angle = |k: u32| f64::from(k) / f64::from(facets) * TAU;
    skin.vertices.extend(
        (0..facets)
            .map(|k| DVec3::new(radius * libm::cos(angle(k)), 0.0, radius * libm::sin(angle(k)))),
    );
    let side = |of: usize| move |k: u32| [2 * k + of as u32, fold + k];
    skin.triangles = (0..facets)
        .flat_map(|k| {
            let next = (k + 1) % facets;
            let ([a, m], [c, n]) = (side(0)(k), side(0)(next));
            let ([b, _], [d, _]) = (side(1)(k), side(1)(next));
            let (left, right) = (2 * facets, 2 * facets + 1);
            [[a, c, m], [m, c, n], [m, n, b], [b, n, d], [a, left, c], [b, d, right]]
        })
        .collect();
    skin.regions = vec![region; skin.triangles.len()];
    skin.weights = vec![skin.weights[0]; skin.vertices.len()];
    skin
}

/// A skin as a whale that stays where it is.
pub fn still(skin: Skin) -> Whale {
    Whale {
        skin: Arc::new(skin),
        joints: JointRanges::unbounded(),
        length_m: 1.0,
        measures: Measures::default(),
        burst_speed_m_s: 0.0,
        position_m: DVec3::ZERO,
        orientation: DQuat::IDENTITY,
        speed_m_s: 0.0,
        motion: Still::shared(),
        motion_attributes: Vec::new(),
        pilot: PilotProgram::default(),
        contact_stiffness_n_m2: 2e6,
        jaws: None,
        kinetic: None,
    }
}

/// Coulomb's law with one coefficient for all skin.
pub fn coulomb(coefficient: f64) -> Friction {
    let model = Coulomb::new();
    let attributes = model
        .descriptor()
        .attributes
        .iter()
        .filter_map(|attribute| attribute.default_value().number())
        .collect();
    Friction::of_one(Arc::new(model), attributes, vec![[coefficient; Region::ALL.len()]])
}

/// A rope drawn round a drum: a steady force on the slack end, the other end driven away.
#[derive(Clone, Copy, Debug)]
pub struct Capstan {
    /// Radius of the drum [m].
    pub radius_m: f64,
    /// Facets round it.
    pub facets: u32,
    /// Angle by which its sides rise from a fold in which the rope lies; none on a drum [rad].
    pub rise: f64,
    /// Turn of the rope [rad].
    pub turn: f64,
    pub friction: f64,
    /// Length of a segment [m].
    pub segment_m: f64,
    pub resolution: Option<Resolution>,
    /// Pull on the slack end [N].
    pub slack_n: f64,
    /// Speed of the driven end [m/s].
    pub speed_m_s: f64,
    /// A steady pull at that end instead [N].
    pub held_n: Option<f64>,
    /// Rope drawn before readings begin, and while they go on [m].
    pub drawn_m: [f64; 2],
    /// Length of each straight end [m].
    pub tail_m: f64,
}

impl Default for Capstan {
    fn default() -> Self {
        Self {
            radius_m: 0.3,
            facets: 96,
            rise: 0.0,
            turn: PI,
            friction: 0.3,
            segment_m: 0.05,
            resolution: None,
            slack_n: 50.0,
            speed_m_s: 0.2,
            held_n: None,
            drawn_m: [0.1, 0.2],
            tail_m: 0.6,
        }
    }
}

/// What a capstan read: shares of the law's `e^{μθ}`.
#[derive(Clone, Copy, Debug)]
pub struct Reading {
    /// Mean ratio of tensions over the law's.
    pub ratio: f64,
    /// Spread of the ratio over its mean.
    pub ripple: f64,
    /// Logarithm of the mean ratio over `μθ`.
    pub friction: f64,
    pub audit: Audit,
}

/// Axial distance of one turn from the next [m].
const PITCH_M: f64 = 0.04;
/// How far above skin rope is laid [m].
const CLEAR_M: f64 = 0.004;
/// Seconds in which rope is drawn onto the drum by the slack end's pull.
const SETTLE_S: f64 = 0.4;

impl Capstan {
    /// The radius at which rope is laid so that its chords clear the drum [m].
    fn laid_m(&self) -> f64 {
        libm::hypot(self.radius_m + CLEAR_M, 0.5 * self.segment_m)
    }

    /// Axial distance of one turn from the next; rope in a fold lies on itself [m].
    fn pitch_m(&self) -> f64 {
        if self.rise > 0.0 { 0.0 } else { PITCH_M }
    }

    fn skin(&self) -> Skin {
        let (half, region) = (0.1 + 0.5 * PITCH_M * self.turn / TAU, Region::LeftFlukeTrailing);
        if self.rise > 0.0 {
            sheave(self.radius_m, self.rise, half, region, self.facets)
        } else {
            drum(self.radius_m, half, region, self.facets)
        }
    }

    fn whole_m(&self) -> f64 {
        2.0 * self.tail_m + self.turn * self.laid_m()
    }

    /// Place at a length along the rope as it is laid.
    fn place(&self, s: f64) -> DVec3 {
        let laid = self.laid_m();
        let along = ((s - self.tail_m) / laid).clamp(0.0, self.turn);
        let beyond = (s - self.tail_m) - along * laid;
        let (sin, cos) = (libm::sin(along), libm::cos(along));
        let axial = self.pitch_m() * (along - 0.5 * self.turn) / TAU;
        DVec3::new(laid * sin + beyond * cos, axial, laid * cos - beyond * sin)
    }

    /// The direction of the rope at an end.
    fn direction(&self, turned: f64) -> DVec3 {
        DVec3::new(libm::cos(turned), 0.0, -libm::sin(turned))
    }

    pub fn spec(&self) -> ModelSpec {
        let whole = self.whole_m();
        let count = (whole / self.segment_m).round() as usize;
        let segments_m = vec![whole / count as f64; count];
        let start_m = (0..=count).map(|k| self.place(whole * k as f64 / count as f64)).collect();
        let pulled =
            JointKind::Pulled { force_n: self.direction(0.0) * -self.slack_n, from_s: -1.0 };
        let away = self.direction(self.turn);
        let driven = match self.held_n {
            Some(force) => JointKind::Pulled { force_n: away * force, from_s: -1.0 },
            None => JointKind::Driven {
                velocity_m_s: away * self.speed_m_s,
                from_s: SETTLE_S,
                until_s: f64::INFINITY,
            },
        };
        let mut rope = super::rope();
        rope.axial_damping_ratio = 0.5;
        ModelSpec {
            water: endline_sim::water::Water { gravity_m_s2: 0.0, ..super::water(0.0, 0.0) },
            seabed: None,
            ropes: vec![rope],
            joints: vec![
                Joint { id: "slack".into(), kind: pulled, position_m: self.place(0.0) },
                Joint { id: "hand".into(), kind: driven, position_m: self.place(whole) },
            ],
            lines: vec![Line {
                id: "rope".into(),
                rope: 0,
                from: 0,
                to: 1,
                segments_m,
                strength: Strength::default(),
                knots_m: [0.0; 2],
                start_m,
            }],
            bodies: Vec::new(),
            links: Vec::new(),
            gear: Vec::new(),
            whale: Some(still(self.skin())),
            friction: Some(coulomb(self.friction)),
            obstacles: Vec::new(),
            probes: Vec::new(),
            settings: Settings {
                step_s: 0.002,
                resolution: self.resolution,
                ..Settings::default()
            },
        }
    }

    /// The rope at rest under the pulls at its ends: how far any node goes between two times [m].
    pub fn creep(&self, from_s: f64, until_s: f64) -> f64 {
        let model = Model::new(self.spec()).expect("a sound model");
        let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
        let mut before = Vec::new();
        while state.time_s < until_s {
            step(&model, &Input::default(), &mut state, &mut workspace)
                .unwrap_or_else(|stop| panic!("{self:?} {stop:?}"));
            if before.is_empty() && state.time_s >= from_s {
                before.clone_from(&state.rope.position);
            }
        }
        assert_eq!(workspace.audit.tunnelled, 0);
        before
            .iter()
            .zip(&state.rope.position)
            .map(|(from, to)| from.distance(*to))
            .fold(0.0, f64::max)
    }

    /// Draws the rope round and reads the tensions at its ends.
    pub fn read(&self) -> Reading {
        let model = Model::new(self.spec()).expect("a sound model");
        let (mut state, mut workspace) = (State::start(&model), Workspace::new(&model));
        let (mut ratios, last) = (Vec::new(), model.segment_count - 1);
        let from = SETTLE_S + self.drawn_m[0] / self.speed_m_s;
        let until = from + self.drawn_m[1] / self.speed_m_s;
        while state.time_s < until {
            step(&model, &Input::default(), &mut state, &mut workspace)
                .unwrap_or_else(|stop| panic!("{self:?} {stop:?}"));
            if state.time_s > from {
                ratios.push(state.rope.tension[last] / state.rope.tension[0]);
            }
        }
        let law = self.friction * self.turn;
        let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
        let square = ratios.iter().map(|ratio| (ratio - mean) * (ratio - mean)).sum::<f64>()
            / ratios.len() as f64;
        Reading {
            ratio: mean / libm::exp(law),
            ripple: square.sqrt() / mean,
            friction: libm::log(mean) / law,
            audit: workspace.audit,
        }
    }
}
