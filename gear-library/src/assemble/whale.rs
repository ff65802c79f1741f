//! Adds the whale to the spec: skin, motion with acts, pilot program and, for a kinetic whale, its dynamics.
//!
//! Mass, centre and inertia are those of the skin. Added mass is that of a spheroid of the whale's length and greatest
//! diameter. The turning drag of an elliptic outline of area `A` and length `L` about its middle is
//! `½ρ C ω|ω| · 4/(60π) A L³`, and the rolling drag of fins of half span `s` and chord `c` is `½ρ C ω|ω| · ½ c s⁴`.

use std::f64::consts::PI;
use std::sync::Arc;

use endline_sdk::{Controls, Descriptor, Posture, WhaleMotion};
use endline_sim::model::{PilotEntry, PilotProgram, Sight, Target, Trigger, Whale};
use endline_sim::whale::acts::{Acting, Answers, Clip, DrawnAnswers, Side};
use endline_sim::whale::kinetic::hull::{fins, spheroid};
use endline_sim::whale::kinetic::{AxialDrag, Dead, Effort, Hull, Kinetic, Muscle};
use endline_sim::whale::{JawStrength, Measures, Skin};
use endline_sim::{DQuat, DVec3};

use crate::diagnostic::{At, hint};
use crate::items::{ActItem, WhaleItem};
use crate::scenario::{AnswersToTouch, PilotOf, PlacedWhale, TiringOf, TriggerOf};
use crate::schema::Kind;
use crate::whale::WhaleForm;

use super::attributes::numbers;
use super::builder::{Builder, Part};
use super::strength::{normal, uniform};

impl Builder<'_> {
    /// Adds the whale; `kinetic` overrides the scenario.
    pub fn add_whale(&mut self, kinetic: Option<bool>) {
        let Some(placed) = &self.scenario.whale else {
            return;
        };
        let whales = &self.library.whales;
        let Some(item) = self.item(Kind::Whale, &placed.item, whales, |whale| &whale.entry) else {
            return;
        };
        item.mesh.iter().for_each(|mesh| self.uses(&mesh.file.value));
        let Some(motion) = self.motion(&placed.motion) else { return };
        let motion = self.with_acts(motion, placed, item);
        let attributes = placed.attributes.resolve(
            motion.descriptor(),
            self.library,
            &mut self.used,
            &self.problems,
        );
        let Some(length_m) = self.length(placed, item) else { return };
        let skin = item.skin_for(length_m, placed.condition, placed.pregnant);
        let measures = Measures::of(&skin, item.density_kg_m3);
        let kinetic = if placed.dead || kinetic.unwrap_or(placed.kinetic) {
            kinetic_whale(placed, item, &skin, [length_m, self.spec.water.density_kg_m3])
        } else {
            None
        };
        let jaws = item.jaws(length_m, &skin);
        self.spec.whale = Some(Whale {
            measures,
            skin,
            joints: item.joints.ranges,
            length_m,
            burst_speed_m_s: item.burst_speed_m_s,
            position_m: placed.position_m,
            orientation: orientation(placed),
            speed_m_s: placed.speed_m_s,
            motion,
            motion_attributes: numbers(&attributes),
            pilot: PilotProgram::default(),
            contact_stiffness_n_m2: placed
                .contact_stiffness_n_m2
                .unwrap_or(item.contact_stiffness_n_m2),
            jaws,
            kinetic,
        });
    }

    /// The motion plugin of an id; a missing one is reported.
    fn motion(&self, id: &At<String>) -> Option<Arc<dyn WhaleMotion>> {
        let motion = self.hooks.motion(&id.value);
        if motion.is_none() {
            let ids = self.hooks.ids();
            let message = format!("there is no plugin with the whale motion `{}`", id.value);
            let help = hint(&id.value, ids.iter().map(String::as_str));
            self.problems.push(id.place.error(message, help));
        }
        motion
    }

    /// Length of the whale: from the scenario, its age or its file [m].
    fn length(&self, placed: &PlacedWhale, item: &WhaleItem) -> Option<f64> {
        if item.mesh.is_some() && (placed.pregnant || (placed.condition - 1.0).abs() > 0.0) {
            let help = "remove `condition` and `pregnant`, or the mesh in the whale's file";
            self.problems.push(placed.item.place.error(
                format!("{} has its own mesh, whose girth cannot change", item.entry.path),
                help,
            ));
        }
        let Some(age) = &placed.age_s else {
            return Some(placed.length_m.unwrap_or(item.form.length_m));
        };
        let law = item.growth.age;
        if law.is_none() {
            let help = "write `length` instead, or the table [age] with `birth`, `one_year` and `tenfold` in the whale's file";
            self.problems.push(
                age.place.error(format!("{} has no law of length by age", item.entry.path), help),
            );
        }
        law.map(|law| law.length_m(age.value))
    }
}

