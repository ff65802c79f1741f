//! Runs that need not be run twice: options that differ in strengths alone are the same run until something parts.
//!
//! Ratings and breaking strengths enter the physics only where a tension passes them. An option whose model is that of
//! another but for strengths, and whose strengths stay well above every tension of the other's run, in which nothing
//! parted, has the same run to the bit; its row is copied. A step that is kept was kept with the tensions that count among the
//! run's greatest, so that with fixed steps a strength above those changes nothing ([`MARGIN`] is for rounding). Steps that follow
//! their error may be taken back, and forget what they tried: [`PACED_MARGIN`] keeps clear of that. `endline study replay` compares hashes.

use endline_sdk::AttributeValue;
use endline_sim::metrics::{LinkSummary, Summary};
use endline_sim::model::{FrictionLaw, Line, Link, Rope, Whale};
use endline_sim::{Model, ModelSpec};

use super::plan::OptionPlan;

/// Share of a strength up to which tensions count as below it, with fixed steps.
const MARGIN: f64 = 0.99;

/// Share of a strength up to which tensions count as below it, with steps that follow their error.
const PACED_MARGIN: f64 = 0.7;

fn margin(spec: &ModelSpec) -> f64 {
    if spec.settings.auto_step { PACED_MARGIN } else { MARGIN }
}

/// Whether `model` has the same run as another that came to `summary` with nothing parted.
pub(super) fn same_run(model: &Model, other: &Model, summary: &Summary) -> bool {
    same_so_far(model, summary) && same_until_parting(model, other)
}

/// Whether two models that are known to differ in strengths alone have the same run, which came to `summary`.
pub(super) fn same_so_far(model: &Model, summary: &Summary) -> bool {
    nothing_parted(summary) && holds(&model.spec, summary, margin(&model.spec))
}

/// Least strength that scatter may leave of a part in one encounter, over the greatest it may give it in another: factors
/// lie above 0.2, and 1.6 is six deviations of the widest scatter in the library.
const SCATTER: f64 = 0.2 / 1.6;

/// Whether two models have the same run up to the moment when something first parts.
pub(super) fn same_until_parting(one: &Model, other: &Model) -> bool {
    alike(&one.spec, &other.spec)
}

/// Whether an option has the same run as another that came to `summary`, decided without assembling it: by the two options'
/// models of whatever encounter, first its own, where they are of one [`family`].
pub(super) fn surely_same_run(
    [bare, other_bare]: [&ModelSpec; 2],
    other: &Model,
    summary: &Summary,
) -> bool {
    // Where the other has in this encounter the strengths it always has, none are drawn.
    let drawn = if strengths(&other.spec).eq(strengths(other_bare)) { 1.0 } else { SCATTER };
    nothing_parted(summary) && holds(bare, summary, margin(bare) * drawn)
}

/// Whether every tension of another model's run stays below a share of what bears it: of the rope's strength along a line, of
/// its rating at a link. The other has the same lines and links.
fn holds(spec: &ModelSpec, summary: &Summary, share: f64) -> bool {
    let lines = summary.lines.iter().zip(ropes(spec)).all(|(line, strength_n)| {
        line.peak_tension_n.max(line.unconverged_peak_n) < share * strength_n
    });
    let at_link = |(link, borne): (&Link, &LinkSummary)| {
        let greatest_n = borne.peak_tension_n.max(borne.unconverged_peak_n);
        !link.enabled || greatest_n < share * link.rating_n
    };
    lines && spec.links.iter().zip(&summary.links).all(at_link)
}

/// Last parts of the paths of strengths: what else an option sets may change its runs in ways that no model shows, such as
/// how a whale's motion answers a touch.
const STRENGTHS: [&str; 4] = ["rating", "strength", "weak_link", "weak_links"];

/// Whether two options differ in strengths alone in every encounter: what they set differently are strengths, their models are
/// alike in one encounter, and what is drawn reaches both in the same fields.
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
    let is_strength =
        |path: &str| path.rsplit('.').next().is_some_and(|last| STRENGTHS.contains(&last));
    let only_strengths = |one: &OptionPlan, other: &OptionPlan| {
        one.sets.iter().all(|set| other.sets.contains(set) || is_strength(&set.0))
    };
    let strengths =
        only_strengths(one, other) && only_strengths(other, one) && one.removes == other.removes;
    strengths
        && own(one).is_empty()
        && own(other).is_empty()
        && alike(&one.prepared.model.spec, &other.prepared.model.spec)
}

