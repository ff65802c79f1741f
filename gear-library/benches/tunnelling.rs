//! Encounters of fast, taut rope with the edges of fins, counted: `cargo bench -p endline-gear --bench tunnelling -- 10000`.
//!
//! The numbers after `--` are the number of encounters and the first of them (default 10,000 from 0). The same encounters are run
//! with tests at the end of each step alone, but only a tenth of them (`docs/lab-notebook.md`, Tunnelling); the word `swept` omits these.
//! With the word `ropes` the piece meets two strands of rope that cross, or one rope in a loop, and rope meets rope and skin at once.
//! With the word `held`, the rope is held until the piece comes near.
//! With the word `bodies`, buoys and traps meet pieces of all of the skin.

#[path = "../tests/all/fins/mod.rs"]
mod fins;

use cpu_time::ProcessTime;
use fins::bodies::{self, Pieces};
use fins::tally::Tally;
use fins::{Encounter, Fins};

/// Encounters between two lines of the report.
const REPORT_EVERY: u64 = 1_000;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let mut asked = words.iter().filter_map(|word| word.parse::<u64>().ok());
    let (count, first) = (asked.next().unwrap_or(10_000), asked.next().unwrap_or(0));
    if words.iter().any(|word| word == "bodies") {
        return meetings(first..first + count);
    }
    let fins = Fins::new();
    if words.iter().any(|word| word == "ropes") {
        let two = |number| fins.encounter_of_two(number);
        return run("two strands", first..first + count, two);
    }
    if words.iter().any(|word| word == "held") {
        return run("held", first..first + count, |number| fins.approach(number));
    }
    if !words.iter().any(|word| word == "swept") {
        run("discrete", first..first + count / 10, |number| fins.encounter(number, false));
    }
    run("swept", first..first + count, |number| fins.encounter(number, true));
}

/// Buoys and traps in place of rope: a tenth of the meetings with discrete tests, along every path.
fn meetings(numbers: std::ops::Range<u64>) {
    let pieces = Pieces::new();
    let tenth = numbers.start..numbers.start + (numbers.end - numbers.start) / 10;
    for (name, numbers, swept) in [("discrete", tenth, false), ("swept", numbers, true)] {
        let (start, mut tally) = (ProcessTime::now(), bodies::Tally::default());
        for number in numbers {
            tally.add(number, pieces.meeting(number, swept));
        }
        println!("{name}: {tally:?}, {:.1} s", start.elapsed().as_secs_f64());
    }
}

fn run(name: &str, numbers: std::ops::Range<u64>, encounter: impl Fn(u64) -> Encounter) {
    let (start, mut tally, last) = (ProcessTime::now(), Tally::default(), numbers.end - 1);
    for number in numbers {
        tally.add(number, encounter(number));
        if number == last || tally.encounters.is_multiple_of(REPORT_EVERY) {
            print_tally(name, &tally, start.elapsed().as_secs_f64());
        }
    }
}

fn print_tally(name: &str, tally: &Tally, spent_s: f64) {
    let Tally { encounters, met, met_both, crossed, ropes_crossed, ended, held, .. } = tally;
    let Tally { solver_steps, passes, unconverged, reported, .. } = tally;
    println!(
        "{name}: {encounters} encounters, {met} with contact, {met_both} with rope on rope too, {crossed} crossed, {ropes_crossed} crossed rope, \
         {ended} ended early, {held} with rope held before, \
         {solver_steps} solver steps, {passes} passes, {unconverged} not converged, {:.2} ms each",
        1e3 * spent_s / *encounters as f64
    );
    reported.iter().for_each(|reported| println!("    {reported}"));
}
