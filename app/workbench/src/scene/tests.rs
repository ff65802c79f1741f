//! Compares the scene with its model, the drawn picture with the scene, and picks with the drawn picture.

use endline_sim::model::WeakPlace;
use endline_sim::{DVec3, Frame, Model};
use glam::DVec2;

use endline_session::scene::colour::{CURRENT, ROPE, tension_colour};
use endline_session::scene::mesh::Colour;
use endline_session::scene::{Look, Scene, Show};
use endline_session::units::Units;

use super::pick::{contact_m, length_m, on_line, pick};
use super::{Camera, Picked, RenderRequest, View, render, render_png, sample};

fn scene() -> Scene {
    let model = sample::model();
    Scene::of(&model, &sample::frame(&model), &Show::default())
}

#[test]
fn every_part_of_the_rig_is_in_the_scene_and_can_be_hidden() {
    let names: Vec<&str> = scene().parts.iter().map(|part| part.name).collect();
    assert_eq!(
        names,
        ["seabed", "whale", "ropes", "bodies", "current", "current heads", "marks", "surface"]
    );
    let model = sample::model();
    let bare = Show {
        scale_n: None,
        surface: false,
        seabed: false,
        current: false,
        contacts: false,
        forces: false,
        whale: false,
        names: false,
        film: false,
    };
    let names: Vec<&str> = Scene::of(&model, &sample::frame(&model), &bare)
        .parts
        .iter()
        .map(|part| part.name)
        .collect();
    assert_eq!(names, ["ropes", "bodies"]);
}

#[test]
fn weak_places_are_marked_where_they_are_until_their_segment_parts() {
    let mut spec = sample::model().spec;
    let place = |at_m| WeakPlace { at_m, strength_n: 7e3 };
    // Of segments of 0.6 m: the middle of the third, and the node between two.
    spec.lines[0].weak_places = vec![place(1.5), place(6.0)];
    let model = Model::new(spec).unwrap();
    let mut frame = sample::frame(&model);
    let marks = |frame: &Frame| {
        let scene = Scene::of(&model, frame, &Show::default());
        scene.part("weak places").map(|part| part.mesh.place.clone()).unwrap_or_default()
    };
    let drawn = marks(&frame);
    let at = [frame.nodes[2].lerp(frame.nodes[3], 0.5), frame.nodes[10]];
    for at in at {
        let near = drawn.iter().filter(|place| place.as_dvec3().distance(at) < 1e-3);
        assert_eq!(near.count(), drawn.len() / 2, "{at}: {drawn:?}");
    }
    frame.cut[2] = true;
    assert_eq!(marks(&frame).len(), drawn.len() / 2);
}

#[test]
fn obstacles_have_their_position_and_size() {
    use endline_sim::geometry::shape::SolidShape;
    use endline_sim::model::{Obstacle, ROPE_ON_HARD_N_M2};
    let mut spec = sample::model().spec;
    let drum = SolidShape::Cylinder { radius_m: 0.5, half_length_m: 2.0 };
    for (shape, half) in [
        (drum, DVec3::new(2.0, 0.5, 0.5)),
        (SolidShape::Box(DVec3::new(3.0, 2.0, 1.0)), DVec3::new(1.0, 2.0, 3.0)),
    ] {
        // Rotated so that the z axis points east.
        let orientation = endline_sim::DQuat::from_rotation_arc(DVec3::Z, DVec3::X);
        let position_m = DVec3::new(4.0, -3.0, -20.0);
        spec.obstacles = vec![Obstacle {
            id: "rock".into(),
            shape,
            position_m,
            orientation,
            friction: 0.3,
            stiffness_n_m2: ROPE_ON_HARD_N_M2,
        }];
        let model = Model::new(spec.clone()).unwrap();
        let mesh = Scene::of(&model, &sample::frame(&model), &Show::default())
            .part("obstacles")
            .unwrap()
            .mesh
            .clone();
        let reach = (0..mesh.vertices())
            .map(|vertex| (mesh.surface(vertex).as_dvec3() - position_m).abs())
            .fold(DVec3::ZERO, DVec3::max);
        assert!((reach - half).length() < 0.01, "{reach}");
    }
}

