//! Rigs at rest: every shipped assembly in every current, and rigs drawn at random from the library.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

mod balance;
mod linked;

use endline_gear::{Library, Options, Scenario, Sources, assemble};
use linked::{Linked, library, root, told};

use endline_sim::model::{BodyRole, Shape};
use endline_sim::statics::Settled;
use endline_sim::{Model, Outcome, settle};

/// Greatest vertical force out of balance on a body, by the figures of the model [N].
const BALANCED_N: f64 = 0.1;
/// Rigs drawn at random where the environment's `ENDLINE_RIGS` does not say how many.
const DRAWN: u64 = 300;
/// Share of them for which statics may find neither rest nor that they drag: 2 of 300, 23 of 2,000 as measured.
const UNKNOWN_SHARE: f64 = 0.015;
/// First of their seeds.
const FIRST_SEED: u64 = 1;

/// An assembly placed in a sea, `heading` degrees from the current's direction.
struct Sea<'a> {
    site: &'a str,
    speed: f64,
    heading: f64,
    nodes: u64,
}

fn placed(library: &Library, assembly: &str, sea: &Sea<'_>) -> Model {
    let Sea { site, speed, heading, nodes } = sea;
    let text = format!(
        "format = 1\nkind = \"scenario\"\nname = \"Rig\"\nduration = \"1 s\"\nrope_nodes = {nodes}\n[site]\n{site}\n\
         [current]\nspeed = \"{speed} m/s\"\ntoward = \"90 deg\"\nexponent = 0.142857\n\
         [[gear]]\nassembly = \"{assembly}\"\nheading = \"{} deg\"\n",
        90.0 + heading
    );
    let scenario = Scenario::read("rig.toml", &text).unwrap_or_else(|problems| panic!("{}", told(&problems)));
    let spec = assemble(&scenario, library, &Linked, &Options::default()).unwrap_or_else(|problems| panic!("{}", told(&problems)));
    Model::new(spec).unwrap()
}

fn read(sources: &Sources) -> Library {
    let (library, problems) = Library::read(sources);
    assert!(problems.is_empty(), "{}", told(&problems));
    library
}

/// What is wrong with a rig that should be at rest; empty where nothing is.
fn faults(model: &Model, settled: &Settled) -> Vec<String> {
    let mut faults = Vec::new();
    let rope = &settled.state.rope;
    if !rope.tension.iter().all(|tension| tension.is_finite()) || !rope.position.iter().all(|place| place.is_finite()) {
        return vec!["not finite".into()];
    }
    for (index, (body, state)) in model.spec.bodies.iter().zip(&settled.state.bodies).enumerate() {
        let foot = body.feet_m.iter().map(|foot| (state.position + state.orientation * *foot).z).fold(f64::INFINITY, f64::min);
        let ground = -model.spec.water.depth_m;
        let radius = match body.shape {
            Shape::Sphere(radius_m) => radius_m,
            Shape::Capsule { half_length_m, .. } => half_length_m,
            Shape::Box(half) => half.z,
        };
        match body.role {
            BodyRole::Buoy if state.position.z >= radius => faults.push(format!("{} flies: {} m", body.id, state.position.z)),
            BodyRole::Trap if (foot - ground).abs() > 0.05 => faults.push(format!("{} is {} m off the seabed", body.id, foot - ground)),
            _ => {}
        }
        let out_n = balance::vertical(model, &settled.state, index);
        if out_n.abs() > BALANCED_N {
            faults.push(format!("{} is {out_n} N out of vertical balance", body.id));
        }
    }
    faults
}

/// The depth an assembly is made for [m], as its notes say; 25 m where they say nothing.
fn made_for(assembly: &str) -> f64 {
    match assembly {
        "pair" => 40.0,
        "trawl-10" | "gillnet-string" | "on-demand-trawl" => 60.0,
        "trawl-20" | "snow-crab-single" => 100.0,
        "trawl-45" => 200.0,
        _ => 25.0,
    }
}

/// Gear for which statics finds neither rest nor that it drags: a string of netting and a long trawl across full tide, a
/// short trawl against it, and stowed rope that nothing holds on the seabed.
fn is_open(assembly: &str, speed: f64, heading: f64) -> bool {
    let across = heading > 1.0 && heading < 179.0;
    speed > 0.3
        && match assembly {
            "on-demand-trawl" => true,
            "gillnet-string" | "trawl-20" => across,
            "trawl-5" => heading > 179.0,
            _ => false,
        }
}