/// Rotation by heading, then pitch, then roll.
fn orientation(placed: &PlacedWhale) -> DQuat {
    DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2 - placed.heading_rad)
        * DQuat::from_rotation_y(-placed.pitch_rad)
        * DQuat::from_rotation_x(placed.roll_rad)
}

/// Dynamics of a whale of a length [m] in water of a density [kg/m³], alive or dead.
fn kinetic_whale(
    placed: &PlacedWhale,
    item: &WhaleItem,
    skin: &Skin,
    [length_m, density_kg_m3]: [f64; 2],
) -> Option<Kinetic> {
    let alive = item.kinetic(length_m, skin, density_kg_m3, (placed.effort, placed.tiring))?;
    if placed.dead { item.dead(skin, alive, density_kg_m3) } else { Some(alive) }
}

/// Numbers of acts with cumulative probabilities, from acts with weights.
fn cumulative(
    weights: &[(At<String>, f64)],
    number: impl Fn(&At<String>) -> Option<usize>,
) -> Option<Vec<(usize, f64)>> {
    let all: f64 = weights.iter().map(|(_, weight)| weight).sum();
    let mut sum = 0.0;
    let act = |(act, weight): &(At<String>, f64)| {
        sum += weight / all;
        Some((number(act)?, sum))
    };
    weights.iter().filter(|(_, weight)| *weight > 0.0).map(act).collect()
}

/// Random numbers of the responses of a run; a whale that responds every 20 s uses them up in 5 h.
fn answer_shares(seed: u64) -> Vec<f64> {
    (0..1000).map(|index| uniform("endline answers to touch 1", seed, index, "")[0]).collect()
}

/// Turning drag of an elliptic outline over its area and the cube of its length.
const TURNING: f64 = 4.0 / (60.0 * PI);

impl WhaleItem {
    /// Dynamics of a living whale of a length in water of a density; `None` if a figure is missing, which is reported.
    pub fn kinetic(
        &self,
        length_m: f64,
        skin: &Skin,
        density_kg_m3: f64,
        effort: (Effort, TiringOf),
    ) -> Option<Kinetic> {
        let measures = Measures::of(skin, self.density_kg_m3);
        let value = |key| self.entry.value(key);
        let form = self.form_at(length_m);
        let (mass_kg, inertia) = (measures.mass_kg, measures.inertia_kg_m2);
        let inertia_kg_m2 = DVec3::new(inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z);
        let drag = self.axial_drag(length_m, mass_kg)?;
        let shares = spheroid(length_m / drag.diameter_m);
        let fins = [flukes(&form), flippers(&form)];
        let muscle = self.muscle(&form, effort)?;
        let arm = DVec3::new(
            value("strength.rolling_arm")?,
            value("strength.steering_arm")?,
            value("strength.steering_arm")?,
        );
        let (side_drag_m2, turn_drag_m5) = self.cross_drag(length_m, &fins)?;
        Some(Kinetic {
            mass_kg,
            centre_m: measures.centre_m,
            inertia_kg_m2,
            added_mass_kg: DVec3::new(shares.along, shares.across, shares.across) * mass_kg,
            added_inertia_kg_m2: DVec3::new(
                fins.iter().map(|[span, chord]| self::fins(density_kg_m3, *span, *chord)).sum(),
                shares.turning * inertia_kg_m2.y,
                shares.turning * inertia_kg_m2.z,
            ),
            drag,
            side_drag_m2,
            turn_drag_m5,
            steering_n_m: arm * (length_m * muscle.sustained_n),
            muscle,
            steering_time_s: value("strength.steering_time")?,
            buoyancy: value("dynamics.buoyancy")?,
            hull: Arc::new(Hull::of(skin, &Posture::default())),
            dead: None,
        })
    }

