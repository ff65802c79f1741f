//! An observation written from a run's ending, as an observer might have reported it.
//!
//! It tests a search on a known encounter: the ending is blurred, so that the search cannot use figures that no observer could see.

use endline_gear::{PathPlace, RopeEnd, Site};

use super::ending::Ending;
use crate::encounters::draw;

/// Probability that an observer gives to rope that is present, or absent.
const SURE: f64 = 0.9;

/// Half the range of reported wraps [turns].
const WRAPS: f64 = 0.25;

/// Greatest error of reported wraps [turns].
const WRAPS_OFF: f64 = 0.15;

/// Half the range of reported lengths and their greatest error, as shares.
const LENGTH: f64 = 0.25;

/// Longest path that an observer would report.
const PATH: usize = 4;

/// The text of an observation file; `seed` determines the errors and the hidden site.
pub fn observation_text(ending: &Ending, encounters: &str, seed: u64) -> String {
    let chances = draw::sobol_point(seed, 0, Site::SINGLE.len() + 2);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place in a list"
    )]
    let hidden = Site::SINGLE[(chances[0] * Site::SINGLE.len() as f64) as usize];
    let seen = Site::SINGLE.into_iter().zip(&chances[2..]).filter(|(site, _)| *site != hidden);
    let sites: String =
        seen.map(|(site, chance)| one_site(ending, site, 2.0 * chance - 1.0)).collect();
    format!(
        "format = 1\nkind = \"observation\"\nname = \"A simulated ending, blurred\"\nsource = \"a run\"\nconfidence = \"estimate\"\n\
         encounters = \"{encounters}\"\n{sites}{}{}\n[hidden]\nparts = [\"{}\"]\n",
        path(ending, hidden),
        trailing(ending, 2.0 * chances[1] - 1.0),
        hidden.name()
    )
}

fn one_site(ending: &Ending, site: Site, off: f64) -> String {
    let head = format!("\n[[site]]\npart = \"{}\"\n", site.name());
    let Some(at) = ending.at(site) else { return format!("{head}present = {:.2}\n", 1.0 - SURE) };
    let wraps = (at.wraps + WRAPS_OFF * off).max(0.0);
    let range = [(wraps - WRAPS).max(0.0), wraps + WRAPS];
    let [least, most] = range;
    let across =
        if at.across > 0 { format!("across = [{0}, {0}]\n", at.across) } else { String::new() };
    format!(
        "{head}present = {SURE}\nwraps = [{least:.2}, {most:.2}]\ntight = {}\n{across}",
        at.tight
    )
}

/// The path of the strand that passes most places, without the hidden one, if it is short enough to be reported.
fn path(ending: &Ending, hidden: Site) -> String {
    let longest = ending.strands.iter().max_by_key(|strand| strand.places.len());
    let mut sites: Vec<PathPlace> = longest
        .map(|strand| {
            strand.places.iter().map(|place| PathPlace { side: None, ..*place }).collect()
        })
        .unwrap_or_default();
    sites.retain(|place| place.site != hidden);
    sites.dedup();
    if sites.is_empty() || sites.len() > PATH {
        return String::new();
    }
    let order: Vec<String> = sites.iter().map(|place| format!("\"{place}\"")).collect();
    format!("\n[path]\norder = [{}]\n", order.join(", "))
}

fn trailing(ending: &Ending, off: f64) -> String {
    let reported = ending.behind_m * (1.0 + LENGTH * off);
    let (least, most) = (reported * (1.0 - LENGTH), reported * (1.0 + LENGTH));
    let ends: Vec<String> = ending
        .strands
        .iter()
        .flat_map(|strand| strand.ends)
        .flatten()
        .map(|end: RopeEnd| format!("\"{}\"", end.name()))
        .collect();
    format!(
        "\n[trailing]\nlength = [\"{least:.1} m\", \"{most:.1} m\"]\nends = [{}]\n",
        ends.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use endline_gear::Observation;

    use super::super::distance::{Distance, LIKE};
    use super::super::ending::{AtSite, Strand};
    use super::*;

    /// The text is an observation, and the ending is like it for every seed.
    #[test]
    fn an_ending_is_like_its_blurred_observation() {
        let at = |site, wraps, tight, across| AtSite { site, wraps, tight, across };
        let places =
            ["left_flipper", "body:left", "peduncle"].map(|name| PathPlace::named(name).unwrap());
        let strand =
            Strand { places: places.to_vec(), ends: [Some(RopeEnd::Trap), Some(RopeEnd::Buoy)] };
        let ending = Ending {
            sites: vec![
                at(Site::Body, 0.8, true, 2),
                at(Site::LeftFlipper, 1.1, true, 0),
                at(Site::Peduncle, 0.3, false, 0),
            ],
            strands: vec![strand],
            behind_m: 22.0,
            twist: 0.0,
        };
        for seed in 0..64 {
            let text = observation_text(&ending, "met-single", seed);
            let seen = Observation::read("blurred.toml", &text)
                .unwrap_or_else(|problems| panic!("{text}\n{problems:?}"));
            let body = seen.sites.iter().find(|one| one.site == Site::Body);
            assert!(body.is_none_or(|one| one.across == Some([2.0, 2.0])), "{text}");
            let distance = Distance::of(&seen, &ending).sum();
            assert!(distance < 0.2 * LIKE, "{distance}: {text}");
            assert!(Distance::of(&seen, &Ending::default()).sum() > LIKE, "{text}");
        }
    }
}
