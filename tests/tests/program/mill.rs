//! Mill tests as their users call them: the law, both criteria, an item of the library, mistakes in a table.

use std::fs;

use crate::common::Place;

const TABLE: &str = "sample,break\n1,\"1,650 lbf\"\n2,1720 lbf\n3,1580 lbf\n4,1705 lbf\n5,1690 lbf\n\
    6,1610 lbf\n7,1745 lbf\n8,1660 lbf\n9,1700 lbf\n10,1640 lbf\n";

#[test]
fn breaks_become_a_law_two_probabilities_and_a_weak_link() {
    let place = Place::new("mill");
    place.write("mill.csv", TABLE);
    place.write("weak-links/none.txt", "");
    let arguments =
        ["mill", "mill.csv", "--json", "--name", "Sleeve", "--out", "weak-links/sleeve.toml"];
    let law = place.endline(&arguments).done().json();
    let mean = law["mean_N"].as_f64().unwrap();
    assert!((mean / 4.448_221_615_260_5 - 1670.0).abs() < 1e-6, "{law}");
    let probability = |at: usize| law["approvals"][at]["probability"].as_f64().unwrap();
    // Far inside 1,530 to 1,870 lbf; 30 lbf below 1,700 with a deviation of 51.4 / √5 = 23.0 lbf: T of 9 below 1.306 is 0.888.
    assert!(probability(0) > 0.999 && (probability(1) - 0.888).abs() < 0.001, "{law}");
    let item = fs::read_to_string(place.path("weak-links/sleeve.toml")).unwrap();
    assert!(item.contains("mill.csv: mean and standard deviation of 10 breaks"), "{item}");
    place.endline(&["check", "weak-links/sleeve.toml"]).done();
    let called =
        place.endline(&["mill", "--break", "1650 lbf", "--break", "7.5 kN", "--break", "1700 lbf"]);
    assert!(called.done().stdout.contains("NOAA bulletin 307460d"));
}

#[test]
fn mistakes_in_a_table_stand_at_their_rows() {
    let place = Place::new("mill-mistakes");
    place.write("mill.csv", &TABLE.replace("1720 lbf", "1720").replace("1580 lbf", "1580 lb"));
    let called = place.endline(&["mill", "mill.csv"]);
    called.fails(1, &["mill.csv:3:3", "has no unit", "mill.csv:4:3", "unit of a mass"]);
    place.write("few.csv", "break\n1700 lbf\n1650 lbf\n");
    place.endline(&["mill", "few.csv"]).fails(1, &["needs 3 or more"]);
    place.endline(&["mill", "none.csv"]).fails(1, &["none.csv", "cannot be read"]);
    place.endline(&["mill"]).fails(2, &["FILE.csv"]);
}

#[test]
fn any_limit_is_compared_with_breaks_or_with_the_mean_of_a_report() {
    let place = Place::new("mill-limit");
    place.write("mill.csv", TABLE);
    let law = place.endline(&["mill", "mill.csv", "--limit", "1,700 lbf", "--json"]).done().json();
    assert_eq!(law["approvals"].as_array().unwrap().len(), 1, "{law}");
    assert_eq!(law["approvals"][0]["source"], "--limit");
    let mean = ["mill", "--mean", "605 lbf", "--count", "10", "--limit", "600 lbf"];
    let said = place.endline(&mean).done().stdout;
    assert!(
        said.contains("at most 600 lbf\n  these breaks do not meet it in the mean\n"),
        "{said}"
    );
    assert!(
        said.contains("deviation  unknown") && said.contains("at least one of the 10"),
        "{said}"
    );
    let known = place.endline(&[mean.as_slice(), &["--deviation", "40 lbf", "--json"]].concat());
    let known = known.done().json();
    assert!(known["approvals"][0]["one_probability"].as_f64().unwrap() < 0.5, "{known}");
    place.write("means.csv", "sample,mean,count\na,470 lbf,10\nb,605 lbf,10\n");
    let laws = place.endline(&["mill", "means.csv", "--limit", "600 lbf", "--json"]).done().json();
    let holds = |at: usize| laws["samples"][at]["approvals"][0]["holds"].as_bool().unwrap();
    assert!(holds(0) && !holds(1), "{laws}");
    let out = ["--name", "Link", "--out", "link.toml"];
    place.endline(&[mean.as_slice(), &out].concat()).fails(1, &["--deviation"]);
    place.endline(&[&["mill", "means.csv"], out.as_slice()].concat()).fails(1, &["one product"]);
    place.endline(&["mill", "--mean", "605 lbf"]).fails(2, &["--count"]);
    place.endline(&["mill", "--mean", "605", "--count", "10"]).fails(2, &["unit"]);
}
