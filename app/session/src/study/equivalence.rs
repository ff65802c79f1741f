//! Equivalence of runs: options that differ in strengths alone share a run until something parts.
//!
//! Ratings and breaking strengths enter the physics only where a tension exceeds them. Take a run in which nothing parted. An option
//! whose model differs from that of the run in strengths alone, all of them above every tension at their place in the run, has the same
//! run to the bit; its row is copied. So it is if something parted whose strength is the same in both. An option with `unbreakable = true` has no strengths, and is the strongest of all. With fixed steps, the greatest tensions of a run include those of every accepted step, so that a strength above
//! them changes nothing ([`MARGIN`] is for rounding). With steps that follow their error, a rejected step leaves no trace of its
//! tensions; [`PACED_MARGIN`] allows for those. `endline study replay` compares hashes.

use endline_sdk::AttributeValue;
use endline_sim::metrics::{LineSummary, LinkSummary, Summary};
use endline_sim::model::{Friction, FrictionLaw, GearHook, Line, Link, Rope, Settings, Whale};
use endline_sim::{Model, ModelSpec};

use super::plan::OptionPlan;

/// Share of a strength up to which tensions count as below it, with fixed steps.
const MARGIN: f64 = 0.99;

/// Share of a strength up to which tensions count as below it, with steps that follow their error.
const PACED_MARGIN: f64 = 0.7;

fn margin(spec: &ModelSpec) -> f64 {
    if spec.settings.auto_step { PACED_MARGIN } else { MARGIN }
}

/// Whether a model has the run of another with this summary.
pub(super) fn same_run(model: &Model, other: &Model, summary: &Summary) -> bool {
    same_so_far(model, other, summary) && same_until_parting(model, other)
}

/// Whether a model, known to differ in strengths alone from that of a run, shares the run up to this summary: each part has the strength
/// that it has in the run, or bears less than its strength in both.
pub(super) fn same_so_far(model: &Model, other: &Model, summary: &Summary) -> bool {
    let (one, other) = (&model.spec, &other.spec);
    let share = margin(one);
    if one.settings.unbreakable || other.settings.unbreakable {
        return nothing_parted(summary) && holds(one, summary, share);
    }
    let lines = one.lines.iter().zip(&other.lines).zip(&summary.lines);
    let links = one.links.iter().zip(&other.links).zip(&summary.links);
    lines.into_iter().all(|((line, other_line), borne)| {
        let is_same = line.strength == other_line.strength
            && rope_n(one, line).to_bits() == rope_n(other, other_line).to_bits();
        is_same || (borne.parted_at_s.is_none() && line_holds(one, line, borne, share))
    }) && links.into_iter().all(|((link, other_link), borne)| {
        let is_same = link.enabled == other_link.enabled
            && link.rating_n.to_bits() == other_link.rating_n.to_bits();
        is_same || (borne.parted_at_s.is_none() && link_holds(link, borne, share))
    })
}

/// Bound of the ratio of a part's strengths in two encounters, by scatter: factors are above 0.2, and 1.6 is six standard deviations
/// above the mean for the widest scatter in the library.
const SCATTER: f64 = 0.2 / 1.6;

/// Whether two models have the same run up to the moment when something first parts.
pub(super) fn same_until_parting(one: &Model, other: &Model) -> bool {
    differ_only_in_strength(&one.spec, &other.spec)
}

/// Whether an option certainly has the run of another of its [`family`], whose summary this is. Decided without assembling its model:
/// by the models of both options in any encounter, its own first.
pub(super) fn is_certainly_same_run(
    [bare, other_bare]: [&ModelSpec; 2],
    other: &Model,
    summary: &Summary,
) -> bool {
    // The other has the same strengths in both encounters only if none are drawn.
    let drawn = if strengths(&other.spec).eq(strengths(other_bare)) { 1.0 } else { SCATTER };
    nothing_parted(summary) && holds(bare, summary, margin(bare) * drawn)
}

/// Whether every tension of a run is below a share of a model's strengths. Run and model have the same lines and links.
fn holds(spec: &ModelSpec, summary: &Summary, share: f64) -> bool {
    let lines = spec.lines.iter().zip(&summary.lines);
    let links = spec.links.iter().zip(&summary.links);
    spec.settings.unbreakable
        || lines.into_iter().all(|(line, borne)| line_holds(spec, line, borne, share))
            && links.into_iter().all(|(link, borne)| link_holds(link, borne, share))
}

