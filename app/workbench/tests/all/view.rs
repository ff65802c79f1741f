//! The 3-D view: things picked and read, distances measured, panes, pictures, films, full screen.

use std::sync::Arc;

use egui_kittest::kittest::Queryable;
use endline_sdk::{BodyPart, Region};
use endline_session::command::TimeAction;
use endline_session::live::{LiveView, Status};
use endline_session::units::Units;
use endline_sim::Frame;
use endline_sim::contact::body_on_skin::BodyContact;
use endline_sim::metrics::{Event, EventKind};
use endline_sim::model::BodyRole;
use endline_workbench::gui::command::action::{ViewAction, WindowCommand};
use endline_workbench::gui::inspector::{along_m, measured, read};
use endline_workbench::gui::palette::offers;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::scene::{Eye, Picked, View};
use glam::{DVec2, DVec3};

use crate::common::{Folder, Reach as _, Window, flown, give, only, real, wait};

/// The workbench with only the 3-D view, after the statics of hello-endline.
fn settled(folder: &Folder) -> Window {
    let mut harness = real(folder, "hello-endline");
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    only(&mut harness, PanelId::View);
    harness
}

/// Clicks at the position of a place in a pane.
fn click(harness: &mut Window, pane: usize, place: DVec3) {
    let rect = harness.get_by_label(&format!("Pane {}", pane + 1)).rect();
    let camera = harness.state().panels.view.eyes[pane].camera.clone();
    let at = camera
        .project(place, DVec2::new(f64::from(rect.width()), f64::from(rect.height())))
        .unwrap();
    let at = rect.min + egui::vec2(at.x as f32, at.y as f32);
    for pressed in [true, false] {
        harness.event(egui::Event::PointerMoved(at));
        let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
        harness.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
        harness.run_steps(1);
    }
    harness.run_steps(2);
}

/// Position of a picked thing.
fn place(harness: &Window, picked: Picked) -> DVec3 {
    let view = harness.view();
    picked.place(&view.model, &view.frame).unwrap()
}

#[test]
fn a_click_on_a_rope_shows_its_tension_and_place_until_it_is_closed() {
    let folder = Folder::new("read-rope");
    let mut harness = settled(&folder);
    let wanted = Picked::Rope { line: 0, at_m: 9.0 };
    let there = place(&harness, wanted);
    click(&mut harness, 0, there);
    let view = harness.view();
    let Some(Picked::Rope { line, at_m }) = harness.state().panels.view.picks.read else {
        panic!("no rope is picked")
    };
    assert!(line == 0 && (at_m - 9.0).abs() < 1.0, "line {line} at {at_m} m");
    let reading = read(&view, Picked::Rope { line, at_m }, Units::Si).unwrap();
    let (segment, _) =
        endline_workbench::scene::pick::on_line(&view.model, &view.frame, line, at_m).unwrap();
    assert!(
        harness.query_by_label(&view.model.spec.lines[line].id).is_some(),
        "its name is on screen"
    );
    let tension = Units::Si.force().text(view.frame.tension_n[segment]);
    assert!(reading.rows.contains(&("Tension here", tension)), "{reading:?}");
    harness.get_by_label("×").click();
    harness.run_steps(3);
    assert_eq!(harness.state().panels.view.picks.read, None);
}

#[test]
fn a_click_on_a_body_or_on_skin_shows_its_reading() {
    let folder = Folder::new("read-body");
    let mut harness = settled(&folder);
    let bodies = harness.view().model.spec.bodies.len();
    for index in 0..bodies {
        let there = place(&harness, Picked::Body(index));
        click(&mut harness, 0, there);
        assert_eq!(harness.state().panels.view.picks.read, Some(Picked::Body(index)));
    }
    give(&mut harness, ViewAction::Look(View::WhaleSide));
    harness.run_steps(3);
    let middle = harness.view().frame.whale.as_ref().unwrap().position;
    click(&mut harness, 0, middle);
    assert!(
        matches!(harness.state().panels.view.picks.read, Some(Picked::Skin { .. })),
        "{:?}",
        harness.state().panels.view.picks
    );
    assert!(harness.query_by_label("Body").is_some(), "the part's name is on screen");
    assert!(harness.query_by_label("Greatest pressure").is_some());
}

