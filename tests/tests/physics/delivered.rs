//! Delivered strength: budgets by hand, and lines that are made to deliver one.

use crate::linked::{Linked, library, report};
use crate::ropes::{assembled, pulled, until_it_parts};
use endline_gear::{Confidence, Options, Scenario, StrengthBudget, assemble_traced};

/// Newtons of a pound-force.
const LBF_N: f64 = 4.448_221_615_260_5;
/// Nothing drawn at random.
const PLAIN: &str = "strength_scatter = false\nrope_nodes = 80";

fn budgets(text: &str) -> Vec<StrengthBudget> {
    let scenario =
        Scenario::read("test.toml", text).unwrap_or_else(|found| panic!("{}", report(&found)));
    assemble_traced(&scenario, &library(), &Linked, &Options::default())
        .unwrap_or_else(|found| panic!("{}", report(&found)))
        .strengths
}

fn of<'a>(budgets: &'a [StrengthBudget], part: &str) -> &'a StrengthBudget {
    budgets.iter().find(|budget| budget.part == part).unwrap()
}

#[test]
fn budgets_of_line_insert_and_sleeve_are_those_of_a_hand_calculation() {
    let inserts = "to_knot = \"bowline\"\n[line.inserts]\nrope = \"weak-1700-3-8\"\nlength = \"3 ft\"\nevery = \"30 ft\"\nwithin = 0.75\nknot = \"eye-splice\"\n";
    let found = budgets(&pulled(PLAIN, inserts));
    // Polysteel 1/2 in: 4,910 lbf at least, 1.11 of it in the mean, 74 % used; its weaker end counts: a splice of 90 %
    // at the post, 95 % at inserts, a bowline of 60 % at the hand.
    let rope_lbf = 4910.0 * 1.11 * 0.74;
    for (part, lbf) in [
        ("warp.1", 0.90 * rope_lbf),
        ("warp.2", 0.95 * rope_lbf),
        ("warp.4", 0.60 * rope_lbf),
        // Approved as made up, and worn like any rope.
        ("warp.insert-2", 1700.0 * 0.74),
    ] {
        let delivered = of(&found, part).delivered_n();
        assert!((delivered / (lbf * LBF_N) - 1.0).abs() < 1e-9, "{part}: {delivered} N");
        assert_eq!(of(&found, part).confidence(), Confidence::Estimate, "{part}");
    }
    let [least, most] = of(&found, "warp.1").nine_of_ten_n();
    // 12 % between pieces, 1.645 deviations.
    assert!((most / least - (1.0 + 0.1974) / (1.0 - 0.1974)).abs() < 1e-9);
}

#[test]
fn what_a_run_pulls_to_pieces_is_what_the_budget_says_of_its_piece() {
    for line in ["to_knot = \"bowline\"", "condition = \"new\"", "wear_factor = 0.4"] {
        let text = pulled("rope_nodes = 40", line);
        let drawn_n = of(&budgets(&text), "warp").drawn_n();
        let (greatest, parted) = until_it_parts(assembled(&text, None));
        assert_eq!(parted, ["warp"]);
        assert!((greatest / drawn_n - 1.0).abs() < 0.01, "{line}: {greatest} against {drawn_n} N");
    }
}

#[test]
fn a_line_made_to_deliver_a_strength_parts_there_at_the_stretch_of_its_rope() {
    let ends = "from_knot = \"eye-splice\"\nto_knot = \"bowline\"";
    let usual = assembled(&pulled(PLAIN, ends), None);
    for lbf in [600.0, 1700.0, 4000.0] {
        let made = format!("{ends}\ndelivered_strength = \"{lbf} lbf\"\nkeeps_stiffness = false");
        let text = pulled(PLAIN, &made);
        let budget = budgets(&text);
        assert!((of(&budget, "warp").delivered_n() / (lbf * LBF_N) - 1.0).abs() < 1e-4, "{lbf}");
        let spec = assembled(&text, None);
        let (rope, before) = (&spec.ropes[0], &usual.ropes[0]);
        let stretch = |rope: &endline_sim::model::Rope| rope.strength_n / rope.axial_stiffness_n;
        assert!((stretch(rope) / stretch(before) - 1.0).abs() < 1e-4, "{lbf}");
        assert_eq!(rope.diameter_m.to_bits(), before.diameter_m.to_bits());
        let (greatest, parted) = until_it_parts(spec);
        assert_eq!(parted, ["warp"]);
        assert!((greatest / (lbf * LBF_N) - 1.0).abs() < 0.01, "{lbf}: {greatest} N");
    }
    let stiff = format!("{ends}\ndelivered_strength = \"600 lbf\"");
    let kept = &assembled(&pulled(PLAIN, &stiff), None).ropes[0];
    assert_eq!(kept.axial_stiffness_n.to_bits(), usual.ropes[0].axial_stiffness_n.to_bits());
}

