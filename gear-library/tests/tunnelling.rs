//! No rope crosses the edge of a fin, however fast and taut; tests at the end of each step alone let many through.
//!
//! More of the same encounters: `cargo bench -p endline-gear --bench tunnelling -- 10000`.

mod fins;

use fins::{Fins, Tally};

const ENCOUNTERS: u64 = 240;
/// Of these, so many are run with discrete tests too.
const DISCRETE: u64 = 60;

#[test]
fn fast_taut_rope_crosses_no_edge() {
    let fins = Fins::new();
    let (mut swept, mut discrete) = (Tally::default(), Tally::default());
    (0..ENCOUNTERS).for_each(|number| swept.add(number, fins.encounter(number, true)));
    (0..DISCRETE).for_each(|number| discrete.add(number, fins.encounter(number, false)));
    println!("{swept:?}\nwith discrete tests: {discrete:?}");
    assert!(swept.met > ENCOUNTERS * 8 / 10, "rope is met by most: {swept:?}");
    assert_eq!(swept.crossed, 0, "{swept:?}");
    // A run in which rope is crushed to nothing ends and says so; that is rare.
    assert!(swept.ended <= ENCOUNTERS / 50, "{swept:?}");
    assert!(discrete.crossed > DISCRETE / 10, "what the sweep is for: {discrete:?}");
}
