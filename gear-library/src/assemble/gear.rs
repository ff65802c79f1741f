//! Gear of the library: builds rigs of assemblies and adds their parts to the spec.

use endline_sdk::{BodyKind, LineEnd, Rig, RigBody, RigEnd, RigJoint, RigLine, RigLink, Site};
use endline_sim::model::{BodyRole, GearHook, Joint, JointKind, Link};
use endline_sim::{DQuat, DVec3};

use crate::assembly::{Assembly, Attributes, Make, PartLine, Parts, Start};
use crate::diagnostic::{At, Place, hint};
use crate::items::BoxGear;
use crate::library::Library;
use crate::line::LineMake;
use crate::scenario::{LineStart, PlacedGear};
use crate::schema::Kind;

use super::body;
use super::builder::{Builder, Part};
use super::line::{NewLine, split};

impl Builder<'_> {
    /// Adds the assemblies that the scenario places.
    pub fn add_gear(&mut self) {
        for gear in &self.scenario.gear {
            let all = &self.library.assemblies;
            match self.item(Kind::Assembly, &gear.assembly, all, |assembly| &assembly.entry) {
                Some(assembly) => self.add_assembly(gear, assembly),
                None => self.incomplete = true,
            }
        }
    }

    fn add_assembly(&mut self, gear: &PlacedGear, assembly: &Assembly) {
        self.fleet = self.fleet_of(gear, assembly);
        let orientation = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2 - gear.heading_rad);
        let mut setting = Setting {
            prefix: gear.id.as_ref().map(|id| format!("{}/", id.value)).unwrap_or_default(),
            origin_m: DVec3::new(gear.position_m[0], gear.position_m[1], 0.0),
            orientation,
            ropes: &gear.ropes,
            makes: gear.lines.clone(),
            usual_place: gear.assembly.place.clone(),
            places: Vec::new(),
        };
        match &assembly.make {
            Make::GearType { id, attributes, lines } => {
                setting.makes = over(lines.clone(), &gear.lines);
                self.add_built(gear, &setting, id, attributes);
            }
            Make::Parts(parts) => {
                if let Some((_, key, _)) = gear.attributes.0.first() {
                    let message =
                        format!("`{}` consists of parts and has no attributes", assembly.entry.id);
                    self.problems.push(key.error(
                        message,
                        "remove the attributes, or place an assembly with a gear type",
                    ));
                }
                setting.places = places(parts);
                setting.makes = over(own_makes(parts), &gear.lines);
                self.add_rig(&rig(parts, self.spec.water.depth_m), &setting);
            }
        }
        self.fleet = None;
    }

    /// Adds gear that a gear type builds from attributes.
    fn add_built(
        &mut self,
        gear: &PlacedGear,
        setting: &Setting<'_>,
        id: &At<String>,
        usual: &Attributes,
    ) {
        let Some(hook) = self.hooks.gear(&id.value) else {
            let ids = self.hooks.ids();
            let message = format!("there is no plugin with the gear type `{}`", id.value);
            self.problems
                .push(id.place.error(message, hint(&id.value, ids.iter().map(String::as_str))));
            self.incomplete = true;
            return;
        };
        let attributes = gear.attributes.over(usual).resolve(
            hook.descriptor(),
            self.library,
            &mut self.used,
            &self.problems,
        );
        let surface = setting.orientation.inverse() * self.spec.water.current.at(1.0, 0.0);
        let site = Site { depth_m: self.spec.water.depth_m, current_m_s: [surface.x, surface.y] };
        let rig = match hook.build(&attributes, &site) {
            Ok(rig) => rig,
            Err(error) => {
                let message = format!("`{}` cannot build this gear: {error}", id.value);
                self.problems.push(
                    gear.assembly
                        .place
                        .error(message, "correct the attribute named in the message"),
                );
                self.incomplete = true;
                return;
            }
        };
        let (lines, links) = self.add_rig(&rig, setting);
        self.spec.gear.push(GearHook { gear: hook, attributes, lines, links });
    }
}

