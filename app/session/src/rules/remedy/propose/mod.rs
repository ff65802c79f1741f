//! Edits that may bring a rule to pass. Each kind of edit is a lever; its tiers are tried from the least edit on.
//!
//! | module | what it changes |
//! |---|---|
//! | `inserts` | weak inserts and sleeves along an endline |
//! | `ropes` | the rope of lines |
//! | `links` | the weak link at the buoy |
//! | `traps` | how many traps are on a set |
//! | `endlines` | endlines, high-flyers and floats |
//! | `lengths` | lengths of lines |
//! | [`scene`] | what all of them look at |

mod endlines;
mod inserts;
mod lengths;
mod links;
mod ropes;
mod scene;
mod traps;

use super::candidate::Candidate;
use super::demand::Demand;

pub(super) use inserts::usual as usual_inserts;
pub(super) use scene::Scene;

/// Edits of one kind, tier by tier: a later tier is tried where no edit of an earlier one serves.
pub(super) type Lever = Vec<Vec<Candidate>>;

/// Every lever for the demands of a rule that fails.
pub(super) fn levers(scene: &Scene<'_>) -> Vec<Lever> {
    let mut levers = vec![inserts::at_places(scene)];
    levers.extend(scene.demands.iter().flat_map(|demand| for_demand(scene, demand)));
    levers.retain(|lever| lever.iter().any(|tier| !tier.is_empty()));
    levers
}

fn for_demand(scene: &Scene<'_>, demand: &Demand) -> Vec<Lever> {
    match demand {
        // Places are put in together, for a rule may ask for several.
        Demand::WeakAt { strength_n, .. } | Demand::WeakOver { strength_n, .. } => {
            vec![ropes::weak(scene, *strength_n)]
        }
        Demand::WeakEvery { spacing, top, strength_n } => {
            vec![inserts::every(scene, spacing, *top, *strength_n)]
        }
        Demand::WeakBelow { clear } => vec![inserts::moved_down(scene, clear)],
        Demand::Fact { name, at_most, limit } => {
            let Some(limit) = limit else { return without_limit(scene, name) };
            match (*name, at_most) {
                ("least_rated" | "least_delivered", true) => {
                    vec![inserts::one(scene, limit.si), ropes::weak(scene, limit.si)]
                }
                ("greatest_rated", true) => vec![ropes::weak(scene, limit.si)],
                ("least_new", true) => {
                    vec![inserts::of_other_strength(scene), ropes::weak(scene, limit.si)]
                }
                ("diameter" | "groundline_diameter", true) => vec![ropes::thin(scene, limit.si)],
                (
                    "top_density"
                    | "least_density"
                    | "groundline_density"
                    | "groundline_least_density",
                    false,
                ) => {
                    vec![ropes::sinking(scene, limit.si)]
                }
                ("sinking_share", false) => vec![ropes::sinking(scene, ropes::SEA_WATER_KG_M3)],
                ("insert_length", false) => vec![inserts::longer(scene, limit)],
                ("buoy_link", true) => vec![links::at_buoy(scene, limit.si)],
                ("traps", false) => vec![traps::added(scene, limit.si)],
                ("endlines", true) => vec![endlines::taken_off(scene, limit.si)],
                ("groundline_floats", true) => vec![endlines::without_floats(scene)],
                ("surface_line", true) => vec![lengths::of_surface_line(scene, limit)],
                ("line_length", true) => vec![lengths::of_endline(scene, limit.si)],
                ("trawl_length" | "groundline_longest" | "groundline_length", true) => {
                    vec![lengths::of_trawl(scene, limit.si), traps::taken_off(scene, limit.si)]
                }
                _ => Vec::new(),
            }
        }
    }
}

/// Levers for a fact that is compared with something else than one number.
fn without_limit(scene: &Scene<'_>, fact: &str) -> Vec<Lever> {
    match fact {
        "least_new" => vec![inserts::of_other_strength(scene)],
        "radar_reflectors" => vec![endlines::with_reflectors(scene)],
        _ => Vec::new(),
    }
}
