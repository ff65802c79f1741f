//! The timeline: a track for each control in the program, with bars that can be dragged.

use egui::{
    Align2, Color32, CursorIcon, FontId, Painter, Pos2, Rect, Response, Sense, Stroke, StrokeKind,
    Ui, WidgetInfo, WidgetType, pos2, vec2,
};
use endline_gear::units::{Quantity, parse};
use endline_sdk::Controls;
use endline_session::command::TimeAction;
use endline_session::edit::Documents;
use endline_session::edit::pilot_program::{Entry, move_to, path, seconds, set, spoken, until_s};
use endline_session::scales::ticks;

use super::PilotPanel;
use crate::gui::shared::Shared;
use crate::gui::theme::{Palette, Theme};

/// Height of a track [points].
const ROW: f32 = 24.0;
/// Height of the axis [points].
const AXIS: f32 = 20.0;
/// Width of the names [points].
const NAMES: f32 = 92.0;
/// Distance to the end of a bar within which a drag moves the end [points].
const EDGE: f32 = 6.0;

/// A bar being dragged.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drag {
    index: usize,
    /// Whether its end is dragged instead of its start.
    end: bool,
    /// Offset from the pointer to the dragged start or end [s].
    off_s: f64,
    /// Current time of the dragged start or end [s].
    to_s: f64,
}

/// The bar of an entry for one control.
struct Bar {
    index: usize,
    rect: Rect,
    text: String,
    /// Height of the fill as a share of the track, from the middle or the bottom.
    level: f32,
    signed: bool,
}

/// Scale of times on the width of the tracks.
#[derive(Clone, Copy)]
struct Axis {
    rect: Rect,
    end_s: f64,
}

impl Axis {
    fn x(&self, time_s: f64) -> f32 {
        self.rect.left() + (time_s / self.end_s) as f32 * self.rect.width()
    }

    fn time_s(&self, x: f32) -> f64 {
        (f64::from((x - self.rect.left()) / self.rect.width()) * self.end_s).clamp(0.0, self.end_s)
    }

    /// Rounds to a tenth of a second, or to a hundredth if that is visible.
    fn snapped_s(&self, time_s: f64) -> f64 {
        let grid = if self.end_s / f64::from(self.rect.width()) < 0.02 { 100.0 } else { 10.0 };
        (time_s * grid).round() / grid
    }
}

/// Draws the tracks.
pub(super) fn show(ui: &mut Ui, panel: &mut PilotPanel, shared: &mut Shared, all: &[Entry]) {
    let named = |control: &usize| {
        all.iter().any(|entry| {
            entry.begin_s.is_some() && entry.controls.iter().any(|(known, _)| known == control)
        })
    };
    let tracks: Vec<usize> = (0..Controls::COUNT).filter(named).collect();
    let size = vec2(ui.available_width(), AXIS + ROW * tracks.len() as f32);
    let (whole, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, "Timeline"));
    let rect =
        Rect::from_min_max(pos2(whole.left() + NAMES, whole.top()), whole.max - vec2(8.0, 0.0));
    let duration_s = shared
        .workbench
        .project()
        .documents
        .field(Documents::SCENARIO, "duration")
        .and_then(|text| parse(&text, Quantity::Time).ok())
        .unwrap_or(60.0);
    let latest_s = all.iter().filter_map(|entry| entry.begin_s).fold(0.0, f64::max);
    let axis = Axis { rect, end_s: duration_s.max(latest_s * 1.02).max(1e-3) };
    let timeline = Timeline { all, bars: bars(all, &tracks, axis, panel.drag), axis };
    let (painter, palette) = (ui.painter_at(whole), Theme::palette_of(ui));
    grid(&painter, axis, &tracks, palette);
    for bar in &timeline.bars {
        draw(&painter, bar, panel.chosen == Some(bar.index), palette);
    }
    if let Some(view) = shared.workbench.view() {
        let x = axis.x(view.frame.time_s);
        let now = [pos2(x, rect.top()), pos2(x, rect.bottom())];
        painter.line_segment(now, Stroke::new(1.5, palette.warning));
    }
    timeline.hand(ui, panel, shared, &response);
}

