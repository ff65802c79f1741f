//! Panes of the 3-D view: their arrangement, the mouse in them, and what is drawn over the scene.

use egui::{Rect, Response, Sense, Stroke, StrokeKind, Ui, WidgetInfo, WidgetType};
use endline_session::command::When;
use endline_session::live::LiveView;
use endline_session::scene::forces::greatest_n;

use crate::gui::panels::help;
use crate::gui::panels::view::{ViewPanel, hud, picking, pose, spoken};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::scene::{Camera, Canvas, Overlay, Water, overlay};

/// Least width of a pane that shows the greatest contact force [points].
const ROOMY: f32 = 480.0;

/// Camera of a pane and its response to the mouse.
pub(super) struct Look {
    camera: Camera,
    response: Response,
}

/// Handles the mouse in a pane: orbits its camera and picks.
pub(super) fn look(
    ui: &Ui,
    panel: &mut ViewPanel,
    shared: &Shared,
    view: &LiveView,
    pane: Pane,
) -> Look {
    let Pane { run, slot, rect } = pane;
    let response = ui.interact(rect, ui.id().with(("pane", run, slot)), Sense::click_and_drag());
    let name =
        if run == 0 { format!("Pane {}", slot + 1) } else { format!("Pane {} of B", slot + 1) };
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, &name));
    if response.clicked() || response.dragged() {
        ui.memory_mut(|memory| memory.stop_text_input());
        panel.chosen = slot;
    }
    let eye = &mut panel.eyes[slot];
    eye.turn(ui, &response, shared.flying);
    if panel.along
        && slot == panel.chosen
        && let Some(camera) = panel.path.camera(view.frame.time_s, |eye| eye.placed(view, rect))
    {
        pick(panel, view, &camera, &response, run);
        return Look { camera, response };
    }
    let camera = eye.placed(view, rect);
    if run == 0 {
        eye.keep(&camera, &view.frame);
    }
    pick(panel, view, &camera, &response, run);
    Look { camera, response }
}

/// A click picks a thing for its reading or the ruler; the thing under the pointer is noted.
fn pick(panel: &mut ViewPanel, view: &LiveView, camera: &Camera, response: &Response, run: usize) {
    let clicked = response.interact_pointer_pos().filter(|_| response.clicked());
    let Some(at) = clicked.or(response.hover_pos()).filter(|_| !response.dragged()) else { return };
    let on_card = panel.picks.cards.iter().any(|card| card.contains(at));
    let hit =
        picking::under(&panel.picks, view, camera, (response.rect, at), &panel.show.effective());
    if clicked.is_some() && !on_card {
        panel.picks.take(hit);
    }
    panel.picks.hovered = hit.map(|hit| (run, hit));
}

/// Draws a pane.
pub(super) fn show(
    ui: &mut Ui,
    panel: &mut ViewPanel,
    shared: &mut Shared,
    view: &LiveView,
    pane: Pane,
    look: &Look,
) {
    paint(ui, panel, shared, pane, &look.camera);
    paint_over(ui, panel, shared, view, pane, &look.camera);
    if look.response.hovered() {
        let units = shared.workbench.preferences().units;
        picking::glance(ui, &panel.picks, &look.response, view, units);
    }
    if pane.run == 0 {
        pose::show(ui, &mut panel.held, shared, pane, &look.camera);
    }
}

fn paint(ui: &Ui, panel: &ViewPanel, shared: &Shared, pane: Pane, camera: &Camera) {
    let rect = pane.rect;
    match &panel.drawn[pane.run].canvas {
        Some(canvas) => {
            let water =
                if shared.preferences.theme == Theme::Dark { Water::DARK } else { Water::LIGHT };
            ui.painter().add(Canvas::callback(canvas, pane.slot, rect, camera.clone(), water));
        }
        None => {
            ui.painter().rect_filled(rect, 0.0, Theme::palette_of(ui).ground);
        }
    }
}

