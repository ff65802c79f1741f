//! Equivalence of runs: options that differ in strengths alone share a run until something parts.
//!
//! Ratings and breaking strengths enter the physics only where a tension exceeds them. Take a run, and a model that differs from its model
//! in strengths alone. The model has the same run to the bit if each rope and each weak link
//!
//! - has the same strength in both, or
//! - did not part, is no weaker in the run, and is stronger in the model than its greatest tension at that place.
//!
//! A part that is weaker in the run could have shortened a step there without parting. An option with `unbreakable = true` has infinite
//! strengths. With fixed steps, the greatest tensions of a run include those of every accepted step, so that a strength above them changes
//! nothing ([`MARGIN`] is for rounding). With steps that follow their error, a rejected step leaves no trace of its tensions;
//! [`PACED_MARGIN`] allows for those. `endline study replay` compares hashes.

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

/// Whether a model, known to differ in strengths alone from that of a run, shares the run up to this summary.
pub(super) fn same_so_far(model: &Model, other: &Model, summary: &Summary) -> bool {
    let (one, other) = (&model.spec, &other.spec);
    let share = margin(one);
    parts(one)
        .zip(parts(other))
        .zip(borne(summary))
        .all(|((own_n, run_n), borne)| shares(own_n, run_n, &borne, share))
}

/// Whether two models have the same run up to the moment when something first parts.
pub(super) fn same_until_parting(one: &Model, other: &Model) -> bool {
    differ_only_in_strength(&one.spec, &other.spec)
}

/// Bound of the ratio of a part's strengths in two encounters, by scatter: factors are above 0.2, and 1.6 is six standard deviations
/// above the mean for the widest scatter in the library.
const SCATTER: f64 = 0.2 / 1.6;

/// Whether an option certainly has the run of another of its [`family`], whose summary this is. Decided without assembling its model:
/// by the models of both options in any encounter, its own first.
pub(super) fn is_certainly_same_run(
    [bare, other_bare]: [&ModelSpec; 2],
    other: &Model,
    summary: &Summary,
) -> bool {
    // The other has the same strengths in both encounters only if none are drawn.
    let drawn = if strengths(&other.spec).eq(strengths(other_bare)) { 1.0 } else { SCATTER };
    let share = margin(bare) * drawn;
    parts(bare).zip(parts(other_bare)).zip(borne(summary)).all(|((own_n, run_n), borne)| {
        !borne.parted && is_no_weaker(run_n, own_n) && holds(own_n, &borne, share)
    })
}

/// What a rope or weak link bore in a run.
struct Borne {
    /// Greatest tension of each place [N].
    peaks_n: [f64; 3],
    parted: bool,
}

/// What every line and then every link bore.
fn borne(summary: &Summary) -> impl Iterator<Item = Borne> {
    let line = |line: &LineSummary| Borne {
        peaks_n: line.place_peaks_n,
        parted: line.parted_at_s.is_some(),
    };
    let link = |link: &LinkSummary| Borne {
        peaks_n: [link.peak_tension_n.max(link.unconverged_peak_n); 3],
        parted: link.parted_at_s.is_some(),
    };
    summary.lines.iter().map(line).chain(summary.links.iter().map(link))
}

/// Strengths of every line, in its first segment, between, and in its last one, and then of every link; infinite if it cannot part [N].
fn parts(spec: &ModelSpec) -> impl Iterator<Item = [f64; 3]> {
    let unbreakable = spec.settings.unbreakable;
    let line = |line: &Line| {
        let along_n = spec.ropes[line.rope].strength_n * line.strength.all;
        [line.strength.end_a, 1.0, line.strength.end_b].map(|left| along_n * left)
    };
    let link = |link: &Link| [if link.enabled { link.rating_n } else { f64::INFINITY }; 3];
    let all = spec.lines.iter().map(line).chain(spec.links.iter().map(link));
    all.map(move |strengths| if unbreakable { [f64::INFINITY; 3] } else { strengths })
}

/// Whether a part of a model behaves as that of a run, in which it bore this.
fn shares(own_n: [f64; 3], run_n: [f64; 3], borne: &Borne, share: f64) -> bool {
    let is_weaker_in_run = !is_no_weaker(run_n, own_n);
    let is_same = !is_weaker_in_run && is_no_weaker(own_n, run_n);
    is_same || (!borne.parted && !is_weaker_in_run && holds(own_n, borne, share))
}

/// Whether strengths are at least others at each place.
fn is_no_weaker(one_n: [f64; 3], other_n: [f64; 3]) -> bool {
    one_n.iter().zip(other_n).all(|(one, other)| *one >= other)
}

/// Whether every tension that a part bore is below a share of its strength there.
fn holds(strengths_n: [f64; 3], borne: &Borne, share: f64) -> bool {
    borne.peaks_n.iter().zip(strengths_n).all(|(peak_n, strength_n)| *peak_n < share * strength_n)
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

/// The least strength of a model, by which options are sorted; infinite if nothing can part [N].
pub(super) fn least_strength_n(spec: &ModelSpec) -> f64 {
    parts(spec).flatten().fold(f64::INFINITY, f64::min)
}

/// Strengths of lines and links, whether or not they can part [N].
fn strengths(spec: &ModelSpec) -> impl Iterator<Item = f64> {
    let line = |line: &Line| spec.ropes[line.rope].strength_n * line.strength.all;
    spec.lines.iter().map(line).chain(spec.links.iter().map(|link| link.rating_n))
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
    fn a_part_is_shared_if_it_is_the_same_or_holds_and_is_no_weaker_in_the_run() {
        let borne = |parted| Borne { peaks_n: [50.0, 100.0, 80.0], parted };
        let shares = |own_n, run_n, parted| shares(own_n, run_n, &borne(parted), MARGIN);
        let (strong, weak) = ([200.0; 3], [60.0, 120.0, 90.0]);
        assert!(shares(strong, strong, true), "the same strength, parted in both");
        assert!(shares(weak, strong, false), "weaker than in the run, and holds");
        assert!(shares(weak, [f64::INFINITY; 3], false), "the run is unbreakable");
        assert!(!shares(strong, weak, false), "weaker in the run, where it could shorten a step");
        assert!(!shares(weak, strong, true), "parted in the run");
        assert!(!shares([60.0, 100.5, 90.0], strong, false), "within the margin of rounding");
        assert!(!shares([49.0, 120.0, 90.0], strong, false), "overloaded in its first segment");
    }

    #[test]
    fn whales_with_jaws_of_unlike_strength_are_different() {
        let jaws = |moment_n_m| Some(JawStrength { moment_n_m: [moment_n_m, 100.0, 100.0] });
        assert!(same_whale(&whale(jaws(1000.0)), &whale(jaws(1000.0))));
        assert!(!same_whale(&whale(jaws(1000.0)), &whale(jaws(1001.0))));
        assert!(!same_whale(&whale(jaws(1000.0)), &whale(None)));
    }
}
