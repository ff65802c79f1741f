//! The report as one HTML file, its figures inside.

use std::fmt::Write;

use endline_gear::Basis;

use crate::study::open::Opened;
use crate::study::stats::{Findings, OptionFinding};

use super::svg::escape;
use super::words::{event_words, force, points, rate, ratio};
use super::{changed, curves, figures};

/// Look of the page: dark on light, no colour needed, narrow enough to read, good to print.
const STYLE: &str = "body{font:16px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#1a1a1a;background:#fff}\
h1{line-height:1.2}h2{margin-top:2.5rem;border-bottom:1px solid #999}table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.9rem;margin:1rem 0}\
th,td{border-bottom:1px solid #ccc;padding:.3rem .7rem;text-align:left;vertical-align:top}th{border-bottom:2px solid #666}caption{text-align:left;font-weight:600;padding:.3rem 0}\
figure{margin:1.5rem 0}svg{width:100%;height:auto;font:12px system-ui,sans-serif}svg .grid{stroke:#ddd}svg .zero{stroke:#333;stroke-width:1.5}\
figcaption{font-size:.9rem;color:#444}.tag{border:1.5px solid;border-radius:.3rem;padding:0 .4rem;white-space:nowrap}.measured{color:#00664a}.derived{color:#00558a}.assumed{color:#a34700;border-style:dashed}\
code,pre{font-size:.85rem;background:#f3f3f3;padding:.1rem .3rem}pre{padding:.7rem;overflow-x:auto}.wide{overflow-x:auto}.i,td:first-child{white-space:nowrap}";

/// The page.
pub(super) fn page(opened: &Opened, findings: &Findings) -> String {
    let study = &opened.study;
    let mut page = format!(
        "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\
         <link rel=\"icon\" href=\"data:,\"><title>{name}</title><style>{STYLE}</style></head><body><h1>{name}</h1><p>{notes}</p>",
        name = escape(&study.name),
        notes = escape(&study.notes)
    );
    page += &lead(opened, findings);
    page += &rates(findings);
    page += &compared(opened, findings);
    page += &changed::section(findings);
    page += &tensions(findings);
    page += &regions(findings);
    page += &claims(findings);
    page += &sensitivity(findings);
    page += &inputs(opened);
    page += &limits();
    page += &again(opened, findings);
    page + "</body></html>\n"
}

fn lead(opened: &Opened, findings: &Findings) -> String {
    let invalid: u64 = findings.options.iter().map(|option| option.invalid).sum();
    let undecided: u64 = findings.options.iter().map(|option| option.undecided).sum();
    format!(
        "<p><strong>{} options met the same {} encounters.</strong> Every rate below is relative: given an encounter, under the distribution of encounters \
         named <em>{}</em> and set out under Inputs. How often whales meet gear is not known here. Brackets are intervals of 95 %. \
         {invalid} of {} runs are invalid, shown and left out; {undecided} were too short for their outcome to be sure, and count.</p>",
        findings.options.len(),
        findings.encounters,
        escape(&opened.study.id),
        findings.encounters * findings.options.len() as u64,
    )
}

/// A table with a caption.
pub(super) fn table(caption: &str, heads: &[&str], rows: &[Vec<String>]) -> String {
    let mut text =
        format!("<div class=\"wide\"><table><caption>{}</caption><thead><tr>", escape(caption));
    heads.iter().for_each(|head| {
        let _ = write!(text, "<th scope=\"col\">{}</th>", escape(head));
    });
    text += "</tr></thead><tbody>";
    for row in rows {
        text += "<tr>";
        row.iter().for_each(|cell| {
            let _ = write!(text, "<td>{cell}</td>");
        });
        text += "</tr>";
    }
    text + "</tbody></table></div>"
}

fn figure(svg: &str, caption: &str) -> String {
    format!("<figure>{svg}<figcaption>{}</figcaption></figure>", escape(caption))
}

fn rates(findings: &Findings) -> String {
    let events = ["contact", "shed", "entangled", "parted", "parted_free", "parted_entangled"];
    let row = |option: &OptionFinding| {
        let mut row = vec![escape(&option.name), option.invalid.to_string()];
        row.extend(events.iter().map(|event| option.rate(event).map_or_else(String::new, rate)));
        row
    };
    let words: Vec<String> = events.iter().map(|event| event_words(event)).collect();
    let heads: Vec<&str> =
        ["option", "invalid runs"].into_iter().chain(words.iter().map(String::as_str)).collect();
    let rows: Vec<Vec<String>> = findings.options.iter().map(row).collect();
    let caption = "Rates by option, given an encounter: whether rope touched, held at the end, and whether anything parted. Bars are intervals of 95 %.";
    format!(
        "<h2>What came of the encounters</h2>{}{}",
        figure(&figures::rates(findings), caption),
        table("Rates given an encounter", &heads, &rows)
    )
}

