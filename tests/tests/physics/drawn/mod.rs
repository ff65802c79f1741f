//! Rigs drawn at random from the library, each from its seed: ropes, traps, anchors, buoys, weak links, bridles, the laws
//! of stretch, depth, current, seabed, resolution.

use endline_gear::{Kind, Library, Options, Rope, Scenario, Sources, assemble};
use endline_sim::Model;

use crate::linked::{Linked, report};

/// Where an assembly is placed: the rest of its `[site]`, the current [m/s], the assembly's bearing off it [deg].
pub struct Sea<'a> {
    pub site: &'a str,
    pub speed: f64,
    pub heading: f64,
    pub nodes: u64,
}

/// The model of an assembly placed in a sea.
pub fn placed(library: &Library, assembly: &str, sea: &Sea<'_>) -> Model {
    let Sea { site, speed, heading, nodes } = sea;
    let text = format!(
        "format = 1\nkind = \"scenario\"\nname = \"Rig\"\nduration = \"1 s\"\nrope_nodes = {nodes}\n[site]\n{site}\n\
         [current]\nspeed = \"{speed} m/s\"\ntoward = \"90 deg\"\nexponent = 0.142857\n\
         [[gear]]\nassembly = \"{assembly}\"\nheading = \"{} deg\"\n",
        90.0 + heading
    );
    let scenario = Scenario::read("rig.toml", &text)
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    let spec = assemble(&scenario, library, &Linked, &Options::default())
        .unwrap_or_else(|problems| panic!("{}", report(&problems)));
    Model::new(spec).unwrap()
}

/// A rig of a seed, and what it is, for a message.
pub struct Rig {
    pub model: Model,
    pub what: String,
}

/// The library that rigs are drawn from.
pub struct Drawer {
    library: Library,
}

impl Drawer {
    pub fn new(library: Library) -> Self {
        Self { library }
    }

    /// The rig of a seed; its current is no stronger than the first trap surely withstands, but for every fourth.
    pub fn rig(&mut self, seed: u64) -> Rig {
        let mut draw = Draw(seed);
        let (depth, speed, heading) =
            (draw.between(10.0, 150.0), draw.unit(), draw.between(0.0, 360.0));
        let nodes = draw.between(40.0, 200.0) as u64;
        let parts = Parts { draw: &mut draw, library: &self.library, depth_m: depth };
        let text = parts.text();
        let bed = format!(
            "rope_friction = {}\nfoot_stiffness = \"{} kN/m\"",
            draw.between(0.3, 1.0),
            draw.between(10.0, 40.0)
        );
        self.lay(text);
        let site = format!("depth = \"{depth} m\"\ndensity = \"1025 kg/m3\"\n{bed}");
        let at = |speed| placed(&self.library, DRAWN, &Sea { site: &site, speed, heading, nodes });
        let share = drag_share(&at(speed));
        let speed = if share > SURE_HOLD && !seed.is_multiple_of(4) {
            speed * (SURE_HOLD / share).sqrt()
        } else {
            speed
        };
        let model = hard(seed, at(speed));
        let lines: Vec<String> =
            model.spec.lines.iter().map(|line| model.spec.ropes[line.rope].id.clone()).collect();
        let what = format!(
            "seed {seed}: {depth:.0} m, {speed:.2} m/s, {heading:.0} deg, {nodes} nodes, {}",
            lines.join(", ")
        );
        Rig { model, what }
    }

    /// Puts an assembly into the library, in the place of the last one drawn.
    fn lay(&mut self, text: String) {
        let mut alone = Sources::default();
        alone.set(format!("assemblies/{DRAWN}.toml"), text);
        let (mut alone, problems) = Library::read(&alone);
        assert!(problems.is_empty(), "{}", report(&problems));
        self.library.assemblies.retain(|assembly| assembly.entry.id != DRAWN);
        self.library.assemblies.append(&mut alone.assemblies);
    }
}

/// Id of the assembly drawn last.
const DRAWN: &str = "drawn";

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

/// The parts of a rig, drawn one after the other.
struct Parts<'a> {
    draw: &'a mut Draw,
    library: &'a Library,
    depth_m: f64,
}

