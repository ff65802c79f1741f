//! Rope that leaves the whale, by where it leads.

use super::*;

/// Trap - 10 m - splice - 8 m - buoy - 2 m - bare end, and a groundline of 20 m from the trap to an anchor.
pub(super) fn single() -> ModelSpec {
    let mut spec = spec(vec![0.5; 20]);
    let at = |body, z| (JointKind::Body { body, offset_m: DVec3::ZERO }, DVec3::new(0.0, 0.0, z));
    let [trap, buoy, anchor] = [at(0, -50.0), at(1, 0.0), at(2, -50.0)];
    spec.bodies = vec![
        body("trap", BodyRole::Trap, trap.1),
        body("buoy", BodyRole::Buoy, buoy.1),
        body("anchor", BodyRole::Anchor, anchor.1 + DVec3::X * 20.0),
    ];
    spec.joints = vec![
        joint("trap", trap.0, trap.1),
        joint("splice", JointKind::Free, DVec3::new(0.0, 0.0, -20.0)),
        joint("buoy", buoy.0, buoy.1),
        joint("tail", JointKind::Free, DVec3::X * 2.0),
        joint("anchor", anchor.0, anchor.1 + DVec3::X * 20.0),
    ];
    spec.lines = vec![
        line("lower", 0, 1, vec![0.5; 20]),
        line("upper", 1, 2, vec![0.5; 16]),
        line("tail", 2, 3, vec![0.5; 4]),
        line("groundline", 0, 4, vec![1.0; 20]),
    ];
    spec
}

/// Rope trailing and tethered with contacts at segments of the model's layout, after some cuts.
fn beyond(contacts: &[(usize, usize)], cuts: &[usize]) -> [f64; 2] {
    let model = model(single());
    let (mut metrics, mut state) = (Metrics::new(&model), State::start(&model));
    cuts.iter().for_each(|segment| state.rope.cut[*segment] = true);
    let one = touch(&model).remove(0);
    let contacts: Vec<_> = contacts
        .iter()
        .map(|(line, segment)| ContactPoint { line: *line, segment: *segment, ..one.clone() })
        .collect();
    advance(&mut metrics, &model, &mut state, &contacts);
    let whale = metrics.summary(&model, &state).whale.unwrap();
    [whale.trailing_m, whale.tethered_m]
}

#[test]
fn rope_beyond_the_whale_is_trailing_or_tethered() {
    let close = |got: [f64; 2], wanted: [f64; 2]| {
        assert!(
            (got[0] - wanted[0]).abs() < 1e-9 && (got[1] - wanted[1]).abs() < 1e-9,
            "{got:?}, wanted {wanted:?}"
        );
    };
    close(beyond(&[], &[]), [0.0, 0.0]);
    // Touched 2.25 m above the trap: below it the trap holds, above hang 7.75 + 8 + 2 m.
    close(beyond(&[(0, 4)], &[]), [17.75, 2.25]);
    // Touched twice: rope between is carried; it neither trails nor is held.
    close(beyond(&[(0, 4), (0, 10)], &[]), [14.75, 2.25]);
    close(beyond(&[(0, 4), (1, 21)], &[]), [7.25 + 2.0, 2.25]);
    // Cut at the trap's end: the lower part is loose too.
    close(beyond(&[(0, 4)], &[0]), [17.75 + 1.75, 0.0]);
    // Cut above: only the rope up to the cut hangs from the whale.
    close(beyond(&[(0, 4)], &[7]), [1.25, 2.25]);
    // Cut in the upper line.
    close(beyond(&[(0, 4)], &[24]), [7.75 + 2.0, 2.25]);
}