fn paint_over(
    ui: &Ui,
    panel: &ViewPanel,
    shared: &Shared,
    view: &LiveView,
    pane: Pane,
    camera: &Camera,
) {
    let Pane { run, slot, rect } = pane;
    let painter = ui.painter().with_clip_rect(rect);
    let several = panel.eyes.len() > 1;
    let compared = shared.workbench.comparison().is_some();
    let caption = caption(panel, shared, view, pane);
    // Only the last pane shows the tension scale.
    let last = slot + 1 == panel.eyes.len() && run == usize::from(compared);
    let scale_n = if last { panel.scale_n } else { 0.0 };
    let metres_a_point = camera.metres_a_point(f64::from(rect.height()));
    if !panel.show.film {
        if panel.show.names {
            overlay::paint_names(&painter, rect, camera, &view.model, &view.frame);
        }
        let overlay = Overlay {
            caption: &caption,
            time_s: view.frame.time_s,
            scale_n,
            metres_a_point,
            units: shared.workbench.preferences().units,
        };
        overlay::paint(&painter, rect, &overlay);
    }
    picking::paint_marks(
        &painter,
        &panel.picks,
        pane,
        camera,
        view,
        shared.workbench.preferences().units,
    );
    if several && slot == panel.chosen {
        painter.rect_stroke(
            rect,
            0.0,
            Stroke::new(1.5, Theme::palette_of(ui).accent),
            StrokeKind::Inside,
        );
    }
    if slot == 0 && run == 0 {
        flash(ui, shared, &painter, rect);
    }
    if shared.flying && slot == panel.chosen && run == 0 {
        let act = shared
            .pilot
            .chosen_act(shared.workbench.acts().len())
            .map(|act| shared.workbench.acts()[act].name.as_ref());
        hud::paint(
            &painter,
            rect,
            view,
            shared.workbench.preferences().units,
            &(hud::waiting(view).to_owned()
                + &hud::controls_text(&view.controls, act, shared.pilot.hands())),
        );
    }
    if slot == panel.chosen && run == 0 && hud::shows_card(ui, shared.flying) {
        hud::card(&painter, rect, &help::keys(When::Flying));
    }
}

fn caption(panel: &ViewPanel, shared: &Shared, view: &LiveView, pane: Pane) -> String {
    let eye = &panel.eyes[pane.slot];
    let run = if shared.workbench.comparison().is_some() { ["A", "B"][pane.run] } else { "" };
    let named = if panel.eyes.len() > 1 { spoken(eye.named) } else { String::new() };
    let roomy = pane.rect.width() > ROOMY;
    let of = shared.workbench.guest().filter(|_| pane.run == 0 && roomy).unwrap_or_default();
    let edited = shared.workbench.stale() && shared.workbench.guest().is_none();
    let state = match (view.sought && pane.run == 0, edited && pane.run == 0) {
        (true, _) => "earlier moment",
        (false, true) => "before the last edits",
        (false, false) => "",
    };
    let greatest_n = if panel.show.forces && roomy { greatest_n(&view.frame) } else { 0.0 };
    let arrows = if greatest_n > 0.0 {
        format!(
            "greatest contact force {}",
            shared.workbench.preferences().units.force().text(greatest_n)
        )
    } else {
        String::new()
    };
    [run, named.as_str(), of, state, arrows.as_str()]
        .into_iter()
        .filter(|words| !words.is_empty())
        .collect::<Vec<_>>()
        .join(", ")
}

/// Flashes the border with the pulses of the pad.
fn flash(ui: &Ui, shared: &Shared, painter: &egui::Painter, rect: Rect) {
    let strength = shared.rumble.strength(ui.input(|input| input.time));
    if strength > 0.0 {
        let warning = Theme::palette_of(ui).warning.gamma_multiply(strength as f32);
        painter.rect_stroke(
            rect,
            0.0,
            Stroke::new(10.0 * strength as f32, warning),
            StrokeKind::Inside,
        );
        ui.ctx().request_repaint();
    }
}

/// Gap between two panes [points].
const PANE_GAP: f32 = 3.0;

/// A pane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pane {
    /// Run shown: 0 for the run, 1 for the run it is compared with.
    pub(super) run: usize,
    /// Index of its eye.
    pub(super) slot: usize,
    /// Its rectangle.
    pub(super) rect: Rect,
}

/// Rectangles of a number of panes: side by side, and also one above the other from three on.
pub(super) fn places(rect: Rect, count: usize) -> Vec<Rect> {
    let middle = rect.center();
    let left = rect.with_max_x(middle.x - PANE_GAP / 2.0);
    let right = rect.with_min_x(middle.x + PANE_GAP / 2.0);
    let halves = |side: Rect| {
        [side.with_max_y(middle.y - PANE_GAP / 2.0), side.with_min_y(middle.y + PANE_GAP / 2.0)]
    };
    match count {
        0 | 1 => vec![rect],
        2 => vec![left, right],
        3 => std::iter::once(left).chain(halves(right)).collect(),
        _ => {
            let ([a, c], [b, d]) = (halves(left), halves(right));
            vec![a, b, c, d]
        }
    }
}
