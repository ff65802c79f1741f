//! One contact through a model's interface, and random numbers.
#![allow(
    dead_code,
    clippy::unwrap_used,
    reason = "each test uses its part of these helpers; an error in one fails its test"
)]

use endline_sdk::{AttributeKind, Contacts, FrictionModel, FrictionResponse};

pub type Vec3 = [f64; 3];

/// Random numbers of a test: splitmix64.
pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.unit()
    }

    pub fn vector(&mut self, size: f64) -> Vec3 {
        std::array::from_fn(|_| self.between(-size, size))
    }

    pub fn direction(&mut self) -> Vec3 {
        loop {
            let v = self.vector(1.0);
            let length = norm(v);
            if length > 0.1 && length < 1.0 {
                return v.map(|c| c / length);
            }
        }
    }

    /// A unit vector across a unit normal.
    pub fn tangent(&mut self, normal: Vec3) -> Vec3 {
        loop {
            let v = across(normal, self.direction());
            let length = norm(v);
            if length > 0.1 {
                return v.map(|c| c / length);
            }
        }
    }
}

pub fn dot(a: Vec3, b: Vec3) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub fn norm(v: Vec3) -> f64 {
    dot(v, v).sqrt()
}

pub fn across(n: Vec3, v: Vec3) -> Vec3 {
    std::array::from_fn(|i| v[i] - dot(n, v) * n[i])
}

/// One contact of a model with attribute values.
#[derive(Clone, Debug)]
pub struct Contact {
    pub dt: f64,
    pub normal_force: f64,
    pub normal: Vec3,
    pub grain: Vec3,
    pub along: Vec3,
    pub slip: Vec3,
    pub length: f64,
    pub mu: f64,
    pub state: Vec<f64>,
}

impl Contact {
    /// A new contact on a plane, grain along y, rope along x.
    pub fn on_plane(model: &dyn FrictionModel, normal_force: f64, mu: f64) -> Self {
        Self {
            dt: 0.002,
            normal_force,
            normal: [0.0, 0.0, 1.0],
            grain: [0.0, 1.0, 0.0],
            along: [1.0, 0.0, 0.0],
            slip: [0.0; 3],
            length: 0.02,
            mu,
            state: vec![0.0; model.descriptor().state_len],
        }
    }

    /// A random new contact.
    pub fn random(model: &dyn FrictionModel, random: &mut Random) -> Self {
        let normal = random.direction();
        let size = libm::exp10(random.between(-7.0, -2.0));
        Self {
            dt: libm::exp10(random.between(-4.0, -2.0)),
            normal_force: random.between(0.1, 500.0),
            normal,
            grain: random.tangent(normal),
            along: random.tangent(normal),
            slip: across(normal, random.vector(size)),
            length: random.between(0.002, 0.03),
            mu: random.between(0.05, 1.0),
            state: vec![0.0; model.descriptor().state_len],
        }
    }

    fn ask<T>(&self, call: impl FnOnce(&Contacts<'_>) -> T) -> T {
        call(&Contacts {
            dt_s: self.dt,
            normal_force_n: &[self.normal_force],
            normal: &[self.normal],
            grain: &[self.grain],
            along: &[self.along],
            slip_m: &[self.slip],
            length_m: &[self.length],
            coefficient: &[self.mu],
            region: &[4],
            rope: &[0],
            state: &self.state,
        })
    }

    pub fn respond(&self, model: &dyn FrictionModel, attributes: &[f64]) -> FrictionResponse {
        let mut out = [FrictionResponse::default()];
        self.ask(|contacts| model.respond(attributes, contacts, &mut out)).unwrap();
        out[0]
    }

    /// Ends the step: updates the state.
    pub fn advance(&mut self, model: &dyn FrictionModel, attributes: &[f64]) {
        let mut out = vec![0.0; self.state.len()];
        self.ask(|contacts| model.advance(attributes, contacts, &mut out)).unwrap();
        self.state = out;
    }

    /// Slips by a distance and ends the step; returns the force.
    pub fn slide(&mut self, model: &dyn FrictionModel, attributes: &[f64], slip: Vec3) -> Vec3 {
        self.slip = slip;
        let force = self.respond(model, attributes).force_n;
        self.advance(model, attributes);
        force
    }
}

/// A model's default values, with some of them changed.
pub fn values(model: &dyn FrictionModel, changed: &[(&str, f64)]) -> Vec<f64> {
    let attributes = &model.descriptor().attributes;
    assert!(
        changed.iter().all(|(key, _)| attributes.iter().any(|attribute| attribute.key == *key))
    );
    let value = |attribute: &endline_sdk::Attribute| {
        let AttributeKind::Number { min, max, default } = attribute.kind else { return f64::NAN };
        let given = changed
            .iter()
            .find(|(key, _)| attribute.key == *key)
            .map_or(default, |(_, value)| *value);
        assert!((min..=max).contains(&given));
        given
    };
    attributes.iter().map(value).collect()
}

/// Values at random within their ranges, evenly by order of magnitude where the range spans many.
pub fn random_values(model: &dyn FrictionModel, random: &mut Random) -> Vec<f64> {
    let value = |attribute: &endline_sdk::Attribute| {
        let AttributeKind::Number { min, max, .. } = attribute.kind else { return f64::NAN };
        let wide = min > 0.0 && max > 100.0 * min;
        if wide {
            libm::exp10(random.between(libm::log10(min), libm::log10(max)))
        } else {
            random.between(min, max)
        }
    };
    model.descriptor().attributes.iter().map(value).collect()
}

/// A block on a plane, pulled along x by a spring whose far end moves at a constant speed: the spring-slider of textbooks.
pub struct Slider<'a> {
    pub model: &'a dyn FrictionModel,
    pub attributes: Vec<f64>,
    pub contact: Contact,
    /// Stiffness of the spring [N/m] and mass of the block [kg].
    pub spring: f64,
    pub mass: f64,
    pub place: f64,
    pub speed: f64,
    pub hand: f64,
}

impl<'a> Slider<'a> {
    pub fn new(
        model: &'a dyn FrictionModel,
        attributes: Vec<f64>,
        contact: Contact,
        spring: f64,
        mass: f64,
    ) -> Self {
        Self { model, attributes, contact, spring, mass, place: 0.0, speed: 0.0, hand: 0.0 }
    }

    pub fn pull(&self) -> f64 {
        self.spring * (self.hand - self.place)
    }

    /// Backward Euler, with implicit friction as in the solver: Newton with the plugin's derivative.
    pub fn step(&mut self, hand_speed: f64) {
        let dt = self.contact.dt;
        self.hand += hand_speed * dt;
        let mut slip = self.speed * dt;
        for pass in 0..200 {
            self.contact.slip = [slip, 0.0, 0.0];
            let answer = self.contact.respond(self.model, &self.attributes);
            let residual = self.mass * (slip / dt - self.speed) / dt
                - self.spring * (self.hand - self.place - slip)
                - answer.force_n[0];
            let change = residual / (self.mass / (dt * dt) + self.spring - answer.by_slip[0][0]);
            slip -= change;
            if change.abs() < 1e-15 + 1e-12 * slip.abs() {
                break;
            }
            assert!(pass < 199, "no balance: slip {slip}, change {change}");
        }
        self.contact.slip = [slip, 0.0, 0.0];
        self.contact.advance(self.model, &self.attributes);
        self.place += slip;
        self.speed = slip / dt;
    }
}