/// Converts parts to a rig, and heights to depths.
fn rig(parts: &Parts, depth_m: f64) -> Rig {
    let at = |start: &Start| [start.xy_m[0], start.xy_m[1], depth_m * (start.height - 1.0)];
    let is_body = |end: &str| parts.bodies.iter().any(|body| body.id.value == split(end).0);
    let end = |id: &At<String>| {
        if is_body(&id.value) {
            RigEnd::Body(id.value.clone())
        } else {
            RigEnd::Joint(id.value.clone())
        }
    };
    let kind = |kind| match kind {
        Kind::Trap => BodyKind::Trap,
        Kind::Buoy => BodyKind::Buoy,
        _ => BodyKind::Anchor,
    };
    let body = |body: &crate::assembly::PartBody| RigBody {
        id: body.id.value.clone(),
        kind: kind(body.kind),
        item: body.item.value.clone(),
        position_m: at(&body.start),
    };
    let line = |line: &PartLine| RigLine {
        id: line.id.value.clone(),
        rope: line.rope.value.clone(),
        from: end(&line.from),
        to: end(&line.to),
        length_m: line.length_m,
        laid_m: Vec::new(),
    };
    let link = |link: &crate::assembly::PartLink| RigLink {
        id: link.id.value.clone(),
        item: link.item.as_ref().map(|item| item.value.clone()).unwrap_or_default(),
        line: link.line.value.clone(),
        end: link.end,
    };
    Rig {
        bodies: parts.bodies.iter().map(body).collect(),
        joints: parts
            .joints
            .iter()
            .map(|joint| RigJoint { id: joint.id.value.clone(), position_m: at(&joint.start) })
            .collect(),
        lines: parts.lines.iter().map(line).collect(),
        links: parts.links.iter().map(link).collect(),
    }
}

/// The make of each line of the parts.
fn own_makes(parts: &Parts) -> Vec<(At<String>, LineMake)> {
    parts.lines.iter().map(|line| (line.id.clone(), line.make.clone())).collect()
}

/// The make of each line; the scenario's choices override the assembly's.
fn over(
    mut makes: Vec<(At<String>, LineMake)>,
    chosen: &[(At<String>, LineMake)],
) -> Vec<(At<String>, LineMake)> {
    for (id, make) in chosen {
        match makes.iter_mut().find(|(known, _)| known.value == id.value) {
            Some((_, usual)) => *usual = make.over(usual),
            None => makes.push((id.clone(), make.clone())),
        }
    }
    makes
}

/// Places of the ids in the assembly's file.
fn places(parts: &Parts) -> Vec<(String, Place)> {
    let ids = parts.bodies.iter().flat_map(|body| [&body.item, &body.id]);
    let ids = ids.chain(parts.joints.iter().map(|joint| &joint.id));
    let ids =
        ids.chain(parts.lines.iter().flat_map(|line| [&line.id, &line.rope, &line.from, &line.to]));
    let ids = ids.chain(
        parts.links.iter().flat_map(|link| [&link.id, &link.line].into_iter().chain(&link.item)),
    );
    ids.map(|id| (id.value.clone(), id.place.clone())).collect()
}

/// The placement of a rig in the scenario.
pub(super) struct Setting<'a> {
    /// Prefix of its ids.
    pub prefix: String,
    /// Its origin [m].
    pub origin_m: DVec3,
    /// Rotation from its frame to the world.
    pub orientation: DQuat,
    /// Replaced ropes, by line.
    pub ropes: &'a [(At<String>, At<String>)],
    /// Makes of lines, by line.
    pub makes: Vec<(At<String>, LineMake)>,
    /// Place at which its problems are reported.
    pub usual_place: Place,
    /// More precise places, by id of a part or item.
    pub places: Vec<(String, Place)>,
}

impl Setting<'_> {
    fn at(&self, id: &str) -> At<String> {
        let place = self
            .places
            .iter()
            .find(|(known, _)| known == id)
            .map_or(&self.usual_place, |(_, place)| place);
        At { value: id.to_owned(), place: place.clone() }
    }

    fn named(&self, id: &str) -> At<String> {
        let At { value, place } = self.at(id);
        At { value: format!("{}{value}", self.prefix), place }
    }
}

