//! Gear as rules see it, read from an assembled model: endlines, groundlines, surface lines.
//!
//! The kind of a line follows from the parts that it joins.
//!
//! | line | rule |
//! |---|---|
//! | endline | from a buoy to the first trap, anchor or branch below it |
//! | surface line | between two buoys |
//! | hold | has a weak link whose item ends in `release`: no line of the gear |
//! | gangion, bridle | by its id |
//! | netting | by its id or the item of its rope; also counted as groundline |
//! | groundline | any other |
//!
//! A buoy that an assembly puts into the lower half of the water has no endline: it is a float, or stowed where a release
//! holds gear down.

use endline_gear::{Assembled, Library, StrengthBudget, WEAK_PLACES};
use endline_sdk::LineEnd;
use endline_sim::model::{BodyRole, JointKind, Line, Link, WeakPlace};

/// Gear as rules see it.
#[derive(Clone, Debug, Default)]
pub(super) struct Gear {
    /// Traps.
    pub traps: usize,
    /// Buoys with a piece named radar reflector.
    pub reflectors: usize,
    /// Ids of floats: buoys with neither endline nor surface line.
    pub floats: Vec<String>,
    /// Whether a release holds a buoy down.
    pub stowed: bool,
    /// Endlines.
    pub endlines: Vec<Endline>,
    /// Groundlines.
    pub groundlines: Vec<Piece>,
    /// Lines of netting between headline and leadline of a gillnet.
    pub netting_lines: usize,
    /// Lengths of lines between buoys [m].
    pub surface_m: Vec<f64>,
}

/// A line from a buoy to the seabed.
#[derive(Clone, Debug, Default)]
pub(super) struct Endline {
    /// Id of its line at the buoy.
    pub id: String,
    /// Id of its buoy.
    pub buoy: String,
    /// Its pieces from the buoy down; sleeves, links and weak places have no length.
    pub pieces: Vec<Piece>,
    /// Id of the weak link at the buoy, and its rating [N].
    pub buoy_link: Option<(String, f64)>,
}

impl Endline {
    /// The lines that it consists of, for messages.
    pub fn name(&self) -> String {
        match self.pieces.last() {
            Some(last) if last.line != self.id => format!("{} to {}", self.id, last.line),
            _ => self.id.clone(),
        }
    }
}

/// A piece of a line, or a sleeve, link or weak place in it.
#[derive(Clone, Debug, Default)]
pub(super) struct Piece {
    /// Its id.
    pub id: String,
    /// Id of the line that it is a piece of.
    pub line: String,
    /// Whether its line's end `to` is the one nearer to the buoy.
    pub from_to: bool,
    /// Id of its rope or its link; of weak places, their number and lengths.
    pub item: String,
    /// Unstretched length; zero for a sleeve, link or weak place [m].
    pub length_m: f64,
    /// Diameter of its rope [m].
    pub diameter_m: f64,
    /// Density of its rope [kg/m³].
    pub density_kg_m3: f64,
    /// Strength of new material as its source states it [N].
    pub rated_n: f64,
    /// Mean strength of new pieces [N].
    pub new_n: f64,
    /// Mean strength delivered [N].
    pub delivered_n: f64,
}

/// A line as it is walked: its index, the end at which it is entered.
type Step = (usize, LineEnd);

/// Reads an assembled model.
struct Reader<'a> {
    made: &'a Assembled,
    /// Lines that hold stowed rope or a stowed buoy.
    holds: Vec<bool>,
}

/// The endlines, groundlines and bodies of assembled gear.
pub(super) fn gear_of(made: &Assembled, library: &Library) -> Gear {
    let reader = Reader { made, holds: holds(made) };
    let mut gear = Gear { stowed: reader.holds.contains(&true), ..Gear::default() };
    let mut taken = reader.holds.clone();
    for (index, body) in made.spec.bodies.iter().enumerate() {
        match body.role {
            BodyRole::Trap => gear.traps += 1,
            BodyRole::Buoy => {
                gear.reflectors += usize::from(has_reflector(library, &body.item));
                if !reader.take_buoy(index, &mut gear, &mut taken) {
                    gear.floats.push(body.id.clone());
                }
            }
            BodyRole::Anchor | BodyRole::Weight => {}
        }
    }
    gear.netting_lines = (0..made.spec.lines.len()).filter(|line| reader.is_netting(*line)).count();
    let on_seabed = |line: &Line| !line.id.contains("gangion") && !line.id.contains("bridle");
    let lines = made.spec.lines.iter().enumerate();
    let left = lines.filter(|(index, line)| !taken[*index] && on_seabed(line));
    gear.groundlines = left.map(|(index, _)| reader.piece(index)).collect();
    gear
}