#[test]
fn every_index_of_a_mesh_has_a_vertex_and_every_number_is_finite() {
    for part in scene().parts {
        let mesh = &part.mesh;
        let vertices = mesh.vertices();
        assert!(
            mesh.normal.len() == vertices
                && mesh.radius_m.len() == vertices
                && mesh.colour.len() == vertices,
            "{}",
            part.name
        );
        assert!(
            mesh.triangles.iter().flatten().all(|corner| (*corner as usize) < vertices),
            "{}",
            part.name
        );
        assert!(
            mesh.place.iter().chain(&mesh.normal).all(|vector| vector.is_finite()),
            "{}",
            part.name
        );
        assert!(
            mesh.normal.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-4),
            "{}",
            part.name
        );
    }
}

#[test]
fn rope_is_coloured_by_its_tension_against_the_scale() {
    let scene = scene();
    assert!((scene.scale_n - 600.0).abs() < 1e-9, "the frame's own peak");
    let ropes = &scene.part("ropes").unwrap().mesh;
    assert!(close(ropes.colour[ropes.vertices() - 1], tension_colour(1.0)), "peak at the buoy");
    let model = sample::model();
    let strength = Show { scale_n: Some(6000.0), ..Show::default() };
    let ropes =
        Scene::of(&model, &sample::frame(&model), &strength).part("ropes").unwrap().mesh.clone();
    assert!(close(ropes.colour[ropes.vertices() - 1], tension_colour(0.1)));
}

/// Whether two colours differ by less than one step of a screen.
fn close(a: Colour, b: Colour) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1.0 / 255.0)
}

#[test]
fn a_cut_segment_is_a_gap() {
    let model = sample::model();
    let mut frame = sample::frame(&model);
    let middle = ((frame.nodes[20] + frame.nodes[21]) * 0.5).z as f32;
    let spanning = |frame: &Frame| {
        let mesh = Scene::of(&model, frame, &Show::default()).part("ropes").unwrap().mesh.clone();
        let above = |corner: &u32| mesh.place[*corner as usize].z > middle;
        mesh.triangles
            .iter()
            .filter(|corners| corners.iter().any(above) && !corners.iter().all(above))
            .count()
    };
    assert_eq!(spanning(&frame), 12, "two triangles a side join the two ends of a whole segment");
    frame.cut[20] = true;
    assert_eq!(spanning(&frame), 0);
}

#[test]
fn arrows_have_the_length_of_the_current_at_their_height() {
    let scene = scene();
    let arrows = &scene.part("current").unwrap().mesh;
    let reach = |low: f64, high: f64| {
        let within = arrows.place.iter().filter(|place| (low..high).contains(&f64::from(place.z)));
        let (least, most) = within
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(least, most), place| {
                (least.min(place.x), most.max(place.x))
            });
        f64::from(most - least)
    };
    let height = (0.5 / 7.0_f64).powf(1.0 / 7.0);
    let lowest = reach(-sample::DEPTH_M * (1.0 - 0.2 / 7.0), -sample::DEPTH_M * (1.0 - 0.8 / 7.0));
    assert!((lowest / (0.6 * height * 6.0) - 1.0).abs() < 0.05, "lowest arrow spans {lowest} m");
}

/// A picture of the sample, its size and its camera.
fn picture(view: View) -> (Vec<[u8; 4]>, DVec2, Camera) {
    picture_of(view, false)
}