/// Whether the tensions of a line are below a share of its rope's strength, at its ends and between them.
fn line_holds(spec: &ModelSpec, line: &Line, borne: &LineSummary, share: f64) -> bool {
    let along_n = share * rope_n(spec, line) * line.strength.all;
    let factors = [line.strength.end_a, 1.0, line.strength.end_b];
    borne.place_peaks_n.iter().zip(factors).all(|(peak_n, left)| *peak_n < along_n * left)
}

/// Whether the tensions of a weak link are below a share of its rating.
fn link_holds(link: &Link, borne: &LinkSummary, share: f64) -> bool {
    let greatest_n = borne.peak_tension_n.max(borne.unconverged_peak_n);
    !link.enabled || greatest_n < share * link.rating_n
}

/// Strength of a line's rope [N].
fn rope_n(spec: &ModelSpec, line: &Line) -> f64 {
    spec.ropes[line.rope].strength_n
}

/// Last parts of the paths of strengths. Other settings may change a run without a trace in the model, such as the response of a
/// whale's motion to touch.
const STRENGTHS: [&str; 8] = [
    "delivered_strength",
    "keeps_stiffness",
    "rating",
    "strength",
    "unbreakable",
    "wear_factor",
    "weak_link",
    "weak_links",
];

/// Whether a setting at a path can change nothing but strengths, and what the models show: the item of a weak link is such a setting.
fn is_strength(path: &str) -> bool {
    let mut parts = path.rsplit('.');
    let last = parts.next().unwrap_or_default();
    STRENGTHS.contains(&last) || (last == "item" && parts.next_back() == Some("link"))
}

/// Whether two options differ in strengths alone in every encounter: they differ in settings of strengths only, their models differ in
/// strengths alone in one encounter, and drawn values reach both in the same fields.
pub(super) fn family(one: &OptionPlan, other: &OptionPlan, drawn_fields: &[&str]) -> bool {
    let own = |plan: &OptionPlan| -> Vec<String> {
        let set = plan
            .settings
            .iter()
            .map(|setting| setting.field.value.clone())
            .chain(plan.removes.iter().cloned());
        let mut own: Vec<String> =
            set.filter(|field| drawn_fields.contains(&field.as_str())).collect();
        own.sort();
        own
    };
    let only_strengths = |one: &OptionPlan, other: &OptionPlan| {
        one.sets.iter().all(|set| other.sets.contains(set) || is_strength(&set.0))
    };
    let removes = |plan: &OptionPlan| -> Vec<String> {
        plan.removes.iter().filter(|field| !is_strength(field)).cloned().collect()
    };
    let strengths =
        only_strengths(one, other) && only_strengths(other, one) && removes(one) == removes(other);
    strengths
        && own(one).is_empty()
        && own(other).is_empty()
        && differ_only_in_strength(&one.prepared.model.spec, &other.prepared.model.spec)
}

fn nothing_parted(summary: &Summary) -> bool {
    summary.lines.iter().all(|line| line.parted_at_s.is_none())
        && summary.links.iter().all(|link| link.parted_at_s.is_none())
}

/// Strength of each line at its weakest place [N].
fn ropes(spec: &ModelSpec) -> impl Iterator<Item = f64> {
    let holds = |line: &Line| {
        rope_n(spec, line)
            * line.strength.all
            * line.strength.end_a.min(line.strength.end_b).min(1.0)
    };
    spec.lines.iter().map(holds)
}

/// Strengths of lines and enabled links [N].
fn strengths(spec: &ModelSpec) -> impl Iterator<Item = f64> {
    ropes(spec).chain(spec.links.iter().filter(|link| link.enabled).map(|link| link.rating_n))
}

/// The least strength of a model, by which options are sorted; infinite if nothing can part [N].
pub(super) fn least_strength_n(spec: &ModelSpec) -> f64 {
    if spec.settings.unbreakable {
        return f64::INFINITY;
    }
    strengths(spec).fold(f64::INFINITY, f64::min)
}