/// At slack, half and full tide, along, across and against the current; at slack tide everything comes to rest.
#[test]
fn every_shipped_assembly_settles_in_every_current() {
    let library = library();
    let mut wrong = Vec::new();
    for assembly in library.assemblies.iter().map(|assembly| assembly.entry.id.as_str()) {
        for (speed, heading) in [0.0, 0.25, 0.5].into_iter().flat_map(|speed| [0.0, 90.0, 180.0].map(|heading| (speed, heading))) {
            if is_open(assembly, speed, heading) {
                continue;
            }
            let site = format!("item = \"cape-cod-bay\"\ndepth = \"{} m\"", made_for(assembly));
            let model = placed(&library, assembly, &Sea { site: &site, speed, heading, nodes: 500 });
            let settled = settle(&model);
            let what = format!("{assembly} at {speed} m/s and {heading} deg: {}, {:.1e} N", settled.why(), settled.residual_n);
            println!("{what}, {} passes", settled.trace_n.len());
            match settled.outcome {
                Outcome::AtRest => wrong.extend(faults(&model, &settled).into_iter().map(|fault| format!("{what}: {fault}"))),
                Outcome::Drags(_) if speed > 0.0 => {}
                _ => wrong.push(what),
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Numbers drawn from a seed (SplitMix64).
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn of<'a>(&mut self, ids: &[&'a str]) -> &'a str {
        ids[(self.unit() * ids.len() as f64) as usize]
    }
}

/// One to three traps on groundline, an endline of two ropes, a buoy; the text of an assembly file.
fn drawn_assembly(draw: &mut Draw, library: &Library, depth_m: f64) -> String {
    let (ropes, traps, buoys) =
        (library.ids(endline_gear::Kind::Rope), library.ids(endline_gear::Kind::Trap), library.ids(endline_gear::Kind::Buoy));
    let length = draw.between(1.05, 2.0) * depth_m;
    let share = draw.between(0.1, 0.9);
    let reach = 0.9 * (length * length - depth_m * depth_m).sqrt();
    let mut text = format!(
        "format = 1\nkind = \"assembly\"\nname = \"Drawn\"\n\
         [[body]]\nid = \"buoy\"\nkind = \"buoy\"\nitem = \"{}\"\nposition = [\"{reach} m\", \"0 m\"]\nheight = 1\n\
         [[joint]]\nid = \"splice\"\nposition = [\"{} m\", \"0 m\"]\nheight = {share}\n\
         [[line]]\nid = \"bottom\"\nrope = \"{}\"\nfrom = \"trap-0\"\nto = \"splice\"\nlength = \"{} m\"\n\
         [[line]]\nid = \"top\"\nrope = \"{}\"\nfrom = \"splice\"\nto = \"buoy\"\nlength = \"{} m\"\n",
        draw.of(&buoys),
        share * reach,
        draw.of(&ropes),
        share * length,
        draw.of(&ropes),
        (1.0 - share) * length,
    );
    let (spacing, slack) = (draw.between(10.0, 40.0), draw.between(1.0, 1.05));
    for trap in 0..1 + (draw.unit() * 3.0) as usize {
        let item = draw.of(&traps);
        let x = -(trap as f64) * spacing;
        text +=
            &format!("[[body]]\nid = \"trap-{trap}\"\nkind = \"trap\"\nitem = \"{item}\"\nposition = [\"{x} m\", \"0 m\"]\nheight = 0\n");
        if trap > 0 {
            let (rope, length, before) = (draw.of(&ropes), spacing * slack, trap - 1);
            text += &format!(
                "[[line]]\nid = \"ground-{trap}\"\nrope = \"{rope}\"\nfrom = \"trap-{before}\"\nto = \"trap-{trap}\"\nlength = \"{length} m\"\n"
            );
        }
    }
    text
}

/// The rig of a seed, and what it is; its current is no stronger than the first trap surely withstands.
fn drawn(seed: u64, sources: &mut Sources) -> (Model, String) {
    let mut draw = Draw(seed);
    let library = read(sources);
    let (depth, speed, heading) = (draw.between(10.0, 150.0), draw.unit(), draw.between(0.0, 360.0));
    let nodes = draw.between(40.0, 200.0) as u64;
    sources.set("assemblies/drawn.toml", drawn_assembly(&mut draw, &library, depth));
    let site = format!("depth = \"{depth} m\"\ndensity = \"1025 kg/m3\"");
    let library = read(sources);
    let at = |speed| placed(&library, "drawn", &Sea { site: &site, speed, heading, nodes });
    let share = drag_share(&at(speed));
    // Every fourth may drag.
    let speed = if share > SURE_HOLD && !seed.is_multiple_of(4) { speed * (SURE_HOLD / share).sqrt() } else { speed };
    let model = hard(seed, at(speed));
    let lines: Vec<String> = model.spec.lines.iter().map(|line| model.spec.ropes[line.rope].id.clone()).collect();
    (model, format!("seed {seed}: {depth:.0} m, {speed:.2} m/s, {heading:.0} deg, {nodes} nodes, {}", lines.join(", ")))
}