fn bars(all: &[Entry], tracks: &[usize], axis: Axis, drag: Option<Drag>) -> Vec<Bar> {
    let mut bars = Vec::new();
    for entry in all {
        let Some(begin_s) = entry.begin_s else { continue };
        for (control, text) in &entry.controls {
            let Some(track) = tracks.iter().position(|known| known == control) else { continue };
            let mut reach_s = [begin_s, until_s(all, entry, *control, axis.end_s)];
            if let Some(drag) = drag.filter(|drag| drag.index == entry.index) {
                let by_s = drag.to_s - begin_s;
                reach_s = if drag.end {
                    [begin_s, drag.to_s.max(begin_s)]
                } else {
                    [drag.to_s, reach_s[1] + by_s]
                };
            }
            let top = axis.rect.top() + AXIS + ROW * track as f32;
            let left = axis.x(reach_s[0]);
            let right = axis.x(reach_s[1]).clamp(left + 3.0, axis.rect.right().max(left + 3.0));
            let signed = Controls::RANGES[*control][0] < 0.0;
            let level = entry.number(*control).map_or(1.0, |number| number as f32);
            let rect = Rect::from_min_max(pos2(left, top + 2.0), pos2(right, top + ROW - 2.0));
            bars.push(Bar { index: entry.index, rect, text: text.clone(), level, signed });
        }
    }
    bars
}

fn grid(painter: &Painter, axis: Axis, tracks: &[usize], palette: Palette) {
    let small = FontId::proportional(11.0);
    for tick in ticks(0.0, axis.end_s, 8) {
        let x = axis.x(tick);
        painter.line_segment(
            [pos2(x, axis.rect.top() + AXIS - 4.0), pos2(x, axis.rect.bottom())],
            Stroke::new(1.0, palette.line),
        );
        let align =
            if x > axis.rect.right() - 20.0 { Align2::RIGHT_CENTER } else { Align2::CENTER_CENTER };
        painter.text(
            pos2(x, axis.rect.top() + 8.0),
            align,
            format!("{tick} s"),
            small.clone(),
            palette.faint,
        );
    }
    for (row, control) in tracks.iter().enumerate() {
        let top = axis.rect.top() + AXIS + ROW * row as f32;
        let place = pos2(axis.rect.left() - NAMES, top + ROW / 2.0);
        painter.text(
            place,
            Align2::LEFT_CENTER,
            spoken(Controls::NAMES[*control]),
            FontId::proportional(12.5),
            palette.text,
        );
        painter.line_segment(
            [pos2(place.x, top + ROW), pos2(axis.rect.right(), top + ROW)],
            Stroke::new(1.0, palette.line),
        );
        if Controls::RANGES[*control][0] < 0.0 {
            let middle =
                [pos2(axis.rect.left(), top + ROW / 2.0), pos2(axis.rect.right(), top + ROW / 2.0)];
            painter.line_segment(middle, Stroke::new(1.0, palette.line.gamma_multiply(0.6)));
        }
    }
}

fn draw(painter: &Painter, bar: &Bar, chosen: bool, palette: Palette) {
    let rect = bar.rect;
    painter.rect_filled(rect, 2.0, palette.accent.gamma_multiply(if chosen { 0.3 } else { 0.14 }));
    let fill = if bar.signed {
        let (middle, half) = (rect.center().y, rect.height() / 2.0 * bar.level.clamp(-1.0, 1.0));
        Rect::from_two_pos(pos2(rect.left(), middle), pos2(rect.right(), middle - half))
    } else {
        rect.with_min_y(rect.bottom() - rect.height() * bar.level.clamp(0.0, 1.0))
    };
    painter.rect_filled(fill, 2.0, palette.accent.gamma_multiply(if chosen { 0.75 } else { 0.45 }));
    let line = if chosen { palette.accent } else { palette.accent.gamma_multiply(0.6) };
    painter.rect_stroke(rect, 2.0, Stroke::new(1.0, line), StrokeKind::Inside);
    if rect.width() > 34.0 {
        let shadow = Color32::from_black_alpha(if palette.text.r() > 128 { 120 } else { 0 });
        let painter = painter.with_clip_rect(rect);
        let galley =
            painter.layout_no_wrap(bar.text.clone(), FontId::proportional(11.5), palette.text);
        let at = pos2(rect.left() + 5.0, rect.center().y - galley.size().y / 2.0);
        painter.rect_filled(
            Rect::from_min_size(at, galley.size()).expand2(vec2(2.0, 0.0)),
            2.0,
            shadow,
        );
        painter.galley(at, galley, palette.text);
    }
}