fn compared(opened: &Opened, findings: &Findings) -> String {
    let event = event_words(&findings.event);
    let row = |option: &OptionFinding| {
        let paired = option.against(&findings.event)?;
        Some(vec![
            escape(&option.name),
            points(paired.difference, paired.difference_interval),
            ratio(paired.ratio, paired.ratio_interval),
            format!("{:.3}", paired.fewer),
            format!("{} and {} of {}", paired.only_this, paired.only_other, paired.encounters),
            format!("{:.3}", paired.mcnemar),
            format!("{:.0} %", 100.0 * option.best_share),
        ])
    };
    let others =
        findings.options.iter().enumerate().filter(|(index, _)| *index != findings.baseline);
    let rows: Vec<Vec<String>> = others.filter_map(|(_, option)| row(option)).collect();
    let baseline = escape(&opened.options[opened.baseline].name);
    let heads = [
        "option",
        "difference",
        "ratio of rates",
        "probability of fewer",
        "only here, only in the baseline",
        "McNemar",
        "lowest rate when drawn again",
    ];
    let caption = format!(
        "Rate of \"{event}\" less that of the baseline, in percentage points, on the same encounters. Left of the line is fewer than with the baseline."
    );
    let mut text = format!(
        "<h2>Compared with {baseline}</h2>{}",
        figure(&figures::forest(findings), &caption)
    );
    text +=
        &table(&format!("\"{event}\" against the baseline, on the same encounters"), &heads, &rows);
    for level in &findings.levels {
        let rows: Vec<Vec<String>> = findings
            .options
            .iter()
            .enumerate()
            .map(|(index, option)| {
                vec![
                    escape(&option.name),
                    rate(&level.rates[index]),
                    points(
                        level.against[index].difference,
                        level.against[index].difference_interval,
                    ),
                    rate(&level.parted[index]),
                ]
            })
            .collect();
        text += &table(
            &format!("Of these, with {}", level.level),
            &["option", &event, "difference", "something parted"],
            &rows,
        );
    }
    text
}

fn tensions(findings: &Findings) -> String {
    let row = |option: &OptionFinding| {
        let at = |share| option.tensions.quantile_n(share).map_or_else(|| "none".into(), force);
        let difference = match (
            option.tensions.median_difference_n,
            option.tensions.median_difference_interval_n,
        ) {
            (Some(difference), Some(interval)) => {
                format!("{difference:+.1} N [{:.1}, {:.1}]", interval.low, interval.high)
            }
            _ => "none".into(),
        };
        vec![escape(&option.name), at(0.05), at(0.5), at(0.95), at(1.0), difference]
    };
    let rows: Vec<Vec<String>> = findings.options.iter().map(row).collect();
    let heads = [
        "option",
        "5 % below",
        "median",
        "95 % below",
        "greatest",
        "median of differences from the baseline",
    ];
    let mut text = format!(
        "<h2>Greatest tension in any line</h2>{}",
        figure(
            &curves::tensions(findings),
            "Share of runs whose greatest tension stays below a value."
        )
    );
    text += &table("Greatest tension of a run", &heads, &rows);
    if let Some(svg) = curves::break_away(findings) {
        text += "<h2>Break-away against strength</h2>";
        text += &figure(
            &svg,
            "Marks: share of encounters in which something parted, by the strength the option stands for. Line: share of the baseline's runs whose greatest tension in any line passes that strength, which is how often a line of that strength would be expected to part wherever the tension is greatest.",
        );
    }
    text
}

fn regions(findings: &Findings) -> String {
    let parts = ["head", "body", "flipper", "peduncle", "fluke"];
    let row = |option: &OptionFinding| {
        let cell = |part: &&str| {
            let one = |kind: &str| {
                option.rate(&format!("{kind}_{part}")).map_or_else(String::new, |rate| {
                    format!(
                        "{:.1} % [{:.1}, {:.1}]",
                        100.0 * rate.rate,
                        100.0 * rate.interval.low,
                        100.0 * rate.interval.high
                    )
                })
            };
            format!("{}<br>{}", one("contact"), one("wrap"))
        };
        [escape(&option.name)].into_iter().chain(parts.iter().map(cell)).collect::<Vec<_>>()
    };
    let rows: Vec<Vec<String>> = findings.options.iter().map(row).collect();
    let heads: Vec<&str> = ["option"].into_iter().chain(parts).collect();
    format!(
        "<h2>Where the rope was</h2>{}",
        table(
            "Upper: rope touched the part. Lower: at least half a turn about it at some time",
            &heads,
            &rows
        )
    )
}

