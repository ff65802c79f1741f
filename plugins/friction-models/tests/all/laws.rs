//! Invariants of every shipped friction model: correct derivatives, bounded forces across the normal, and no creation of
//! energy, at random attributes and inputs.

use crate::common;
use crate::common::{Contact, Random, Vec3, across, dot, norm, random_values};
use endline_friction_models::all;
use endline_sdk::FrictionModel;

/// Slides a new contact for a while, so that its state is not the initial one.
fn used(model: &dyn FrictionModel, attributes: &[f64], random: &mut Random) -> Contact {
    let mut contact = Contact::random(model, random);
    let way = libm::exp10(random.between(-6.0, -2.0));
    for _ in 0..(random.unit() * 6.0) as usize {
        let slip = across(contact.normal, random.vector(way));
        contact.slide(model, attributes, slip);
    }
    contact.slip = across(contact.normal, random.vector(way));
    contact
}

/// Forces a little to either side along an axis: first differences for the derivative, second differences to detect a change of branch.
fn beside(
    model: &dyn FrictionModel,
    attributes: &[f64],
    contact: &Contact,
    axis: usize,
    by: f64,
) -> [Vec3; 2] {
    [by, -by].map(|by| {
        let mut moved = contact.clone();
        moved.slip[axis] += by;
        moved.respond(model, attributes).force_n
    })
}

#[test]
fn derivatives_agree_with_finite_differences() {
    for model in all() {
        let (mut random, mut compared) = (Random(17), 0);
        for _ in 0..3000 {
            let attributes = random_values(model.as_ref(), &mut random);
            let contact = used(model.as_ref(), &attributes, &mut random);
            let here = contact.respond(model.as_ref(), &attributes);
            let by = 1e-5 * norm(contact.slip).max(1e-8);
            let sides: Vec<_> = (0..3)
                .map(|axis| beside(model.as_ref(), &attributes, &contact, axis, by))
                .collect();
            let scale = here
                .by_slip
                .as_flattened()
                .iter()
                .fold(0.0_f64, |most, entry| most.max(entry.abs()))
                .max(1e-9);
            let bent = |plus: Vec3, minus: Vec3| {
                (0..3)
                    .any(|i| (plus[i] + minus[i] - 2.0 * here.force_n[i]).abs() > 1e-4 * scale * by)
            };
            if sides.iter().any(|[plus, minus]| bent(*plus, *minus)) {
                continue;
            }
            compared += 1;
            for (axis, [plus, minus]) in sides.iter().enumerate() {
                for row in 0..3 {
                    let difference = (plus[row] - minus[row]) / (2.0 * by);
                    let rounding = 1e-10 * norm(here.force_n) / by;
                    let error = (difference - here.by_slip[row][axis]).abs();
                    assert!(
                        error < 1e-3 * scale + rounding,
                        "{}: {difference} {:?}",
                        model.descriptor().id,
                        here.by_slip
                    );
                }
            }
            let press = 1e-5 * contact.normal_force;
            let pressed = |by: f64| {
                Contact { normal_force: contact.normal_force + by, ..contact.clone() }
                    .respond(model.as_ref(), &attributes)
            };
            let (more, less) = (pressed(press).force_n, pressed(-press).force_n);
            for row in 0..3 {
                let (up, down) = (
                    (more[row] - here.force_n[row]) / press,
                    (here.force_n[row] - less[row]) / press,
                );
                if (up - down).abs() < 1e-3 * contact.mu {
                    let difference = 0.5 * (up + down);
                    assert!(
                        (difference - here.by_normal_force[row]).abs() < 2e-3 * contact.mu,
                        "{difference} {here:?}"
                    );
                }
            }
        }
        assert!(compared > 1500, "{}: {compared} compared", model.descriptor().id);
    }
}

#[test]
fn force_lies_across_the_normal_and_is_bounded() {
    for model in all() {
        let mut random = Random(11);
        for _ in 0..3000 {
            let attributes = random_values(model.as_ref(), &mut random);
            let contact = used(model.as_ref(), &attributes, &mut random);
            let force = contact.respond(model.as_ref(), &attributes).force_n;
            assert!(dot(force, contact.normal).abs() < 1e-9 * (1.0 + norm(force)));
            let most = 10.0 * contact.mu * contact.normal_force;
            assert!(
                norm(force) <= most * (1.0 + 1e-9),
                "{}: {} N beyond {most} N",
                model.descriptor().id,
                norm(force)
            );
        }
    }
}

/// From the first contact on, work on the rope is never positive: no energy is created. Normal force, slip and
/// place on a turning body change at random.
#[test]
fn no_model_adds_energy_over_any_path() {
    for model in all() {
        let (mut random, mut given) = (Random(5), 0.0);
        for _ in 0..300 {
            let attributes = random_values(model.as_ref(), &mut random);
            let mut contact = Contact::random(model.as_ref(), &mut random);
            let way = libm::exp10(random.between(-6.0, -2.0));
            let (mut work, mut exchanged) = (0.0, 0.0_f64);
            for _ in 0..300 {
                turn(&mut contact, random.vector(0.02));
                contact.normal_force = random.between(-100.0, 300.0).max(0.0);
                let slip = across(contact.normal, random.vector(way));
                let step = dot(contact.slide(model.as_ref(), &attributes, slip), slip);
                work += step;
                exchanged += step.abs();
                given += step.max(0.0);
                assert!(
                    work <= 1e-12 * exchanged,
                    "{}: {work} J out of nothing, {attributes:?}",
                    model.descriptor().id
                );
            }
        }
        assert!(given > 0.0, "{}: bristles give back what they stored", model.descriptor().id);
    }
}

/// Turns a contact's frame with the skin under it, by a small rotation vector.
fn turn(contact: &mut Contact, by: Vec3) {
    let cross = |v: Vec3| {
        [by[1] * v[2] - by[2] * v[1], by[2] * v[0] - by[0] * v[2], by[0] * v[1] - by[1] * v[0]]
    };
    let turned = |v: Vec3| {
        let d = cross(v);
        let moved: Vec3 = std::array::from_fn(|i| v[i] + d[i]);
        moved.map(|c| c / norm(moved))
    };
    contact.normal = turned(contact.normal);
    let grain = across(contact.normal, turned(contact.grain));
    contact.grain = grain.map(|c| c / norm(grain));
    contact.along = contact.grain;
}

/// A pull below the limit moves the rope once, and never again.
#[test]
fn a_rope_held_below_the_limit_does_not_creep() {
    for model in all() {
        let attributes = common::values(model.as_ref(), &[]);
        let (mu, normal_force) = (0.3, 200.0);
        let mut contact = Contact::on_plane(model.as_ref(), normal_force, mu);
        let pull = 0.95 * mu * normal_force;
        let mut travelled = Vec::new();
        for _ in 0..300 {
            // The slip at which friction holds the pull, by halving: laws with a taut range are steep there.
            let (mut less, mut more) = (0.0, 0.5);
            for _ in 0..80 {
                contact.slip = [0.5 * (less + more), 0.0, 0.0];
                let holds = -contact.respond(model.as_ref(), &attributes).force_n[0] >= pull;
                (less, more) =
                    if holds { (less, contact.slip[0]) } else { (contact.slip[0], more) };
            }
            travelled.push(contact.slip[0]);
            contact.advance(model.as_ref(), &attributes);
        }
        assert!(travelled[0] > 0.0);
        let creep: f64 = travelled[1..].iter().map(|slip| slip.abs()).sum();
        assert!(creep < 1e-9, "{}: crept {creep} m in 300 steps", model.descriptor().id);
    }
}
