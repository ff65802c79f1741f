//! A search recovers an encounter from its ending alone, which is reported with errors and with a part hidden.

use crate::recovery::{Way, hide, host, opened, recover};

/// `cargo bench -p endline-tests --bench recovery` does the same with twenty encounters.
#[test]
fn a_hidden_encounter_is_found_by_what_it_left() {
    let host = host();
    let hidden = hide(&opened(&host), 1);
    let [hidden] = hidden.as_slice() else { panic!("no draw ends entangled") };
    let folder = std::env::temp_dir().join(format!("endline-recovered-{}", std::process::id()));
    let found = recover(hidden, 0, &Way { trials: 96, net: 64, folder: &folder }, &host);
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(found.nearest <= 1.0, "{}: {}", hidden.class, found.nearest);
}
