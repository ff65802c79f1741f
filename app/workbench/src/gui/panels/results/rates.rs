//! Tables of rates, comparisons and claims, with intervals.

use egui::{Grid, RichText, Ui};
use endline_session::study::StudyResults;
use endline_session::study::report::lowest;
use endline_session::study::stats::{Interval, OptionFinding, Rate, Verdict};

use crate::gui::theme::Theme;
use crate::gui::widgets;

/// `12.0 % [8.1, 17.4]`.
pub(super) fn rate(rate: &Rate) -> String {
    format!("{:.1} % {}", 100.0 * rate.rate, percent(rate.interval))
}

/// `-3.5 [-6.1, -0.9]`, in percentage points.
pub(super) fn points(difference: f64, interval: Interval) -> String {
    format!("{:+.1} {}", 100.0 * difference, percent(interval))
}

fn percent(Interval { low, high }: Interval) -> String {
    format!("[{:.1}, {:.1}]", 100.0 * low, 100.0 * high)
}

/// Draws the table of options.
pub(super) fn show(ui: &mut Ui, shown: &StudyResults, event: &str) {
    let faint = Theme::palette_of(ui).faint;
    let heads = [
        ("Option", ""),
        ("Runs", "Valid runs of all runs"),
        ("Rate [%]", "Share of runs with the event, with its interval"),
        (
            "Difference from baseline [points]",
            "Rate minus that of the baseline in the same encounters; negative is rarer",
        ),
        ("Ratio", "Rate divided by that of the baseline"),
        (
            "Chance that it is rarer",
            "Probability that the event is rarer than with the baseline, from 0 to 1",
        ),
        (
            "Lowest",
            "How often this option has the lowest rate in resampled encounters: alone, or tied with others",
        ),
        ("Undecided", "Runs too short for a final outcome; they are included"),
    ];
    Grid::new("rates").num_columns(heads.len()).striped(true).spacing([16.0, 4.0]).show(ui, |ui| {
        for (head, help) in heads {
            ui.label(RichText::new(head).small().color(faint)).on_hover_text(help);
        }
        ui.end_row();
        for (index, option) in shown.findings.options.iter().enumerate() {
            row(ui, option, event, index == shown.findings.baseline, event == shown.findings.event);
        }
    });
    levels(ui, shown);
}

fn row(ui: &mut Ui, option: &OptionFinding, event: &str, baseline: bool, own_event: bool) {
    let palette = Theme::palette_of(ui);
    let (Some(own), Some(paired)) = (option.rate(event), option.against(event)) else { return };
    let name = if baseline { format!("{} (baseline)", option.name) } else { option.name.clone() };
    ui.label(RichText::new(name).color(if baseline { palette.accent } else { palette.text }))
        .on_hover_text(&option.id);
    ui.label(format!("{} of {}", own.runs, own.runs + option.invalid));
    ui.label(rate(own)).on_hover_text(format!("{} of {}", own.hits, own.runs));
    if baseline {
        (0..3).for_each(|_| drop(ui.label(RichText::new("–").color(palette.faint))));
    } else {
        let sure = paired.difference_interval.low > 0.0 || paired.difference_interval.high < 0.0;
        let text = RichText::new(points(paired.difference, paired.difference_interval));
        ui.label(if sure { text.strong() } else { text }).on_hover_text(format!(
            "{} encounters: both {}, this alone {}, baseline alone {}; McNemar {:.3}",
            paired.encounters, paired.both, paired.only_this, paired.only_other, paired.mcnemar
        ));
        ui.label(match (paired.ratio, paired.ratio_interval) {
            (Some(ratio), Some(Interval { low, high })) => {
                format!("{ratio:.2} [{low:.2}, {high:.2}]")
            }
            _ => "none".into(),
        });
        ui.label(format!("{:.3}", paired.fewer));
    }
    ui.label(if own_event { lowest(option.lowest) } else { "–".into() });
    ui.label(option.undecided.to_string());
    ui.end_row();
}

/// Draws rates by levels of the prior that splits the results.
fn levels(ui: &mut Ui, shown: &StudyResults) {
    let faint = Theme::palette_of(ui).faint;
    for level in &shown.findings.levels {
        widgets::caption(ui, &level.level);
        Grid::new(("level", &level.level)).num_columns(4).striped(true).spacing([16.0, 3.0]).show(
            ui,
            |ui| {
                for head in [
                    "Option",
                    "Rate of the event [%]",
                    "Difference from baseline [points]",
                    "Parted [%]",
                ] {
                    ui.label(RichText::new(head).small().color(faint));
                }
                ui.end_row();
                let rows = shown
                    .findings
                    .options
                    .iter()
                    .zip(&level.rates)
                    .zip(&level.against)
                    .zip(&level.parted);
                for (((option, own), paired), parted) in rows {
                    ui.label(&option.name);
                    ui.label(rate(own));
                    ui.label(points(paired.difference, paired.difference_interval));
                    ui.label(rate(parted));
                    ui.end_row();
                }
            },
        );
    }
}

/// Draws the claims.
pub(super) fn claims(ui: &mut Ui, shown: &StudyResults) {
    let palette = Theme::palette_of(ui);
    for claim in &shown.findings.claims {
        let colour = match claim.verdict {
            Verdict::Holds => palette.good,
            Verdict::Opposite => palette.error,
            Verdict::Open | Verdict::Alone => palette.warning,
        };
        ui.label(RichText::new(&claim.says).strong()).on_hover_text(&claim.source);
        ui.label(format!("more: {}, {}", claim.more, rate(&claim.more_rate)));
        ui.label(format!("less: {}, {}", claim.less, rate(&claim.less_rate)));
        ui.horizontal(|ui| {
            ui.label(format!("difference {} points", points(claim.difference, claim.interval)));
            ui.label(RichText::new(claim.verdict.words()).color(colour));
        });
        ui.add_space(8.0);
    }
}
