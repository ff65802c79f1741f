//! Table of line tensions and float heights at slack and running tide.

use egui::{Color32, Grid, RichText, Ui};
use endline_gear::WEAK_PLACES;
use endline_session::statics::RigAtRest;
use endline_session::statics::sweep::top_m;
use endline_session::units::Units;
use endline_sim::model::BodyRole;

use super::side::{A, B};
use super::{AssemblyPanel, Rig, strength, surface_m_s};
use crate::gui::theme::Theme;

/// Columns; those that are compared come first, so that a narrow panel shows them.
const HEADS: [&str; 8] = [
    "",
    "Line",
    "Slack, low / high end",
    "Running, low / high end",
    "Used",
    "Delivered strength",
    "Length",
    "Rope",
];

/// Draws the table.
pub(super) fn show(ui: &mut Ui, panel: &AssemblyPanel, units: Units) {
    let drawn = panel.drawn();
    Grid::new("statics")
        .num_columns(HEADS.len())
        .min_col_width(12.0)
        .striped(true)
        .spacing([12.0, 3.0])
        .show(ui, |ui| {
            let faint = Theme::palette_of(ui).faint;
            for head in HEADS {
                ui.label(RichText::new(head).small().color(faint));
            }
            ui.end_row();
            for (gear, rigs) in [(A, drawn.a), (B, drawn.b)] {
                let color = gear.color(ui);
                gear_rows(ui, if gear == A { "A" } else { "B" }, color, rigs, units);
            }
        });
}

/// Height of all rows.
pub(super) fn height(panel: &AssemblyPanel) -> f32 {
    let drawn = panel.drawn();
    let rows = |rigs: [Rig<'_>; 2]| {
        let spec = rigs.into_iter().find_map(|rig| rig.rest).map(|rest| &rest.model.spec);
        spec.map_or(0, |spec| {
            spec.lines.len()
                + spec.lines.iter().filter(|line| !line.weak_places.is_empty()).count()
                + spec.links.iter().filter(|link| link.enabled).count()
                + 1
                + spec.bodies.iter().filter(|body| body.role == BodyRole::Buoy).count()
        })
    };
    40.0 + 25.0 * (rows(drawn.a) + rows(drawn.b)) as f32
}

fn gear_rows(ui: &mut Ui, name: &str, color: Color32, rigs: [Rig<'_>; 2], units: Units) {
    let [slack, running] = rigs.map(|rig| rig.rest);
    let Some(model) = slack.or(running).map(|rest| &rest.model) else { return };
    for (index, line) in model.spec.lines.iter().enumerate() {
        let rope = &model.spec.ropes[line.rope];
        ui.label(RichText::new(name).color(color));
        ui.label(&line.id);
        for rest in [slack, running] {
            ui.label(ends(rest, index, units));
        }
        let strength = slack.or(running).and_then(|rest| strength::of(rest, &line.id));
        let strength_n = strength.map_or(f64::INFINITY, |strength| strength.drawn_N);
        ui.label(used(running, index, strength_n))
            .on_hover_text("Greatest tension at running tide divided by strength");
        strength::cell(ui, strength, rope.strength_n, units);
        ui.label(units.length(line.segments_m.iter().sum()));
        ui.label(format!("{}  {}", rope.id, units.diameter(rope.diameter_m)));
        ui.end_row();
    }
    for line in model.spec.lines.iter().filter(|line| !line.weak_places.is_empty()) {
        let part = format!("{}.{WEAK_PLACES}", line.id);
        let strength = slack.or(running).and_then(|rest| strength::of(rest, &part));
        ui.label(RichText::new(name).color(color));
        ui.label(&part);
        (0..3).for_each(|_| drop(ui.label("")));
        let usual_n = line.weak_places.first().map_or(0.0, |place| place.strength_n);
        strength::cell(ui, strength, usual_n, units);
        ui.label("");
        ui.label(strength.map_or("", |strength| strength.item.as_str()));
        ui.end_row();
    }
    for link in model.spec.links.iter().filter(|link| link.enabled) {
        ui.label(RichText::new(name).color(color));
        ui.label(&link.id);
        (0..3).for_each(|_| drop(ui.label("")));
        let strength = slack.or(running).and_then(|rest| strength::of(rest, &link.id));
        strength::cell(ui, strength, link.rating_n, units);
        ui.end_row();
    }
    for (index, body) in
        model.spec.bodies.iter().enumerate().filter(|(_, body)| body.role == BodyRole::Buoy)
    {
        ui.label(RichText::new(name).color(color));
        ui.label(format!("{}, float height", body.id));
        for rest in [slack, running] {
            float(ui, rest, index, units);
        }
        ui.end_row();
    }
    whole(ui, name, color, slack, running, units);
}

fn ends(rest: Option<&RigAtRest>, line: usize, units: Units) -> String {
    let Some(shape) = rest.and_then(|rest| rest.shape.lines.get(line)) else {
        return "…".to_owned();
    };
    format!(
        "{} / {}",
        units.force().text(shape.end_a_tension_N),
        units.force().text(shape.end_b_tension_N)
    )
}

fn used(rest: Option<&RigAtRest>, line: usize, strength_n: f64) -> String {
    let Some(shape) = rest.and_then(|rest| rest.shape.lines.get(line)) else {
        return String::new();
    };
    let most = shape.tension_N.iter().copied().fold(0.0, f64::max);
    if strength_n > 0.0 && strength_n.is_finite() {
        format!("{:.1} %", 100.0 * most / strength_n)
    } else {
        String::new()
    }
}

fn float(ui: &mut Ui, rest: Option<&RigAtRest>, body: usize, units: Units) {
    // While gear is edited, the two tides can have different parts for a moment.
    let at =
        rest.and_then(|rest| rest.model.spec.bodies.get(body).zip(rest.shape.bodies.get(body)));
    let Some((body, at)) = at else {
        ui.label("…");
        return;
    };
    let top = top_m(body, at);
    let palette = Theme::palette_of(ui);
    if top >= 0.0 {
        ui.label(format!("{} above water", units.length(top)));
    } else {
        ui.label(RichText::new(format!("{} under", units.length(-top))).color(palette.warning))
            .on_hover_text("Pulled under by the tide");
    }
}

/// Draws the row of the whole gear: endline over depth, and whether statics converged.
fn whole(
    ui: &mut Ui,
    name: &str,
    color: Color32,
    slack: Option<&RigAtRest>,
    running: Option<&RigAtRest>,
    units: Units,
) {
    let palette = Theme::palette_of(ui);
    ui.label(RichText::new(name).color(color));
    ui.label(slack.map_or_else(
        || "whole gear".to_owned(),
        |rest| format!("in {} of water", units.depth(rest.model.spec.water.depth_m)),
    ));
    for rest in [slack, running] {
        let (text, colour) = match rest {
            Some(rest) if rest.shape.converged => ("at rest".to_owned(), palette.good),
            Some(rest) => (rest.shape.outcome.clone(), palette.warning),
            None => ("…".to_owned(), palette.faint),
        };
        let hover = rest.map_or_else(String::new, |rest| {
            let (outcome, wall_ms) = (&rest.shape.outcome, 1000.0 * rest.shape.wall_s);
            let current = units.speed(surface_m_s(rest));
            format!("{outcome}; surface current {current}; computed in {wall_ms:.0} ms")
        });
        ui.label(RichText::new(text).color(colour)).on_hover_text(hover);
    }
    ui.end_row();
}