impl Builder<'_> {
    /// A place of a rig in the world [m]; its depth is scaled by the local water depth.
    fn rig_place(&self, position_m: [f64; 3], setting: &Setting<'_>) -> DVec3 {
        let mut place = setting.origin_m + setting.orientation * DVec3::from_array(position_m);
        let (level_m, local_m) = (self.spec.water.depth_m, -self.seabed_height(place));
        if local_m <= 0.0 {
            let message =
                format!("the seabed rises {:.1} m above the surface under this gear", -local_m);
            self.problems.push(
                setting
                    .usual_place
                    .error(message, "move the gear, or make the seabed's slope less steep"),
            );
        }
        place.z *= local_m / level_m;
        place
    }

    /// The orientation of a box on the seabed: that of the rig, tilted with the slope.
    fn standing(&self, setting: &Setting<'_>) -> DQuat {
        let normal = self.spec.seabed.as_ref().map_or(DVec3::Z, |bed| bed.normal);
        DQuat::from_rotation_arc(DVec3::Z, normal) * setting.orientation
    }

    /// Adds a rig to the spec; returns first and last piece of its lines, and its links, in order.
    pub fn add_rig(&mut self, rig: &Rig, setting: &Setting<'_>) -> (Vec<[usize; 2]>, Vec<usize>) {
        for body in &rig.bodies {
            self.add_rig_body(body, setting);
        }
        for joint in &rig.joints {
            let id = setting.named(&joint.id);
            self.name(id.value.clone(), Part::Joint(self.spec.joints.len()), &id.place);
            self.spec.joints.push(Joint {
                id: id.value,
                kind: JointKind::Free,
                position_m: self.rig_place(joint.position_m, setting),
            });
        }
        let lines = rig.lines.iter().map(|line| self.add_rig_line(line, setting)).collect();
        let first_link = self.spec.links.len();
        for link in &rig.links {
            self.add_rig_link(link, setting);
        }
        let named = setting
            .ropes
            .iter()
            .map(|(line, _)| line)
            .chain(setting.makes.iter().map(|(line, _)| line));
        for line in named.filter(|line| !rig.lines.iter().any(|known| known.id == line.value)) {
            let known = rig.lines.iter().map(|line| line.id.as_str());
            let help = hint(&line.value, known);
            self.problems
                .push(line.place.error(format!("this gear has no line `{}`", line.value), help));
        }
        (lines, (first_link..self.spec.links.len()).collect())
    }

    fn add_rig_body(&mut self, body: &RigBody, setting: &Setting<'_>) {
        let (id, item) = (setting.named(&body.id), setting.at(&body.item));
        let (place, standing) = (self.rig_place(body.position_m, setting), self.standing(setting));
        let (library, density) = (self.library, self.spec.water.density_kg_m3);
        let made = match body.kind {
            BodyKind::Buoy => {
                library.buoys.iter().find(|buoy| buoy.entry.id == item.value).map(|buoy| {
                    let made =
                        body::of_buoy(id.value.clone(), buoy, density, place, setting.orientation);
                    (made, body::buoy_points(buoy), &buoy.entry.path)
                })
            }
            BodyKind::Trap | BodyKind::Anchor => {
                box_item(library, body.kind, &item.value).map(|item| {
                    let role =
                        if body.kind == BodyKind::Trap { BodyRole::Trap } else { BodyRole::Anchor };
                    let made = body::of_box(id.value.clone(), role, item, density, place, standing);
                    (made, body::box_points(item), &item.entry.path)
                })
            }
        };
        let Some((made, points, path)) = made else {
            self.no_item(library_kind(body.kind), &item.value, &item.place);
            self.incomplete = true;
            return;
        };
        self.uses(path);
        self.name(id.value, Part::Body(self.spec.bodies.len()), &id.place);
        self.spec.bodies.push(made);
        self.points.push(points);
    }

    fn add_rig_line(&mut self, line: &RigLine, setting: &Setting<'_>) -> [usize; 2] {
        let id = setting.named(&line.id);
        let chosen = setting
            .ropes
            .iter()
            .find(|(known, _)| known.value == line.id)
            .map(|(_, rope)| rope.clone());
        // A rope that a scenario chooses is that of no fleet.
        let fleet = self.fleet.take_if(|_| chosen.is_some());
        let rope = chosen.unwrap_or_else(|| setting.at(&line.rope));
        let mut end = |end: &RigEnd| {
            let (RigEnd::Body(part) | RigEnd::Joint(part)) = end;
            self.end(&setting.named(part))
        };
        let ends = (end(&line.from), end(&line.to));
        let usual = LineMake::default();
        let make = setting
            .makes
            .iter()
            .find(|(known, _)| known.value == line.id)
            .map_or(&usual, |(_, make)| make);
        let laid_m = line.laid_m.iter().map(|place| self.rig_place(*place, setting)).collect();
        let pieces = self.add_line(&NewLine {
            id,
            rope,
            ends,
            length_m: line.length_m,
            start: LineStart::Straight,
            laid_m,
            make,
        });
        self.fleet = self.fleet.take().or(fleet);
        pieces
    }

    fn add_rig_link(&mut self, link: &RigLink, setting: &Setting<'_>) {
        let (id, item, line) =
            (setting.named(&link.id), setting.at(&link.item), setting.named(&link.line));
        let rating = self.rating(&item, &id.value);
        self.add_link(&id, rating, &line, link.end);
    }

    /// Rating of a weak link of the library, drawn for a link id.
    pub fn rating(&mut self, item: &At<String>, id: &str) -> Option<Rated> {
        let links = &self.library.weak_links;
        let found = self.item(Kind::WeakLink, item, links, |link| &link.entry)?;
        let rating_n = self.link_strength(found, id);
        Some(Rated { rating_n, breadth_m: found.breadth_m })
    }

    /// Adds a weak link at an end of a line, by the line's id.
    pub fn add_link(
        &mut self,
        id: &At<String>,
        rated: Option<Rated>,
        line: &At<String>,
        end: LineEnd,
    ) {
        let Some(Part::Line { first, last }) = self.part(&line.value) else {
            self.unknown("line", line, |part| matches!(part, Part::Line { .. }));
            return;
        };
        self.add_link_to(id, rated, if end == LineEnd::A { first } else { last }, end);
    }

    /// Adds a weak link at an end of a line of the spec.
    pub fn add_link_to(
        &mut self,
        id: &At<String>,
        rated: Option<Rated>,
        line: usize,
        end: LineEnd,
    ) {
        let Rated { rating_n, breadth_m } = rated.unwrap_or_default();
        let knot_m = &mut self.spec.lines[line].knots_m[usize::from(end == LineEnd::B)];
        *knot_m = knot_m.max(0.5 * breadth_m);
        self.name(id.value.clone(), Part::Link(self.spec.links.len()), &id.place);
        self.spec.links.push(Link { id: id.value.clone(), line, end, rating_n, enabled: true });
    }

    /// Enables or disables all weak links.
    pub fn enable_links(&mut self, enabled: bool) {
        for link in &mut self.spec.links {
            link.enabled = enabled;
        }
    }
}

/// Drawn rating and breadth of a weak link.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Rated {
    /// Tension above which it parts [N].
    pub rating_n: f64,
    /// Breadth; zero if it is not broader than the rope [m].
    pub breadth_m: f64,
}

fn library_kind(kind: BodyKind) -> Kind {
    match kind {
        BodyKind::Trap => Kind::Trap,
        BodyKind::Buoy => Kind::Buoy,
        BodyKind::Anchor => Kind::Anchor,
    }
}

fn box_item<'a>(library: &'a Library, kind: BodyKind, id: &str) -> Option<&'a BoxGear> {
    let items = if kind == BodyKind::Trap { &library.traps } else { &library.anchors };
    items.iter().find(|item| item.entry.id == id)
}
