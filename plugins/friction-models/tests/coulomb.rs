//! The Coulomb model against finite differences, energy, and the capstan's closed form.
#![expect(clippy::unwrap_used, reason = "helpers of tests: where one cannot go on, the test fails there")]

use endline_friction_models::Coulomb;
use endline_sdk::{AttributeKind, Contacts, FrictionModel, FrictionResponse};

type Vec3 = [f64; 3];

/// Random numbers of a test: splitmix64.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.unit()
    }

    fn vector(&mut self, size: f64) -> Vec3 {
        std::array::from_fn(|_| self.between(-size, size))
    }

    fn direction(&mut self) -> Vec3 {
        loop {
            let v = self.vector(1.0);
            let length = norm(v);
            if length > 0.1 && length < 1.0 {
                return v.map(|c| c / length);
            }
        }
    }
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(v: Vec3) -> f64 {
    dot(v, v).sqrt()
}

fn across(n: Vec3, v: Vec3) -> Vec3 {
    std::array::from_fn(|i| v[i] - dot(n, v) * n[i])
}

/// One contact, with the model's default attributes.
#[derive(Clone, Copy)]
struct Contact {
    normal_force: f64,
    normal: Vec3,
    slip: Vec3,
    length: f64,
    mu: f64,
    state: Vec3,
}

impl Contact {
    fn random(random: &mut Random) -> Self {
        let normal = random.direction();
        let size = libm::exp10(random.between(-7.0, -2.0));
        Self {
            normal_force: random.between(0.1, 500.0),
            normal,
            slip: across(normal, random.vector(size)),
            length: random.between(0.002, 0.03),
            mu: random.between(0.05, 1.0),
            state: random.vector(1e-5),
        }
    }

