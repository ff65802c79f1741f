//! Makes models: checks a spec, and lays out its nodes and segments.
//!
//! What a model must hold before anything moves: every problem is reported at once, with its part.

use std::ops::Range;
use std::sync::Arc;

use endline_sdk::LineEnd;

use crate::model::{
    Body, Gears, Joint, JointKind, Knot, Line, Link, Model, ModelError, ModelSpec, Obstacle,
    Resolution, Rope, Settings, Strength, WeakPlace,
};
use crate::step::rest;
use crate::water::Sea;
use crate::whale::tree::SkinTree;

impl Model {
    /// Checks a spec and lays out nodes and segments.
    /// Errors: all errors of the spec.
    pub fn new(spec: ModelSpec) -> Result<Self, Vec<ModelError>> {
        let errors = check(&spec);
        if !errors.is_empty() {
            return Err(errors);
        }
        let skin_tree =
            spec.whale.as_ref().map(|whale| Arc::new(SkinTree::new(whale.skin.clone())));
        let sea = Sea::new(&spec.water, spec.seabed.as_ref(), spec.settings.seed);
        Ok(Self::laid_out(spec, skin_tree, sea))
    }

    /// Lays out nodes and segments of a checked spec.
    fn laid_out(spec: ModelSpec, skin_tree: Option<Arc<SkinTree>>, sea: Sea) -> Self {
        let (mut line_nodes, mut line_segments) = (Vec::new(), Vec::new());
        let (mut node_count, mut segment_count) = (0, 0);
        for line in &spec.lines {
            let segments = line.segments_m.len();
            line_nodes.push(node_count..node_count + segments + 1);
            line_segments.push(segment_count..segment_count + segments);
            node_count += segments + 1;
            segment_count += segments;
        }
        let segment_line = spec
            .lines
            .iter()
            .enumerate()
            .flat_map(|(index, line)| std::iter::repeat_n(index, line.segments_m.len()))
            .collect();
        let rope_strength_n = spec
            .lines
            .iter()
            .flat_map(|line| strengths(line, spec.ropes[line.rope].strength_n))
            .collect();
        let knots = knots(&spec, &line_segments);
        debug_assert!(
            spec.lines.iter().flat_map(|line| &line.segments_m).all(|length| *length > 0.0),
            "segments have positive lengths"
        );
        Self {
            gears: Gears::of(&spec),
            may_be_held: rest::may_be_held(&spec),
            knots,
            spec,
            line_nodes,
            line_segments,
            node_count,
            segment_count,
            segment_line,
            rope_strength_n,
            skin_tree,
            sea,
        }
    }

    /// The gear with other lines in the same sea, without whale, plugins, links and probes.
    pub(crate) fn with_lines(&self, lines: Vec<Line>) -> Self {
        let spec = &self.spec;
        let alone = ModelSpec {
            water: spec.water.clone(),
            seabed: spec.seabed.clone(),
            ropes: spec.ropes.clone(),
            joints: spec.joints.clone(),
            lines,
            bodies: spec.bodies.clone(),
            links: Vec::new(),
            gear: Vec::new(),
            whale: None,
            friction: None,
            obstacles: spec.obstacles.clone(),
            probes: Vec::new(),
            settings: Settings { resolution: None, ..spec.settings.clone() },
        };
        Self::laid_out(alone, None, self.sea.clone())
    }

    /// Some gear of the model with the same whale, in the same sea.
    pub(crate) fn with_gear(&self, spec: ModelSpec) -> Self {
        Self::laid_out(spec, self.skin_tree.clone(), self.sea.clone())
    }

    /// A spec without a whale in the same sea, with the same wave components.
    pub(crate) fn with_spec(&self, spec: ModelSpec) -> Self {
        Self::laid_out(spec, None, self.sea.clone())
    }

    /// The gear alone in a fraction of its current.
    pub(crate) fn with_current_times(&self, share: f64) -> Self {
        let mut weaker = self.with_lines(self.spec.lines.clone());
        weaker.spec.water.current.surface_m_s *= share;
        weaker.sea.weaken_current(share);
        weaker
    }
}

