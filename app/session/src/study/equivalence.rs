//! Equivalence of runs: options that differ in strengths alone share a run until something parts.
//!
//! Ratings and breaking strengths enter the physics only where a tension exceeds them. Take a run, and a model that differs from its model
//! in strengths alone. The model has the same run to the bit if each rope and each weak link
//!
//! - has the same strength in both, or
//! - did not part, is no weaker in the run, and is stronger in the model than its greatest tension at that place.
//!
//! A place is the first segment of a line, the last one, all between, or a bin of its length for each weak place in it
//! ([`TENSION_BIN_M`](endline_sim::metrics::TENSION_BIN_M)). A part that is weaker in the run could have shortened a step there without
//! parting. An option with `unbreakable = true` has infinite strengths. With fixed steps, the greatest tensions of a run include those of
//! every accepted step, so that a strength above them changes nothing ([`MARGIN`] is for rounding). With steps that follow their error, a rejected step leaves no trace of its tensions;
//! [`PACED_MARGIN`] allows for those. `endline study replay` compares hashes.

use endline_sdk::AttributeValue;
use endline_sim::metrics::{LineSummary, LinkSummary, Summary};
use endline_sim::model::{
    Friction, FrictionLaw, GearHook, Line, Link, Rope, Settings, WeakPlace, Whale,
};
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
    debug_assert_eq!(parts(one).count(), parts(other).count(), "the same lines and links");
    debug_assert_eq!(parts(one).count(), borne(summary).count(), "those of the run");
    let share = margin(one);
    parts(one)
        .zip(parts(other))
        .zip(borne(summary))
        .all(|((own, run), borne)| shares(&own, &run, &borne, share))
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
    // A drawn assembly may have other lines and links.
    if !names(other_bare).eq(names(&other.spec)) {
        return false;
    }
    // The positions of weak places may differ between encounters.
    let has_weak_places = |spec: &ModelSpec| parts(spec).any(|part| !part.weak_places.is_empty());
    if has_weak_places(&other.spec) || has_weak_places(other_bare) {
        return false;
    }
    // The other has the same strengths in both encounters only if none are drawn.
    let drawn = if strengths(&other.spec).eq(strengths(other_bare)) { 1.0 } else { SCATTER };
    let share = margin(bare) * drawn;
    parts(bare).zip(parts(other_bare)).zip(borne(summary)).all(|((own, run), borne)| {
        !borne.parted && is_no_weaker(&run, &own) && holds_anywhere(&own, &borne, share)
    })
}

/// Strengths of a rope or weak link.
#[derive(Clone, Copy)]
struct Part<'a> {
    /// In the first segment, between, and in the last one; infinite if it cannot part [N].
    strengths_n: [f64; 3],
    /// Weak places of a rope that can part.
    weak_places: &'a [WeakPlace],
}

impl Part<'_> {
    /// A part that cannot part.
    const UNBREAKABLE: Part<'static> = Part { strengths_n: [f64::INFINITY; 3], weak_places: &[] };

    /// A bound of its strength at a length from end A, from above [N].
    fn most_at_n(&self, at_m: f64) -> f64 {
        let rope_n = self.strengths_n.into_iter().fold(0.0, f64::max);
        let here = self.weak_places.iter().filter(|place| place.at_m.to_bits() == at_m.to_bits());
        here.map(|place| place.strength_n).fold(rope_n, f64::min)
    }

    /// Its least strength [N].
    fn least_n(&self) -> f64 {
        let places = self.weak_places.iter().map(|place| place.strength_n);
        self.strengths_n.into_iter().chain(places).fold(f64::INFINITY, f64::min)
    }
}

/// What a rope or weak link bore in a run.
struct Borne<'a> {
    /// Greatest tension of the first segment, of all between, and of the last one [N].
    peaks_n: [f64; 3],
    /// The line, for its greatest tensions by length; `None` of a weak link.
    line: Option<&'a LineSummary>,
    parted: bool,
}

/// What every line and then every link bore.
fn borne(summary: &Summary) -> impl Iterator<Item = Borne<'_>> {
    let of_line = |line| {
        let LineSummary { place_peaks_n: peaks_n, parted_at_s, .. }: &LineSummary = line;
        Borne { peaks_n: *peaks_n, line: Some(line), parted: parted_at_s.is_some() }
    };
    let of_link = |link: &LinkSummary| Borne {
        peaks_n: [link.peak_tension_n.max(link.unconverged_peak_n); 3],
        line: None,
        parted: link.parted_at_s.is_some(),
    };
    summary.lines.iter().map(of_line).chain(summary.links.iter().map(of_link))
}

