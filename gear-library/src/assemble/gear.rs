//! Gear of the library, placed: assemblies become rigs, rigs become parts.

use endline_sdk::{BodyKind, Rig, RigBody, RigEnd, RigJoint, RigLine, RigLink, Site};
use endline_sim::model::GearHook;
use endline_sim::{DQuat, DVec3};

use crate::assembly::{Assembly, Make, PartLine, Parts, Start};
use crate::attributes::Attributes;
use crate::diagnostic::{At, Place};
use crate::line::LineMake;
use crate::nearest::hint;
use crate::scenario::PlacedGear;
use crate::schema::Kind;

use super::builder::Builder;
use super::ends::split;
use super::rig::Setting;

impl Builder<'_> {
    /// Every assembly the scenario places.
    pub fn add_gear(&mut self) {
        for gear in &self.scenario.gear {
            let Some(assembly) = self
                .library
                .assemblies
                .iter()
                .find(|assembly| assembly.entry.id == gear.assembly.value)
            else {
                self.no_item(Kind::Assembly, &gear.assembly.value, &gear.assembly.place);
                self.incomplete = true;
                continue;
            };
            self.uses(&assembly.entry.path);
            self.add_assembly(gear, assembly);
        }
    }

    fn add_assembly(&mut self, gear: &PlacedGear, assembly: &Assembly) {
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
                    let message = format!(
                        "`{}` is written out part by part and takes no attributes",
                        assembly.entry.id
                    );
                    self.problems.push(key.error(
                        message,
                        "take the attributes out, or place an assembly with a gear type",
                    ));
                }
                setting.places = places(parts);
                setting.makes = over(own_makes(parts), &gear.lines);
                self.add_rig(&rig(parts, self.spec.water.depth_m), &setting);
            }
        }
    }

    /// Gear that a gear type builds from attributes.
    fn add_built(
        &mut self,
        gear: &PlacedGear,
        setting: &Setting<'_>,
        id: &At<String>,
        usual: &Attributes,
    ) {
        let Some(hook) = self.hooks.gear(&id.value) else {
            let ids = self.hooks.ids();
            let message = format!("no gear type `{}` among the plugins", id.value);
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
                self.problems
                    .push(gear.assembly.place.error(message, "fix the attribute it names"));
                self.incomplete = true;
                return;
            }
        };
        let (lines, links) = self.add_rig(&rig, setting);
        self.spec.gear.push(GearHook { gear: hook, attributes, lines, links });
    }
}

/// Parts as a rig, heights turned into depths.
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

/// How each line of the parts is made up.
fn own_makes(parts: &Parts) -> Vec<(At<String>, LineMake)> {
    parts.lines.iter().map(|line| (line.id.clone(), line.make.clone())).collect()
}

/// How each line is made up, the scenario's choices over the assembly's.
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

/// Where each id of the parts stands in the assembly's file.
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
