//! The state of an assembly: the spec so far, names of its parts, problems.

use endline_sim::DVec3;
use endline_sim::model::{ModelSpec, Settings};
use endline_sim::water::{Current, Water};

use crate::diagnostic::{At, Diagnostic, Place, hint};
use crate::entry::Entry;
use crate::fields::Problems;
use crate::items::{Condition, Rope};
use crate::library::Library;
use crate::limits;
use crate::scenario::{LineStart, Scenario};
use crate::schema::Kind;
use crate::strength::StrengthBudget;

use super::strength::Fleet;
use super::{Assembled, Hooks};

/// A part of the spec by kind and index; a line with inserts is a range of lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Body(usize),
    Joint(usize),
    Line { first: usize, last: usize },
    Link(usize),
    Obstacle(usize),
}

/// A line before it is cut into segments.
pub(super) struct Uncut {
    /// Unstretched length [m].
    pub length_m: f64,
    /// The shape it starts in.
    pub start: LineStart,
    /// Initial path, if its gear type states one [m].
    pub laid_m: Vec<DVec3>,
    /// Its place in a file, for messages.
    pub place: Place,
}

/// Factors on strength and stiffness of a rope of a line with a required delivered strength [1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// On the strength.
    pub strength: f64,
    /// On the stiffness.
    pub stiffness: f64,
}

/// Assembly in progress.
pub(super) struct Builder<'a> {
    /// The scenario.
    pub scenario: &'a Scenario,
    /// The gear library.
    pub library: &'a Library,
    /// The plugins.
    pub hooks: &'a dyn Hooks,
    /// Problems found so far.
    pub problems: Problems,
    /// Paths of library files used so far.
    pub used: Vec<String>,
    /// The spec so far.
    pub spec: ModelSpec,
    /// Library items of the spec's ropes.
    pub stock: Vec<Rope>,
    /// Materials of the spec's ropes, for friction.
    pub materials: Vec<At<String>>,
    /// Points of each body for lines, in the body's frame [m]; the default first.
    pub points: Vec<Vec<(String, DVec3)>>,
    /// The spec's lines before they are cut.
    pub uncut: Vec<Uncut>,
    /// Strength budgets of lines and weak links.
    pub strengths: Vec<StrengthBudget>,
    /// Variation of strength between gears of a fleet, for the assembly that is being added.
    pub fleet: Option<Fleet>,
    /// Whether gear could not be built; then unknown ids are not reported.
    pub incomplete: bool,
    /// Parts by id.
    names: Vec<(String, Part)>,
}

impl<'a> Builder<'a> {
    /// An empty spec with these settings.
    pub fn new(
        scenario: &'a Scenario,
        library: &'a Library,
        hooks: &'a dyn Hooks,
        settings: Settings,
    ) -> Self {
        let water = Water {
            density_kg_m3: 0.0,
            gravity_m_s2: 9.81,
            depth_m: 1.0,
            rope_dries: true,
            current: Current::uniform(DVec3::ZERO),
            waves: None,
        };
        let spec = ModelSpec {
            water,
            seabed: None,
            ropes: Vec::new(),
            joints: Vec::new(),
            lines: Vec::new(),
            bodies: Vec::new(),
            links: Vec::new(),
            gear: Vec::new(),
            whale: None,
            friction: None,
            obstacles: Vec::new(),
            probes: Vec::new(),
            settings,
        };
        Self {
            scenario,
            library,
            hooks,
            problems: Problems::default(),
            used: Vec::new(),
            spec,
            stock: Vec::new(),
            materials: Vec::new(),
            points: Vec::new(),
            uncut: Vec::new(),
            strengths: Vec::new(),
            fleet: None,
            incomplete: false,
            names: Vec::new(),
        }
    }

    /// Registers the id of a part; a duplicate id is reported.
    pub fn name(&mut self, id: String, part: Part, place: &Place) {
        let most = limits::PARTS.most as usize;
        if self.names.len() >= most {
            if self.names.len() == most {
                self.problems.push(place.error(
                    format!("the gear has more than {most} parts"),
                    format!("{}; take some out", limits::PARTS.words()),
                ));
                self.names.push((id, part));
            }
            return;
        }
        if self.names.iter().any(|(known, _)| *known == id) {
            self.problems.push(place.error(
                format!("there are two parts with the id `{id}`"),
                "give one of them another id",
            ));
        }
        if id.contains(':') && matches!(part, Part::Body(_) | Part::Joint(_)) {
            let message = format!("the id `{id}` has a colon");
            self.problems.push(
                place.error(message, "a colon separates a body from its point; choose another id"),
            );
        }
        self.names.push((id, part));
    }

    /// A part by id.
    pub fn part(&self, id: &str) -> Option<Part> {
        self.names.iter().find(|(known, _)| known == id).map(|(_, part)| *part)
    }