    /// Drag along the axis of a whale of a length and mass.
    fn axial_drag(&self, length_m: f64, mass_kg: f64) -> Option<AxialDrag> {
        let value = |key| self.entry.value(key);
        Some(AxialDrag {
            length_m,
            diameter_m: value("drag.diameter_offset")? + value("drag.diameter")? * length_m,
            wetted_area_m2: value("drag.wetted_area")?
                * libm::pow(mass_kg, value("drag.wetted_area_exponent")?),
            appendages: value("drag.appendages")?,
            oscillation: value("drag.oscillation")?,
            open_mouth: value("drag.open_mouth")?,
            wide_rad: value("drag.wide_mouth")?,
        })
    }

    /// Drag areas from the side and from above [m²], and turning drag about each axis [m⁵]; `fins` have half span and
    /// mean chord [m].
    fn cross_drag(&self, length_m: f64, fins: &[[f64; 2]; 2]) -> Option<([f64; 2], DVec3)> {
        let value = |key| self.entry.value(key);
        let (area, cross) = (length_m * length_m, value("drag.cross")?);
        let [side, plan] = [value("drag.side_area")? * area, value("drag.plan_area")? * area];
        let rolling =
            fins.map(|[span, chord]| 0.5 * chord * span * span * span * span).iter().sum::<f64>();
        let turning = DVec3::new(
            cross * rolling,
            TURNING * cross * plan * area * length_m,
            TURNING * cross * side * area * length_m,
        );
        Some(([cross * side, cross * plan], turning))
    }

    /// Dynamics of a dead whale afloat: its mass equals the water that it displaces at rest.
    /// `None` if a figure is missing, which is reported.
    pub fn dead(&self, skin: &Skin, alive: Kinetic, density_kg_m3: f64) -> Option<Kinetic> {
        let measures = Measures::of(skin, self.density_kg_m3);
        let value = |key| self.entry.value(key);
        let mass_kg = density_kg_m3 * measures.volume_m3 * (1.0 - value("dead.afloat")?);
        let posture = Posture { jaw: value("dead.jaw")?, ..Posture::default() };
        Some(Kinetic {
            mass_kg,
            centre_m: alive.centre_m
                + DVec3::Z * (value("dead.weight_above")? * alive.drag.length_m),
            inertia_kg_m2: alive.inertia_kg_m2 * (mass_kg / alive.mass_kg),
            hull: Arc::new(Hull::of(skin, &posture)),
            dead: Some(Dead { posture }),
            ..alive
        })
    }

    /// Closing strength of jaws and lips at a length, from the burst thrust; `None` if its file has none.
    pub fn jaws(&self, length_m: f64, skin: &Skin) -> Option<JawStrength> {
        let value = |key| self.entry.value(key);
        let burst_n = value("strength.burst")? * libm::pow(length_m, value("strength.exponent")?);
        let forces_n = [value("strength.jaw")? * burst_n, value("strength.lip")? * burst_n];
        Some(JawStrength::of_forces(skin, forces_n))
    }