/// Bars of the entries, and the drag.
struct Timeline<'a> {
    all: &'a [Entry],
    bars: Vec<Bar>,
    axis: Axis,
}

impl Timeline<'_> {
    /// The topmost bar at a place, and whether the place is at its end.
    fn hit(&self, at: Pos2) -> Option<(usize, bool)> {
        let under = |bar: &&Bar| bar.rect.expand2(vec2(2.0, 2.0)).contains(at);
        let bar = self.bars.iter().rev().find(under)?;
        let end = at.x > bar.rect.right() - EDGE && bar.rect.width() > 2.0 * EDGE;
        Some((bar.index, end))
    }

    /// Handles the mouse: a click selects, a drag moves the start or the hold, a click on the axis shows its moment.
    fn hand(&self, ui: &Ui, panel: &mut PilotPanel, shared: &mut Shared, response: &Response) {
        let pointer = response.interact_pointer_pos().or(response.hover_pos());
        let Some(at) = pointer else { return self.finish(panel, shared, response) };
        let under = self.hit(at);
        if let Some((index, end)) = under {
            let cursor = if end { CursorIcon::ResizeHorizontal } else { CursorIcon::Grab };
            ui.ctx().set_cursor_icon(cursor);
            if panel.drag.is_none() && !response.dragged() {
                response.clone().on_hover_text(self.all[index].words());
            }
        }
        if response.clicked() {
            match under {
                Some((index, _)) => panel.chosen = Some(index),
                None if at.y < self.axis.rect.top() + AXIS => {
                    shared.give(TimeAction::Seek(self.axis.time_s(at.x)))
                }
                None => panel.chosen = None,
            }
        }
        self.take(ui, panel, response);
        if let Some(drag) = &mut panel.drag {
            drag.to_s = self.axis.snapped_s((self.axis.time_s(at.x) + drag.off_s).max(0.0));
        }
        self.finish(panel, shared, response);
    }

    /// Starts to drag the bar under the pointer.
    fn take(&self, ui: &Ui, panel: &mut PilotPanel, response: &Response) {
        let origin = ui.input(|input| input.pointer.press_origin());
        let Some(origin) = origin.filter(|_| response.drag_started()) else { return };
        let Some((index, end)) = self.hit(origin) else { return };
        let Some(begin_s) = self.all[index].begin_s else { return };
        panel.chosen = Some(index);
        let held_s = if end { self.end_s(index) } else { begin_s };
        let off_s = held_s - self.axis.time_s(origin.x);
        panel.drag = Some(Drag { index, end, off_s, to_s: held_s });
    }

    /// End of the bars of an entry [s].
    fn end_s(&self, index: usize) -> f64 {
        let own = self.bars.iter().filter(|bar| bar.index == index);
        self.axis.time_s(own.map(|bar| bar.rect.right()).fold(0.0, f32::max))
    }

    /// Ends a drag, as one edit.
    fn finish(&self, panel: &mut PilotPanel, shared: &mut Shared, response: &Response) {
        if !response.drag_stopped() {
            return;
        }
        let Some(drag) = panel.drag.take() else { return };
        let Some(entry) = self.all.get(drag.index) else { return };
        let begin_s = entry.begin_s.unwrap_or(0.0);
        let mut chosen = drag.index;
        super::change(shared, |document| match (drag.end, entry.trigger) {
            (true, _) => {
                set(document, drag.index, "hold", &seconds((drag.to_s - begin_s).max(0.1)))
            }
            (false, "at") => move_to(document, drag.index, drag.to_s).map(|index| chosen = index),
            // An entry after another keeps its trigger; the drag changes its delay.
            (false, _) => {
                let delay = document.get(&path(drag.index, "delay"));
                let delay_s = delay.and_then(|text| parse(&text, Quantity::Time).ok());
                let moved_s = delay_s.unwrap_or(0.0) + drag.to_s - begin_s;
                set(document, drag.index, "delay", &seconds(moved_s))
            }
        });
        panel.chosen = Some(chosen);
    }
}
