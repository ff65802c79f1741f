//! `endline search`: encounters that end like an observation of a real whale.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

use endline_session::campaign::{Control, Shard};
use endline_session::encounters::Encounter;
use endline_session::json;
use endline_session::search::{
    DEFAULT_NET, Effort, Folder, LIKE, Progress, Question, Stories, Story, page, search as found,
};
use endline_session::study::REPLAY_HZ;

use super::interrupt::Interrupt;
use super::study::args::shard;
use super::study::{all_cores, lower_priority, save_run};
use super::{Failure, host, output};

/// Time between two notes of progress.
const BETWEEN: Duration = Duration::from_secs(30);

#[derive(Debug, clap::Args)]
pub(super) struct SearchArgs {
    /// Observation file, or the id of an observation in the gear library.
    #[arg(value_name = "OBSERVATION")]
    observation: String,
    /// Study with one option whose encounters are searched [default: the one that the observation names].
    #[arg(long, value_name = "STUDY")]
    encounters: Option<String>,
    /// Folder of the search [default: results/search- followed by the observation's id].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Number of runs wanted; the round that reaches it is finished (first rounds of 32). A greater number continues a finished search.
    #[arg(long, value_name = "N", default_value_t = 1000)]
    trials: usize,
    /// Neighbours to run of every story that ends alike; 0 runs none.
    #[arg(long, value_name = "N", default_value_t = 12)]
    neighbours: usize,
    /// Write the best stories as scenario, recording and picture.
    #[arg(long, value_name = "N", default_value_t = 0)]
    keep: usize,
    /// Draws from the priors before the first local search; as many as `--trials`, and draws alone are tried.
    #[arg(long, value_name = "N", default_value_t = DEFAULT_NET)]
    net: usize,
    /// Folder of draws that searches among the same encounters share [default: the search's own].
    #[arg(long, value_name = "DIR")]
    net_folder: Option<PathBuf>,
    /// Run only this part of every round, such as 2/7, and wait for the others; all parts need one folder.
    #[arg(long, value_name = "I/N", default_value = "1/1", value_parser = shard)]
    shard: Shard,
    /// Number of threads [default: one for each core].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Run at normal priority instead of low priority.
    #[arg(long)]
    eager: bool,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Searches, prints the results, and stores the best stories as runs.
pub(super) fn search(args: &SearchArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let host = host::load();
    let question = Question::open(&args.observation, args.encounters.as_deref(), library, &host)?;
    let usual = || Path::new("results").join(format!("search-{}", question.observation.id));
    let out = args.out.clone().unwrap_or_else(usual);
    let folder = Folder::open(&out, args.net_folder.as_deref(), &question)?;
    if !args.eager {
        lower_priority();
    }
    let effort = Effort {
        trials: args.trials,
        threads: args.threads.map_or_else(all_cores, usize::from),
        shard: args.shard,
        neighbours: args.neighbours,
        net: args.net,
    };
    let control = Arc::new(Control::default());
    let (interrupt, watched) = (Interrupt::watch(), Arc::clone(&control));
    interrupt.on_asked(move || watched.cancel());
    let stories = found(&question, &folder, &effort, &control, progress())?;
    if let Some(code) = interrupt.exit_code() {
        output::warn(&format!(
            "interrupted: runs are kept in {}; the same command continues from them",
            folder.path.display()
        ));
        return Ok(code);
    }
    for (number, story) in stories.stories.iter().take(args.keep).enumerate() {
        let encounter = Encounter::at_point(&question.opened.study, &story.point);
        let played = question.opened.play(0, &encounter, REPLAY_HZ)?;
        save_run(&folder.path.join(format!("story-{}", number + 1)), &played)?;
    }
    let report = page::write(&question, &folder, &stories)?;
    output::note(&format!("the report is {}", report.display()));
    output::print(&if args.json { json::indented(&stories) + "\n" } else { words(&stories) })?;
    Ok(ExitCode::SUCCESS)
}

/// Notes progress now and then.
fn progress() -> impl FnMut(Progress) {
    let mut last = Instant::now();
    move |progress: Progress| {
        if last.elapsed() < BETWEEN && progress.trials < progress.of {
            return;
        }
        last = Instant::now();
        let best = progress.best.map_or("none".to_owned(), |best| format!("{best:.2}"));
        output::note(&format!(
            "{} of {} runs, least distance {best}",
            progress.trials, progress.of
        ));
    }
}

fn words(stories: &Stories) -> String {
    let like = stories.stories.iter().filter(|story| story.is_like()).count();
    let head = format!(
        "{} runs among the encounters of `{}`, {} of them drawn from its priors\n",
        stories.trials, stories.encounters, stories.net
    );
    let found = match like {
        0 => format!("Not found: no run ends like `{}`, nearest first:\n", stories.observation),
        1 => format!("One kind of story ends like `{}`:\n", stories.observation),
        like => format!("{like} kinds of story end like `{}`:\n", stories.observation),
    };
    let share = format!(
        "draws from the priors that end like it (distance at most {LIKE}): {}\n",
        stories.share_of_draws()
    );
    let listed: String =
        stories.stories.iter().enumerate().map(|(n, story)| one(n + 1, story, stories)).collect();
    let free = stories.free_in_words().map_or(String::new(), |free| format!("{free}\n"));
    format!("{head}{share}\n{found}{listed}{free}")
}

fn one(number: usize, story: &Story, stories: &Stories) -> String {
    let alike = story.trust(stories).map_or(String::new(), |trust| format!("; {trust}"));
    let course =
        if story.course.is_empty() { String::new() } else { format!(", {}", story.course) };
    let mirrored = if story.mirrored { ", as its mirror image" } else { "" };
    let terms: String =
        story.terms.iter().map(|(cost, says)| format!("      {cost:5.2}  {says}\n")).collect();
    format!(
        "{number:3}. {:.2}  first the {}; {}{course}{mirrored}{alike}\n{terms}",
        story.distance,
        story.first_part.replace('_', " "),
        story.acts_in_words()
    )
}