#[test]
fn the_ruler_measures_straight_and_along_the_rope() {
    let folder = Folder::new("ruler");
    let mut harness = settled(&folder);
    harness.get_by_label("Ruler").click();
    harness.run_steps(3);
    let ends = [Picked::Rope { line: 0, at_m: 2.0 }, Picked::Rope { line: 0, at_m: 8.0 }];
    for end in ends {
        let there = place(&harness, end);
        click(&mut harness, 0, there);
    }
    let view = harness.view();
    let picked = harness.state().panels.view.picks.ends.clone();
    assert_eq!(picked.len(), 2, "two clicks, two ends");
    let along = along_m(&view, picked[0], picked[1]).unwrap();
    let straight = (place(&harness, picked[0]) - place(&harness, picked[1])).length();
    assert!((along - 6.0).abs() < 1.0, "{along} m of rope between 2 m and 8 m");
    // The stretch is far below 0.1 %.
    assert!(straight <= along * 1.001 && straight > 3.0, "{straight} m straight, {along} m along");
    assert!(
        measured(&view, &picked, Units::Si)
            .unwrap()
            .rows
            .contains(&("Along the rope", Units::Si.length(along)))
    );
    let through = along_m(&view, Picked::Body(0), Picked::Body(1)).unwrap();
    let rope_m: f64 = view.frame.segment_length_m.iter().sum();
    assert!(
        (through - rope_m).abs() < 1e-9,
        "the path from trap to buoy is the whole endline: {through} m of {rope_m} m"
    );
}

#[test]
fn four_panes_have_different_views_and_only_the_active_one_changes() {
    let folder = Folder::new("four");
    let mut harness = settled(&folder);
    give(&mut harness, ViewAction::Split(4));
    harness.run_steps(3);
    let named: Vec<View> = harness.state().panels.view.eyes.iter().map(|eye| eye.named).collect();
    assert_eq!(named, [View::Orbit, View::Side, View::Top, View::Front]);
    let rects: Vec<egui::Rect> =
        (1..=4).map(|pane| harness.get_by_label(&format!("Pane {pane}")).rect()).collect();
    for (index, rect) in rects.iter().enumerate() {
        assert!(
            rects[..index].iter().all(|other| !rect.intersect(*other).is_positive()),
            "panes do not overlap: {rects:?}"
        );
    }
    // Side, top and front look north, down and west: perpendicular lines of sight.
    let ahead: Vec<DVec3> =
        harness.state().panels.view.eyes.iter().map(|eye| eye.camera.axes().2).collect();
    for (one, other) in [(1, 2), (1, 3), (2, 3)] {
        assert!(ahead[one].dot(ahead[other]).abs() < 0.01, "{one} and {other}: {ahead:?}");
    }
    let there = place(&harness, Picked::Body(0));
    click(&mut harness, 2, there);
    assert_eq!(harness.state().panels.view.chosen, 2);
    assert_eq!(
        harness.state().panels.view.picks.read,
        Some(Picked::Body(0)),
        "the body is picked from above too"
    );
    give(&mut harness, ViewAction::Look(View::FirstPerson));
    harness.run_steps(2);
    let named: Vec<View> = harness.state().panels.view.eyes.iter().map(|eye| eye.named).collect();
    assert_eq!(named, [View::Orbit, View::Side, View::FirstPerson, View::Front]);
    give(&mut harness, ViewAction::Split(1));
    harness.run_steps(2);
    assert!(
        harness.query_by_label("Pane 2").is_none() && harness.query_by_label("Pane 1").is_some()
    );
}

#[test]
fn the_palette_offers_a_reading_of_every_line_and_body() {
    let folder = Folder::new("readable");
    let harness = settled(&folder);
    let shared = &harness.state().shared;
    let view = shared.workbench.view().cloned().unwrap();
    let readings: Vec<Picked> = offers(shared)
        .into_iter()
        .filter_map(|offer| match offer.command {
            WindowCommand::View(ViewAction::Inspect(picked)) => Some(picked),
            _ => None,
        })
        .collect();
    assert_eq!(readings.len(), view.model.spec.lines.len() + view.model.spec.bodies.len());
    for picked in readings {
        let reading = read(&view, picked, Units::Noaa).unwrap();
        assert!(reading.rows.iter().all(|(_, value)| !value.contains("NaN")), "{reading:?}");
        if let Picked::Rope { line, .. } = picked {
            let most = view.frame.tension_n[view.model.line_segments[line].clone()]
                .iter()
                .copied()
                .fold(0.0, f64::max);
            assert!(
                reading.rows.contains(&("Tension here", Units::Noaa.force().text(most))),
                "{reading:?}: {most} N"
            );
        }
    }
}

