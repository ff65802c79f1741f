//! Tide, waves and slope of scenarios: reading, diagnostics with places, and runs with shipped gear.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use crate::linked::{Linked, library, report, scenario_text, spec_of};
use endline_gear::{Options, Scenario, assemble};
use endline_sim::water::current::{Profile, Tide};
use endline_sim::water::waves::WaveKind;
use endline_sim::{DVec3, Input, Model, ModelSpec, State, Workspace, settle, step};

fn assembled(text: &str) -> ModelSpec {
    spec_of("test.toml", text)
}

/// The single in Cape Cod Bay with these lines in `[site]` and these tables after it.
fn single(site: &str, tables: &str) -> String {
    format!(
        "format = 1\nkind = \"scenario\"\nname = \"Test\"\nduration = \"10 s\"\nrope_nodes = 60\n[site]\nitem = \"cape-cod-bay\"\n{site}\n\
         {tables}\n[[gear]]\nassembly = \"single\"\n"
    )
}

fn run(model: &Model, state: &mut State, until_s: f64, mut see: impl FnMut(&State)) {
    let mut workspace = Workspace::new(model);
    while state.time_s < until_s - 1e-9 {
        step(model, &Input::default(), state, &mut workspace)
            .unwrap_or_else(|stop| panic!("{stop:?}"));
        see(state);
    }
}

#[test]
fn a_current_in_rows_turns_with_height_and_the_tide_turns_all_of_it() {
    let rows = "[[current.profile]]\ndepth = \"0 m\"\nspeed = \"0.5 m/s\"\ntoward = \"90 deg\"\n\
                [[current.profile]]\nheight = \"5 m\"\nspeed = \"0.25 m/s\"\ntoward = \"0 deg\"\n\
                [current.tide]\nperiod = \"12.42 h\"\nslack = \"0 s\"\nresidual = \"0.1 m/s\"\nresidual_toward = \"180 deg\"\n";
    let water = assembled(&single("", rows)).water;
    let Profile::Table(table) = &water.current.profile else {
        panic!("{:?}", water.current.profile)
    };
    assert!((table[0].height - 0.2).abs() < 1e-12 && (table[1].height - 1.0).abs() < 1e-12);
    // At slack water the residual is left; a quarter of a period later the fastest row runs as written.
    assert!((water.current.at(1.0, 0.0) - DVec3::new(0.0, -0.1, 0.0)).length() < 1e-12);
    let quarter = 0.25 * 12.42 * 3600.0;
    assert!((water.current.at(1.0, quarter) - DVec3::new(0.5, -0.1, 0.0)).length() < 1e-12);
    // Without the residual the lower row runs to the north: half as fast, a right angle to the left.
    let steady = assembled(&single("", rows.split("[current.tide]").next().unwrap())).water.current;
    assert!((steady.at(0.1, 0.0) - DVec3::new(0.0, 0.25, 0.0)).length() < 1e-12);
    assert!((steady.at(0.6, 0.0) - DVec3::new(0.25, 0.125, 0.0)).length() < 1e-12);
}

#[test]
fn a_tide_in_rows_and_the_seabed_of_a_scenario_are_read() {
    let at = |time: &str, speed: &str, toward: &str| {
        format!("[[current.at]]\ntime = \"{time}\"\nspeed = \"{speed}\"\ntoward = \"{toward}\"\n")
    };
    let rows = at("0 s", "0.4 m/s", "90 deg")
        + &at("1 h", "0 m/s", "90 deg")
        + &at("2 h", "0.4 m/s", "270 deg");
    let bed = "slope = \"5 deg\"\nslope_toward = \"90 deg\"\nrope_friction = 0.8\nrope_stiffness = \"9 kN/m2\"\nfoot_stiffness = \"30 kN/m\"";
    let spec = assembled(&single(bed, &rows));
    assert!(matches!(&spec.water.current.tide, Tide::Table(rows) if rows.len() == 3));
    assert!((spec.water.current.at(1.0, 5400.0) - DVec3::new(-0.2, 0.0, 0.0)).length() < 1e-12);
    let seabed = spec.seabed.unwrap();
    assert!(
        (seabed.height_at(DVec3::X * 100.0) + 25.0 + 100.0 * 5_f64.to_radians().tan()).abs() < 1e-9
    );
    assert_eq!(
        (seabed.rope_friction, seabed.rope_stiffness_n_m2, seabed.foot_stiffness_n_m),
        (0.8, 9e3, 3e4)
    );
    let waves = assembled(&scenario_text("waves-buoy.toml")).water.waves.unwrap();
    assert!(
        matches!(waves.kind, WaveKind::Jonswap { spectrum, components: 64 } if (spectrum.significant_height_m - 1.2).abs() < 1e-12)
    );
    assert!((waves.toward + DVec3::X).length() < 1e-12 && (waves.ramp_s - 10.0).abs() < 1e-12);
}