/// Whether two models differ in nothing but the strengths of links and ropes. Structs are taken apart without `..`, so that a new
/// field is compared or left out on purpose.
fn differ_only_in_strength(one: &ModelSpec, other: &ModelSpec) -> bool {
    let ModelSpec {
        water,
        seabed,
        ropes,
        joints,
        lines,
        bodies,
        links,
        gear,
        whale,
        friction,
        obstacles,
        // A probe measures and changes nothing.
        probes: _,
        settings,
    } = one;
    let same_rope = |one: &Rope, other: &Rope| {
        *one == Rope { id: one.id.clone(), strength_n: one.strength_n, ..other.clone() }
    };
    let same_line =
        |one: &Line, other: &Line| *one == Line { strength: one.strength, ..other.clone() };
    let same_link = |one: &Link, other: &Link| {
        let Link { id, line, end, rating_n: _, enabled: _ } = one;
        (id, *line, *end) == (&other.id, other.line, other.end)
    };
    all(ropes, &other.ropes, same_rope)
        && all(lines, &other.lines, same_line)
        && all(links, &other.links, same_link)
        && all(gear, &other.gear, same_gear_type)
        && *joints == other.joints
        && *bodies == other.bodies
        && *obstacles == other.obstacles
        && *settings == Settings { unbreakable: settings.unbreakable, ..other.settings.clone() }
        && *water == other.water
        && *seabed == other.seabed
        && both(friction.as_ref(), other.friction.as_ref(), same_friction)
        && both(whale.as_ref(), other.whale.as_ref(), same_whale)
}

/// Whether two lists have one length and the same elements.
fn all<T>(ones: &[T], others: &[T], same: fn(&T, &T) -> bool) -> bool {
    ones.len() == others.len() && ones.iter().zip(others).all(|(one, other)| same(one, other))
}

/// Whether two values are the same, or neither is there.
fn both<T>(one: Option<&T>, other: Option<&T>, same: fn(&T, &T) -> bool) -> bool {
    match (one, other) {
        (Some(one), Some(other)) => same(one, other),
        (None, None) => true,
        _ => false,
    }
}

/// Gear types without a state that differ in items alone: what an item changes in the gear shows elsewhere in the model.
fn same_gear_type(one: &GearHook, other: &GearHook) -> bool {
    let GearHook { gear, attributes, lines, links } = one;
    let same_value = |one: &AttributeValue, other: &AttributeValue| {
        one == other || matches!((one, other), (AttributeValue::Item(_), AttributeValue::Item(_)))
    };
    let descriptor = gear.descriptor();
    descriptor.id == other.gear.descriptor().id
        && descriptor.state_len == 0
        && *lines == other.lines
        && *links == other.links
        && all(attributes, &other.attributes, same_value)
}

fn same_friction(one: &Friction, other: &Friction) -> bool {
    let same_law = |one: &FrictionLaw, other: &FrictionLaw| {
        let FrictionLaw { model, attributes } = one;
        model.descriptor().id == other.model.descriptor().id && *attributes == other.attributes
    };
    let Friction { laws, law_of, coefficients, law_of_bodies, coefficients_of_bodies } = one;
    all(laws, &other.laws, same_law)
        && *law_of == other.law_of
        && *coefficients == other.coefficients
        && *law_of_bodies == other.law_of_bodies
        && coefficients_of_bodies[..] == other.coefficients_of_bodies[..]
}

fn same_whale(one: &Whale, other: &Whale) -> bool {
    let Whale {
        skin,
        joints,
        length_m,
        measures,
        burst_speed_m_s,
        position_m,
        orientation,
        speed_m_s,
        motion,
        motion_attributes,
        pilot,
        contact_stiffness_n_m2,
        jaws,
        kinetic,
    } = one;
    let numbers = [
        (length_m, &other.length_m),
        (burst_speed_m_s, &other.burst_speed_m_s),
        (speed_m_s, &other.speed_m_s),
        (contact_stiffness_n_m2, &other.contact_stiffness_n_m2),
    ];
    motion.descriptor().id == other.motion.descriptor().id
        && *motion_attributes == other.motion_attributes
        && *pilot == other.pilot
        && *skin == other.skin
        && *joints == other.joints
        && *measures == other.measures
        && *jaws == other.jaws
        && *kinetic == other.kinetic
        && *position_m == other.position_m
        && *orientation == other.orientation
        && numbers.iter().all(|(one, other)| one.to_bits() == other.to_bits())
}

#[cfg(test)]
mod tests {
    use endline_fixtures::whale::still;
    use endline_sim::whale::jaws::JawStrength;
    use endline_sim::whale::skin::Skin;

    use super::*;

    fn whale(jaws: Option<JawStrength>) -> Whale {
        Whale { jaws, ..still(Skin::default()) }
    }

    #[test]
    fn whales_with_jaws_of_unlike_strength_are_different() {
        let jaws = |moment_n_m| Some(JawStrength { moment_n_m: [moment_n_m, 100.0, 100.0] });
        assert!(same_whale(&whale(jaws(1000.0)), &whale(jaws(1000.0))));
        assert!(!same_whale(&whale(jaws(1000.0)), &whale(jaws(1001.0))));
        assert!(!same_whale(&whale(jaws(1000.0)), &whale(None)));
    }
}
