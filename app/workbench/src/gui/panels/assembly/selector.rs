//! The gear selector: a picture of the statics of every assembly; a click selects one.

use egui::text::LayoutJob;
use egui::{Color32, Pos2, Rect, RichText, ScrollArea, Sense, Stroke, Ui, pos2, vec2};
use endline_session::edit::Documents;
use endline_session::statics::worker::Answer;
use endline_session::statics::{RigAtRest, Trial, TrialGear, TrialSea};
use endline_sim::model::BodyRole;
use glam::DVec2;

use super::AssemblyPanel;
use super::side::A;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;

/// Size of a picture [points].
const CARD: egui::Vec2 = vec2(168.0, 112.0);
/// Height of the name below a picture, two rows [points].
const NAME: f32 = 36.0;

/// Draws all assemblies as cards; returns the one that was clicked.
pub(super) fn show(ui: &mut Ui, panel: &mut AssemblyPanel, shared: &Shared) -> Option<String> {
    let all = super::assemblies(shared);
    ask(panel, shared, &all);
    let chosen = panel.shown(shared);
    let mut taken = None;
    ScrollArea::vertical().id_salt("selector").auto_shrink(false).show(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            for (index, (id, name)) in all.iter().enumerate() {
                let answer = panel.pictured.newest(index).cloned();
                if card(
                    ui,
                    name,
                    answer.as_ref(),
                    chosen.as_ref().is_some_and(|gear| *gear == TrialGear::Assembly(id.clone())),
                ) {
                    taken = Some(id.clone());
                }
            }
        });
    });
    taken
}

/// Requests the statics of all assemblies in the scenario's sea, if files have changed.
fn ask(panel: &mut AssemblyPanel, shared: &Shared, all: &[(String, String)]) {
    panel.pictured.poll();
    let version = shared.workbench.project().documents.version();
    if panel.pictured_for == Some(version) {
        return;
    }
    let trial = |(id, _): &(String, String)| Trial {
        gear: TrialGear::Assembly(id.clone()),
        sea: TrialSea { depth: None, current_m_s: None },
    };
    let trials = all.iter().map(trial).collect();
    let scenario = shared
        .workbench
        .project()
        .documents
        .text(Documents::SCENARIO)
        .unwrap_or_default()
        .to_owned();
    let (library, (host, waker)) =
        (shared.workbench.project().documents.library().clone(), shared.workbench.helpers());
    panel.pictured.ask(&scenario, &library, trials, &host, &waker);
    panel.pictured_for = Some(version);
}

fn card(ui: &mut Ui, name: &str, answer: Option<&Answer>, chosen: bool) -> bool {
    let palette = Theme::palette_of(ui);
    let color = A.color(ui);
    let size = CARD + vec2(0.0, NAME);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let (picture, below) = rect.split_top_bottom_at_y(rect.top() + CARD.y);
    let painter = ui.painter_at(rect);
    painter.rect_filled(picture, 4.0, palette.field);
    let say = |text: &str| {
        painter.text(
            picture.center(),
            egui::Align2::CENTER_CENTER,
            text,
            egui::FontId::proportional(12.0),
            palette.faint,
        );
    };
    match answer {
        None => say("…"),
        Some(Ok(rest)) => draw(&painter, picture.shrink(8.0), rest, color, palette.faint),
        Some(Err(_)) => say("not here"),
    }
    let outline = match (chosen, response.hovered()) {
        (true, _) => Stroke::new(2.0, palette.accent),
        (false, true) => Stroke::new(1.5, palette.faint),
        (false, false) => Stroke::new(1.0, palette.line),
    };
    painter.rect_stroke(picture, 4.0, outline, egui::StrokeKind::Inside);
    let font = egui::FontId::proportional(12.0);
    let mut job = LayoutJob::simple(name.to_owned(), font, palette.text, CARD.x - 4.0);
    job.wrap.max_rows = 2;
    let text = ui.painter().layout_job(job);
    painter.with_clip_rect(below).galley(below.left_top() + vec2(2.0, 3.0), text, palette.text);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, name));
    let text = match answer {
        Some(Err(why)) => format!("{name}\nno statics in this scenario's sea: {why}"),
        _ => name.to_owned(),
    };
    response.on_hover_text(RichText::new(text)).clicked()
}

/// Draws lines and bodies from the side, scaled to fit.
fn draw(painter: &egui::Painter, room: Rect, rest: &RigAtRest, color: Color32, faint: Color32) {
    let of_lines = || rest.shape.lines.iter().flat_map(|line| &line.position_m);
    let places = || of_lines().chain(rest.shape.bodies.iter().map(|body| &body.position_m));
    let flat = |place: &[f64; 3]| DVec2::new(place[0], place[1]);
    let Some(first) = places().next().map(flat) else { return };
    let far = places()
        .map(|place| flat(place) - first)
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    let axis = far.and_then(DVec2::try_normalize).unwrap_or(DVec2::X);
    let along = |place: &[f64; 3]| flat(place).dot(axis);
    let ends = places()
        .map(along)
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    let depth_m = rest.model.spec.water.depth_m.max(0.1);
    let middle = f64::midpoint(ends[0], ends[1]);
    // Equal scales, so that the scope is visible; a long trawl is compressed.
    let up = f64::from(room.height()) / depth_m;
    let across = (f64::from(room.width()) / (ends[1] - ends[0]).max(0.1)).min(up);
    let at = |place: &[f64; 3]| -> Pos2 {
        pos2(
            room.center().x + ((along(place) - middle) * across) as f32,
            room.top() + (-place[2] * up) as f32,
        )
    };
    for y in [room.top(), room.bottom()] {
        painter.line_segment(
            [pos2(room.left(), y), pos2(room.right(), y)],
            Stroke::new(1.0, faint.gamma_multiply(0.6)),
        );
    }
    for line in &rest.shape.lines {
        painter.add(egui::Shape::line(
            line.position_m.iter().map(at).collect(),
            Stroke::new(1.4, color),
        ));
    }
    for (body, shape) in rest.model.spec.bodies.iter().zip(&rest.shape.bodies) {
        let place = at(&shape.position_m);
        if body.role == BodyRole::Buoy {
            painter.circle_filled(place, 3.0, Color32::from_rgb(0xd5, 0x5e, 0x00));
        } else {
            painter.rect_filled(Rect::from_center_size(place, vec2(5.0, 5.0)), 0.0, color);
        }
    }
}