/// A logarithmic current runs at its speed where the scenario says so, by `ln(1 + z/z0)`; the site's holds where it says nothing.
#[test]
fn a_logarithmic_current_has_its_speed_at_its_height() {
    let water = assembled(&single(
        "",
        "[current]\nspeed = \"0.3 m/s\"\nspeed_height = \"1.5 m\"\nroughness = \"3 mm\"\n",
    ))
    .water;
    let at = |height: f64| water.current.at(height / 25.0, 0.0).x;
    assert!((at(1.5) - 0.3).abs() < 1e-12);
    for height in [0.001, 0.1, 5.0, 25.0] {
        assert!(
            (at(height) - 0.3 * (1.0 + height / 3e-3_f64).ln() / 501_f64.ln()).abs() < 1e-12,
            "{height} m"
        );
    }
    let water =
        assembled(&single("item = \"jonesport\"", "").replace("item = \"cape-cod-bay\"\n", ""))
            .water;
    assert!(
        (water.current.at(1.5 / 30.0, 0.0).x - 0.3).abs() < 1e-12
            && water.current.at(1.0, 0.0).x > 0.4
    );
    // A speed or a law of the scenario goes over the site's.
    let slow = single("item = \"jonesport\"", "[current]\nspeed = \"0.2 m/s\"\nexponent = 0\n")
        .replace("item = \"cape-cod-bay\"\n", "");
    assert!((assembled(&slow).water.current.at(0.01, 0.0).x - 0.2).abs() < 1e-12);
}

/// Mistakes: lines of `[site]`, tables after it, how the line at fault begins, and what the message says.
const MISTAKES: [(&str, &str, &str, [&str; 2]); 19] = [
    ("slope = \"80 deg\"", "", "slope", ["`slope` is 1.39", "between 0 rad and 1 rad"]),
    (
        "",
        "[current]\nspeed = \"1 m/s\"\n[[current.at]]\ntime = \"0 s\"\nspeed = \"1 m/s\"",
        "speed",
        ["beside a tide in rows", "remove this"],
    ),
    (
        "",
        "[current]\nexponent = 0.1\n[[current.profile]]\nheight = \"0 m\"\nspeed = \"1 m/s\"",
        "exponent",
        ["beside a profile in rows", "remove this"],
    ),
    (
        "",
        "[current]\nexponent = 0.1\nroughness = \"3 mm\"",
        "roughness",
        ["both `exponent` and `roughness`", "keep"],
    ),
    ("", "[current]\nroughness = \"3 m\"", "roughness", ["`roughness` is 3 m", "1 m"]),
    ("", "[current]\nspeed_height = \"2 m\"", "speed_height", ["without a `speed`", "remove this"]),
    (
        "",
        "[current]\nspeed = \"1 m/s\"\nspeed_height = \"26 m\"",
        "speed_height",
        ["outside the water", "25 m deep"],
    ),
    (
        "",
        "[current]\nroughness = \"3 mm\"\n[[current.profile]]\nheight = \"0 m\"\nspeed = \"1 m/s\"",
        "roughness",
        ["beside a profile", "remove"],
    ),
    (
        "",
        "[[current.profile]]\nspeed = \"1 m/s\"",
        "[[current.profile]]",
        ["`height` is missing", "above the seabed"],
    ),
    (
        "",
        "[[current.profile]]\nheight = \"1 m\"\ndepth = \"1 m\"\nspeed = \"1 m/s\"",
        "depth",
        ["both `height` and `depth`", "keep"],
    ),
    (
        "",
        "[[current.profile]]\nheight = \"26 m\"\nspeed = \"1 m/s\"",
        "height",
        ["outside the water", "25 m deep"],
    ),
    (
        "",
        "[current.tide]\npeak = \"0 s\"",
        "[current.tide]",
        ["`period` is missing", "expected a time"],
    ),
    (
        "",
        "[current.tide]\nperiod = \"12 h\"\npeak = \"0 s\"\nslack = \"0 s\"",
        "slack",
        ["both `peak` and `slack`", "keep"],
    ),
    (
        "",
        "[[current.at]]\ntime = \"9 s\"\nspeed = \"1 m/s\"\n[[current.at]]\ntime = \"8 s\"\nspeed = \"1 m/s\"",
        "time = \"8 s\"",
        ["rising order", "order of time"],
    ),
    ("", "[waves]\nheight = \"1 m\"", "[waves]", ["`period` is missing", "expected a time"]),
    (
        "",
        "[waves]\nheight = \"8 m\"\nperiod = \"5 s\"",
        "height",
        ["waves of 8 m and 5 s break", "at most"],
    ),
    (
        "",
        "[waves]\nheight = \"1 m\"\nperiod = \"5 s\"\ngamma = 2.0",
        "gamma",
        ["figure of a spectrum", "spectrum = \"jonswap\""],
    ),
    (
        "",
        "[waves]\nspectrum = \"jonswop\"\nheight = \"1 m\"\nperiod = \"5 s\"",
        "spectrum",
        ["not a value of `spectrum`", "did you mean `jonswap`?"],
    ),
    (
        "",
        "[waves]\nspectrum = \"jonswap\"\nheight = \"1 m\"\nperiod = \"5 s\"\ncomponents = 5000",
        "components",
        ["`components` is 5000", "64 is usual"],
    ),
];

