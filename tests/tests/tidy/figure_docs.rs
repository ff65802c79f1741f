//! docs/figures.md says of every figure what its declaration says.
//!
//! `ENDLINE_WRITE_DOCS=1 cargo test -p endline-tests --test tidy figure_docs` writes the page anew.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail the test")]

use std::fmt::Write;
use std::fs;

use endline_session::figures::{
    ATTEMPT, AUDIT, BALANCE, BEAT, BODY, COST, EVENT, Figure, KINETIC, LINE, LINK, MOMENT, PART,
    PATCH, PHASE, PLUGIN, PROBE, RUN, SETTLED, View, WHALE,
};
use endline_tests::root;

const DOCUMENT: &str = "docs/figures.md";

const HEAD: &str = "# Figures

This page lists every figure that Endline reports of a run.
It is written from the declarations in `app/session/src/figures`; the head of `tests/tests/tidy/figure_docs.rs` explains how to write it again.
[entanglement.md](entanglement.md) defines the measures.

*Key* is the key in the JSON of `endline run --json`, schema `endline.run/1`; a figure in brackets is not in the JSON.
*Column* is the name in `table.parquet` and `table.csv` of a study.
The columns of a part of the whale begin with the name of the part, such as `head_wraps`.
*Shown* names the other views: the tables of the command line, the panels *Summary* and *Entanglement*, and *Compare*, the comparison of two runs.
A study adds a column `drawn_NAME` for each quantity that it draws.
";

/// The views of a figure besides JSON and table of a study.
fn views<S>(figure: &Figure<S>) -> String {
    let name = |view: &View| match view {
        View::Table => "command line",
        View::Summary => "Summary",
        View::Entanglement => "Entanglement",
        View::Compare => "Compare",
    };
    figure.views.iter().map(name).collect::<Vec<_>>().join(", ")
}

/// A section with the table of a list.
fn section<S>(page: &mut String, title: &str, figures: &[Figure<S>]) {
    write!(
        page,
        "\n## {title}\n\n| key | unit | column | shown | meaning |\n|---|---|---|---|---|\n"
    )
    .unwrap();
    for figure in figures {
        let key = if figure.in_json {
            format!("`{}`", figure.key)
        } else {
            format!("(`{}`)", figure.key)
        };
        let column = figure.column.map_or_else(String::new, |column| format!("`{}`", column.name));
        writeln!(
            page,
            "| {key} | {} | {column} | {} | {} |",
            figure.quantity.unit(),
            views(figure),
            figure.help
        )
        .unwrap();
    }
}

fn page() -> String {
    let mut page = HEAD.to_owned();
    section(&mut page, "Run", RUN);
    section(&mut page, "`audit`: the solver", AUDIT);
    section(&mut page, "`audit.balance`: momentum and energy of the gear", BALANCE);
    section(&mut page, "`approach` and `contact`: phases of the run", PHASE);
    section(&mut page, "`settled`: the statics before the run", SETTLED);
    section(&mut page, "`cost`: computing time", COST);
    section(&mut page, "`lines`: each line", LINE);
    section(&mut page, "`links`: each weak link", LINK);
    section(&mut page, "`bodies`: each trap, buoy, anchor and weight", BODY);
    section(&mut page, "`probes`: each probe", PROBE);
    section(&mut page, "`whale`: the whale", WHALE);
    section(&mut page, "`whale.regions`: each part of the body", PART);
    section(&mut page, "`whale.patches`: each labelled patch of skin", PATCH);
    section(&mut page, "`whale.beat`: the fluke beat", BEAT);
    section(&mut page, "`whale.kinetic`: a kinetic whale", KINETIC);
    section(&mut page, "`events`: each event", EVENT);
    section(&mut page, "`plugins`: each plugin of the model", PLUGIN);
    section(&mut page, "Added by a study", ATTEMPT);
    section(&mut page, "The moment shown", MOMENT);
    page
}

#[test]
fn the_document_has_every_figure_as_it_is_declared() {
    let path = root().join(DOCUMENT);
    let fresh = page();
    if std::env::var_os("ENDLINE_WRITE_DOCS").is_some() {
        fs::write(&path, &fresh).unwrap();
        return;
    }
    let document = fs::read_to_string(&path).unwrap_or_default();
    let first = document.lines().zip(fresh.lines()).find(|(old, new)| old != new);
    assert_eq!(
        document, fresh,
        "{DOCUMENT} is out of date, first at {first:?}; the head of \
         tests/tests/tidy/figure_docs.rs says how to write it again"
    );
}