/// Knots at the ends of lines: at a free joint only the largest, centred on it; at a body or fixture all, each beside the
/// joint.
fn knots(spec: &ModelSpec, line_segments: &[Range<usize>]) -> Vec<Knot> {
    let mut knots: Vec<(usize, Knot)> = Vec::new();
    for (line, segments) in spec.lines.iter().zip(line_segments) {
        let ends =
            [(LineEnd::A, line.from, segments.start), (LineEnd::B, line.to, segments.end - 1)];
        for ((end, joint, segment), radius_m) in ends.into_iter().zip(line.knots_m) {
            let is_free = matches!(spec.joints[joint].kind, JointKind::Free);
            let from_end_m = if is_free { 0.0 } else { radius_m };
            let knot = Knot { segment, end, from_end_m, radius_m };
            let other = knots.iter_mut().find(|(of, _)| is_free && *of == joint);
            match other {
                Some((_, other)) if other.radius_m < radius_m => *other = knot,
                None if radius_m > 0.0 => knots.push((joint, knot)),
                _ => {}
            }
        }
    }
    let mut knots: Vec<Knot> = knots.into_iter().map(|(_, knot)| knot).collect();
    knots.sort_by_key(|knot| knot.segment);
    knots
}

/// Strength of each segment of a line; the factor of an end applies to the segment at that end.
fn strengths(line: &Line, rope_n: f64) -> Vec<f64> {
    let Strength { all, end_a, end_b } = line.strength;
    debug_assert!(!line.segments_m.is_empty(), "a line has at least one segment");
    let mut strengths = vec![rope_n * all; line.segments_m.len()];
    let last = strengths.len() - 1;
    strengths[0] *= end_a;
    strengths[last] = strengths[last].min(rope_n * all * end_b);
    strengths
}

/// Returns all errors of a spec.
pub(crate) fn check(spec: &ModelSpec) -> Vec<ModelError> {
    let mut found = Found { part: String::new(), errors: Vec::new() };
    check_water(spec, &mut found);
    for rope in &spec.ropes {
        check_rope(rope, found.of("rope", &rope.id));
    }
    for body in &spec.bodies {
        check_body(body, found.of("body", &body.id));
    }
    for joint in &spec.joints {
        check_joint(spec, joint, found.of("joint", &joint.id));
    }
    for line in &spec.lines {
        check_line(spec, line, found.of("line", &line.id));
    }
    for link in &spec.links {
        check_link(spec, link, found.of("link", &link.id));
    }
    for obstacle in &spec.obstacles {
        check_obstacle(obstacle, found.of("obstacle", &obstacle.id));
    }
    check_whale(spec, found.of("whale", ""));
    found.errors
}

/// Errors found, and the part under test.
struct Found {
    part: String,
    errors: Vec<ModelError>,
}

impl Found {
    fn of(&mut self, kind: &str, id: &str) -> &mut Self {
        self.part = format!("{kind} {id}").trim_end().into();
        self
    }

    fn need(&mut self, holds: bool, message: &str) {
        if !holds {
            self.errors.push(ModelError { part: self.part.clone(), message: message.into() });
        }
    }

    fn above_zero(&mut self, name: &str, value: f64) {
        self.need(
            value.is_finite() && value > 0.0,
            &format!("{name} is {value}, expected a number above zero"),
        );
    }

    fn not_below_zero(&mut self, name: &str, value: f64) {
        self.need(
            value.is_finite() && value >= 0.0,
            &format!("{name} is {value}, expected zero or more"),
        );
    }
}

fn check_water(spec: &ModelSpec, found: &mut Found) {
    let found = found.of("water", "");
    found.not_below_zero("density", spec.water.density_kg_m3);
    found.not_below_zero("gravity", spec.water.gravity_m_s2);
    found.above_zero("depth", spec.water.depth_m);
    spec.water.problems().into_iter().for_each(|problem| found.need(false, &problem));
    if let Some(seabed) = &spec.seabed {
        let found = found.of("seabed", "");
        found.above_zero("stiffness under rope", seabed.rope_stiffness_n_m2);
        found.above_zero("stiffness under a foot", seabed.foot_stiffness_n_m);
        found.not_below_zero("friction", seabed.rope_friction);
        found.need(
            (seabed.normal.length() - 1.0).abs() < 1e-9 && seabed.normal.z > 0.0,
            "its normal is not a unit vector that points up",
        );
    }
    let found = found.of("settings", "");
    found.above_zero("step", spec.settings.step_s);
    found.above_zero("contact step", spec.settings.contact_step_s);
    found.above_zero("contact tolerance", spec.settings.contact_tolerance);
    found.above_zero("least step", spec.settings.least_step_s);
    found.above_zero("duration", spec.settings.duration_s);
    if let Some(Resolution { near_m, edge_m, far_m }) = spec.settings.resolution {
        found.above_zero("resolution near the whale", near_m);
        found.above_zero("resolution near edges", edge_m);
        found.above_zero("resolution far from the whale", far_m);
        found.need(
            edge_m <= near_m && near_m <= far_m,
            "resolution is not finest near edges and coarsest far from the whale",
        );
    }
}

