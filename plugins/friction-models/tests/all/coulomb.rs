//! The Coulomb model against finite differences, energy, and the capstan's closed form.

use crate::common::{Contact, Random, across, dot, norm, values};
use endline_friction_models::Coulomb;
use endline_sdk::{Contacts, FrictionModel, FrictionResponse};

const STIFFNESS: f64 = 1e7;

fn respond(contact: &Contact) -> FrictionResponse {
    let model = Coulomb::new();
    contact.respond(&model, &values(&model, &[]))
}

fn advance(contact: &mut Contact) {
    let model = Coulomb::new();
    contact.advance(&model, &values(&model, &[]));
}

fn random(random: &mut Random) -> Contact {
    let mut contact = Contact::random(&Coulomb::new(), random);
    contact.state = random.vector(1e-5).to_vec();
    contact
}

fn sticks(contact: &Contact) -> bool {
    let stretch =
        across(contact.normal, std::array::from_fn(|i| contact.state[i] + contact.slip[i]));
    STIFFNESS * contact.length * norm(stretch) <= contact.mu * contact.normal_force
}

#[test]
fn derivatives_agree_with_finite_differences() {
    let mut numbers = Random(7);
    let (mut stuck, mut slipping) = (0, 0);
    for _ in 0..4000 {
        let contact = random(&mut numbers);
        let here = respond(&contact);
        let step = 1e-4 * norm(contact.slip).max(1e-8);
        let moved = |axis: usize, by: f64| {
            let mut other = contact.clone();
            other.slip[axis] += by;
            other
        };
        let crosses = (0..3).any(|axis| {
            [step, -step].iter().any(|by| sticks(&moved(axis, *by)) != sticks(&contact))
        });
        if crosses {
            continue;
        }
        if sticks(&contact) {
            stuck += 1
        } else {
            slipping += 1
        }
        let scale = STIFFNESS * contact.length;
        for axis in 0..3 {
            let (plus, minus) =
                (respond(&moved(axis, step)).force_n, respond(&moved(axis, -step)).force_n);
            for row in 0..3 {
                let by_difference = (plus[row] - minus[row]) / (2.0 * step);
                assert!(
                    (by_difference - here.by_slip[row][axis]).abs() < 2e-5 * scale,
                    "{by_difference} {:?}",
                    here.by_slip
                );
            }
        }
        let mut pressed = contact.clone();
        pressed.normal_force += 1e-6;
        for row in 0..3 {
            let by_difference = (respond(&pressed).force_n[row] - here.force_n[row]) / 1e-6;
            assert!(
                (by_difference - here.by_normal_force[row]).abs() < 1e-5,
                "{by_difference} {:?}",
                here.by_normal_force
            );
        }
    }
    assert!(stuck > 300 && slipping > 300, "{stuck} stuck, {slipping} slipping");
}

#[test]
fn force_lies_across_the_normal_and_never_exceeds_the_limit() {
    let mut numbers = Random(11);
    for _ in 0..5000 {
        let contact = Contact { state: vec![0.0; 3], ..random(&mut numbers) };
        let force = respond(&contact).force_n;
        assert!(dot(force, contact.normal).abs() < 1e-9 * (1.0 + norm(force)));
        assert!(norm(force) <= contact.mu * contact.normal_force * (1.0 + 1e-12));
        assert!(dot(force, contact.slip) <= 0.0, "pushes the way it slips");
    }
}

/// Work on the rope over any path is at most the energy stored in the bristle: none is created.
#[test]
fn friction_takes_energy_over_any_path() {
    let mut numbers = Random(3);
    for _ in 0..50 {
        let mut contact = Contact { state: vec![0.0; 3], ..random(&mut numbers) };
        let mut work = 0.0;
        for _ in 0..400 {
            contact.slip = across(contact.normal, numbers.vector(2e-5));
            contact.normal_force = numbers.between(0.0, 300.0);
            work += dot(respond(&contact).force_n, contact.slip);
            advance(&mut contact);
            let stored = 0.5
                * STIFFNESS
                * contact.length
                * dot(
                    [contact.state[0], contact.state[1], contact.state[2]],
                    [contact.state[0], contact.state[1], contact.state[2]],
                );
            assert!(work + stored <= 1e-12 * work.abs(), "work {work} J with {stored} J stored");
        }
    }
}

/// A rope point pulled along the skin at 95 % of the limit: it moves once, then never again.
#[test]
fn a_stuck_rope_does_not_creep() {
    let (mu, normal_force, length) = (0.3, 200.0, 0.02);
    let pull = 0.95 * mu * normal_force;
    let mut contact = Contact { length, ..Contact::on_plane(&Coulomb::new(), normal_force, mu) };
    let mut travelled = Vec::new();
    for _ in 0..2000 {
        contact.slip = [0.0; 3];
        for _ in 0..20 {
            let answer = respond(&contact);
            contact.slip[0] -= (answer.force_n[0] + pull) / answer.by_slip[0][0];
        }
        travelled.push(contact.slip[0]);
        advance(&mut contact);
    }
    assert!((travelled[0] - pull / (STIFFNESS * length)).abs() < 1e-12);
    let creep: f64 = travelled[1..].iter().map(|slip| slip.abs()).sum();
    assert!(creep < 1e-12, "crept {creep} m in 2000 steps");
}

/// Rope dragged round a drum: at a node that bends by `D` with its contact at the node, equilibrium gives
/// `ln(T2/T1) = 2 atanh(mu tan(D/2))`; many nodes approach the capstan's `exp(mu theta)`.
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
        let fresh = Contact::on_plane(&Coulomb::new(), (before + after) * s, mu);
        let contact = Contact { slip: [1e-3, 0.0, 0.0], length: 0.08, ..fresh };
        after = before - respond(&contact).force_n[0] / c;
    }
    after
}

#[test]
fn wrong_lengths_are_an_error() {
    let (model, attributes) = (Coulomb::new(), values(&Coulomb::new(), &[]));
    let contacts = Contacts {
        dt_s: 0.002,
        normal_force_n: &[1.0],
        normal: &[[0.0, 0.0, 1.0]],
        grain: &[[0.0, 1.0, 0.0]],
        along: &[[1.0, 0.0, 0.0]],
        slip_m: &[[0.0; 3]],
        length_m: &[0.02],
        coefficient: &[0.3],
        region: &[4],
        rope: &[0],
        state: &[0.0; 3],
    };
    let error = model.respond(&[1.0], &contacts, &mut [FrictionResponse::default()]).unwrap_err();
    assert!(error.message.contains("2 attribute values"), "{error}");
    let error =
        model.respond(&attributes, &contacts, &mut [FrictionResponse::default(); 2]).unwrap_err();
    assert!(error.message.contains("differ in length"));
}
