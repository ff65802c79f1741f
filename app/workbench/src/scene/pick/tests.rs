//! What is picked where, in the hand-made sample.

use endline_session::scene::Scene;

use super::super::camera::View;
use super::super::sample;
use super::*;

const SIZE: DVec2 = DVec2::new(900.0, 700.0);
/// The whale is not shown.
const HIDDEN: Show = Show {
    scale_n: None,
    surface: true,
    seabed: true,
    current: true,
    contacts: true,
    forces: false,
    whale: false,
    names: false,
};

#[test]
fn what_is_clicked_where_it_is_drawn_is_what_is_picked() {
    let model = sample::model();
    let frame = sample::frame(&model);
    let camera =
        Camera::of_view(View::Side, &Scene::places_of(&model, &frame), None, 13.0, SIZE.x / SIZE.y);
    for at_m in [6.0, 15.3, 30.1] {
        let wanted = Picked::Rope { line: 0, at_m };
        let place = wanted.place(&model, &frame).unwrap();
        let beside = camera.project(place, SIZE).unwrap() + DVec2::new(2.0, 0.0);
        let Some(Picked::Rope { line: 0, at_m: found_m }) =
            pick(&model, &frame, &camera, beside, SIZE, &HIDDEN)
        else {
            panic!("rope at {at_m} m is not found")
        };
        assert!(
            (found_m - at_m).abs() < 3.0 * camera.metres_a_point(SIZE.y),
            "{found_m} for {at_m}"
        );
    }
    let buoy = camera.project(frame.bodies[1].0, SIZE).unwrap();
    assert_eq!(pick(&model, &frame, &camera, buoy, SIZE, &Show::default()), Some(Picked::Body(1)));
    assert_eq!(
        pick(&model, &frame, &camera, DVec2::new(5.0, SIZE.y / 2.0), SIZE, &Show::default()),
        None,
        "open water"
    );
}

#[test]
fn the_near_side_of_the_skin_is_picked_and_its_place_lies_on_the_ray() {
    let model = sample::model();
    let frame = sample::frame(&model);
    let at = frame.whale.as_ref().unwrap();
    let camera = Camera::of_view(View::WhaleSide, &[], Some(at), 13.0, SIZE.x / SIZE.y);
    let middle = SIZE / 2.0 + DVec2::new(11.0, -3.0);
    let Some(picked @ Picked::Skin { .. }) =
        pick(&model, &frame, &camera, middle, SIZE, &Show::default())
    else {
        panic!("the whale fills the picture")
    };
    let place = picked.place(&model, &frame).unwrap();
    assert!((camera.project(place, SIZE).unwrap() - middle).length() < 1e-6, "under the pointer");
    assert!(
        (place - camera.eye()).length() < (at.position - camera.eye()).length(),
        "not on its far side"
    );
    assert_eq!(
        pick(&model, &frame, &camera, middle, SIZE, &HIDDEN),
        None,
        "a whale that is not shown is not read"
    );
}

#[test]
fn lengths_along_a_line_are_found_again() {
    let model = sample::model();
    let frame = sample::frame(&model);
    assert!((length_m(&model, &frame, 0) - 36.0).abs() < 1e-9);
    let (segment, share) = on_line(&model, &frame, 0, 36.0 * 12.25 / 60.0).unwrap();
    assert!(segment == 12 && (share - 0.25).abs() < 1e-9, "{segment} {share}");
    assert_eq!(on_line(&model, &frame, 7, 1.0), None);
}

/// The sample with its buoy a metre before the side of the whale, and a camera that looks along that line, so that the one hides
/// the other.
fn buoy_before_the_whale() -> (Model, Frame, Camera) {
    let model = sample::model();
    let mut frame = sample::frame(&model);
    let at = frame.whale.clone().unwrap();
    let camera = Camera::of_view(View::WhaleSide, &[], Some(&at), 13.0, SIZE.x / SIZE.y);
    let toward = (camera.eye() - at.position).normalize();
    frame.bodies[1].0 = at.position + toward * 2.5;
    (model, frame, camera)
}

#[test]
fn a_body_before_the_whale_is_picked_and_beside_its_rounded_shape_the_skin_behind() {
    let (model, frame, camera) = buoy_before_the_whale();
    let pick = |place: DVec3| {
        let at = camera.project(place, SIZE).unwrap();
        pick(&model, &frame, &camera, at, SIZE, &Show::default())
    };
    let (middle, (right, up, _)) = (frame.bodies[1].0, camera.axes());
    assert_eq!(pick(middle), Some(Picked::Body(1)));
    // A capsule 0.36 m across that stands upright: a corner of the box round it is not on it.
    assert_eq!(pick(middle + right * 0.15 + up * 0.1), Some(Picked::Body(1)));
    let corner = middle + right * 0.17 + up * 0.39;
    assert!(matches!(pick(corner), Some(Picked::Skin { .. })), "{:?}", pick(corner));
    let mut behind = frame.clone();
    behind.bodies[1].0 = frame.whale.as_ref().unwrap().position * 2.0 - middle;
    let at = camera.project(middle, SIZE).unwrap();
    let hit = super::pick(&model, &behind, &camera, at, SIZE, &Show::default());
    assert!(matches!(hit, Some(Picked::Skin { .. })), "the skin hides the buoy: {hit:?}");
}

#[test]
fn an_arrow_is_picked_where_it_is_shown_and_tells_what_presses() {
    let (model, mut frame, camera) = buoy_before_the_whale();
    let (right, up, _) = camera.axes();
    let place = frame.bodies[1].0 + right * 1.0;
    frame.body_contacts = vec![sample::body_contact(1, 3, place, up, 500.0)];
    let show = Show { forces: true, ..Show::default() };
    // The arrow of the greatest force is 1.5 m long and ends at the place, skin being pushed downward.
    let at = camera.project(place + up * 0.8, SIZE).unwrap();
    let wanted = Picked::BodyOnSkin { body: 1, triangle: 3 };
    assert_eq!(pick(&model, &frame, &camera, at, SIZE, &show), Some(wanted));
    let hit = pick(&model, &frame, &camera, at, SIZE, &Show::default());
    assert!(matches!(hit, Some(Picked::Skin { .. })), "no arrow is shown: {hit:?}");
    let mark = camera.project(place, SIZE).unwrap();
    assert_eq!(pick(&model, &frame, &camera, mark, SIZE, &Show::default()), Some(wanted));
    assert_eq!(wanted.place(&model, &frame), Some(place));
    frame.body_contacts.clear();
    assert_eq!(wanted.place(&model, &frame), None, "it presses no more");
}

#[test]
fn the_place_of_a_contact_of_rope_is_found_again_along_its_line() {
    let model = sample::model();
    let frame = sample::frame(&model);
    let touch = &frame.contacts[0];
    let at_m = press::contact_m(&model, &frame, touch).unwrap();
    assert!((at_m - 36.0 * 30.5 / 60.0).abs() < 1e-9, "{at_m}");
    let picked = Picked::RopeOnSkin { line: 0, at_m: at_m + 0.3 };
    assert_eq!(picked.place(&model, &frame), Some(touch.position));
    assert_eq!(Picked::RopeOnSkin { line: 0, at_m: at_m + 0.6 }.place(&model, &frame), None);
}