/// Each mistake is reported at its line, with how to fix it.
#[test]
fn mistakes_in_the_sea_are_reported_with_their_place() {
    for (site, tables, line, parts) in MISTAKES {
        let whole = single(site, tables);
        let problems = match Scenario::read("test.toml", &whole) {
            Err(problems) => problems,
            Ok(scenario) => assemble(&scenario, &library(), &Linked, &Options::default())
                .err()
                .unwrap_or_default(),
        };
        let message = report(&problems);
        let first = problems.first().unwrap_or_else(|| panic!("this assembles:\n{whole}"));
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
        assert!(whole.lines().nth(first.line - 1).unwrap().starts_with(line), "{message}");
    }
}

/// Heights are shares of the local depth: trap square on the slope at rest, buoy at the surface; nothing slides.
#[test]
fn gear_on_a_slope_of_five_degrees_rests_on_it() {
    let site = "slope = \"5 deg\"\nslope_toward = \"90 deg\"";
    for tables in ["[current]\nspeed = \"0 m/s\"", "[current]\nspeed = \"0.25 m/s\""] {
        let east = single(site, tables).replace(
            "assembly = \"single\"",
            "assembly = \"single\"\nposition = [\"40 m\", \"0 m\"]",
        );
        let model = Model::new(assembled(&east)).unwrap();
        let seabed = model.spec.seabed.clone().unwrap();
        assert!(
            (model.spec.bodies[0].position_m.z + 28.5).abs() < 0.5
                && seabed.height_at(DVec3::X * 40.0) < -28.4
        );
        let settled = settle(&model);
        assert!(settled.converged, "{tables}: {} N", settled.residual_n);
        let feet = |state: &State| {
            let (trap, now) = (&model.spec.bodies[0], &state.bodies[0]);
            let height = |foot: &DVec3| {
                let place = now.position + now.orientation * *foot;
                place.z - seabed.height_at(place)
            };
            trap.feet_m[..4].iter().map(height).collect::<Vec<_>>()
        };
        let before = feet(&settled.state);
        assert!(before.iter().all(|height| height.abs() < 0.02), "{tables}: {before:?}");
        let mut state = settled.state.clone();
        run(&model, &mut state, 10.0, |_| ());
        let moved = (state.bodies[0].position - settled.state.bodies[0].position).length();
        println!("{tables}: feet {before:?} m, moved {moved:.1e} m in 10 s");
        assert!(moved < 1e-3, "{moved}");
    }
}

/// The shipped run, its own way: the buoy streams to the north-east at flood and to the south-west at ebb, as far.
#[test]
fn the_shipped_tide_swings_the_buoy_round() {
    let model = Model::new(assembled(&scenario_text("tide-turns.toml"))).unwrap();
    let buoy = model.spec.bodies.iter().position(|body| body.id == "buoy").unwrap();
    let settled = settle(&model);
    assert!(settled.converged);
    let (flood, mut state, mut highest) =
        (settled.state.bodies[buoy].position, settled.state.clone(), f64::MIN);
    run(&model, &mut state, 600.0, |state| highest = highest.max(state.bodies[buoy].position.z));
    let ebb = state.bodies[buoy].position;
    println!("flood {flood:.2}, ebb {ebb:.2}, highest {highest:.2}");
    assert!(flood.x > 8.0 && (flood.x - flood.y).abs() < 0.1 * flood.x);
    // The trap's line leaves one end of it, so that the swing is about that end.
    assert!((ebb.truncate() + flood.truncate()).length() < 2.0, "{flood} and {ebb}");
}

/// The buoy heaves as the sea's spectrum does: its standard deviation against a quarter of the significant height.
#[test]
fn the_shipped_buoy_rides_its_waves() {
    let model = Model::new(assembled(&scenario_text("waves-buoy.toml"))).unwrap();
    let buoy = model.spec.bodies.iter().position(|body| body.id == "buoy").unwrap();
    let mut state = settle(&model).state;
    let (mut count, mut off, mut heave, mut peak) = (0.0, 0.0, 0.0, 0.0_f64);
    run(&model, &mut state, 60.0, |state| {
        if state.time_s > 20.0 {
            let place = state.bodies[buoy].position;
            let surface = model.sea.at(place, state.time_s).surface_m;
            count += 1.0;
            off += (place.z - surface) * (place.z - surface);
            heave += surface * surface;
            peak = state.rope.tension.iter().fold(peak, |peak, tension| peak.max(*tension));
        }
    });
    let (off, heave): (f64, f64) = ((off / count).sqrt(), (heave / count).sqrt());
    println!(
        "surface over the buoy {heave:.3} m rms, buoy off it {off:.3} m rms, greatest tension {peak:.0} N"
    );
    assert!((0.15..0.5).contains(&heave) && off < 0.5 * heave);
}