fn check_rope(rope: &Rope, found: &mut Found) {
    found.above_zero("diameter", rope.diameter_m);
    found.above_zero("mass per metre", rope.mass_kg_m);
    found.not_below_zero("displaced volume per metre", rope.displaced_m3_m);
    found.above_zero("axial stiffness", rope.axial_stiffness_n);
    found.not_below_zero("axial stiffening", rope.axial_stiffening_n);
    found.not_below_zero("axial damping", rope.axial_damping_n_s);
    found.not_below_zero("axial damping ratio", rope.axial_damping_ratio);
    found.not_below_zero("bending stiffness", rope.bending_stiffness_n_m2);
    found.not_below_zero("normal drag coefficient", rope.drag_normal);
    found.not_below_zero("tangential drag coefficient", rope.drag_tangential);
    found.need(
        (0.0..=1.0).contains(&rope.drag_tangential_viscous),
        "viscous share of the tangential drag is not between 0 and 1",
    );
    found.above_zero("speed of the tangential drag coefficient", rope.drag_tangential_speed_m_s);
    found.not_below_zero("added mass coefficient", rope.added_mass_normal);
    found.not_below_zero("added mass coefficient along", rope.added_mass_tangential);
    found.need(rope.strength_n > 0.0, "strength is not above zero");
}

fn check_body(body: &Body, found: &mut Found) {
    found.need(!body.parts.is_empty(), "it has no part");
    found.above_zero("mass", body.mass_kg);
    found.need(
        body.inertia_kg_m2.is_finite() && body.inertia_kg_m2.min_element() > 0.0,
        "moments of inertia are not all above zero",
    );
    let zero_or_more =
        [body.added_mass_kg, body.added_inertia_kg_m2, body.drag_area_m2, body.turn_drag_m5];
    found.need(
        zero_or_more.iter().all(|v| v.is_finite() && v.min_element() >= 0.0),
        "an added mass, added inertia or drag is below zero",
    );
    found.need(
        body.position_m.is_finite() && body.orientation.is_normalized(),
        "its initial position is not finite or its orientation is not a unit quaternion",
    );
    for float in &body.floats {
        found.not_below_zero("volume of a float", float.volume_m3);
        found.need(float.form.is_sound(), "a measure of a float is not above zero");
        found.need(float.offset_m.is_finite(), "the position of a float is not a finite number");
        found.need(
            float.drag_area_m2.is_finite() && float.drag_area_m2.min_element() >= 0.0,
            "the drag of a float is below zero",
        );
    }
    found.not_below_zero("start friction", body.start_friction);
    found.not_below_zero("slide friction", body.slide_friction);
    found.not_below_zero("break-out force of a foot", body.foot_break_out_n);
}

fn check_joint(spec: &ModelSpec, joint: &Joint, found: &mut Found) {
    found.need(joint.position_m.is_finite(), "its position is not a finite number");
    match joint.kind {
        JointKind::Body { body, .. } => {
            found.need(body < spec.bodies.len(), "its body does not exist")
        }
        JointKind::Whale(hitch) => {
            let triangles = spec.whale.as_ref().map_or(0, |whale| whale.skin.triangles.len());
            found.need(
                hitch.triangle < triangles,
                "it is attached to a whale or a skin triangle that does not exist",
            );
            let sound = hitch
                .barycentric
                .iter()
                .chain([&hitch.stand_off_m])
                .all(|number| number.is_finite());
            found.need(sound, "its position on the whale's skin is not a finite number");
        }
        JointKind::Pulled { force_n, .. } => {
            found.need(force_n.is_finite(), "the force on it is not a finite number")
        }
        _ => {}
    }
}