/// Moves the pointer to the position of a place.
fn rest(harness: &mut Window, place: DVec3) {
    let rect = harness.get_by_label("Pane 1").rect();
    let camera = harness.state().panels.view.eyes[0].camera.clone();
    let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
    let at = camera.project(place, size).unwrap();
    harness.event(egui::Event::PointerMoved(rect.min + egui::vec2(at.x as f32, at.y as f32)));
    harness.run_steps(3);
}

#[test]
fn a_reading_is_shown_beside_the_pointer_and_not_in_open_water() {
    let folder = Folder::new("rest");
    let mut harness = settled(&folder);
    let view = harness.view();
    let buoy = view.model.spec.bodies.iter().position(|body| body.role == BodyRole::Buoy).unwrap();
    let id = view.model.spec.bodies[buoy].id.clone();
    let there = place(&harness, Picked::Body(buoy));
    rest(&mut harness, there);
    assert_eq!(harness.state().panels.view.picks.hovered, Some((0, Picked::Body(buoy))));
    assert_eq!(harness.state().panels.view.picks.read, None, "hovering does not pick");
    assert!(harness.query_by_label(&id).is_some(), "its name is on screen");
    assert!(harness.query_by_label("On the whale").is_some());
    assert!(harness.query_by_label("not now").is_some());
    rest(&mut harness, there + DVec3::new(0.0, 0.0, 3.0));
    assert_eq!(harness.state().panels.view.picks.hovered, None);
    assert!(harness.query_by_label(&id).is_none(), "the reading disappears");
}

/// A view at 9 s with the buoy on the whale: 300 N on the left flipper and 100 N on the body, since 2 s, caught since 7 s.
fn with_buoy_on_whale(view: &LiveView, buoy: usize) -> LiveView {
    let contact = |triangle: usize, region: Region, push_n: f64| BodyContact {
        body: buoy,
        triangle,
        region,
        position: DVec3::new(1.0, 2.0, -5.0),
        normal: DVec3::Z,
        depth_m: 0.01,
        normal_force_n: push_n,
        friction_n: DVec3::X * (0.2 * push_n),
        slip_m: DVec3::ZERO,
    };
    let mut frame = (*view.frame).clone();
    frame.time_s = 9.0;
    frame.body_contacts =
        vec![contact(5, Region::LeftFlipperTip, 300.0), contact(9, Region::Body, 100.0)];
    let event = |time_s: f64, kind: EventKind| Event {
        time_s,
        kind,
        subject: view.model.spec.bodies[buoy].id.clone(),
        value: 10.0,
    };
    let events = [event(2.0, EventKind::BodyTouched), event(7.0, EventKind::CaughtBuoy)];
    let mut view = view.clone();
    let whale = &mut view.summary.as_mut().unwrap().bodies[buoy].on_whale;
    whale.peak_whale_push_n = 800.0;
    whale.peak_whale_part = Some(BodyPart::LeftFlipper);
    LiveView { frame: Arc::new(frame), events: events.into(), ..view }
}

