//! Runs that need not be run twice: options that differ in strengths alone are the same run until something parts.
//!
//! Ratings and breaking strengths enter the physics only where a tension passes them. An option whose model is that of
//! another but for strengths, and whose strengths stay well above every tension of the other's run, in which nothing
//! parted, has the same run to the bit; its row is copied. A solver step may try a tension that it does not keep, and a
//! strength passed by such a trial would shorten the step; [`MARGIN`] keeps clear of that, and `endline study replay` compares hashes.

use endline_sdk::AttributeValue;
use endline_sim::metrics::Summary;
use endline_sim::model::{FrictionLaw, Line, Rope};
use endline_sim::whale::Whale;
use endline_sim::{Model, ModelSpec};

use super::open::OptionPlan;

/// Share of a line's strength up to which tensions count as well below it.
pub const MARGIN: f64 = 0.7;

/// Whether `model` has the same run as another that came to `summary` with nothing parted.
pub(super) fn same_run(model: &Model, other: &Model, summary: &Summary) -> bool {
    nothing_parted(summary)
        && alike(&model.spec, &other.spec)
        && summary.lines.iter().zip(weakest(&model.spec)).all(|(line, weakest_n)| line.peak_tension_n < MARGIN * weakest_n)
}

/// Least strength that scatter may leave of a part in one encounter, over the greatest it may give it in another: factors
/// lie above 0.2, and 1.6 is six deviations of the widest scatter in the library.
const SCATTER: f64 = 0.2 / 1.6;

/// Whether an option has the same run as another that came to `summary`, told without assembling it: by its `bare` model,
/// of whatever encounter, where the two options are of one [`family`].
pub(super) fn surely_same_run(bare: &ModelSpec, summary: &Summary) -> bool {
    nothing_parted(summary)
        && summary.lines.iter().zip(weakest(bare)).all(|(line, weakest_n)| line.peak_tension_n < MARGIN * SCATTER * weakest_n)
}

/// Whether two options differ in strengths alone in every encounter: their models are alike in one, and what is drawn
/// reaches both in the same fields.
pub(super) fn family(one: &OptionPlan, other: &OptionPlan, drawn_fields: &[&str]) -> bool {
    let own = |plan: &OptionPlan| -> Vec<String> {
        let set = plan.settings.iter().map(|setting| setting.field.value.clone()).chain(plan.removes.iter().cloned());
        let mut own: Vec<String> = set.filter(|field| drawn_fields.contains(&field.as_str())).collect();
        own.sort();
        own
    };
    own(one).is_empty() && own(other).is_empty() && alike(&one.prepared.model.spec, &other.prepared.model.spec)
}

fn nothing_parted(summary: &Summary) -> bool {
    summary.lines.iter().all(|line| line.parted_at_s.is_none()) && summary.links.iter().all(|link| link.parted_at_s.is_none())
}

/// What each line holds: the least of its rope's strength and of the links in it [N].
fn weakest(spec: &ModelSpec) -> Vec<f64> {
    let mut weakest: Vec<f64> = spec
        .lines
        .iter()
        .map(|line| spec.ropes[line.rope].strength_n * line.strength.all * line.strength.end_a.min(line.strength.end_b).min(1.0))
        .collect();
    for link in spec.links.iter().filter(|link| link.enabled) {
        weakest[link.line] = weakest[link.line].min(link.rating_n);
    }
    weakest
}

/// The least strength of all, by which options are put in order [N].
pub(super) fn least_strength_n(spec: &ModelSpec) -> f64 {
    weakest(spec).into_iter().fold(f64::INFINITY, f64::min)
}

/// Whether two models differ in nothing but the strengths of links and ropes.
fn alike(one: &ModelSpec, other: &ModelSpec) -> bool {
    let ropes = one.ropes.len() == other.ropes.len()
        && one.ropes.iter().zip(&other.ropes).all(|(a, b)| *a == Rope { id: a.id.clone(), strength_n: a.strength_n, ..b.clone() });
    let lines = one.lines.len() == other.lines.len()
        && one.lines.iter().zip(&other.lines).all(|(a, b)| *a == Line { strength: a.strength, ..b.clone() });
    ropes
        && lines
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
    let same_value =
        |(a, b): (&AttributeValue, &AttributeValue)| a == b || matches!((a, b), (AttributeValue::Item(_), AttributeValue::Item(_)));
    one.gear.len() == other.gear.len()
        && one.gear.iter().zip(&other.gear).all(|(a, b)| {
            let (own, its) = (a.gear.descriptor(), b.gear.descriptor());
            own.id == its.id && own.state_len == 0 && a.lines == b.lines && a.attributes.iter().zip(&b.attributes).all(same_value)
        })
}

fn same_whale(one: &ModelSpec, other: &ModelSpec) -> bool {
    let friction = match (&one.friction, &other.friction) {
        (Some(a), Some(b)) => {
            let same_law =
                |(a, b): (&FrictionLaw, &FrictionLaw)| a.model.descriptor().id == b.model.descriptor().id && a.attributes == b.attributes;
            let laws = a.laws.len() == b.laws.len() && a.laws.iter().zip(&b.laws).all(same_law);
            laws && a.law_of == b.law_of && a.coefficients == b.coefficients
        }
        (None, None) => true,
        _ => false,
    };
    let whale = match (&one.whale, &other.whale) {
        (Some(a), Some(b)) => {
            let motion = a.motion.descriptor().id == b.motion.descriptor().id && a.motion_attributes == b.motion_attributes;
            let body = a.skin == b.skin && a.joints == b.joints && a.kinetic == b.kinetic && a.measures == b.measures;
            let start = a.position_m == b.position_m && a.orientation == b.orientation && a.pilot == b.pilot;
            let numbers = |whale: &Whale| [whale.length_m, whale.burst_speed_m_s, whale.speed_m_s, whale.contact_stiffness_n_m2];
            motion && body && start && numbers(a).map(f64::to_bits) == numbers(b).map(f64::to_bits)
        }
        (None, None) => true,
        _ => false,
    };
    friction && whale
}
