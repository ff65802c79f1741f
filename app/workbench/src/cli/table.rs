//! Summaries for people: aligned columns, forces in newtons and pounds-force.

use std::fmt::Write;

use endline_session::Report;
use endline_session::report::{
    BeatReport, LineReport, LinkReport, PhaseReport, ProbeReport, WhaleReport,
};
use endline_session::settled::SettledShape;

/// Newtons in a pound-force.
const N_PER_LBF: f64 = 4.448_221_615_260_5;

/// The summary of a run.
pub(super) fn summary(report: &Report) -> String {
    let mut text = format!("{}\n\n", report.scenario);
    text += &head(report);
    text += &lines(&report.lines);
    text += &links(&report.links);
    text += &bodies(report);
    text += &probes(&report.probes);
    text += &report.whale.as_ref().map(|own| whale(own, report)).unwrap_or_default();
    text + &events(report)
}

/// The gear at rest.
pub(super) fn settled(shape: &SettledShape) -> String {
    let mut text = format!("{}\n\n", shape.scenario);
    text += &columns(&[
        vec!["outcome".into(), shape.outcome.clone()],
        vec!["out of balance".into(), out_of_balance(shape)],
        vec!["passes".into(), format!("{} in {:.1} ms", shape.trace_N.len(), 1e3 * shape.wall_s)],
        vec!["rope nodes".into(), shape.nodes.to_string()],
    ]);
    let mut rows = vec![row(&["line", "length", "tension at end A", "tension at end B"])];
    for line in &shape.lines {
        rows.push(vec![
            line.id.clone(),
            format!("{:.2} m", line.length_m),
            force(line.end_a_tension_N),
            force(line.end_b_tension_N),
        ]);
    }
    text += &columns(&rows);
    let mut rows = vec![row(&["body", "east", "north", "up"])];
    rows.extend(shape.bodies.iter().map(|body| place(&body.id, body.position_m)));
    text + &columns(&rows) + &probes(&shape.probes)
}

fn out_of_balance(shape: &SettledShape) -> String {
    let at = shape.worst_part.as_ref().map_or_else(String::new, |part| format!(" at {part}"));
    format!("{:.2e} N{at}", shape.residual_N)
}

fn head(report: &Report) -> String {
    let state = match &report.stopped {
        Some(stopped) => stopped.clone(),
        None if report.valid => "ran to its end".into(),
        None => format!(
            "INVALID, ran to its end, but its numbers cannot be trusted: {}",
            report.invalid_because.join("; ")
        ),
    };
    let audit = &report.audit;
    columns(&[
        vec!["run".into(), state],
        vec![
            "simulated".into(),
            format!("{:.2} s in {} steps of {} s", report.simulated_s, report.steps, report.dt_s),
        ],
        vec!["speed".into(), speed(report)],
        vec![
            "model".into(),
            format!(
                "{} rope nodes, {} triangles, seed {}",
                report.nodes, report.triangles, report.seed
            ),
        ],
        vec![
            "audit".into(),
            format!(
                "{} tunnelled, {} ropes crossed, {} not finite, {:.2} mm deepest, {}, {} winding jumps, {} steps not converged",
                audit.tunnelled,
                audit.ropes_crossed,
                audit.non_finite,
                1e3 * audit.max_penetration_m,
                audit.least_distance_m.map_or_else(
                    || "never near skin".into(),
                    |least| format!("{:.2} mm off the skin at least", 1e3 * least)
                ),
                audit.winding_jumps,
                audit.unconverged
            ),
        ],
        vec![
            "solver steps".into(),
            format!("{}, mostly limited by {}", audit.solver_steps, audit.steps_mostly_limited_by),
        ],
        vec!["state hash".into(), report.state_hash.clone()],
    ])
}

fn speed(report: &Report) -> String {
    let phase = |name: &str, phase: &PhaseReport| {
        if phase.simulated_s > 0.0 {
            format!("{name} {:.1}", phase.times_real_time)
        } else {
            format!("{name} none")
        }
    };
    format!(
        "{:.1} times real time ({}, {})",
        report.times_real_time,
        phase("approach", &report.approach),
        phase("contact", &report.contact)
    )
}