fn picture_of(view: View, film: bool) -> (Vec<[u8; 4]>, DVec2, Camera) {
    let model = sample::model();
    let frame = sample::frame(&model);
    let size = [640, 480];
    let out = std::path::PathBuf::new();
    let request = RenderRequest {
        model: &model,
        frame: &frame,
        size,
        view: view.name(),
        show: Show { film, ..Show::default() },
        fit: &[],
        caption: "sample",
        out: &out,
        units: Units::Mixed,
    };
    let pixels = render(&request).unwrap();
    let places = Scene::places_of(&model, &frame);
    (
        pixels,
        DVec2::new(640.0, 480.0),
        Camera::of_view(view, &places, frame.whale.as_ref(), 13.0, 640.0 / 480.0),
    )
}

/// The pixel at a place in the world.
fn pixel(pixels: &[[u8; 4]], size: DVec2, camera: &Camera, place: DVec3) -> [u8; 4] {
    let at = camera.project(place, size).unwrap();
    pixels[at.y as usize * size.x as usize + at.x as usize]
}

/// Mean of red and green minus blue.
fn yellow(colour: Colour) -> f32 {
    (colour[0] + colour[1]) / 2.0 - colour[2]
}

#[test]
fn the_picture_shows_whale_and_rope_where_the_camera_projects_them() {
    let (pixels, size, camera) = picture(View::Side);
    assert_eq!(pixels.len(), 640 * 480);
    let open_water = pixel(&pixels, size, &camera, DVec3::new(9.0, 0.0, -25.0));
    let whale = pixel(&pixels, size, &camera, DVec3::new(-7.0, 2.0, -14.0));
    let difference = |a: [u8; 4], b: [u8; 4]| {
        (0..3).map(|part| i32::from(a[part].abs_diff(b[part]))).sum::<i32>()
    };
    assert!(difference(whale, open_water) > 40, "whale {whale:?} against water {open_water:?}");
    let model = sample::model();
    let near_top = sample::frame(&model).nodes[56];
    let around: Vec<[u8; 4]> = (-2..=2)
        .map(|step| pixel(&pixels, size, &camera, near_top + DVec3::X * 0.05 * f64::from(step)))
        .collect();
    let yellowest = around
        .iter()
        .map(|colour| yellow(colour.map(|part| f32::from(part) / 255.0)))
        .fold(f32::MIN, f32::max);
    assert!(
        yellowest > 0.5 * yellow(tension_colour(0.95)),
        "the taut end of the rope is yellow: {around:?}"
    );
}

#[test]
fn a_film_has_no_instruments_and_its_rope_has_one_colour() {
    let model = sample::model();
    let scene = Scene::of(&model, &sample::frame(&model), &Show { film: true, ..Show::default() });
    let names: Vec<&str> = scene.parts.iter().map(|part| part.name).collect();
    assert_eq!(names, ["seabed", "whale", "ropes", "bodies", "surface"]);
    let ropes = &scene.part("ropes").unwrap().mesh;
    assert!(ropes.colour.iter().all(|colour| *colour == ROPE));
    assert_eq!(scene.part("seabed").unwrap().look, Look::Seabed { grid_m: 0.0 });
}

/// The part of the picture under the scale bar: differences from pixel to pixel along its rows, which letters and lines make large.
#[test]
fn a_film_has_no_text() {
    let sharpest = |film: bool| {
        let (pixels, size, _) = picture_of(View::Side, film);
        let (width, height) = (size.x as usize, size.y as usize);
        let rows = pixels.chunks(width).skip(height - 40);
        let steps = rows.flat_map(|row| row[..140].windows(2));
        steps.map(|pair| pair[0][1].abs_diff(pair[1][1])).max().unwrap()
    };
    let (measured, film) = (sharpest(false), sharpest(true));
    assert!(measured > 100 && film < 50, "{measured} with a scale bar, {film} in a film");
}