/// Strengths of every line and then of every link.
fn parts(spec: &ModelSpec) -> impl Iterator<Item = Part<'_>> {
    let unbreakable = spec.settings.unbreakable;
    let of_line = |line| {
        let Line { rope, strength, weak_places, .. }: &Line = line;
        let along_n = spec.ropes[*rope].strength_n * strength.all;
        let strengths_n = [strength.end_a, 1.0, strength.end_b].map(|left| along_n * left);
        Part { strengths_n, weak_places }
    };
    let of_link = |link: &Link| {
        let rated = Part { strengths_n: [link.rating_n; 3], weak_places: &[] };
        if link.enabled { rated } else { Part::UNBREAKABLE }
    };
    let all = spec.lines.iter().map(of_line).chain(spec.links.iter().map(of_link));
    all.map(move |part| if unbreakable { Part::UNBREAKABLE } else { part })
}

/// Whether a part of a model behaves as that of a run, in which it bore this.
fn shares(own: &Part<'_>, run: &Part<'_>, borne: &Borne<'_>, share: f64) -> bool {
    let is_weaker_in_run = !is_no_weaker(run, own);
    let is_same = !is_weaker_in_run && is_no_weaker(own, run);
    is_same || (!borne.parted && !is_weaker_in_run && holds(own, borne, share))
}

/// Whether the strengths of a part are at least those of another at each place.
fn is_no_weaker(one: &Part<'_>, other: &Part<'_>) -> bool {
    one.strengths_n.iter().zip(other.strengths_n).all(|(one, other)| *one >= other)
        && one.weak_places.iter().all(|place| place.strength_n >= other.most_at_n(place.at_m))
}

/// Whether every tension that a part bore is below a share of its strength there.
fn holds(part: &Part<'_>, borne: &Borne<'_>, share: f64) -> bool {
    let places = borne.peaks_n.iter().zip(part.strengths_n);
    let weak = part
        .weak_places
        .iter()
        .flat_map(|place| borne.line.map(|line| (line.peak_near_n(place.at_m), place.strength_n)));
    places
        .map(|(peak_n, strength_n)| (*peak_n, strength_n))
        .chain(weak)
        .all(|(peak_n, strength_n)| peak_n < share * strength_n)
}

