//! No rope crosses the edge of a fin at any speed and tension; with tests only at the end of each step most would cross.
//!
//! It is slow because the sample has ten thousand encounters; a larger sample: `cargo bench -p endline-gear --bench tunnelling -- 100000`.

#![allow(clippy::expect_used, reason = "a test fails by panicking, in its helpers too")]

use std::ops::Range;

use crate::fins::Fins;
use crate::fins::bodies::{self, Pieces};
use crate::fins::tally::Tally;

const ENCOUNTERS: u64 = 10_000;
/// Number of encounters that are also run with discrete tests.
const DISCRETE: u64 = 200;
/// Parts that run at a time.
const PARTS: u64 = 2;

#[test]
fn fast_taut_rope_crosses_no_edge() {
    let fins = Fins::new();
    let (swept, discrete) = (run(&fins, 0..ENCOUNTERS, true), run(&fins, 0..DISCRETE, false));
    println!("{swept:?}\nwith discrete tests: {discrete:?}");
    assert!(swept.met > ENCOUNTERS * 99 / 100, "rope is met by nearly all: {swept:?}");
    assert_eq!(swept.crossed, 0, "{swept:?}");
    // A run with a crushed rope ends with an error, which is rare.
    assert!(swept.ended <= ENCOUNTERS / 500, "{swept:?}");
    assert!(swept.unconverged < swept.solver_steps / 10, "{swept:?}");
    assert!(discrete.crossed > DISCRETE * 7 / 10, "what the sweep is for: {discrete:?}");
}

/// Encounters of rope that is held.
const HELD: u64 = 1_000;

#[test]
fn nothing_touches_rope_while_it_is_held() {
    let (fins, mut tally) = (Fins::new(), Tally::default());
    (0..HELD).for_each(|number| tally.add(number, fins.approach(number)));
    println!("{tally:?}");
    assert!(tally.held > HELD * 9 / 10, "rope is held in nearly all: {tally:?}");
    assert!(tally.met > HELD * 9 / 10, "and met in nearly all: {tally:?}");
    assert_eq!(tally.crossed, 0, "{tally:?}");
    assert!(tally.ended <= HELD / 100, "{tally:?}");
}

#[test]
fn nothing_touches_rope_of_a_field_while_it_is_held() {
    let (fins, mut tally) = (Fins::new(), Tally::default());
    (0..HELD).for_each(|number| tally.add(number, fins.approach_in_field(number)));
    println!("{tally:?}");
    assert!(tally.held > HELD * 9 / 10, "rope is held in nearly all: {tally:?}");
    assert!(tally.met > HELD * 9 / 10, "and met in nearly all: {tally:?}");
    assert_eq!(tally.crossed, 0, "{tally:?}");
    assert!(tally.ended <= HELD / 100, "{tally:?}");
}

const OF_TWO: u64 = 200;

#[test]
fn two_strands_between_rope_and_skin_cross_neither() {
    let (fins, mut tally) = (Fins::new(), Tally::default());
    (0..OF_TWO).for_each(|number| tally.add(number, fins.encounter_of_two(number)));
    println!("{tally:?}");
    assert!(tally.met > OF_TWO * 9 / 10, "most are met: {tally:?}");
    assert!(tally.met_both > OF_TWO / 2, "rope is between skin and rope in most: {tally:?}");
    assert_eq!((tally.crossed, tally.ropes_crossed), (0, 0), "{tally:?}");
    assert!(tally.ended <= OF_TWO / 50, "{tally:?}");
    assert!(tally.unconverged < tally.solver_steps / 10, "{tally:?}");
}

const MEETINGS: u64 = 1_000;

#[test]
fn no_body_goes_through_skin() {
    let pieces = Pieces::new();
    let run = |numbers: Range<u64>, swept: bool| {
        let mut tally = bodies::Tally::default();
        numbers.for_each(|number| tally.add(number, pieces.meeting(number, swept)));
        tally
    };
    let (swept, discrete) = (run(0..MEETINGS, true), run(0..DISCRETE, false));
    println!("{swept:?}\nwith discrete tests: {discrete:?}");
    assert!(swept.met > MEETINGS * 8 / 10, "most are met: {swept:?}");
    assert_eq!(swept.crossed, 0, "{swept:?}");
    assert!(swept.ended <= MEETINGS / 500, "{swept:?}");
    assert!(discrete.crossed > DISCRETE / 10, "what the path is looked at for: {discrete:?}");
}

/// Encounters with each kind of curved body: flat-ended buoy, spheroid, high-flyer.
const OF_EACH: u64 = 200;

#[test]
fn no_buoy_of_any_shape_goes_through_skin() {
    let pieces = Pieces::new();
    for kind in 3..6 {
        let mut tally = bodies::Tally::default();
        let drawn = (0..OF_EACH).map(|number| pieces.meeting_of(number, true, Some(kind)));
        (0..).zip(drawn).for_each(|(number, meeting)| tally.add(number, meeting));
        println!("{kind}: {tally:?}");
        assert!(tally.met > OF_EACH * 8 / 10, "most are met: {kind}: {tally:?}");
        assert_eq!(tally.crossed, 0, "{kind}: {tally:?}");
        assert!(tally.ended <= OF_EACH / 100, "{kind}: {tally:?}");
    }
}

/// Runs the encounters of these numbers in parallel parts.
fn run(fins: &Fins, numbers: Range<u64>, swept: bool) -> Tally {
    let each = (numbers.end - numbers.start) / PARTS;
    std::thread::scope(|scope| {
        let part = |part: u64| {
            let first = numbers.start + part * each;
            scope.spawn(move || {
                let mut tally = Tally::default();
                (first..first + each)
                    .for_each(|number| tally.add(number, fins.encounter(number, swept)));
                tally
            })
        };
        let parts: Vec<_> = (0..PARTS).map(part).collect();
        parts.into_iter().fold(Tally::default(), |sum, part| {
            sum.with(part.join().expect("a part ran to its end"))
        })
    })
}