fn check_obstacle(obstacle: &Obstacle, found: &mut Found) {
    found.need(
        obstacle.position_m.is_finite() && obstacle.orientation.is_normalized(),
        "its position is not finite or its orientation is not a unit quaternion",
    );
    if let Some(fault) = obstacle.shape.fault() {
        found.need(false, fault);
    }
    found.not_below_zero("friction", obstacle.friction);
    found.above_zero("stiffness under rope", obstacle.stiffness_n_m2);
}

fn check_line(spec: &ModelSpec, line: &Line, found: &mut Found) {
    found.need(line.rope < spec.ropes.len(), "its rope does not exist");
    found.need(
        line.from < spec.joints.len() && line.to < spec.joints.len(),
        "the joint of an end does not exist",
    );
    found.need(line.from != line.to, "both ends are at the same joint");
    found.need(!line.segments_m.is_empty(), "it has no segments");
    found.need(
        line.segments_m.iter().all(|length| length.is_finite() && *length > 0.0),
        "a segment's length is not above zero",
    );
    let shares = [line.strength.all, line.strength.end_a, line.strength.end_b];
    found.need(
        shares.iter().all(|share| share.is_finite() && *share > 0.0),
        "a share of its strength is not above zero",
    );
    let length_m: f64 = line.segments_m.iter().sum();
    let sound = |place: &WeakPlace| {
        (0.0..=length_m).contains(&place.at_m)
            && place.strength_n.is_finite()
            && place.strength_n > 0.0
    };
    found.need(
        line.weak_places.iter().all(sound) && line.weak_places.is_sorted_by_key(|place| place.at_m),
        "a weak place is not on it, or its strength is not above zero, or they are not sorted by length",
    );
    found.need(
        line.knots_m.iter().all(|radius| radius.is_finite() && *radius >= 0.0),
        "the radius of a knot is below zero",
    );
    found.need(
        line.start_m.is_empty() || line.start_m.len() == line.segments_m.len() + 1,
        "its initial guess has a wrong number of nodes",
    );
}

fn check_link(spec: &ModelSpec, link: &Link, found: &mut Found) {
    found.need(link.line < spec.lines.len(), "its line does not exist");
    found.above_zero("rating", link.rating_n);
}

fn check_whale(spec: &ModelSpec, found: &mut Found) {
    let Some(whale) = &spec.whale else { return };
    let skin = &whale.skin;
    found.above_zero("length", whale.length_m);
    found.above_zero("contact stiffness", whale.contact_stiffness_n_m2);
    found.need(whale.pilot.is_sound(), "an entry of its pilot program has a number that is not finite, or follows an entry that is not before it");
    found.need(
        whale.position_m.is_finite() && whale.orientation.is_normalized(),
        "its initial position is not finite or its orientation is not a unit quaternion",
    );
    found.need(
        !skin.triangles.is_empty() && !skin.bones.is_empty(),
        "its skin has no triangles or no bones",
    );
    found.need(
        skin.regions.len() == skin.triangles.len(),
        "its skin needs one region for each triangle",
    );
    found.need(skin.weights.len() == skin.vertices.len(), "its skin needs weights for each vertex");
    let corners = skin.triangles.iter().flatten();
    found.need(
        corners.into_iter().all(|corner| (*corner as usize) < skin.vertices.len()),
        "a triangle refers to a vertex that does not exist",
    );
    let named =
        skin.weights.iter().flatten().all(|(bone, _)| usize::from(*bone) < skin.bones.len());
    found.need(named, "a vertex refers to a bone that does not exist");
    if let Some(fault) = whale.kinetic.as_ref().and_then(|kinetic| kinetic.fault()) {
        found.need(false, fault);
    }
    let Some(friction) = &spec.friction else {
        found.need(false, "a whale needs a friction model");
        return;
    };
    found.need(
        friction.coefficients.len() == spec.ropes.len(),
        "friction needs a row of coefficients for each rope",
    );
    let rows = friction.law_of.len() == spec.ropes.len()
        && friction.law_of.iter().flatten().all(|law| *law < friction.laws.len());
    found.need(
        rows && !friction.laws.is_empty(),
        "friction needs a row of valid laws for each rope",
    );
    found.need(
        friction.law_of_bodies.iter().all(|law| *law < friction.laws.len()),
        "friction of bodies refers to a law that does not exist",
    );
    let coefficients = friction.coefficients.iter().flatten();
    let sound = coefficients
        .chain(&friction.coefficients_of_bodies)
        .all(|value| value.is_finite() && *value >= 0.0);
    found.need(sound, "a coefficient of friction is below zero or not finite");
}