    fn muscle(&self, form: &WhaleForm, (effort, tiring): (Effort, TiringOf)) -> Option<Muscle> {
        let value = |key| self.entry.value(key);
        let length = form.length_m;
        let grown = libm::pow(length, value("strength.exponent")?);
        Some(Muscle {
            sustained_n: value("strength.sustained")? * grown,
            burst_n: value("strength.burst")? * grown,
            tires_s: tiring.tires_s.or(value("strength.tires")).unwrap_or(f64::INFINITY),
            recovers_s: tiring.recovers_s.or(value("strength.recovers")).unwrap_or(f64::INFINITY),
            efficiency: value("strength.efficiency")?,
            swept_area_m2: form.flukes.span * value("strength.stroke")? * length * length,
            effort,
        })
    }
}

/// Half span and mean chord of the flukes [m].
fn flukes(form: &WhaleForm) -> [f64; 2] {
    [
        0.5 * form.flukes.span * form.length_m,
        0.5 * (form.flukes.root_chord + form.flukes.tip_chord) * form.length_m,
    ]
}

/// Reach from the axis and mean chord of the flippers [m].
fn flippers(form: &WhaleForm) -> [f64; 2] {
    let at = form.flippers.insertion;
    let nearest = form
        .stations
        .iter()
        .min_by(|one, other| (one.at - at).abs().total_cmp(&(other.at - at).abs()));
    let half_width = 0.5 * form.breadth_scale * nearest.map_or(0.0, |station| station.width);
    let reach = half_width + form.flippers.span * libm::cos(form.flippers.droop);
    [
        reach * form.length_m,
        0.5 * (form.flippers.root_chord + form.flippers.max_chord) * form.length_m,
    ]
}

