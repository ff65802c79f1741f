//! `endline rules study`: what rules buy, as a study.

use std::path::Path;
use std::process::ExitCode;

use endline_session::locate;
use endline_session::rules::Packs;
use endline_session::rules::remedy::Asked;
use endline_session::rules::study::{RuleOption, options, text};
use endline_session::source::AssemblyFile;

use super::args::StudyArgs;
use super::write_new;
use crate::cli::{Failure, host, output};

pub(super) fn study(args: &StudyArgs, library: Option<&Path>) -> Result<ExitCode, Failure> {
    let packs = Packs::open(library, &args.pack)?;
    let file = AssemblyFile::open(&args.assembly, library)?;
    let like = locate::named(&args.like, "studies", library).map_err(Failure::failed)?;
    let like = endline_gear::read::text(&like)
        .map_err(|error| Failure::failed(format!("{}: {error}", like.display())))?;
    let asked = Asked { id: &file.id, text: &file.text, sources: &file.sources };
    let options = options(asked, &args.option, args.depth, &packs, &host::load())?;
    let text = text(&file.id, &options, &like, args.depth)?;
    let path = write_new(&args.out, &file.root, "studies", &text)?;
    output::print(&words(&path, &options))?;
    Ok(ExitCode::SUCCESS)
}

fn words(path: &Path, options: &[RuleOption]) -> String {
    let mut text = String::new();
    for option in options {
        let edit = option.edit.as_ref().map_or("The gear as it stands.", |edit| &edit.says);
        text += &format!("{:26}  {edit}\n", option.rule);
    }
    let file = path.display();
    text + &format!("\nThe study is {file}; `endline study plan {file}` prints its encounters.\n")
}
