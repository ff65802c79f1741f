//! Blind recovery in numbers: how many hidden encounters a search finds again.
//!
//! ```text
//! cargo bench -p endline-tests --bench recovery -- 20 2000 2000 --folder=results/recovery
//! # hidden encounters, runs of each search, draws of its net; a repeated call continues from the results in the folder
//! # a fourth number omits that many of the first, reported elsewhere; --only=7,13 searches for these alone
//! ```

#![allow(clippy::print_stdout, reason = "its result is a table for documents")]

#[path = "../tests/recovery/mod.rs"]
mod recovery;

use std::time::Instant;

use recovery::{Way, hide, host, opened, recover};

fn main() {
    let numbers: Vec<usize> =
        std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let number = |place: usize, usual| numbers.get(place).copied().unwrap_or(usual);
    let (count, trials, net, omitted) =
        (number(0, 20), number(1, 2000), number(2, 2000), number(3, 0));
    let folder =
        std::env::args().find_map(|argument| Some(argument.strip_prefix("--folder=")?.into()));
    let only: Option<Vec<usize>> = std::env::args().find_map(|argument| {
        let list = argument.strip_prefix("--only=")?.split(',');
        Some(list.filter_map(|number| number.parse().ok()).collect())
    });
    let folder = folder.unwrap_or_else(|| std::env::temp_dir().join("endline-recovery"));
    let way = Way { trials, net, folder: &folder };
    let host = host();
    let begun = Instant::now();
    let hidden = hide(&opened(&host), count);
    println!(
        "| | seen | first touched | D | part first touched among the stories | runs to D <= 1 |"
    );
    println!("|---|---|---|---|---|---|");
    let (mut searched, mut like, mut named) = (0, 0, 0);
    let wanted = |number: usize| only.as_ref().is_none_or(|only| only.contains(&(number + 1)));
    for (number, hidden) in hidden.iter().enumerate().skip(omitted) {
        if !wanted(number) {
            continue;
        }
        searched += 1;
        let found = recover(hidden, number, &way, &host);
        like += usize::from(found.nearest <= 1.0);
        named += usize::from(found.named);
        println!(
            "| {} | {} | {} | {:.2} | {} | {} |",
            number + 1,
            hidden.class,
            hidden.first_part,
            found.nearest,
            if found.named { "yes" } else { "no" },
            found.after.map_or("-".to_owned(), |after| after.to_string())
        );
    }
    println!(
        "\n{like} of {searched} with D <= 1, {named} with the part first touched; {:.0} s",
        begun.elapsed().as_secs_f64()
    );
}
