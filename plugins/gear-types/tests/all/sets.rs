//! Pairs, trawls and gillnet strings: their parts, their lengths, first guesses that the rope can reach.

use crate::common::{SITE, apart, built, item, lines, number, place, values, word};
use endline_gear_types::{Gillnet, Pair, Trawl, all};
use endline_sdk::{GearType, Rig, RigEnd, Site};

/// Rope from the near end to the far end along the seabed [m].
fn groundline_m(rig: &Rig) -> f64 {
    rig.lines
        .iter()
        .filter(|line| line.id.starts_with("groundline") || line.id.ends_with("anchor-line"))
        .map(|line| line.length_m)
        .sum()
}

#[test]
fn every_line_of_every_gear_type_can_reach_from_end_to_end() {
    for gear in all() {
        let (id, counts) = (gear.descriptor().id.clone(), [1.0, 2.0, 6.0, 45.0]);
        let has_traps =
            gear.descriptor().attributes.iter().any(|attribute| attribute.key == "traps");
        for traps in if has_traps { &counts[..] } else { &counts[..1] } {
            for current_m_s in [[0.0, 0.4], [-0.7, 0.1], [0.0, 0.0]] {
                let changes = if has_traps { vec![("traps", number(*traps))] } else { Vec::new() };
                let rig = gear
                    .build(&values(gear.as_ref(), &changes), &Site { current_m_s, ..SITE })
                    .unwrap();
                for line in &rig.lines {
                    let apart = apart(place(&rig, &line.from), place(&rig, &line.to));
                    // A stowed line leaves its trap from the top edge and its buoy from below.
                    assert!(
                        apart
                            <= line.length_m * (1.0 + 1e-12)
                                + 0.7 * f64::from(u8::from(id.ends_with("on-demand"))),
                        "{id} {}",
                        line.id
                    );
                }
            }
        }
    }
}

#[test]
fn a_pair_is_two_traps_in_one_groundline_with_one_endline() {
    let rig = built(&Pair::new(), &[]);
    let bodies: Vec<_> = rig.bodies.iter().map(|body| body.id.as_str()).collect();
    assert_eq!(bodies, ["trap-1", "trap-2", "buoy"]);
    assert_eq!(lines(&rig, ""), ["groundline-1", "endline-bottom", "endline-top"]);
    assert_eq!(rig.lines[1].from, RigEnd::Body("trap-1".into()));
    let length = rig.lines[0].length_m;
    let apart = apart(place(&rig, &rig.lines[0].from), place(&rig, &rig.lines[0].to));
    assert!((length / apart - 1.03).abs() < 1e-9, "{length} m over {apart} m");
}

/// NOAA's Decision Support Tool: one endline up to 5 traps, two from 6 up.
#[test]
fn a_trawl_has_two_endlines_from_six_traps_up() {
    for (traps, endlines) in [(1.0, 1), (5.0, 1), (6.0, 2), (45.0, 2)] {
        let rig = built(&Trawl::new(), &[("traps", number(traps))]);
        assert_eq!(
            rig.bodies.iter().filter(|body| body.id.ends_with("buoy")).count(),
            endlines,
            "{traps} traps"
        );
        assert_eq!(lines(&rig, "gangion").len(), traps as usize);
        assert_eq!(lines(&rig, "groundline").len(), traps as usize - 1);
    }
    let both = built(&Trawl::new(), &[("endlines", number(2.0))]);
    assert_eq!(lines(&both, "far-"), ["far-endline-bottom", "far-endline-top"]);
    assert_eq!(
        both.links.iter().map(|link| link.id.as_str()).collect::<Vec<_>>(),
        ["buoy-link", "far-buoy-link"]
    );
}

/// 45 traps at 33.6 fathoms and 20 fathoms to each anchor: the 1.5 nmi that 50 CFR 697.21(b)(3) allows
/// (86 FR 51970 raised it for LMA 3).
#[test]
fn a_trawl_of_45_traps_fits_into_the_longest_that_is_allowed() {
    let fathom = 1.8288;
    let offshore = [
        ("traps", number(45.0)),
        ("spacing", number(33.6 * fathom)),
        ("anchor", item("danforth")),
        ("anchor_line", number(20.0 * fathom)),
    ];
    let rig = built(&Trawl::new(), &offshore);
    let longest = 1.5 * 1852.0;
    assert!(
        groundline_m(&rig) <= longest && groundline_m(&rig) > 0.99 * longest,
        "{} m",
        groundline_m(&rig)
    );
    assert_eq!(
        rig.lines.iter().find(|line| line.id == "far-endline-bottom").unwrap().from,
        RigEnd::Body("far-anchor".into())
    );
}