#[test]
fn a_colour_that_is_read_against_a_scale_is_drawn_as_it_is() {
    let model = sample::model();
    let (pixels, size, camera) = picture(View::Side);
    let arrow = Scene::of(&model, &sample::frame(&model), &Show::default());
    let heads = &arrow.part("current heads").unwrap().mesh;
    let places: Vec<DVec3> =
        (0..heads.vertices()).map(|vertex| heads.surface(vertex).as_dvec3()).collect();
    let wanted = CURRENT.map(|part| part * 255.0);
    let nearest = places.iter().map(|place| {
        let seen = pixel(&pixels, size, &camera, *place);
        (0..3).map(|part| (f32::from(seen[part]) - wanted[part]).abs()).fold(0.0, f32::max)
    });
    // The side of a head that is seen at a flat angle is up to a fifth darker.
    let nearest = nearest.fold(f32::MAX, f32::min);
    assert!(nearest < 0.1 * 255.0, "{nearest} of 255 away from {wanted:?}");
}

#[test]
fn a_picture_is_the_same_twice() {
    assert!(picture(View::Orbit).0 == picture(View::Orbit).0);
}

#[test]
fn an_unknown_view_or_size_is_refused_with_what_is_allowed() {
    let model = sample::model();
    let frame = sample::frame(&model);
    let out = std::path::PathBuf::new();
    let request = |view, size| RenderRequest {
        model: &model,
        frame: &frame,
        size,
        view,
        show: Show::default(),
        fit: &[],
        caption: "",
        out: &out,
        units: Units::Mixed,
    };
    assert!(
        render(&request("behind", [64, 64]))
            .unwrap_err()
            .contains("orbit, side, top, front, whale")
    );
    assert!(render(&request("side", [64, 0])).unwrap_err().contains("16 to 8192"));
}

#[test]
fn a_png_has_the_requested_size_and_an_unwritable_path_is_named() {
    let model = sample::model();
    let frame = sample::frame(&model);
    let out = std::env::temp_dir().join(format!("endline-picture-{}.png", std::process::id()));
    let request = |out| RenderRequest {
        model: &model,
        frame: &frame,
        size: [900, 600],
        view: "orbit",
        show: Show::default(),
        fit: &[],
        caption: "sample",
        out,
        units: Units::Mixed,
    };
    render_png(&request(&out)).unwrap();
    let decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(&out).unwrap()));
    let info = decoder.read_info().unwrap().info().clone();
    std::fs::remove_file(&out).unwrap();
    assert_eq!((info.width, info.height), (900, 600));
    let nowhere = std::path::Path::new("/nowhere/at/all.png");
    assert!(render_png(&request(nowhere)).unwrap_err().contains("/nowhere/at/all.png"));
}

#[test]
fn the_arrow_of_the_greatest_force_ends_at_its_contact_and_points_against_the_normal() {
    let model = sample::model();
    let frame = sample::frame(&model);
    let scene = Scene::of(&model, &frame, &Show { forces: true, ..Show::default() });
    let mesh = &scene.part("forces").unwrap().mesh;
    let touch = &frame.contacts[0];
    // The normal points east and there is no friction: the arrow starts 1.5 m east of the contact.
    let reach = mesh
        .place
        .iter()
        .map(|place| f64::from(place.x) - touch.position.x)
        .fold([f64::MAX, f64::MIN], |[low, high], x| [low.min(x), high.max(x)]);
    assert!(reach[0].abs() < 1e-3 && (reach[1] - 1.5).abs() < 1e-3, "{reach:?}");
    assert!((endline_session::scene::forces::greatest_n(&frame) - 80.0).abs() < 1e-9);
    assert!(Scene::of(&model, &frame, &Show::default()).part("forces").is_none());
}

const SIZE: DVec2 = DVec2::new(900.0, 700.0);
/// Shows everything but the whale.
const HIDDEN: Show = Show {
    scale_n: None,
    surface: true,
    seabed: true,
    current: true,
    contacts: true,
    forces: false,
    whale: false,
    names: false,
    film: false,
};

#[test]
fn a_click_on_a_drawn_thing_picks_it() {
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
fn the_near_side_of_the_skin_is_picked_at_a_place_on_the_ray() {
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
        "a hidden whale is not picked"
    );
}