/// As [`holds`], for weak places at any length.
fn holds_anywhere(part: &Part<'_>, borne: &Borne<'_>, share: f64) -> bool {
    let peak_n = borne.peaks_n.into_iter().fold(0.0, f64::max);
    let bare = Part { weak_places: &[], ..*part };
    holds(&bare, borne, share)
        && part.weak_places.iter().all(|place| peak_n < share * place.strength_n)
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

/// Table of a line's weak places, with settings of its own.
const WEAK_PLACES: &str = "weak_places";

/// Whether a setting at a path can change nothing but strengths, and what the models show: the item of a weak link is such a setting.
fn is_strength(path: &str) -> bool {
    let mut parts = path.rsplit('.');
    let (last, table) = (parts.next().unwrap_or_default(), parts.next());
    STRENGTHS.contains(&last)
        || [Some(last), table].contains(&Some(WEAK_PLACES))
        || (last == "item" && path.split('.').next() == Some("link"))
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
        let mut own: Vec<String> = set
            .filter(|field| drawn_fields.iter().any(|drawn| is_at_or_in(drawn, field)))
            .collect();
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

/// Whether a path is that of a field, or of one in its table.
fn is_at_or_in(path: &str, field: &str) -> bool {
    path.strip_prefix(field).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// The least strength of a model, by which options are sorted; infinite if nothing can part [N].
pub(super) fn least_strength_n(spec: &ModelSpec) -> f64 {
    parts(spec).map(|part| part.least_n()).fold(f64::INFINITY, f64::min)
}

/// Ids of lines with those of their ropes, and then of links.
fn names(spec: &ModelSpec) -> impl Iterator<Item = [&str; 2]> {
    let lines = spec.lines.iter().map(|line| [&*line.id, &*spec.ropes[line.rope].id]);
    lines.chain(spec.links.iter().map(|link| [&*link.id, ""]))
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
    let same_line = |one: &Line, other: &Line| {
        let Line { strength, weak_places, .. } = one;
        *one == Line { strength: *strength, weak_places: weak_places.clone(), ..other.clone() }
    };
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
    use endline_fixtures::gear::{fixed, line, model, water};
    use endline_fixtures::whale::still;
    use endline_sim::DVec3;
    use endline_sim::whale::jaws::JawStrength;
    use endline_sim::whale::skin::Skin;

    use super::*;
    use crate::figures::tests::made_up;

    fn whale(jaws: Option<JawStrength>) -> Whale {
        Whale { jaws, ..still(Skin::default()) }
    }

    #[test]
    fn a_part_is_shared_if_it_is_the_same_or_holds_and_is_no_weaker_in_the_run() {
        let borne = |parted| Borne { peaks_n: [50.0, 100.0, 80.0], line: None, parted };
        let part = |strengths_n| Part { strengths_n, weak_places: &[] };
        let shares =
            |own_n, run_n, parted| shares(&part(own_n), &part(run_n), &borne(parted), MARGIN);
        let (strong, weak) = ([200.0; 3], [60.0, 120.0, 90.0]);
        assert!(shares(strong, strong, true), "the same strength, parted in both");
        assert!(shares(weak, strong, false), "weaker than in the run, and holds");
        assert!(shares(weak, [f64::INFINITY; 3], false), "the run is unbreakable");
        assert!(!shares(strong, weak, false), "weaker in the run, where it could shorten a step");
        assert!(!shares(weak, strong, true), "parted in the run");
        assert!(!shares([60.0, 100.5, 90.0], strong, false), "within the margin of rounding");
        assert!(!shares([49.0, 120.0, 90.0], strong, false), "overloaded in its first segment");
    }

    /// A line that bore 50 N in its first metre and 100 N beyond, in bins of half a metre, with rope of 200 N.
    #[test]
    fn weak_places_are_tested_where_they_lie() {
        let mut line = made_up::report().summary.lines[0].clone();
        line.bin_peaks_n = vec![50.0, 50.0, 100.0, 100.0];
        let borne = Borne { peaks_n: [50.0, 100.0, 100.0], line: Some(&line), parted: false };
        let at = |at_m, strength_n| WeakPlace { at_m, strength_n };
        let part =
            |weak_places: &'static [WeakPlace]| Part { strengths_n: [200.0; 3], weak_places };
        let shares = |own: &[WeakPlace], run: &[WeakPlace]| {
            let [own, run] = [own, run].map(|places| part(places.to_vec().leak()));
            shares(&own, &run, &borne, MARGIN)
        };
        assert!(shares(&[at(0.7, 60.0)], &[]), "60 N where it bore 50 N");
        assert!(!shares(&[at(1.2, 60.0)], &[]), "60 N where it bore 100 N");
        assert!(!shares(&[at(0.7, 60.0), at(1.2, 60.0)], &[]), "one of two is overloaded");
        assert!(!shares(&[at(0.7, 50.2)], &[]), "within the margin of rounding");
        assert!(shares(&[at(0.7, 60.0), at(1.2, 120.0)], &[at(1.2, 120.0)]), "one more, and holds");
        assert!(!shares(&[at(0.7, 60.0)], &[at(1.2, 120.0)]), "the run is weaker at 1.2 m");
        assert!(!shares(&[], &[at(0.7, 60.0)]), "the run is weaker at 0.7 m");
        assert!(!shares(&[at(0.7, 70.0)], &[at(0.7, 60.0)]), "the run is weaker at 0.7 m");
        let parted = Borne { parted: true, ..borne };
        let places: &'static [WeakPlace] = vec![at(1.2, 90.0)].leak();
        assert!(super::shares(&part(places), &part(places), &parted, MARGIN), "the same in both");
        assert!(!super::shares(&part(places), &part(&[]), &parted, MARGIN), "parted in the run");
    }

    #[test]
    fn weak_places_are_strengths_and_change_nothing_else() {
        for path in [
            "line.0.weak_places",
            "line.0.weak_places.every",
            "line.1.weak_places.at",
            "gear.0.lines.endline-top.weak_places.first",
            "line.0.delivered_strength",
            "link.0.item",
        ] {
            assert!(is_strength(path), "{path}");
        }
        for path in ["line.0.inserts.every", "line.0.rope", "body.0.item", "rope_nodes"] {
            assert!(!is_strength(path), "{path}");
        }
        let spec = |weak_places: Vec<WeakPlace>, length_m: f64| {
            let joints = vec![fixed("low", DVec3::ZERO), fixed("high", DVec3::Z * length_m)];
            let lines = vec![Line { weak_places, ..line("warp", length_m, 5) }];
            let settings = Settings::default();
            let mut spec = model(water(0.0, 0.0), joints, lines, Vec::new(), settings).spec;
            spec.ropes[0].strength_n = 300.0;
            spec
        };
        let places = vec![WeakPlace { at_m: 2.0, strength_n: 100.0 }];
        assert!(differ_only_in_strength(&spec(places.clone(), 9.0), &spec(Vec::new(), 9.0)));
        assert!(!differ_only_in_strength(&spec(places.clone(), 9.0), &spec(places.clone(), 8.0)));
        let mut weak = spec(places, 9.0);
        assert!((least_strength_n(&weak) - 100.0).abs() < 1e-12);
        assert!((least_strength_n(&spec(Vec::new(), 9.0)) - 300.0).abs() < 1e-12);
        weak.settings.unbreakable = true;
        assert!(least_strength_n(&weak).is_infinite());
        assert!(is_at_or_in("line.0.weak_places.strength", "line.0.weak_places"));
        assert!(!is_at_or_in("line.0.weak_places", "line.0.weak"));
    }

    #[test]
    fn whales_with_jaws_of_unlike_strength_are_different() {
        let jaws = |moment_n_m| Some(JawStrength { moment_n_m: [moment_n_m, 100.0, 100.0] });
        assert!(same_whale(&whale(jaws(1000.0)), &whale(jaws(1000.0))));
        assert!(!same_whale(&whale(jaws(1000.0)), &whale(jaws(1001.0))));
        assert!(!same_whale(&whale(jaws(1000.0)), &whale(None)));
    }
}
