//! Blind recovery in numbers: how many hidden encounters a search finds again.
//!
//! ```text
//! cargo bench -p endline-tests --bench recovery -- 20 400      # hidden encounters, trials of each search
//! ```

#![allow(clippy::print_stdout, reason = "its result is a table for documents")]

#[path = "../tests/recovery/mod.rs"]
mod recovery;

use recovery::{hide, host, opened, recover};

fn main() {
    let numbers: Vec<usize> =
        std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let (count, trials) =
        (numbers.first().copied().unwrap_or(20), numbers.get(1).copied().unwrap_or(400));
    let host = host();
    let hidden = hide(&opened(&host), count);
    println!(
        "| | seen | first touched | D | part first touched among the stories | runs to D <= 1 |"
    );
    println!("|---|---|---|---|---|---|");
    let (mut like, mut named) = (0, 0);
    for (number, hidden) in hidden.iter().enumerate() {
        let found = recover(hidden, number, trials, &host);
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
    println!("\n{like} of {} with D <= 1, {named} with the part first touched", hidden.len());
}