/// Every tenth rig has rope a thousand times as stiff, every tenth a trap ten thousand times as heavy as the lightest node.
fn hard(seed: u64, model: Model) -> Model {
    let mut spec = model.spec;
    match seed % 10 {
        3 => spec.ropes.iter_mut().for_each(|rope| rope.axial_stiffness_n *= 1e3),
        7 => {
            let node_kg = |line: &endline_sim::model::Line| 0.5 * spec.ropes[line.rope].mass_kg_m * line.segments_m[0];
            let lightest_kg = spec.lines.iter().map(node_kg).fold(f64::INFINITY, f64::min);
            let trap = spec.bodies.iter_mut().find(|body| body.id == "trap-0").unwrap();
            trap.mass_kg = trap.mass_kg.max(1e4 * lightest_kg);
        }
        _ => {}
    }
    Model::new(spec).unwrap()
}

/// Share of the first trap's weight in water below which the drag of endline and buoy surely leaves it where it
/// stands. That drag is counted broadside and at the speed of the surface, about twice what it is; the trap's
/// friction of 0.6 or more, less what the line lifts, holds a third of its weight.
const SURE_HOLD: f64 = 0.6;

/// Greatest drag of endline and buoy as a share of the first trap's weight in water.
fn drag_share(model: &Model) -> f64 {
    let (spec, water) = (&model.spec, &model.spec.water);
    let body = |id: &str| spec.bodies.iter().find(|body| body.id == id).unwrap();
    let trap = body("trap-0");
    let displaced: f64 = trap.floats.iter().map(|float| float.volume_m3).sum();
    let weight = (trap.mass_kg - water.density_kg_m3 * displaced) * water.gravity_m_s2;
    let endline = spec.lines.iter().filter(|line| !line.id.starts_with("ground"));
    let areas = endline.map(|line| (&spec.ropes[line.rope], line.segments_m.iter().sum::<f64>()));
    let rope: f64 = areas.map(|(rope, length)| rope.drag_normal * rope.diameter_m * length).sum();
    let area = rope + body("buoy").whole_drag_area_m2().max_element();
    0.5 * water.density_kg_m3 * area * water.current.surface_m_s.length_squared() / weight
}

/// Few may be left without an answer, none may leave numbers that are not finite; what comes to rest is in balance.
///
/// `ENDLINE_RIGS=10000 cargo test --release -p endline-tests --test rigs random -- --nocapture` is the full run.
#[test]
fn rigs_drawn_at_random_settle_or_say_why() {
    let mut sources = Sources::from_folder(&root()).unwrap();
    let count = std::env::var("ENDLINE_RIGS").map_or(DRAWN, |count| count.parse().unwrap());
    let (mut unknown, mut dragging, mut passes) = (Vec::new(), 0, 0);
    for seed in FIRST_SEED..FIRST_SEED + count {
        let (model, what) = drawn(seed, &mut sources);
        let settled = settle(&model);
        let rope = &settled.state.rope;
        assert!(rope.position.iter().all(|place| place.is_finite()) && rope.tension.iter().all(|pull| pull.is_finite()), "{what}");
        passes += settled.trace_n.len();
        match settled.outcome {
            Outcome::AtRest => {
                let bodies = 0..model.spec.bodies.len();
                let out_n = bodies.map(|body| balance::vertical(&model, &settled.state, body).abs()).fold(0.0, f64::max);
                assert!(out_n < BALANCED_N, "{what}: {out_n} N out of vertical balance");
            }
            Outcome::Drags(_) => {
                println!("{what}: {}", settled.why());
                dragging += 1;
            }
            Outcome::NotFound => unknown.push(format!("{what}: {} after {} passes", settled.why(), settled.trace_n.len())),
        }
    }
    let found = format!("{dragging} of {count} drag, {} are without an answer, {} passes each", unknown.len(), passes as u64 / count);
    println!("{found}\n{}", unknown.join("\n"));
    assert!(unknown.len() as f64 <= UNKNOWN_SHARE * count as f64, "{found}:\n{}", unknown.join("\n"));
}