    fn ask<T>(&self, call: impl FnOnce(&Coulomb, &[f64], &Contacts<'_>) -> T) -> T {
        let contacts = Contacts {
            dt_s: 0.002,
            normal_force_n: &[self.normal_force],
            normal: &[self.normal],
            slip_m: &[self.slip],
            length_m: &[self.length],
            coefficient: &[self.mu],
            region: &[4],
            rope: &[0],
            state: &self.state,
        };
        call(&Coulomb::new(), &defaults(), &contacts)
    }

    fn respond(&self) -> FrictionResponse {
        self.ask(|model, attributes, contacts| {
            let mut out = [FrictionResponse::default()];
            model.respond(attributes, contacts, &mut out).unwrap();
            out[0]
        })
    }

    fn advance(&self) -> Vec3 {
        self.ask(|model, attributes, contacts| {
            let mut out = [0.0; 3];
            model.advance(attributes, contacts, &mut out).unwrap();
            out
        })
    }

    fn sticks(&self) -> bool {
        let stretch = across(self.normal, std::array::from_fn(|i| self.state[i] + self.slip[i]));
        STIFFNESS * self.length * norm(stretch) <= self.mu * self.normal_force
    }
}

const STIFFNESS: f64 = 1e7;

fn defaults() -> Vec<f64> {
    let value = |kind: &AttributeKind| if let AttributeKind::Number { default, .. } = kind { *default } else { f64::NAN };
    Coulomb::new().descriptor().attributes.iter().map(|attribute| value(&attribute.kind)).collect()
}

#[test]
fn derivatives_agree_with_finite_differences() {
    let mut random = Random(7);
    let (mut stuck, mut slipping) = (0, 0);
    for _ in 0..4000 {
        let contact = Contact::random(&mut random);
        let here = contact.respond();
        let step = 1e-4 * norm(contact.slip).max(1e-8);
        let moved = |axis: usize, by: f64| {
            let mut other = contact;
            other.slip[axis] += by;
            other
        };
        let crosses = (0..3).any(|axis| [step, -step].iter().any(|by| moved(axis, *by).sticks() != contact.sticks()));
        if crosses {
            continue;
        }
        if contact.sticks() {
            stuck += 1
        } else {
            slipping += 1
        }
        let scale = STIFFNESS * contact.length;
        for axis in 0..3 {
            let (plus, minus) = (moved(axis, step).respond().force_n, moved(axis, -step).respond().force_n);
            for row in 0..3 {
                let by_difference = (plus[row] - minus[row]) / (2.0 * step);
                assert!((by_difference - here.by_slip[row][axis]).abs() < 2e-5 * scale, "{by_difference} {:?}", here.by_slip);
            }
        }
        let mut pressed = contact;
        pressed.normal_force += 1e-6;
        for row in 0..3 {
            let by_difference = (pressed.respond().force_n[row] - here.force_n[row]) / 1e-6;
            assert!((by_difference - here.by_normal_force[row]).abs() < 1e-5, "{by_difference} {:?}", here.by_normal_force);
        }
    }
    assert!(stuck > 300 && slipping > 300, "{stuck} stuck, {slipping} slipping");
}

#[test]
fn force_lies_across_the_normal_and_never_exceeds_the_limit() {
    let mut random = Random(11);
    for _ in 0..5000 {
        let contact = Contact { state: [0.0; 3], ..Contact::random(&mut random) };
        let force = contact.respond().force_n;
        assert!(dot(force, contact.normal).abs() < 1e-9 * (1.0 + norm(force)));
        assert!(norm(force) <= contact.mu * contact.normal_force * (1.0 + 1e-12));
        assert!(dot(force, contact.slip) <= 0.0, "pushes the way it slips");
    }
}

/// Work done on the rope over any path is at most what the bristle took in: no energy comes out.
#[test]
fn friction_takes_energy_over_any_path() {
    let mut random = Random(3);
    for _ in 0..50 {
        let mut contact = Contact { state: [0.0; 3], ..Contact::random(&mut random) };
        let mut work = 0.0;
        for _ in 0..400 {
            contact.slip = across(contact.normal, random.vector(2e-5));
            contact.normal_force = random.between(0.0, 300.0);
            work += dot(contact.respond().force_n, contact.slip);
            contact.state = contact.advance();
            let stored = 0.5 * STIFFNESS * contact.length * dot(contact.state, contact.state);
            assert!(work + stored <= 1e-12 * work.abs(), "work {work} J with {stored} J stored");
        }
    }
}

/// A rope point pulled along the skin at 95 % of the limit: it gives once, then never moves again.
#[test]
fn a_stuck_rope_does_not_creep() {
    let (mu, normal_force, length) = (0.3, 200.0, 0.02);
    let pull = 0.95 * mu * normal_force;
    let mut contact = Contact { normal_force, normal: [0.0, 0.0, 1.0], slip: [0.0; 3], length, mu, state: [0.0; 3] };
    let mut travelled = Vec::new();
    for _ in 0..2000 {
        contact.slip = [0.0; 3];
        for _ in 0..20 {
            let answer = contact.respond();
            contact.slip[0] -= (answer.force_n[0] + pull) / answer.by_slip[0][0];
        }
        travelled.push(contact.slip[0]);
        contact.state = contact.advance();
    }
    assert!((travelled[0] - pull / (STIFFNESS * length)).abs() < 1e-12);
    let creep: f64 = travelled[1..].iter().map(|slip| slip.abs()).sum();
    assert!(creep < 1e-12, "crept {creep} m in 2000 steps");
}

/// Rope dragged round a drum: at a node turning by `D` with its contact at the node, equilibrium gives
/// `ln(T2/T1) = 2 atanh(mu tan(D/2))`; many nodes come to the capstan's `exp(mu theta)`.
#[test]
fn a_dragged_rope_obeys_the_capstan_equation() {
    for mu in [0.1, 0.3, 0.6] {
        for (nodes, tolerance) in [(24_u32, 0.02), (96, 1.3e-3)] {
            let turn = std::f64::consts::TAU / f64::from(nodes);
            let mut tension = 50.0;
            for _ in 0..nodes {
                tension = drag_over_node(mu, turn, tension);
            }
            let ratio = libm::log(tension / 50.0);
            let closed = f64::from(nodes) * 2.0 * libm::atanh(mu * libm::tan(turn / 2.0));
            assert!((ratio - closed).abs() < 1e-9, "{ratio} {closed}");
            let capstan = mu * std::f64::consts::TAU;
            assert!((ratio / capstan - 1.0).abs() < tolerance, "{ratio} {capstan}");
        }
    }
}

/// Tension past a node where the rope slips by 1 mm a step: balance along and across the node's plane.
fn drag_over_node(mu: f64, turn: f64, before: f64) -> f64 {
    let (s, c) = libm::sincos(turn / 2.0);
    let mut after = before;
    for _ in 0..200 {
        let contact = Contact {
            normal_force: (before + after) * s,
            normal: [0.0, 0.0, 1.0],
            slip: [1e-3, 0.0, 0.0],
            length: 0.08,
            mu,
            state: [0.0; 3],
        };
        after = before - contact.respond().force_n[0] / c;
    }
    after
}

#[test]
fn wrong_lengths_are_an_error() {
    let contact = Contact::random(&mut Random(1));
    let error = contact.ask(|model, _, contacts| model.respond(&[1.0], contacts, &mut [FrictionResponse::default()]).unwrap_err());
    assert!(error.message.contains("2 attribute values"), "{error}");
    let error = contact.ask(|model, attributes, contacts| model.respond(attributes, contacts, &mut [FrictionResponse::default(); 2]));
    assert!(error.unwrap_err().message.contains("differ in length"));
}