fn lines(lines: &[LineReport]) -> String {
    let mut rows = vec![row(&["line", "peak tension", "at", "settled", "parted"])];
    for line in lines {
        let peak_at = format!("{:.2} s", line.peak_at_s);
        rows.push(vec![
            line.id.clone(),
            force(line.peak_tension_N),
            peak_at,
            force(line.settled_tension_N),
            moment(line.parted_at_s),
        ]);
    }
    columns(&rows)
}

fn links(links: &[LinkReport]) -> String {
    let mut rows = vec![row(&["weak link", "rating", "peak tension", "parted"])];
    for link in links {
        rows.push(vec![
            link.id.clone(),
            force(link.rating_N),
            force(link.peak_tension_N),
            moment(link.parted_at_s),
        ]);
    }
    columns(&rows)
}

fn bodies(report: &Report) -> String {
    let mut rows = vec![row(&["body", "east", "north", "up", "peak speed"])];
    for body in &report.bodies {
        let mut row = place(&body.id, body.position_m);
        row.push(format!("{:.2} m/s", body.peak_speed_m_s));
        rows.push(row);
    }
    columns(&rows)
}

fn probes(probes: &[ProbeReport]) -> String {
    let mut rows = vec![row(&["probe", "final", "least", "greatest", "mean"])];
    for probe in probes {
        let value = |number: f64| format!("{number:.4} {}", probe.unit);
        rows.push(vec![
            probe.id.clone(),
            value(probe.last),
            value(probe.min),
            value(probe.max),
            value(probe.mean),
        ]);
    }
    columns(&rows)
}

fn beat(beat: &BeatReport) -> String {
    let strouhal = beat
        .strouhal
        .map_or_else(String::new, |strouhal| format!(", Strouhal number {strouhal:.2}"));
    format!(
        "{:.3} Hz, {:.2} m from top to bottom at {:.2} m/s{strouhal}",
        beat.frequency_Hz, beat.excursion_m, beat.speed_m_s
    )
}

fn whale(whale: &WhaleReport, report: &Report) -> String {
    let undecided = if whale.decided { "" } else { " (undecided: the run is too short to tell)" };
    let mut text = columns(&[
        vec!["whale".into(), whale.outcome.replace('_', " ") + undecided],
        vec!["first touched".into(), moment(whale.first_contact_s)],
        vec!["rope drag".into(), force(whale.drag_added_N)],
        vec!["hooked".into(), yes_no(whale.hooked)],
        vec!["lodged in the mouth".into(), yes_no(whale.lodged_in_mouth)],
        vec![
            "trailing rope".into(),
            format!("{:.1} m, and {:.1} m to what holds", whale.trailing_m, whale.tethered_m),
        ],
        vec![
            "hangs on it".into(),
            if whale.carried.is_empty() { "nothing".into() } else { whale.carried.join(", ") },
        ],
        vec![
            "joints held at their ends".into(),
            format!("in {} of {} steps", report.audit.postures_held, report.steps),
        ],
        vec!["fluke beat".into(), whale.beat.as_ref().map_or_else(|| "none".into(), beat)],
    ]);
    if let Some(kinetic) = &whale.kinetic {
        text += &columns(&[
            vec![
                "thrust".into(),
                format!("{}, at most {}", force(kinetic.thrust_N), force(kinetic.peak_thrust_N)),
            ],
            vec!["pull of rope".into(), format!("at most {}", force(kinetic.peak_rope_pull_N))],
            vec!["power".into(), format!("{:.0} W", kinetic.power_W)],
            vec![
                "speed".into(),
                format!("{:.2} m/s, {:.2} m/s lost", kinetic.speed_m_s, kinetic.speed_lost_m_s),
            ],
        ]);
    }
    let mut rows = vec![row(&[
        "region",
        "wraps",
        "at most",
        "touching",
        "rope in contact",
        "peak normal force",
        "friction work",
    ])];
    for region in whale.regions.iter().filter(|region| region.peak_normal_N > 0.0) {
        rows.push(vec![
            region.region.replace('_', " "),
            format!("{:.2}", region.wraps),
            format!("{:.2}", region.peak_wraps),
            format!("{:.2}", region.touching_wraps),
            format!("{:.2} m", region.contact_length_m),
            force(region.peak_normal_N),
            format!("{:.1} J", region.friction_work_J),
        ]);
    }
    text += &columns(&rows);
    text + &patches(whale)
}