fn nothing_parted(summary: &Summary) -> bool {
    summary.lines.iter().all(|line| line.parted_at_s.is_none())
        && summary.links.iter().all(|link| link.parted_at_s.is_none())
}

/// What the rope of each line holds, at its weakest place [N].
fn ropes(spec: &ModelSpec) -> impl Iterator<Item = f64> {
    let holds = |line: &Line| {
        spec.ropes[line.rope].strength_n
            * line.strength.all
            * line.strength.end_a.min(line.strength.end_b).min(1.0)
    };
    spec.lines.iter().map(holds)
}

/// What ropes and links hold [N].
fn strengths(spec: &ModelSpec) -> impl Iterator<Item = f64> {
    ropes(spec).chain(spec.links.iter().filter(|link| link.enabled).map(|link| link.rating_n))
}

/// The least strength of all, by which options are put in order [N].
pub(super) fn least_strength_n(spec: &ModelSpec) -> f64 {
    strengths(spec).fold(f64::INFINITY, f64::min)
}

/// Whether two models differ in nothing but the strengths of links and ropes.
fn alike(one: &ModelSpec, other: &ModelSpec) -> bool {
    let ropes =
        one.ropes.len() == other.ropes.len()
            && one.ropes.iter().zip(&other.ropes).all(|(a, b)| {
                *a == Rope { id: a.id.clone(), strength_n: a.strength_n, ..b.clone() }
            });
    let lines = one.lines.len() == other.lines.len()
        && one
            .lines
            .iter()
            .zip(&other.lines)
            .all(|(a, b)| *a == Line { strength: a.strength, ..b.clone() });
    let links = one.links.len() == other.links.len()
        && one
            .links
            .iter()
            .zip(&other.links)
            .all(|(a, b)| (&a.id, a.line, a.end) == (&b.id, b.line, b.end));
    ropes
        && lines
        && links
        && same_gear_types(one, other)
        && one.joints == other.joints
        && one.bodies == other.bodies
        && one.obstacles == other.obstacles
        && one.settings == other.settings
        && one.water == other.water
        && one.seabed == other.seabed
        && same_whale(one, other)
}

/// Gear types that keep nothing in mind and differ in items alone, whose effect on the gear shows elsewhere in the model.
fn same_gear_types(one: &ModelSpec, other: &ModelSpec) -> bool {
    let same_value = |(a, b): (&AttributeValue, &AttributeValue)| {
        a == b || matches!((a, b), (AttributeValue::Item(_), AttributeValue::Item(_)))
    };
    one.gear.len() == other.gear.len()
        && one.gear.iter().zip(&other.gear).all(|(a, b)| {
            let (own, its) = (a.gear.descriptor(), b.gear.descriptor());
            own.id == its.id
                && own.state_len == 0
                && a.lines == b.lines
                && a.attributes.iter().zip(&b.attributes).all(same_value)
        })
}

fn same_whale(one: &ModelSpec, other: &ModelSpec) -> bool {
    let friction = match (&one.friction, &other.friction) {
        (Some(a), Some(b)) => {
            let same_law = |(a, b): (&FrictionLaw, &FrictionLaw)| {
                a.model.descriptor().id == b.model.descriptor().id && a.attributes == b.attributes
            };
            let laws = a.laws.len() == b.laws.len() && a.laws.iter().zip(&b.laws).all(same_law);
            laws && a.law_of == b.law_of
                && a.coefficients == b.coefficients
                && a.law_of_bodies == b.law_of_bodies
                && a.coefficients_of_bodies[..] == b.coefficients_of_bodies[..]
        }
        (None, None) => true,
        _ => false,
    };
    let whale = match (&one.whale, &other.whale) {
        (Some(a), Some(b)) => {
            let motion = a.motion.descriptor().id == b.motion.descriptor().id
                && a.motion_attributes == b.motion_attributes;
            let body = a.skin == b.skin
                && a.joints == b.joints
                && a.kinetic == b.kinetic
                && a.measures == b.measures;
            let start = a.position_m == b.position_m
                && a.orientation == b.orientation
                && a.pilot == b.pilot;
            let numbers = |whale: &Whale| {
                [
                    whale.length_m,
                    whale.burst_speed_m_s,
                    whale.speed_m_s,
                    whale.contact_stiffness_n_m2,
                ]
            };
            motion && body && start && numbers(a).map(f64::to_bits) == numbers(b).map(f64::to_bits)
        }
        (None, None) => true,
        _ => false,
    };
    friction && whale
}