fn claims(findings: &Findings) -> String {
    if findings.claims.is_empty() {
        return String::new();
    }
    let row = |claim: &crate::study::stats::ClaimFinding| {
        vec![
            format!("{}<br><small>{}</small>", escape(&claim.says), escape(&claim.source)),
            format!("{}<br>{}", escape(&claim.more), rate(&claim.more_rate)),
            format!("{}<br>{}", escape(&claim.less), rate(&claim.less_rate)),
            points(claim.difference, claim.interval),
            claim.verdict.words().to_owned(),
        ]
    };
    let rows: Vec<Vec<String>> = findings.claims.iter().map(row).collect();
    format!(
        "<h2>Claims and their signs</h2>{}",
        table(
            "Whether the sign holds",
            &["claim", "should be more", "should be less", "difference", "so"],
            &rows
        )
    )
}

fn sensitivity(findings: &Findings) -> String {
    let Some(svg) = figures::tornado(findings) else { return String::new() };
    let row = |input: &crate::study::stats::InputFinding| {
        let parts: Vec<String> = input
            .parts
            .iter()
            .map(|part| format!("{}: {}", escape(&part.name), rate(&part.rate)))
            .collect();
        let best =
            if input.same_best { "some option has or shares it throughout" } else { "changes" };
        vec![escape(&input.words), parts.join("<br>"), best.to_owned()]
    };
    let rows: Vec<Vec<String>> = findings.inputs.iter().map(row).collect();
    let caption = format!(
        "Rate of \"{}\" with the baseline, by the lower and upper half of each input or by its levels: the words at a bar's ends name the parts with the least and the greatest rate. A wide bar is an input on which the result hangs.",
        event_words(&findings.event)
    );
    format!(
        "<h2>What the result hangs on</h2>{}{}",
        figure(&svg, &caption),
        table(
            "Sensitivity and rank",
            &["input", "rate by part", "option with the lowest rate"],
            &rows
        )
    )
}

fn inputs(opened: &Opened) -> String {
    let tag = |basis: Basis| format!("<span class=\"tag {0}\">{0}</span>", basis.word());
    let law = |prior: &endline_gear::Prior| escape(&prior.law.words());
    let rows: Vec<Vec<String>> = opened
        .study
        .priors
        .iter()
        .map(|prior| {
            vec![escape(&prior.words()), law(prior), tag(prior.basis), escape(&prior.source)]
        })
        .collect();
    let options: Vec<Vec<String>> = opened
        .study
        .options
        .iter()
        .map(|option| {
            let set: Vec<String> = option
                .settings
                .iter()
                .map(|setting| {
                    format!(
                        "<code>{} = {}</code>",
                        escape(&setting.field.value),
                        escape(&setting.value.written())
                    )
                })
                .collect();
            vec![escape(&option.name), set.join("<br>")]
        })
        .collect();
    format!(
        "<h2>Inputs</h2><p>Baseline scenario: <code>{}</code>.</p>{}{}",
        escape(&opened.study.scenario.value),
        table("How encounters are drawn", &["quantity", "law", "sureness", "source"], &rows),
        table("Options as differences from the baseline", &["option", "what is set"], &options)
    )
}

fn limits() -> String {
    "<h2>What these numbers do not say</h2><ul><li>How often whales meet gear, and so how many would be entangled.</li>\
     <li>Intervals speak of chance: of the number of encounters, not of whether friction, behaviour or the model are right.</li>\
     <li>Inputs tagged <em>assumed</em> are nobody's measurement.</li><li>Outcome, wrap and contact are definitions, \
     written down with the program's documents (entanglement), their thresholds estimates.</li></ul>"
        .to_owned()
}

fn again(opened: &Opened, findings: &Findings) -> String {
    let plugins: Vec<String> = opened.options[opened.baseline]
        .prepared
        .plugins
        .iter()
        .map(|plugin| escape(&format!("{} {}", plugin.id, plugin.version)))
        .collect();
    format!(
        "<h2>To do it again</h2><p>The folder <code>bundle</code> beside this file holds study, scenario and library as they were. With Endline {}:</p>\
         <pre>{}</pre><p>Study hash <code>{}</code>, seed {}, {} encounters; plugins {}.</p>",
        crate::VERSION,
        escape(super::bundle::COMMANDS),
        findings.hash,
        opened.study.seed,
        findings.encounters,
        plugins.join(", ")
    )
}
