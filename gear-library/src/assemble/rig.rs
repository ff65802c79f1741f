//! A rig's parts, put into the spec.

use endline_sdk::{BodyKind, LineEnd, Rig, RigBody, RigEnd, RigLine, RigLink};
use endline_sim::model::{BodyRole, Joint, JointKind, Link};
use endline_sim::{DQuat, DVec3};

use crate::diagnostic::{At, Place};
use crate::items::BoxGear;
use crate::library::Library;
use crate::line::LineMake;
use crate::scenario::LineStart;
use crate::schema::Kind;

use super::body;
use super::builder::{Builder, Part};
use super::line::NewLine;

/// How a rig is set into the scenario.
pub(super) struct Setting<'a> {
    /// Put before its ids.
    pub prefix: String,
    /// Where its origin lies [m].
    pub origin_m: DVec3,
    /// Its frame, to world.
    pub orientation: DQuat,
    /// Ropes over its own, by line.
    pub ropes: &'a [(At<String>, At<String>)],
    /// How lines are made up, by line: the scenario's over the assembly's.
    pub makes: Vec<(At<String>, LineMake)>,
    /// Where problems of it are reported.
    pub usual_place: Place,
    /// Better places, by id of a part or item.
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
    /// A place of a rig in the world: its height is a share of the depth, which over a slope is the local one.
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

    /// The frame of a box that stands on the seabed: the rig's, tilted with the slope.
    fn standing(&self, setting: &Setting<'_>) -> DQuat {
        let normal = self.spec.seabed.as_ref().map_or(DVec3::Z, |bed| bed.normal);
        DQuat::from_rotation_arc(DVec3::Z, normal) * setting.orientation
    }

    /// Puts a rig into the spec; answers its lines by first and last piece, and its links, in the order built.
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
            let help = crate::nearest::hint(&line.value, known);
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
        self.add_line(&NewLine {
            id,
            rope,
            ends,
            length_m: line.length_m,
            start: LineStart::Straight,
            laid_m,
            make,
        })
    }

    fn add_rig_link(&mut self, link: &RigLink, setting: &Setting<'_>) {
        let (id, item, line) =
            (setting.named(&link.id), setting.at(&link.item), setting.named(&link.line));
        let rating = self.rating(&item, &id.value);
        self.add_link(&id, rating, &line, link.end);
    }

    /// Rating of a weak link of the library, drawn for the link of this id.
    pub fn rating(&mut self, item: &At<String>, id: &str) -> Option<Rated> {
        let Some(found) = self.library.weak_links.iter().find(|known| known.entry.id == item.value)
        else {
            self.no_item(Kind::WeakLink, &item.value, &item.place);
            return None;
        };
        self.uses(&found.entry.path);
        let rating_n = self.link_strength(found, id);
        Some(Rated { rating_n, breadth_m: found.breadth_m })
    }

    /// Puts a weak link at an end of a line, by the line's id.
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

    /// Puts a weak link at an end of a line of the spec.
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

    /// Weak links on or off.
    pub fn enable_links(&mut self, enabled: bool) {
        for link in &mut self.spec.links {
            link.enabled = enabled;
        }
    }
}

/// A weak link as it is put into a line: the tension above which it parts, as drawn, and its breadth.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Rated {
    /// [N].
    pub rating_n: f64,
    /// Zero where it is no broader than the rope [m].
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