#[test]
fn the_reading_of_a_buoy_on_the_whale_has_place_start_and_force() {
    let folder = Folder::new("on-whale");
    let harness = settled(&folder);
    let view = harness.view();
    let buoy = view.model.spec.bodies.iter().position(|body| body.role == BodyRole::Buoy).unwrap();
    let view = with_buoy_on_whale(&view, buoy);
    let has = |picked: Picked, row: &'static str, value: &str| {
        let reading = read(&view, picked, Units::Si).unwrap();
        assert!(reading.rows.contains(&(row, value.to_owned())), "{row}: {value} in {reading:?}");
    };
    let body = Picked::Body(buoy);
    has(body, "Kind", "buoy, Bullet buoy 6 x 14 in");
    has(body, "Size", "0.15 m across, 0.36 m long");
    has(body, "On the whale", "left flipper, body, since 2.00 s");
    has(body, "Push now", "400 N, friction 80.0 N");
    has(body, "Greatest push", "800 N, left flipper");
    has(body, "Caught", "yes, since 7.00 s");
    let place = Picked::BodyOnSkin { body: buoy, triangle: 5 };
    has(place, "Patch", "left flipper tip");
    has(place, "Push here", "300 N");
    has(place, "Friction here", "60.0 N");
    has(place, "Push at all places", "400 N");
    let at = |frame: Frame| LiveView { frame: Arc::new(frame), sought: true, ..view.clone() };
    let early = at(Frame { time_s: 5.0, ..(*view.frame).clone() });
    let reading = read(&early, body, Units::Si).unwrap();
    assert!(reading.rows.contains(&("Caught", "not yet: 3.0 s of 5 s".to_owned())), "{reading:?}");
    assert!(reading.rows.contains(&("Greatest of the run", "800 N, left flipper".to_owned())));
    let free = at(Frame { body_contacts: Vec::new(), ..(*view.frame).clone() });
    let reading = read(&free, place, Units::Si).unwrap();
    assert_eq!(reading.rows, [("On the whale", "not now".to_owned())], "the card remains");
    let names = |view: &LiveView| -> Vec<&str> {
        let reading = read(view, body, Units::Si).unwrap();
        reading.rows.into_iter().map(|(name, _)| name).collect()
    };
    assert_eq!(names(&free), names(&early), "the rows remain while the buoy is off the skin");
}

#[test]
fn a_saved_picture_shows_the_rope_at_the_position_of_the_pane() {
    let folder = Folder::new("view-picture");
    let mut harness = settled(&folder);
    let file = folder.0.join("view.png");
    give(&mut harness, ViewAction::SavePicture(file.clone()));
    let notice = harness.notice();
    assert!(notice.text.starts_with("saved "), "{}", notice.text);
    let decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(file).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let size = DVec2::new(1920.0, 1080.0);
    assert_eq!((info.width, info.height), (1920, 1080));
    let view = harness.view();
    let camera = harness.state().panels.view.eyes[0].camera.clone();
    let middle = view.frame.nodes[view.frame.nodes.len() / 2];
    let at = camera.project(middle, size).unwrap();
    let pixel = |x: f64, y: f64| {
        let first = 3 * (y as usize * 1920 + x as usize);
        [bytes[first], bytes[first + 1], bytes[first + 2]].map(i32::from)
    };
    // Rope is yellow to grey, water blue.
    let near = (-2..=2).map(|aside| pixel(at.x + f64::from(aside), at.y));
    let warmest = near.map(|[red, _, blue]| red - blue).max().unwrap();
    let [red, _, blue] = pixel(at.x + 60.0, at.y);
    assert!(warmest > 0 && red < blue, "rope {warmest}, water {red} {blue}");
}

#[test]
fn a_film_is_made_in_the_background_from_stored_frames_and_can_be_cancelled() {
    let folder = Folder::new("view-film");
    let mut harness = flown(&folder);
    alone(&mut harness);
    set_keys(&mut harness);
    let file = folder.0.join("run.gif");
    give(&mut harness, ViewAction::SaveFilm(file.clone()));
    assert!(harness.state().shared.film.is_some(), "the film is made in the background");
    let steps = harness.view().frame.step;
    wait(&mut harness, |app| app.shared.film.is_none());
    let notice = harness.notice();
    assert_eq!(notice.text, format!("saved {}", file.display()));
    assert_eq!(harness.view().frame.step, steps);

    let mut decoder = gif::DecodeOptions::new();
    decoder.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = decoder.read_info(std::fs::File::open(&file).unwrap()).unwrap();
    let mut pictures = Vec::new();
    while let Some(picture) = decoder.read_next_frame().unwrap() {
        pictures.push(picture.buffer.to_vec());
    }
    // Two seconds at 20 pictures per second. The camera moves from side to top, so the first and last pictures differ more than any
    // two neighbours.
    assert_eq!((decoder.width(), decoder.height()), (1280, 720));
    assert!((40..=41).contains(&pictures.len()), "{}", pictures.len());
    let differ = |one: &[u8], other: &[u8]| -> f64 {
        let sum: u64 = one.iter().zip(other).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
        sum as f64 / one.len() as f64
    };
    let whole = differ(&pictures[0], &pictures[pictures.len() - 1]);
    let most = pictures.windows(2).map(|two| differ(&two[0], &two[1])).fold(0.0, f64::max);
    assert!(whole > 5.0 && most < 0.6 * whole, "{whole} {most}");

    let cut = folder.0.join("cut.gif");
    give(&mut harness, ViewAction::SaveFilm(cut.clone()));
    give(&mut harness, ViewAction::CancelFilm);
    wait(&mut harness, |app| app.shared.film.is_none());
    let notice = harness.notice();
    assert!(notice.text.contains(" of "), "{}", notice.text);

    give(&mut harness, ViewAction::SaveFilm(folder.0.join("no-such-folder/run.gif")));
    assert!(harness.state().shared.film.is_none());
    let notice = harness.notice();
    assert!(notice.text.contains("no-such-folder"), "{}", notice.text);
}