impl Reader<'_> {
    /// Walks every line of a buoy; whether one of them is an endline or a surface line.
    fn take_buoy(&self, buoy: usize, gear: &mut Gear, taken: &mut [bool]) -> bool {
        let mut is_held = false;
        let spec = &self.made.spec;
        let is_sunk = spec.bodies[buoy].position_m.z < -0.5 * spec.water.depth_m;
        if is_sunk && !gear.stowed {
            return false;
        }
        let of_buoy = |joint: usize| matches!(spec.joints[joint].kind, JointKind::Body { body, .. } if body == buoy);
        let joints: Vec<usize> = (0..spec.joints.len()).filter(|joint| of_buoy(*joint)).collect();
        for step in joints.iter().flat_map(|joint| self.steps(*joint)) {
            let (path, last) = self.walk(step);
            if is_sunk {
                // A stowed endline stands in no water and lies along no groundline.
                path.iter().for_each(|(line, _)| taken[*line] = true);
                is_held = true;
                continue;
            }
            let ends_at = self.role_at(last);
            if ends_at == Some(BodyRole::Buoy) {
                // A surface line is walked from both its buoys and counted once.
                if !path.iter().any(|(line, _)| taken[*line]) {
                    gear.surface_m.push(path.iter().map(|(line, _)| self.length_m(*line)).sum());
                }
            } else if ends_at.is_some() || self.is_fixture(last) || self.steps(last).len() > 1 {
                let buoy = spec.bodies[buoy].id.clone();
                gear.endlines.push(Endline { buoy, ..self.endline(&path) });
            } else {
                continue;
            }
            is_held = true;
            path.iter().for_each(|(line, _)| taken[*line] = true);
        }
        is_held
    }

    /// Line ends at a joint, without those of holds.
    fn steps(&self, joint: usize) -> Vec<Step> {
        let lines = self.made.spec.lines.iter().enumerate();
        let at = |(index, line): (usize, &Line)| {
            let a = (line.from == joint).then_some((index, LineEnd::A));
            let b = (line.to == joint).then_some((index, LineEnd::B));
            a.into_iter().chain(b)
        };
        lines.filter(|(index, _)| !self.holds[*index]).flat_map(at).collect()
    }

    /// Follows a line and those spliced to it; the path, and the joint where it ends.
    fn walk(&self, first: Step) -> (Vec<Step>, usize) {
        let (mut path, mut step) = (Vec::new(), first);
        loop {
            path.push(step);
            let line = &self.made.spec.lines[step.0];
            let joint = if step.1 == LineEnd::A { line.to } else { line.from };
            let free = matches!(self.made.spec.joints[joint].kind, JointKind::Free);
            let ends = self.steps(joint);
            let onward = ends.iter().find(|end| end.0 != step.0);
            match onward {
                Some(next) if free && ends.len() == 2 && path.len() <= self.holds.len() => {
                    step = *next;
                }
                _ => return (path, joint),
            }
        }
    }

    fn role_at(&self, joint: usize) -> Option<BodyRole> {
        match self.made.spec.joints[joint].kind {
            JointKind::Body { body, .. } => Some(self.made.spec.bodies[body].role),
            _ => None,
        }
    }

    /// A place that does not move, such as the foot of a scenario's own endline.
    fn is_fixture(&self, joint: usize) -> bool {
        matches!(self.made.spec.joints[joint].kind, JointKind::Fixed)
    }

    /// Whether a line stands for netting: its id, or the item of its rope, says so.
    fn is_netting(&self, line: usize) -> bool {
        let id = &self.made.spec.lines[line].id;
        let item = self.budget(id).map_or("", |budget| budget.item.as_str());
        [id.as_str(), item].iter().any(|name| name.contains("netting"))
    }

    fn length_m(&self, line: usize) -> f64 {
        self.made.spec.lines[line].segments_m.iter().sum()
    }

    /// The pieces of a path, with the links between them.
    fn endline(&self, path: &[Step]) -> Endline {
        let mut endline = Endline::default();
        for (number, (line, entered)) in path.iter().enumerate() {
            let left = if *entered == LineEnd::A { LineEnd::B } else { LineEnd::A };
            for link in self.links(*line, *entered) {
                if number == 0 {
                    let rated = self.budget(&link.id).map(rated_n);
                    endline.buoy_link = rated.map(|rated| (link.id.clone(), rated));
                } else {
                    endline.pieces.push(self.link(link));
                }
            }
            endline.pieces.extend(self.pieces_of(*line, *entered));
            endline.pieces.extend(self.links(*line, left).map(|link| self.link(link)));
        }
        let top = endline.pieces.first().map(|piece| piece.id.as_str()).unwrap_or_default();
        endline.id = whole(top);
        endline
    }

    fn links(&self, line: usize, end: LineEnd) -> impl Iterator<Item = &Link> {
        self.made.spec.links.iter().filter(move |link| link.line == line && link.end == end)
    }

    fn budget(&self, id: &str) -> Option<&StrengthBudget> {
        self.made.strengths.iter().find(|budget| budget.part == id)
    }

    fn link(&self, link: &Link) -> Piece {
        let line = whole(&self.made.spec.lines[link.line].id);
        let piece = Piece { id: link.id.clone(), line, ..Piece::default() };
        self.with_strength(piece, link.rating_n)
    }

    fn piece(&self, line: usize) -> Piece {
        let spec = &self.made.spec;
        let rope = &spec.ropes[spec.lines[line].rope];
        let piece = Piece {
            id: spec.lines[line].id.clone(),
            line: whole(&spec.lines[line].id),
            length_m: self.length_m(line),
            diameter_m: rope.diameter_m,
            density_kg_m3: rope.mass_kg_m / rope.displaced_m3_m,
            ..Piece::default()
        };
        self.with_strength(piece, rope.strength_n)
    }

    /// A line from the end at which it is entered: its rope between weak places, which have no length.
    fn pieces_of(&self, line: usize, entered: LineEnd) -> Vec<Piece> {
        let from_to = entered == LineEnd::B;
        let rope = Piece { from_to, ..self.piece(line) };
        let places = &self.made.spec.lines[line].weak_places;
        let at_m =
            |place: &WeakPlace| if from_to { rope.length_m - place.at_m } else { place.at_m };
        let (mut pieces, mut done_m) = (Vec::new(), 0.0);
        let mut add = |place: &WeakPlace| {
            let length_m = (at_m(place) - done_m).max(0.0);
            done_m += length_m;
            let id = format!("{}.{WEAK_PLACES}", rope.id);
            let weak = Piece { id, line: rope.line.clone(), from_to, ..Piece::default() };
            pieces.push(Piece { length_m, ..rope.clone() });
            pieces.push(self.with_strength(weak, place.strength_n));
        };
        if from_to {
            places.iter().rev().for_each(&mut add);
        } else {
            places.iter().for_each(&mut add);
        }
        pieces.push(Piece { length_m: (rope.length_m - done_m).max(0.0), ..rope });
        pieces
    }

    /// A piece with the strengths of its budget, or with one for all where it has none.
    fn with_strength(&self, piece: Piece, usual_n: f64) -> Piece {
        let budget = self.budget(&piece.id);
        let or_usual = |of: fn(&StrengthBudget) -> f64| budget.map_or(usual_n, of);
        Piece {
            item: budget.map(|budget| budget.item.clone()).unwrap_or_default(),
            rated_n: or_usual(rated_n),
            new_n: or_usual(new_n),
            delivered_n: or_usual(StrengthBudget::delivered_n),
            ..piece
        }
    }
}