impl Parts<'_> {
    /// One to three traps on groundline, some with an anchor behind them, an endline of two ropes, some with a bridle, and a
    /// buoy, some with a weak link; the text of an assembly file.
    fn text(mut self) -> String {
        let length = self.draw.between(1.05, 2.0) * self.depth_m;
        let share = self.draw.between(0.1, 0.9);
        let reach = 0.9 * (length * length - self.depth_m * self.depth_m).sqrt();
        let buoys = self.library.ids(Kind::Buoy);
        let buoy = self.draw.of(&buoys);
        let mut text = String::from("format = 1\nkind = \"assembly\"\nname = \"Drawn\"\n")
            + &body("buoy", "buoy", buoy, reach, 1)
            + &joint("splice", share * reach, share);
        let foot = if self.draw.unit() < 0.25 { self.bridle(&mut text) } else { "trap-0" };
        text += &self.line("bottom", [foot, "splice"], share * length);
        text += &self.line("top", ["splice", "buoy"], (1.0 - share) * length);
        if self.draw.unit() < 0.5 {
            let links = self.library.ids(Kind::WeakLink);
            let link = self.draw.of(&links);
            text += &format!(
                "[[link]]\nid = \"link\"\nitem = \"{link}\"\nline = \"top\"\nend = \"to\"\n"
            );
        }
        text + &self.ground()
    }

    /// Two legs from the corners of the first trap's edge; where they meet.
    fn bridle(&mut self, text: &mut String) -> &'static str {
        let leg = self.draw.between(0.6, 2.0);
        *text += &joint("bridle", 0.0, leg / self.depth_m);
        *text += &self.line("port", ["trap-0:bridle-port", "bridle"], leg);
        *text += &self.line("starboard", ["trap-0:bridle-starboard", "bridle"], leg);
        "bridle"
    }

    /// What lies on the seabed.
    fn ground(&mut self) -> String {
        let (spacing, slack) = (self.draw.between(10.0, 40.0), self.draw.between(1.0, 1.05));
        let (traps, anchors) = (self.library.ids(Kind::Trap), self.library.ids(Kind::Anchor));
        let (count, anchored) = (1 + (self.draw.unit() * 3.0) as usize, self.draw.unit() < 0.3);
        let mut text = String::new();
        for place in 0..count + usize::from(anchored) {
            let (kind, item) = if place < count {
                ("trap", self.draw.of(&traps))
            } else {
                ("anchor", self.draw.of(&anchors))
            };
            text += &body(&format!("trap-{place}"), kind, item, -(place as f64) * spacing, 0);
            if place > 0 {
                let ends = [format!("trap-{}", place - 1), format!("trap-{place}")];
                text += &self.line(
                    &format!("ground-{place}"),
                    ends.each_ref().map(String::as_str),
                    spacing * slack,
                );
            }
        }
        text
    }

    /// A line of a drawn rope and law of stretch.
    fn line(&mut self, id: &str, [from, to]: [&str; 2], length: f64) -> String {
        let ropes = self.library.ids(Kind::Rope);
        let rope = self.draw.of(&ropes);
        let is = |condition: &str| {
            self.library.ropes.iter().any(|known| known.entry.id == rope && has(known, condition))
        };
        let condition = Some(self.draw.of(&["secant", "secant", "new", "worked"]))
            .filter(|condition| is(condition))
            .unwrap_or("secant");
        format!(
            "[[line]]\nid = \"{id}\"\nrope = \"{rope}\"\nfrom = \"{from}\"\nto = \"{to}\"\nlength = \"{length} m\"\ncondition = \"{condition}\"\n"
        )
    }
}

/// Whether a rope says what that law of stretch needs.
fn has(rope: &Rope, condition: &str) -> bool {
    match condition {
        "new" => rope.toe.is_some() && rope.stretch_at_break.is_some(),
        "worked" => rope.worked_stiffness_n.is_some(),
        _ => true,
    }
}

fn body(id: &str, kind: &str, item: &str, x: f64, height: u8) -> String {
    format!(
        "[[body]]\nid = \"{id}\"\nkind = \"{kind}\"\nitem = \"{item}\"\nposition = [\"{x} m\", \"0 m\"]\nheight = {height}\n"
    )
}

fn joint(id: &str, x: f64, height: f64) -> String {
    format!("[[joint]]\nid = \"{id}\"\nposition = [\"{x} m\", \"0 m\"]\nheight = {height}\n")
}

/// Every tenth rig has rope a thousand times as stiff, every tenth a trap ten thousand times as heavy as the lightest node.
fn hard(seed: u64, model: Model) -> Model {
    let mut spec = model.spec;
    match seed % 10 {
        3 => spec.ropes.iter_mut().for_each(|rope| rope.axial_stiffness_n *= 1e3),
        7 => {
            let node_kg = |line: &endline_sim::model::Line| {
                0.5 * spec.ropes[line.rope].mass_kg_m * line.segments_m[0]
            };
            let lightest_kg = spec.lines.iter().map(node_kg).fold(f64::INFINITY, f64::min);
            let trap = spec.bodies.iter_mut().find(|body| body.id == "trap-0").unwrap();
            trap.mass_kg = trap.mass_kg.max(1e4 * lightest_kg);
        }
        _ => {}
    }
    Model::new(spec).unwrap()
}

/// Share of the first trap's weight in water below which the drag of endline and buoy surely leaves it where it
/// stands. That drag is counted broadside and at the speed of the surface, about twice its true value; the trap's
/// friction of 0.6 or more, less the lift of the line, holds a third of its weight.
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