#[test]
fn traps_lie_beside_the_groundline_within_reach_of_their_gangions() {
    let y = |side: &str| -> Vec<f64> {
        let rig = built(&Trawl::new(), &[("side", word(side))]);
        rig.bodies
            .iter()
            .filter(|body| body.id.starts_with("trap"))
            .map(|body| body.position_m[1])
            .collect()
    };
    assert!(y("alternate").windows(2).all(|pair| pair[0] * pair[1] < 0.0));
    assert!(y("left").iter().all(|y| *y < -0.5) && y("right").iter().all(|y| *y > 0.5));
}

#[test]
fn bridles_hold_each_trap_by_two_corners() {
    let rig = built(&Trawl::new(), &[("traps", number(3.0)), ("bridle", number(1.0))]);
    assert_eq!(lines(&rig, "bridle").len(), 6);
    let gangion = rig.lines.iter().find(|line| line.id == "gangion-2").unwrap();
    assert_eq!(gangion.to, RigEnd::Joint("bridle-2".into()));
    let corner = rig.lines.iter().find(|line| line.id == "bridle-port-2").unwrap();
    assert_eq!(corner.from, RigEnd::Body("trap-2:bridle-port".into()));
}

#[test]
fn a_high_flyer_rides_beyond_the_buoy() {
    let rig = built(&Trawl::new(), &[("high_flyer", item("high-flyer"))]);
    let line = rig.lines.iter().find(|line| line.id == "high-flyer-line").unwrap();
    assert_eq!(
        (&line.from, &line.to),
        (&RigEnd::Body("buoy".into()), &RigEnd::Body("high-flyer".into()))
    );
    assert_eq!(rig.links[0].line, "endline-top");
}

#[test]
fn a_gillnet_is_as_long_as_its_panels_and_bridled_at_both_ends() {
    let rig = built(&Gillnet::new(), &[]);
    for rope in ["headline", "leadline"] {
        let length: f64 = rig
            .lines
            .iter()
            .filter(|line| line.id.starts_with(rope))
            .map(|line| line.length_m)
            .sum();
        assert!((length - 3.0 * 91.44).abs() < 1e-9, "{rope}: {length} m");
    }
    assert_eq!(lines(&rig, "netting").len(), 19);
    assert_eq!(rig.links.iter().filter(|link| link.id.starts_with("panel-link")).count(), 3);
    assert_eq!(lines(&rig, "bridle").len() + lines(&rig, "far-bridle").len(), 4);
    assert_eq!(
        rig.lines.iter().find(|line| line.id == "far-endline-bottom").unwrap().from,
        RigEnd::Body("far-anchor".into())
    );
}

#[test]
fn an_error_of_a_layout_names_its_attribute() {
    for (gear, changes, named) in [
        (&Trawl::new() as &dyn GearType, ("gangion", number(15.0)), "`gangion`"),
        (&Trawl::new(), ("gangion_rope", item("")), "`gangion_rope`"),
        (&Trawl::new(), ("trap", item("")), "`trap`"),
        (&Trawl::new(), ("traps", number(2.5)), "`traps`"),
        (&Pair::new(), ("groundline", item("")), "`groundline`"),
        (&Gillnet::new(), ("net_height", number(24.0)), "`net_height`"),
        (&Gillnet::new(), ("bridle", number(1.0)), "`bridle`"),
    ] {
        let changes = if named == "`net_height`" {
            vec![changes, ("bridle", number(20.0))]
        } else {
            vec![changes]
        };
        let error = gear.build(&values(gear, &changes), &SITE).unwrap_err();
        assert!(error.message.contains(named), "{error}");
    }
    let error = Trawl::new()
        .build(&values(&Trawl::new(), &[]), &Site { depth_m: -3.0, ..SITE })
        .unwrap_err();
    assert!(error.message.contains("-3 m"), "{error}");
}
