//! Forces, work of friction and added drag against worked examples.

use super::*;

/// Rope of 3 N/m pressed on the back, dragged aft at 0.5 m/s with friction 0.4 for 2 s: work = mu N v t.
#[test]
fn friction_work_of_a_steady_slide() {
    for solver_steps in [1.0, 5.0] {
        let model = model(spec(vec![0.5; 4]));
        let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
        let mut contacts = touch(&model);
        contacts[0].normal_force_n = 30.0;
        contacts[0].friction_n = DVec3::X * 12.0;
        contacts[0].slip_m = DVec3::X * -0.5 * STEP_S / solver_steps;
        contacts[0].dt_s = STEP_S / solver_steps;
        (0..200).for_each(|_| advance(&mut metrics, &model, &mut state, &contacts));
        let whale = metrics.summary(&model, &state).whale.unwrap();
        let body = &whale.regions[BodyPart::Body as usize];
        assert!((body.friction_work_j - 12.0 * 0.5 * 2.0).abs() < 1e-9, "{body:?}");
        assert!((body.peak_pressure_pa - 30.0 / (0.5 * 0.01)).abs() < 1e-9);
        assert!(
            whale
                .regions
                .iter()
                .filter(|region| region.part != BodyPart::Body)
                .all(|region| region.friction_work_j.abs() < 1e-12)
        );
    }
}

/// Stretch of a sticking contact that springs back does no work in the end.
#[test]
fn sticking_to_and_fro_does_no_work() {
    let model = model(spec(vec![0.5; 4]));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    let mut contacts = touch(&model);
    for k in 0..1000 {
        let phase = std::f64::consts::TAU * f64::from(k) / 1000.0;
        contacts[0].friction_n = DVec3::Y * -1e4 * 1e-3 * libm::sin(phase);
        contacts[0].slip_m = DVec3::Y * 1e-3 * libm::cos(phase) * std::f64::consts::TAU / 1000.0;
        advance(&mut metrics, &model, &mut state, &contacts);
    }
    let work = metrics.summary(&model, &state).whale.unwrap().regions[BodyPart::Body as usize]
        .friction_work_j;
    assert!(work.abs() < 1e-9, "{work}");
}

/// Normal forces add up over a part, and the peak is of the sum.
#[test]
fn peak_normal_force_is_of_the_sum() {
    let model = model(spec(vec![0.5; 4]));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    for force in [5.0, 40.0, 20.0] {
        let one = ContactPoint { normal_force_n: force, ..touch(&model)[0].clone() };
        let idle = ContactPoint { normal_force_n: 0.0, segment: 2, ..one.clone() };
        advance(
            &mut metrics,
            &model,
            &mut state,
            &[one.clone(), ContactPoint { segment: 1, ..one }, idle],
        );
    }
    let body = &metrics.summary(&model, &state).whale.unwrap().regions[BodyPart::Body as usize];
    assert_eq!((body.peak_normal_n, body.contact_length_m), (80.0, 1.0));
}

/// A whale heading north is held back by contact that pushes rope north; 3 s of 100 N in the last 5 s is 60 N.
#[test]
fn added_drag_is_along_the_heading_and_a_mean_of_five_seconds() {
    let model = model(spec(vec![0.5; 4]));
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    state.whale.as_mut().unwrap().orientation = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
    let mut contacts = touch(&model);
    (contacts[0].normal, contacts[0].normal_force_n) = (DVec3::new(0.0, 0.6, 0.8), 100.0);
    contacts[0].friction_n = DVec3::new(7.0, 40.0, -30.0);
    (0..400).for_each(|_| advance(&mut metrics, &model, &mut state, &contacts));
    let early = metrics.summary(&model, &state).whale.unwrap();
    assert!(
        (early.drag_added_n - 100.0).abs() < 1e-9 && (early.drag_added_now_n - 100.0).abs() < 1e-9,
        "{early:?}"
    );
    (0..700).for_each(|_| advance(&mut metrics, &model, &mut state, &[]));
    (0..300).for_each(|_| advance(&mut metrics, &model, &mut state, &contacts));
    let late = metrics.summary(&model, &state).whale.unwrap();
    assert!((late.drag_added_n - 60.0).abs() < 0.3, "{}", late.drag_added_n);
}