#[test]
fn with_inserts_the_line_delivers_at_its_weakest_place_of_own_rope() {
    let made = "to_knot = \"bowline\"\ndelivered_strength = \"900 lbf\"\n[line.inserts]\nrope = \"weak-1700-3-8\"\nlength = \"3 ft\"\nevery = \"30 ft\"\nwithin = 0.75\n";
    let found = budgets(&pulled(PLAIN, made));
    let own = found.iter().filter(|budget| budget.item == "polysteel-1-2");
    let least = own.map(StrengthBudget::delivered_n).fold(f64::INFINITY, f64::min);
    assert!((least / (900.0 * LBF_N) - 1.0).abs() < 1e-4, "{least}");
    let insert = of(&found, "warp.insert-1").delivered_n();
    assert!((insert / (1700.0 * 0.74 * LBF_N) - 1.0).abs() < 1e-9, "{insert}");
}

/// Weak places have a row of their own beside the line, and one draw: at any seed, the line parts there at the drawn strength.
#[test]
fn weak_places_deliver_their_strength_with_the_variation_of_the_line() {
    let places = "[line.weak_places]\nstrength = \"1700 lbf\"\nevery = \"60 ft\"\n";
    let found = budgets(&pulled(PLAIN, places));
    let parts: Vec<(&str, &str)> =
        found.iter().map(|budget| (budget.part.as_str(), budget.item.as_str())).collect();
    assert_eq!(
        parts,
        [("warp", "polysteel-1-2"), ("warp.weak-places", "2 weak places at 9.14 m, 27.43 m")]
    );
    let own = of(&found, "warp.weak-places");
    assert!((own.delivered_n() / (1700.0 * LBF_N) - 1.0).abs() < 1e-9, "{}", own.delivered_n());
    assert_eq!(own.variation, of(&found, "warp").variation);
    for nodes in [20, 40, 80] {
        let text = pulled(&format!("rope_nodes = {nodes}"), places);
        let found = budgets(&text);
        let [line, own] = ["warp", "warp.weak-places"].map(|part| of(&found, part).clone());
        assert!((own.drawn - line.drawn).abs() < 1e-15 && (own.drawn - 1.0).abs() > 1e-6);
        let (greatest, parted) = until_it_parts(assembled(&text, None));
        assert_eq!(parted, ["warp"]);
        assert!((greatest / own.drawn_n() - 1.0).abs() < 0.01, "{greatest} of {}", own.drawn_n());
    }
    // A required strength of the line is that of its rope.
    let made = format!("delivered_strength = \"2600 lbf\"\n{places}");
    let delivered_n = of(&budgets(&pulled(PLAIN, &made)), "warp").delivered_n();
    assert!((delivered_n / (2600.0 * LBF_N) - 1.0).abs() < 1e-9, "{delivered_n}");
}

/// A trawl of the library with this seed.
fn trawl(traps: u32, seed: u64, tables: &str) -> String {
    format!(
        "format = 1\nkind = \"scenario\"\nname = \"Test\"\nduration = \"1 s\"\nseed = {seed}\nrope_nodes = 500\n\
         [site]\nitem = \"cape-cod-bay\"\ndepth = \"60 m\"\n[[gear]]\nassembly = \"trawl-{traps}\"\n{tables}"
    )
}

/// NOAA's means and coefficients of variation by traps per trawl (`cases/tables/noaa-dst-strength-by-traps.csv`).
#[test]
fn endlines_of_trawls_are_as_strong_and_vary_as_those_of_the_fishery() {
    for (traps, mean_lbf, cv) in [(10, 2339.0, 0.394), (20, 2962.0, 0.398), (45, 5418.0, 0.330)] {
        let weaker = |seed: u64, tables: &str| {
            let found = budgets(&trawl(traps, seed, tables));
            let endline = found.into_iter().filter(|part| part.part.starts_with("endline"));
            endline.min_by(|a, b| a.delivered_n().total_cmp(&b.delivered_n())).unwrap()
        };
        let one = weaker(1, "");
        let delivered = one.delivered_n() / LBF_N;
        println!("{traps}: {} delivers {delivered:.0} lbf for {mean_lbf}", one.part);
        assert!((delivered / mean_lbf - 1.0).abs() < 0.08, "{traps}: {delivered}");
        let square = |figure: &Option<endline_gear::StrengthFigure>| {
            figure.as_ref().map_or(0.0, |figure| figure.value * figure.value)
        };
        let both = (square(&one.variation) + square(&one.fleet)).sqrt();
        assert!((both / cv - 1.0).abs() < 0.03, "{traps}: {both}");
        let drawn: Vec<f64> = (1..=60).map(|seed| weaker(seed, "").drawn).collect();
        let mean = drawn.iter().sum::<f64>() / 60.0;
        let square = drawn.iter().map(|share| (share - mean) * (share - mean)).sum::<f64>() / 59.0;
        println!("{traps}: drawn {mean:.3}, {:.3}", square.sqrt());
        // Three standard errors of 60 draws.
        assert!((mean - 1.0).abs() < 0.16 && (square.sqrt() / cv - 1.0).abs() < 0.28);

        // A rope that the scenario chooses varies between pieces only.
        let chosen = weaker(1, "[gear.attributes]\nupper_rope = \"weak-1700-3-8\"\n");
        assert_eq!(chosen.fleet, None);
    }
}