impl Builder<'_> {
    /// The motion with the acts that the scenario names, or all of the library, and the answer to touch.
    pub fn with_acts(
        &mut self,
        motion: Arc<dyn WhaleMotion>,
        placed: &PlacedWhale,
        whale: &WhaleItem,
    ) -> Arc<dyn WhaleMotion> {
        let clips = self.clips(placed, whale);
        self.check_ids(motion.as_ref(), &clips, placed);
        let own = motion.descriptor().acts.len();
        let answers =
            placed.answers.as_ref().and_then(|answers| self.answers(answers, &clips, own));
        if clips.is_empty() { motion } else { Arc::new(Acting::new(motion, clips, answers)) }
    }

    /// Responses to touch, with acts as numbers after those of the motion.
    fn answers(&self, answers: &AnswersToTouch, clips: &[Clip], own: usize) -> Option<Answers> {
        let number = |act: &At<String>| {
            let ids = || std::iter::once("none").chain(clips.iter().map(|clip| clip.id.as_str()));
            let Some(at) = ids().position(|id| id == act.value) else {
                let message =
                    format!("the whale has no act `{}` to answer a touch with", act.value);
                return self.problems.refuse(act.place.error(message, hint(&act.value, ids())));
            };
            Some(if at == 0 { 0 } else { own + at })
        };
        let first = match &answers.first {
            Some(act) => Some(number(act)?),
            None => None,
        };
        let drawn = match &answers.drawn {
            Some(drawn) => {
                let [touched, by_mouth, by_fin] =
                    drawn.weights.each_ref().map(|weights| cumulative(weights, number));
                Some(DrawnAnswers {
                    acts: [touched?, by_mouth?, by_fin?],
                    held_after_s: drawn.held_after_s,
                    shares: answer_shares(self.spec.settings.seed),
                })
            }
            None => None,
        };
        Some(Answers { first, above_n: answers.above_n, again_s: answers.again_s, drawn })
    }

    /// Clips of the acts that the scenario names, or of all.
    fn clips(&mut self, placed: &PlacedWhale, whale: &WhaleItem) -> Vec<Clip> {
        let library = self.library;
        let Some(named) = &placed.acts else {
            self.used.extend(library.acts.iter().flat_map(ActItem::files).map(str::to_owned));
            return library.acts.iter().flat_map(|act| act.clips.iter().cloned()).collect();
        };
        let every =
            || library.acts.iter().flat_map(|act| act.clips.iter().map(move |clip| (act, clip)));
        let mut clips = Vec::new();
        for id in named {
            let Some((act, clip)) = every().find(|(_, clip)| clip.id == id.value) else {
                let known = every().map(|(_, clip)| clip.id.as_str());
                self.problems.push(
                    id.place
                        .error(format!("no act `{}` in acts/", id.value), hint(&id.value, known)),
                );
                continue;
            };
            self.used.extend(act.files().map(str::to_owned));
            self.check_joints(act, whale);
            clips.push(clip.clone());
        }
        clips
    }

    /// Checks a named act against the joint ranges; other acts are clamped to them.
    fn check_joints(&self, act: &ActItem, whale: &WhaleItem) {
        for (angle, figure) in &act.angles {
            let [least, most] = whale.joints.ranges.of(*angle);
            // Tolerance for rounding of a distributed bend.
            if figure.value < least - 1e-9 || figure.value > most + 1e-9 {
                let [value, least, most] = [figure.value, least, most].map(f64::to_degrees);
                let message = format!(
                    "the act sets {angle:?} to {value:.1} deg, the joint range of `{}` is {least:.1} to {most:.1} deg",
                    whale.entry.id
                );
                let help =
                    format!("stay in that range, or change [joints] in {}", whale.entry.path);
                self.problems.push(figure.place.error(message, help));
            }
        }
    }

    /// Checks that ids of acts are unique.
    fn check_ids(&self, motion: &dyn WhaleMotion, clips: &[Clip], placed: &PlacedWhale) {
        let own = motion.descriptor().acts.iter().map(|act| act.id.as_ref());
        let ids: Vec<&str> = own.chain(clips.iter().map(|clip| clip.id.as_str())).collect();
        for (index, id) in ids.iter().enumerate() {
            if ids[..index].contains(id) {
                let named = placed.acts.iter().flatten().rfind(|named| named.value == *id);
                let place = named.map_or(&placed.motion.place, |named| &named.place);
                let help = "name each act once in `acts`, and give files of acts/ ids that the motion's own acts do not have";
                self.problems.push(place.error(format!("two acts have the id `{id}`"), help));
            }
        }
    }
}