/// Loads on the patches that rope touched.
fn patches(whale: &WhaleReport) -> String {
    let mut rows = vec![row(&[
        "patch",
        "peak normal force",
        "peak friction",
        "peak tension",
        "peak pressure",
        "friction work",
    ])];
    for patch in whale.patches.iter().filter(|patch| patch.peak_normal_N > 0.0) {
        rows.push(vec![
            patch.patch.replace('_', " "),
            force(patch.peak_normal_N),
            force(patch.peak_friction_N),
            force(patch.peak_tension_N),
            format!("{:.3} MPa", 1e-6 * patch.peak_pressure_Pa),
            format!("{:.1} J", patch.friction_work_J),
        ]);
    }
    columns(&rows)
}

/// Everything that happened, in order.
fn events(report: &Report) -> String {
    let mut rows = vec![row(&["time", "event", "of", "value"])];
    for event in &report.events {
        let value = format!("{:.3} {}", event.value, event.unit);
        rows.push(vec![
            format!("{:.3} s", event.time_s),
            event.kind.replace('_', " "),
            event.subject.replace('_', " "),
            value,
        ]);
    }
    columns(&rows)
}

fn yes_no(yes: bool) -> String {
    if yes { "yes" } else { "no" }.into()
}

/// A force in newtons and pounds-force.
fn force(newtons: f64) -> String {
    if newtons.is_finite() {
        format!("{newtons:.1} N ({:.1} lbf)", newtons / N_PER_LBF)
    } else {
        "none".into()
    }
}

fn moment(time_s: Option<f64>) -> String {
    time_s.map_or_else(|| "no".into(), |time_s| format!("{time_s:.3} s"))
}

fn place(id: &str, position_m: [f64; 3]) -> Vec<String> {
    let mut row = vec![id.to_owned()];
    row.extend(position_m.iter().map(|metres| format!("{metres:.2} m")));
    row
}

fn row(cells: &[&str]) -> Vec<String> {
    cells.iter().map(ToString::to_string).collect()
}

/// Rows in aligned columns and an empty line; nothing where there is only a heading of several columns.
pub(super) fn columns(rows: &[Vec<String>]) -> String {
    if rows.len() == 1 && rows[0].len() > 2 {
        return String::new();
    }
    let count = rows.iter().map(Vec::len).max().unwrap_or_default();
    let width = |column: usize| {
        rows.iter()
            .filter_map(|row| row.get(column))
            .map(|cell| cell.chars().count())
            .max()
            .unwrap_or_default()
    };
    let widths: Vec<usize> = (0..count).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (cell, width) in row.iter().zip(&widths) {
            // Writing into a String cannot fail.
            let _ = write!(line, "{cell:<width$}  ");
        }
        text += line.trim_end();
        text.push('\n');
    }
    text + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_and_headings_alone_are_left_out() {
        let rows = [row(&["line", "peak", "at"]), row(&["endline-top", "2 N", "1 s"])];
        assert_eq!(columns(&rows), "line         peak  at\nendline-top  2 N   1 s\n\n");
        assert_eq!(columns(&rows[..1]), "");
    }

    #[test]
    fn forces_come_in_both_units() {
        assert_eq!(force(7_561.976_745_942_85), "7562.0 N (1700.0 lbf)");
        assert_eq!(force(f64::INFINITY), "none");
    }
}
