//! Where rope passes the whale, in order, and what it leads to.

use endline_sdk::Side;

use super::leaving::single;
use super::*;
use crate::metrics::{LeadsTo, Route, routes};

/// A contact of a line's segment with a part, on the ray from its axis.
fn on(model: &Model, line: usize, segment: usize, part: BodyPart, toward: DVec3) -> ContactPoint {
    let from = match part {
        BodyPart::Body => trunk_middle(0.55),
        BodyPart::Peduncle => trunk_middle(-4.55),
        _ => FLIPPER_ROOT.lerp(FLIPPER_TIP, 0.52),
    };
    let skin = &model.spec.whale.as_ref().unwrap().skin;
    ContactPoint { line, segment, ..contact(model, 0, ray(skin, part, from, toward)) }
}

/// Routes with cuts, their stations by part and side.
fn found(contacts: &[ContactPoint], cuts: &[usize]) -> Vec<Route> {
    let model = model(single());
    let mut state = State::start(&model);
    cuts.iter().for_each(|segment| state.rope.cut[*segment] = true);
    routes(&model, &state, contacts)
}

#[test]
fn stations_come_in_the_order_of_the_rope_across_a_splice() {
    let model = model(single());
    let side = |sign: f64| DVec3::new(0.0, sign, 0.1);
    let contacts = [
        on(&model, 1, 25, BodyPart::Peduncle, side(-1.0)),
        on(&model, 0, 4, BodyPart::LeftFlipper, DVec3::Z),
        on(&model, 0, 5, BodyPart::LeftFlipper, DVec3::Z),
        on(&model, 0, 9, BodyPart::Body, side(1.0)),
        on(&model, 0, 12, BodyPart::Body, DVec3::new(0.0, 0.01, 1.0)),
    ];
    let routes = found(&contacts, &[]);
    let [route] = routes.as_slice() else { panic!("{routes:?}") };
    let stations: Vec<_> =
        route.stations.iter().map(|station| (station.part, station.side)).collect();
    assert_eq!(
        stations,
        [
            (BodyPart::LeftFlipper, None),
            (BodyPart::Body, Some(Side::Left)),
            (BodyPart::Body, None),
            (BodyPart::Peduncle, Some(Side::Right)),
        ]
    );
    assert!(route.stations.iter().all(|station| !station.in_mouth));
}

/// The trap's line is 10 m long, the buoy's 8 m, in segments of 0.5 m; contacts lie at the middle of theirs.
#[test]
fn ends_are_what_rope_leads_to_and_how_far() {
    let model = model(single());
    let touch = |line, segment| on(&model, line, segment, BodyPart::Body, DVec3::Z);
    let ends = |contacts: &[ContactPoint], cuts: &[usize]| {
        let routes = found(contacts, cuts);
        let end = |route: &Route| route.ends.map(|end| (end.leads_to, end.rope_m));
        routes.iter().map(end).collect::<Vec<_>>()
    };
    let one = [touch(0, 4)];
    assert_eq!(ends(&one, &[]), [[(LeadsTo::Body(0), 2.25), (LeadsTo::Body(1), 15.75)]]);
    assert_eq!(ends(&one, &[0]), [[(LeadsTo::Broken, 1.75), (LeadsTo::Body(1), 15.75)]]);
    assert_eq!(ends(&one, &[24]), [[(LeadsTo::Body(0), 2.25), (LeadsTo::Broken, 9.75)]]);
    // The tail beyond the buoy and the groundline are strands of their own.
    let two = [touch(2, 37), touch(3, 45)];
    assert_eq!(
        ends(&two, &[]),
        [
            [(LeadsTo::Body(1), 0.75), (LeadsTo::Bare, 1.25)],
            [(LeadsTo::Body(0), 5.5), (LeadsTo::Body(2), 14.5)],
        ]
    );
    assert!(ends(&[], &[]).is_empty());
}