#[test]
fn lengths_along_a_line_are_found_in_its_segments() {
    let model = sample::model();
    let frame = sample::frame(&model);
    assert!((length_m(&model, &frame, 0) - 36.0).abs() < 1e-9);
    let (segment, share) = on_line(&model, &frame, 0, 36.0 * 12.25 / 60.0).unwrap();
    assert!(segment == 12 && (share - 0.25).abs() < 1e-9, "{segment} {share}");
    assert_eq!(on_line(&model, &frame, 7, 1.0), None);
}

/// The sample with its buoy one metre in front of the side of the whale, and a camera for which the buoy hides the whale.
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
fn a_body_in_front_of_the_whale_is_picked_and_beside_its_round_shape_the_skin_behind() {
    let (model, frame, camera) = buoy_before_the_whale();
    let pick = |place: DVec3| {
        let at = camera.project(place, SIZE).unwrap();
        pick(&model, &frame, &camera, at, SIZE, &Show::default())
    };
    let (middle, (right, up, _)) = (frame.bodies[1].0, camera.axes());
    assert_eq!(pick(middle), Some(Picked::Body(1)));
    // A vertical capsule 0.36 m in diameter: the corners of its bounding box are not on it.
    assert_eq!(pick(middle + right * 0.15 + up * 0.1), Some(Picked::Body(1)));
    let corner = middle + right * 0.17 + up * 0.39;
    assert!(matches!(pick(corner), Some(Picked::Skin { .. })), "{:?}", pick(corner));
    let mut behind = frame.clone();
    behind.bodies[1].0 = frame.whale.as_ref().unwrap().position * 2.0 - middle;
    let at = camera.project(middle, SIZE).unwrap();
    let hit = super::pick::pick(&model, &behind, &camera, at, SIZE, &Show::default());
    assert!(matches!(hit, Some(Picked::Skin { .. })), "the skin hides the buoy: {hit:?}");
}

#[test]
fn a_shown_arrow_is_picked_and_names_the_body_that_presses() {
    let (model, mut frame, camera) = buoy_before_the_whale();
    let (right, up, _) = camera.axes();
    let place = frame.bodies[1].0 + right * 1.0;
    frame.body_contacts = vec![sample::body_contact(1, 3, place, up, 500.0)];
    let show = Show { forces: true, ..Show::default() };
    // The arrow of the greatest force is 1.5 m long and ends at the contact, which pushes the skin downward.
    let at = camera.project(place + up * 0.8, SIZE).unwrap();
    let wanted = Picked::BodyOnSkin { body: 1, triangle: 3 };
    assert_eq!(pick(&model, &frame, &camera, at, SIZE, &show), Some(wanted));
    let hit = pick(&model, &frame, &camera, at, SIZE, &Show::default());
    assert!(matches!(hit, Some(Picked::Skin { .. })), "no arrow is shown: {hit:?}");
    let mark = camera.project(place, SIZE).unwrap();
    assert_eq!(pick(&model, &frame, &camera, mark, SIZE, &Show::default()), Some(wanted));
    assert_eq!(wanted.place(&model, &frame), Some(place));
    frame.body_contacts.clear();
    assert_eq!(wanted.place(&model, &frame), None, "the contact has ended");
}

#[test]
fn a_contact_of_rope_is_found_by_its_length_along_the_line() {
    let model = sample::model();
    let frame = sample::frame(&model);
    let touch = &frame.contacts[0];
    let at_m = contact_m(&model, &frame, touch).unwrap();
    assert!((at_m - 36.0 * 30.5 / 60.0).abs() < 1e-9, "{at_m}");
    let picked = Picked::RopeOnSkin { line: 0, at_m: at_m + 0.3 };
    assert_eq!(picked.place(&model, &frame), Some(touch.position));
    assert_eq!(Picked::RopeOnSkin { line: 0, at_m: at_m + 0.6 }.place(&model, &frame), None);
}