impl Builder<'_> {
    /// Adds the pilot program, after the gear that its entries may name.
    pub fn add_pilot(&mut self) {
        let Some(motion) = self.spec.whale.as_ref().map(|whale| Arc::clone(&whale.motion)) else {
            return;
        };
        let Some(placed) = &self.scenario.whale else { return };
        let program = self.pilot(placed, motion.descriptor());
        if let Some(whale) = &mut self.spec.whale {
            whale.pilot = program;
        }
    }

    /// The program of a whale.
    fn pilot(&self, placed: &PlacedWhale, motion: &Descriptor) -> PilotProgram {
        let entries = 0..placed.pilot.len();
        PilotProgram {
            entries: entries.filter_map(|index| self.pilot_entry(placed, index, motion)).collect(),
        }
    }

    fn pilot_entry(
        &self,
        placed: &PlacedWhale,
        index: usize,
        motion: &Descriptor,
    ) -> Option<PilotEntry> {
        let entry = &placed.pilot[index];
        let mut controls = entry.controls;
        if let Some(act) = &entry.act {
            controls[Controls::ACT] = Some(self.act(act, motion)?);
        }
        let trigger = match &entry.trigger {
            TriggerOf::Time(time_s) => Trigger::Time(*time_s),
            TriggerOf::Touch(part) => Trigger::Touch(*part),
            TriggerOf::Within(distance_m, of) => {
                Trigger::Within(*distance_m, self.target(of.as_ref())?)
            }
            TriggerOf::Sees([mean_m, deviation_m], of) => {
                let mut whales = self.library.whales.iter();
                let item = whales.find(|whale| whale.entry.id == placed.item.value)?;
                Trigger::Sees(Sight {
                    distance_m: mean_m + deviation_m * self.seen_deviation(index),
                    eye_m: item.eye_m(self.spec.whale.as_ref()?.length_m),
                    target: self.target(of.as_ref())?,
                })
            }
            TriggerOf::Depth(depth_m) => Trigger::Depth(*depth_m),
            TriggerOf::Heading(bearing_rad) => Trigger::Heading(*bearing_rad),
            TriggerOf::After(entry) => Trigger::After(*entry),
        };
        let controls_starboard = match &entry.trigger {
            TriggerOf::Sees(..) => Some(self.mirrored(&controls, entry, motion)?),
            _ => None,
        };
        Some(PilotEntry {
            trigger,
            delay_s: entry.delay_s,
            hold_s: entry.hold_s,
            ramp_s: entry.ramp_s,
            controls,
            controls_starboard,
        })
    }

    /// The controls of an entry for rope seen on the starboard side: roll and yaw reversed, and the mirror image of the act if it has one.
    fn mirrored(
        &self,
        controls: &[Option<f64>; Controls::COUNT],
        entry: &PilotOf,
        motion: &Descriptor,
    ) -> Option<[Option<f64>; Controls::COUNT]> {
        let mut mirrored = *controls;
        for (name, control) in Controls::NAMES.iter().zip(&mut mirrored) {
            if ["roll", "yaw"].contains(name) {
                *control = control.map(|value| -value);
            }
        }
        let Some(act) = &entry.act else { return Some(mirrored) };
        let is_act = |item: &&ActItem| item.clips.iter().any(|clip| clip.id == act.value);
        let Some(item) = self.library.acts.iter().find(is_act) else { return Some(mirrored) };
        match item.clips.as_slice() {
            [clip] if clip.side == Side::Touched => {
                let message = format!("`{}` turns by the side that was touched", act.value);
                let help = "name an act with a mirror image, such as `veer-from-left`, or one without a side";
                self.problems.push(act.place.error(message, help));
            }
            [one, other] => {
                let image = if act.value == one.id { other } else { one };
                let image = At { value: image.id.clone(), place: act.place.clone() };
                mirrored[Controls::ACT] = Some(self.act(&image, motion)?);
            }
            _ => {}
        }
        Some(mirrored)
    }

    /// Standard normal deviate of the distance at which an entry's target is seen.
    fn seen_deviation(&self, entry: usize) -> f64 {
        normal(uniform("endline sight 1", self.spec.settings.seed, entry as u64, ""))
    }

    /// Number of an act; `none` is 0.
    fn act(&self, act: &At<String>, motion: &Descriptor) -> Option<f64> {
        let known = || motion.acts.iter().map(|act| act.id.as_ref());
        let place = std::iter::once("none").chain(known()).position(|id| id == act.value);
        if place.is_none() {
            let message = format!("the motion {} has no act `{}`", motion.id, act.value);
            self.problems.push(act.place.error(message, hint(&act.value, known().chain(["none"]))));
        }
        place.map(|place| place as f64)
    }

    /// The target of a distance; any line by default.
    fn target(&self, of: Option<&At<String>>) -> Option<Target> {
        let Some(of) = of else { return Some(Target::AnyLine) };
        match self.part(&of.value) {
            Some(Part::Body(body)) => Some(Target::Body(body)),
            Some(Part::Joint(joint)) => Some(Target::Joint(joint)),
            Some(Part::Line { first, last }) => Some(Target::Lines(first..last + 1)),
            _ => {
                let is_target =
                    |part| matches!(part, Part::Body(_) | Part::Joint(_) | Part::Line { .. });
                self.unknown("line, body or joint", of, is_target);
                None
            }
        }
    }
}