/// The line that a piece is of: a line with inserts is cut into `line.1`, `line.insert-1`, `line.2`.
fn whole(piece: &str) -> String {
    piece.split('.').next().unwrap_or(piece).to_owned()
}

/// Which lines hold stowed gear down.
fn holds(made: &Assembled) -> Vec<bool> {
    let is_release = |link: &Link| {
        made.strengths
            .iter()
            .any(|budget| budget.part == link.id && budget.item.ends_with("release"))
    };
    let mut holds = vec![false; made.spec.lines.len()];
    for link in made.spec.links.iter().filter(|link| is_release(link)) {
        holds[link.line] = true;
    }
    holds
}

/// The product of the factors of a budget that are named.
fn with_factors(budget: &StrengthBudget, names: &[&str]) -> f64 {
    let factors = budget.factors.iter().filter(|factor| names.contains(&factor.name.as_str()));
    factors.fold(budget.stated.value, |left, factor| left * factor.figure.value)
}

/// As its source states it; a line made to deliver a strength has rope of its own.
fn rated_n(budget: &StrengthBudget) -> f64 {
    with_factors(budget, &["made to deliver"])
}

fn new_n(budget: &StrengthBudget) -> f64 {
    with_factors(budget, &["made to deliver", "mean of new pieces"])
}

fn has_reflector(library: &Library, item: &str) -> bool {
    let buoy = library.buoys.iter().find(|buoy| buoy.entry.name == item);
    buoy.is_some_and(|buoy| buoy.entry.pieces.iter().any(|piece| piece.name == "radar reflector"))
}