/// Shows only the 3-D view.
fn alone(harness: &mut Window) {
    only(harness, PanelId::View);
}

/// Sets a camera key at the side view at 0 s, and one at the top view at 2 s.
fn set_keys(harness: &mut Window) {
    for (time_s, from) in [(0.0, View::Side), (2.0, View::Top)] {
        harness.perform(TimeAction::Seek(time_s));
        wait(harness, |app| {
            let view = app.shared.workbench.view().unwrap();
            (view.frame.time_s - time_s).abs() < 0.1
        });
        give(harness, ViewAction::Look(from));
        harness.run_steps(2);
        harness.key_press(egui::Key::I);
        harness.run_steps(2);
    }
}

#[test]
fn the_camera_of_a_film_moves_from_key_to_key() {
    let folder = Folder::new("view-keys");
    let mut harness = flown(&folder);
    alone(&mut harness);
    give(&mut harness, ViewAction::ClearKeys);
    let notice = harness.notice();
    assert_eq!(notice.text, "the camera has no keys");
    set_keys(&mut harness);
    harness.get_by_label("Camera ⏷").click();
    harness.run_steps(2);
    harness.get_by_label("Keys set: 2");
    harness.key_press(egui::Key::Escape);
    harness.run_steps(2);
    let app = harness.state();
    let view = app.shared.workbench.view().unwrap();
    let seen = |time_s: f64| {
        let placed = |eye: &Eye| eye.at_moment(&view.model, &view.frame, 16.0 / 9.0);
        app.panels.view.path.camera(time_s, placed).unwrap()
    };
    // From the south to vertical; in between at half time.
    let up = |time_s: f64| {
        let camera = seen(time_s);
        (camera.eye() - camera.target).normalize().z
    };
    assert!(
        up(0.0).abs() < 0.1 && up(5.0) > 0.99 && (0.6..0.8).contains(&up(1.0)),
        "{} {} {}",
        up(0.0),
        up(1.0),
        up(5.0)
    );

    give(&mut harness, ViewAction::ClearKeys);
    harness.run_steps(2);
    harness.get_by_label("Camera ⏷");
}

#[test]
fn full_screen_shows_only_the_view_and_escape_restores_panels_and_scale() {
    let folder = Folder::new("view-presented");
    let mut harness = settled(&folder);
    harness.get_by_label("Ruler");
    let size = harness.ctx.zoom_factor();
    harness.key_press(egui::Key::F11);
    harness.run_steps(3);
    assert!(
        harness.query_by_label("Ruler").is_none() && harness.query_by_label("Window").is_none()
    );
    assert!(harness.ctx.zoom_factor() > 1.4 * size);
    // The stored preference remains the normal scale.
    assert!((harness.state().shared.preferences.scale.0 - size).abs() < 1e-6);
    harness.get_by_label("▶ Play");
    harness.key_press(egui::Key::Escape);
    harness.run_steps(3);
    harness.get_by_label("Ruler");
    assert!((harness.ctx.zoom_factor() - size).abs() < 1e-6);
}