    /// Reports an id that names no part of the expected kind.
    pub fn unknown(&self, what: &str, id: &At<String>, wanted: fn(Part) -> bool) {
        if self.incomplete {
            return;
        }
        let known =
            self.names.iter().filter(|(_, part)| wanted(*part)).map(|(name, _)| name.as_str());
        self.problems.push(
            id.place.error(format!("there is no {what} `{}`", id.value), hint(&id.value, known)),
        );
    }

    /// Reports an item that is not in the library.
    pub fn no_item(&self, kind: Kind, id: &str, place: &Place) {
        self.problems.push(
            place.error(
                format!("no `{id}` in {}/", kind.folder()),
                hint(id, self.library.ids(kind)),
            ),
        );
    }

    /// An item of the library, whose file is used; a missing one is reported.
    pub fn item<T>(
        &mut self,
        kind: Kind,
        id: &At<String>,
        items: &'a [T],
        entry: fn(&T) -> &Entry,
    ) -> Option<&'a T> {
        let found = items.iter().find(|item| entry(item).id == id.value);
        match found {
            Some(item) => self.uses(&entry(item).path),
            None => self.no_item(kind, &id.value, &id.place),
        }
        found
    }

    /// Records a library file as used.
    pub fn uses(&mut self, path: &str) {
        self.used.push(path.to_owned());
    }

    /// Index in the spec of a rope in a condition, scaled for a required delivered strength; it is added if it is new.
    pub fn rope(
        &mut self,
        id: &At<String>,
        condition: &At<Condition>,
        scale: Option<Scale>,
    ) -> Option<usize> {
        let rope = self.rope_item(id)?;
        let mut made = match rope.in_condition(condition.value) {
            Ok(made) => made,
            Err(key) => {
                let message = format!(
                    "rope `{}` has no `{key}`, so it cannot be \"{}\"",
                    id.value,
                    condition.value.word()
                );
                return self.problems.refuse(
                    condition
                        .place
                        .error(message, format!("give it a `{key}`, or choose another condition")),
                );
            }
        };
        if let Some(scale) = scale {
            made = scaled(made, scale);
        }
        if let Some(index) = self.spec.ropes.iter().position(|known| known.id == made.id) {
            return Some(index);
        }
        if self.scenario.rope_bending {
            made.bending_stiffness_n_m2 = rope.bending_stiffness_n_m2;
        }
        self.materials.push(At { value: rope.material.clone(), place: id.place.clone() });
        self.stock.push(rope);
        self.spec.ropes.push(made);
        Some(self.spec.ropes.len() - 1)
    }

    /// A rope written in place, or of the library.
    fn rope_item(&mut self, id: &At<String>) -> Option<Rope> {
        let Some(rope) = self.find_rope(id, &self.problems) else {
            let mut known = self.library.ids(Kind::Rope);
            known.extend(self.scenario.ropes.iter().map(|entry| entry.id.as_str()));
            return self
                .problems
                .refuse(id.place.error(format!("no rope `{}`", id.value), hint(&id.value, known)));
        };
        if !self.scenario.ropes.iter().any(|entry| entry.id == id.value) {
            self.uses(&rope.entry.path);
        }
        Some(rope)
    }

    /// Finds a rope without a report of a missing one.
    pub fn find_rope(&self, id: &At<String>, problems: &Problems) -> Option<Rope> {
        match self.scenario.ropes.iter().find(|entry| entry.id == id.value) {
            Some(entry) => Rope::from_entry(entry.clone(), problems),
            None => self.library.ropes.iter().find(|rope| rope.entry.id == id.value).cloned(),
        }
    }

    /// The spec, or all problems.
    pub fn finish(mut self) -> Result<Assembled, Vec<Diagnostic>> {
        if self.problems.any_error() {
            return Err(self.problems.into_sorted());
        }
        self.used.sort();
        self.used.dedup();
        Ok(Assembled { spec: self.spec, files: self.used, strengths: self.strengths })
    }
}

/// A scaled rope, with its own id.
fn scaled(rope: endline_sim::model::Rope, scale: Scale) -> endline_sim::model::Rope {
    // The id distinguishes ropes to a tenth of a newton.
    let strength_n = (10.0 * rope.strength_n * scale.strength).round() / 10.0;
    endline_sim::model::Rope {
        id: format!("{} (new {strength_n:.1} N, stiffness {:.3})", rope.id, scale.stiffness),
        strength_n,
        axial_stiffness_n: rope.axial_stiffness_n * scale.stiffness,
        axial_stiffening_n: rope.axial_stiffening_n * scale.stiffness,
        axial_damping_n_s: rope.axial_damping_n_s * scale.stiffness,
        ..rope
    }
}
