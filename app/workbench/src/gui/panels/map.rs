//! The map: gear, the whale and its track from above, with the current and the depth. Gear, fields of gear and the start of the whale are
//! placed with the mouse, and copied, rotated and removed below the map.

use std::collections::BTreeSet;
use std::sync::Arc;

use egui::{RichText, Stroke, Ui, vec2};
use egui_plot::{
    Line, LineStyle, MarkerShape, Plot, PlotPoint, PlotPoints, PlotUi, Points, Polygon,
};
use endline_gear::units::{Quantity, parse};
use endline_gear::{Document, Setting};
use endline_session::command::RunAction;
use endline_session::edit::Documents;
use endline_session::live::{Channel, LiveView};
use endline_session::units::{Units, bearing_degrees};
use endline_sim::Model;
use endline_sim::metrics::EventKind;
use endline_sim::model::BodyRole;
use glam::{DQuat, DVec2, DVec3};

use crate::gui::fields::{self, Said};
use crate::gui::panel::Panel;
use crate::gui::panels::view::pose::{Start, write_start};
use crate::gui::shared::Shared;
use crate::gui::theme::{Palette, Theme};
use crate::gui::widgets;
use crate::gui::widgets::plot::{with_ticks, x_axis, y_axis};

/// Greatest distance at which the pointer takes hold of a handle [points].
const REACH: f32 = 12.0;

/// Distance of a copy from its original, to the east [m].
const BESIDE_M: f64 = 30.0;

/// Tables of the scenario that place gear.
const TABLES: [&str; 2] = ["gear", "field"];

/// Outline of a whale from above: along the body from its middle, and to one side, in body lengths.
const OUTLINE: [[f64; 2]; 8] = [
    [0.5, 0.0],
    [0.42, 0.07],
    [0.2, 0.11],
    [-0.1, 0.1],
    [-0.35, 0.035],
    [-0.44, 0.02],
    [-0.5, 0.15],
    [-0.46, 0.0],
];

/// The map.
#[derive(Default)]
pub struct MapPanel {
    /// What is dragged, and where it is now: east and north [m].
    held: Option<(Handle, DVec2)>,
    /// What is under the pointer.
    hovered: Option<Handle>,
    /// The gear whose fields are shown below the map.
    chosen: Option<Handle>,
    /// The model for which the map was framed.
    framed: Option<Arc<Model>>,
}

/// What can be placed with the mouse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Handle {
    /// The start of the whale.
    Whale,
    /// A `[[gear]]` or `[[field]]`: index of the table, and place in it.
    Placed(usize, usize),
}

impl Handle {
    /// Path of its table in the scenario.
    fn table(self) -> String {
        match self {
            Self::Whale => "whale".to_owned(),
            Self::Placed(table, index) => format!("{}.{index}", TABLES[table]),
        }
    }
}

impl Panel for MapPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let Some(view) = shared.workbench.view().cloned() else {
            return widgets::nothing(
                ui,
                "Open a scenario: its gear and its whale are drawn from above.",
            );
        };
        let handles = handles(shared.documents());
        self.chosen =
            self.chosen.filter(|chosen| handles.iter().any(|(handle, _)| handle == chosen));
        self.form(ui, shared);
        facts(ui, &view, shared.workbench.preferences().units);
        self.map(ui, shared, &view, &handles);
    }
}

impl MapPanel {
    /// Draws the map, and moves what is dragged.
    fn map(
        &mut self,
        ui: &mut Ui,
        shared: &mut Shared,
        view: &LiveView,
        handles: &[(Handle, DVec2)],
    ) {
        let palette = Theme::palette_of(ui);
        let units = shared.workbench.preferences().units;
        let frames_again = self.framed.as_ref().is_none_or(|of| !Arc::ptr_eq(of, &view.model));
        let is_busy = self.held.is_some() || self.hovered.is_some();
        let symbol = units.length_symbol();
        let mut plot = with_ticks(Plot::new("map"), palette)
            .data_aspect(1.0)
            .allow_drag(!is_busy)
            .allow_boxed_zoom(false)
            .custom_x_axes(vec![x_axis(format!("east [{symbol}]"))])
            .custom_y_axes(vec![y_axis(format!("north [{symbol}]")).min_thickness(42.0)])
            .show_background(false);
        if frames_again {
            plot = plot.reset();
            self.framed = Some(Arc::clone(&view.model));
        }
        let scale = units.of_metres(1.0);
        let own = plot.show(ui, |plot| {
            draw(plot, view, scale, palette);
            self.draw_handles(plot, handles, scale, palette);
            plot.pointer_coordinate().map(|at| DVec2::new(at.x, at.y) / scale)
        });
        let (response, transform) = (own.response, own.transform);
        let on_screen = |at_m: DVec2| {
            transform.position_from_point(&PlotPoint::new(at_m.x * scale, at_m.y * scale))
        };
        self.hovered = response.hover_pos().and_then(|pointer| {
            let near =
                handles.iter().map(|(handle, at)| (on_screen(*at).distance(pointer), *handle));
            near.filter(|(distance, _)| *distance < REACH)
                .min_by(|one, other| one.0.total_cmp(&other.0))
                .map(|(_, handle)| handle)
        });
        if self.hovered.is_some() {
            ui.ctx().set_cursor_icon(egui::CursorIcon::Grab);
        }
        if (response.drag_started() || response.clicked()) && self.hovered.is_some() {
            self.chosen = self.hovered;
        }
        if let (true, Some(handle)) = (response.drag_started(), self.hovered) {
            let at = handles.iter().find(|(other, _)| *other == handle);
            self.held = at.map(|(_, at)| (handle, *at));
        }
        if let (Some((_, at)), Some(pointer)) = (&mut self.held, own.inner) {
            *at = pointer;
        }
        if response.drag_stopped()
            && let Some((handle, at)) = self.held.take()
        {
            place(shared, handle, at);
        }
        current(ui, &response, view, units, palette);
    }

    /// Draws a mark for everything that can be placed.
    fn draw_handles(
        &self,
        plot: &mut PlotUi<'_>,
        handles: &[(Handle, DVec2)],
        scale: f64,
        palette: Palette,
    ) {
        for (handle, at) in handles {
            let held = self.held.filter(|(held, _)| held == handle).map(|(_, at)| at);
            let at = held.unwrap_or(*at) * scale;
            let is_active = self.chosen == Some(*handle) || self.hovered == Some(*handle);
            let mark = Points::new("", vec![[at.x, at.y]])
                .shape(MarkerShape::Diamond)
                .radius(if is_active { 8.0 } else { 6.0 })
                .color(if is_active { palette.accent } else { palette.text })
                .filled(is_active)
                .allow_hover(false);
            plot.points(mark);
        }
    }

    /// Draws the fields of the chosen gear, and buttons that copy and remove it.
    fn form(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let faint = Theme::palette_of(ui).faint;
        let Some(handle) = self.chosen else {
            let text = "Drag a diamond to place gear, a field or the start of the whale; click it for its fields.";
            ui.add(egui::Label::new(RichText::new(text).color(faint)).truncate());
            return;
        };
        let table = handle.table();
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(title(shared.documents(), handle)).strong());
            for (name, field, help) in [
                ("east", "position.0", "Place to the east, such as 20 m"),
                ("north", "position.1", "Place to the north, such as 20 m"),
                ("heading", "heading", "Compass bearing, such as 45 deg"),
            ] {
                ui.label(RichText::new(name).color(faint));
                let (path, said) = (format!("{table}.{field}"), Said { hint: "usual", help });
                let typed =
                    fields::edit(ui, shared.documents(), Documents::SCENARIO, &path, 72.0, said);
                if let Some(typed) = typed {
                    write_field(shared, &table, field, &typed);
                }
            }
            let Handle::Placed(list, index) = handle else { return };
            if ui.button("Copy").on_hover_text("Places a copy 30 m to the east").clicked() {
                copy(shared, TABLES[list], index);
            }
            if ui.button("Remove").on_hover_text("Removes it from the scenario").clicked() {
                shared.alter(Documents::SCENARIO, |document| {
                    document.remove_table(TABLES[list], index).map_err(|error| error.message)
                });
                self.chosen = None;
            }
        });
    }
}

/// What can be placed in the scenario, with its place.
fn handles(documents: &Documents) -> Vec<(Handle, DVec2)> {
    let read = |field: &str| {
        let text = documents.field(Documents::SCENARIO, field)?;
        parse(&text, Quantity::Length).ok()
    };
    let mut found = Vec::new();
    for (table, name) in TABLES.into_iter().enumerate() {
        let is_there =
            |index: &usize| documents.has(Documents::SCENARIO, &format!("{name}.{index}"));
        for index in (0..).take_while(is_there) {
            let at = |axis: usize| read(&format!("{name}.{index}.position.{axis}"));
            let place = DVec2::new(at(0).unwrap_or_default(), at(1).unwrap_or_default());
            found.push((Handle::Placed(table, index), place));
        }
    }
    let start = Start::of(documents);
    found.extend(start.map(|start| (Handle::Whale, DVec2::new(start.place.x, start.place.y))));
    found
}

/// Name of what can be placed.
fn title(documents: &Documents, handle: Handle) -> String {
    let Handle::Placed(list, _) = handle else { return "Start of the whale".to_owned() };
    let field =
        |key: &str| documents.field(Documents::SCENARIO, &format!("{}.{key}", handle.table()));
    let assembly = field("assembly").unwrap_or_default();
    let name = documents.field(&format!("assemblies/{assembly}.toml"), "name").unwrap_or(assembly);
    match (field("id"), list) {
        (Some(id), 1) => format!("Field {id}: {name}"),
        (Some(id), _) => format!("{id}: {name}"),
        (None, _) => name,
    }
}

/// Writes a place as one edit.
fn place(shared: &mut Shared, handle: Handle, at: DVec2) {
    let start = Start::of(shared.documents()).filter(|_| handle == Handle::Whale);
    if let Some(start) = start {
        let place = DVec3::new(at.x, at.y, start.place.z);
        return write_start(shared, &Start { place, ..start });
    }
    let texts = [at.x, at.y].map(|at_m| format!("{:.1} m", at_m + 0.0));
    let field = format!("{}.position", handle.table());
    let change = |document: &mut Document| {
        document.put(&field, &Setting::texts(&texts)).map_err(|error| error.message)
    };
    if shared.alter(Documents::SCENARIO, change) {
        apply(shared);
    }
}

/// Writes a typed field; both coordinates are written if the scenario has none.
fn write_field(shared: &mut Shared, table: &str, field: &str, typed: &str) {
    let whole = format!("{table}.position");
    let has_place = shared.documents().has(Documents::SCENARIO, &whole);
    let change = |document: &mut Document| {
        if field.starts_with("position") && !has_place {
            document.put(&whole, &Setting::texts(&["0 m".to_owned(), "0 m".to_owned()]))?;
        }
        document.put(&format!("{table}.{field}"), &Setting::text(typed))
    };
    if shared.alter(Documents::SCENARIO, |document| change(document).map_err(|error| error.message))
    {
        apply(shared);
    }
}

/// Applies an edit at once if the run has not started.
fn apply(shared: &mut Shared) {
    if shared.workbench.view().is_some_and(|view| view.newest_s <= 0.0) {
        shared.give(RunAction::Apply);
    }
}

/// Adds a copy of a table of gear beside it, with an id of its own.
fn copy(shared: &mut Shared, list: &str, index: usize) {
    let change = |document: &mut Document| {
        let message = |error: endline_gear::EditError| error.message;
        let ids: BTreeSet<String> = TABLES
            .into_iter()
            .flat_map(|name| {
                (0..document.count(name)).map(move |index| format!("{name}.{index}.id"))
            })
            .filter_map(|field| document.get(&field))
            .collect();
        let mut fresh = (1..).map(|number| format!("gear-{number}")).filter(|id| !ids.contains(id));
        // Several gears need ids.
        let own = format!("{list}.{index}.id");
        if !document.has(&own) {
            let id = fresh.next().unwrap_or_default();
            document.put(&own, &Setting::text(&id)).map_err(message)?;
        }
        let id = fresh.next().unwrap_or_default();
        let place = document.push_table(list, &[]).map_err(message)?;
        copy_fields(document, &format!("{list}.{index}"), &format!("{list}.{place}"))?;
        document.put(&format!("{list}.{place}.id"), &Setting::text(&id)).map_err(message)?;
        let at = |axis: usize| {
            let text = document.get(&format!("{list}.{index}.position.{axis}")).unwrap_or_default();
            parse(&text, Quantity::Length).unwrap_or_default()
        };
        let texts = [at(0) + BESIDE_M, at(1)].map(|at_m| format!("{at_m:.1} m"));
        document.put(&format!("{list}.{place}.position"), &Setting::texts(&texts)).map_err(message)
    };
    if shared.alter(Documents::SCENARIO, change) {
        apply(shared);
    }
}

/// Copies the fields of a table and of the tables in it; its place is left out.
fn copy_fields(document: &mut Document, from: &str, to: &str) -> Result<(), String> {
    for key in document.keys(from) {
        if key == "id" || key == "position" {
            continue;
        }
        let (own, copy) = (format!("{from}.{key}"), format!("{to}.{key}"));
        match document.get(&own) {
            Some(text) => {
                let is_text = text.parse::<f64>().is_err() && text != "true" && text != "false";
                let value = if is_text { Setting::text(&text) } else { Setting::plain(&text) };
                document.put(&copy, &value).map_err(|error| error.message)?;
            }
            None => copy_fields(document, &own, &copy)?,
        }
    }
    Ok(())
}

/// Draws depth, number of lines, and what the whale has met so far.
fn facts(ui: &mut Ui, view: &LiveView, units: Units) {
    let spec = &view.model.spec;
    let mut words = vec![
        format!("depth {}", units.depth(spec.water.depth_m)),
        format!("{} lines", spec.lines.len()),
    ];
    let count = |kind: EventKind| view.events.iter().filter(|event| event.kind == kind).count();
    let parted = count(EventKind::LineParted) + count(EventKind::LinkParted);
    if spec.whale.is_some() && view.newest_s > 0.0 {
        let now: BTreeSet<usize> = view.frame.contacts.iter().map(|contact| contact.line).collect();
        words.push(format!("{} lines touch the whale", now.len()));
        words.push(format!("{parted} parted"));
    }
    ui.label(RichText::new(words.join(" · ")).color(Theme::palette_of(ui).faint));
}

/// Draws lines, bodies, track and whale; coordinates are multiplied by `scale`.
fn draw(plot: &mut PlotUi<'_>, view: &LiveView, scale: f64, palette: Palette) {
    let (model, frame) = (&view.model, &view.frame);
    let flat = |place: DVec3| [place.x * scale, place.y * scale];
    let touching: BTreeSet<usize> = frame.contacts.iter().map(|contact| contact.line).collect();
    for (index, nodes) in model.line_nodes.iter().enumerate() {
        let points: Vec<[f64; 2]> = frame.nodes[nodes.clone()].iter().copied().map(flat).collect();
        let is_touching = touching.contains(&index);
        let color = if is_touching { palette.error } else { palette.accent };
        let line = Line::new(model.spec.lines[index].id.clone(), PlotPoints::from(points));
        plot.line(line.color(color).width(if is_touching { 2.5 } else { 1.5 }));
    }
    for (role, name, shape, radius) in [
        (BodyRole::Trap, "traps", MarkerShape::Square, 3.5),
        (BodyRole::Buoy, "buoys", MarkerShape::Circle, 3.5),
        (BodyRole::Anchor, "anchors", MarkerShape::Cross, 4.0),
    ] {
        let own = model.spec.bodies.iter().zip(&frame.bodies).filter(|(body, _)| body.role == role);
        let points: Vec<[f64; 2]> = own.map(|(_, (place, _))| flat(*place)).collect();
        if !points.is_empty() {
            plot.points(Points::new(name, points).shape(shape).radius(radius).color(palette.faint));
        }
    }
    let east = view.history.samples(Channel::East.index());
    let north = view.history.samples(Channel::North.index());
    let track: Vec<[f64; 2]> =
        east.zip(north).map(|((_, east), (_, north))| [east * scale, north * scale]).collect();
    if track.len() > 1 {
        let line = Line::new("track of the whale", PlotPoints::from(track));
        plot.line(line.color(palette.warning).width(1.5).style(LineStyle::dashed_dense()));
    }
    if let (Some(whale), Some(at)) = (&model.spec.whale, &frame.whale) {
        let outline = outline(at.position, at.orientation, whale.length_m);
        let points: Vec<[f64; 2]> =
            outline.into_iter().map(|at| [at.x * scale, at.y * scale]).collect();
        let body = Polygon::new("whale", PlotPoints::from(points));
        let ink = palette.text;
        plot.polygon(body.fill_color(ink.gamma_multiply(0.35)).stroke(Stroke::new(1.0, ink)));
    }
}

/// Outline of a whale from above: east and north [m].
fn outline(place: DVec3, orientation: DQuat, length_m: f64) -> Vec<DVec2> {
    let ahead = orientation * DVec3::X;
    let ahead = DVec2::new(ahead.x, ahead.y).try_normalize().unwrap_or(DVec2::X);
    let at = |[along, out]: [f64; 2], side: f64| {
        DVec2::new(place.x, place.y) + (ahead * along + ahead.perp() * (side * out)) * length_m
    };
    let port = OUTLINE.into_iter().map(|spot| at(spot, 1.0));
    port.chain(OUTLINE.into_iter().rev().map(|spot| at(spot, -1.0))).collect()
}

/// Draws the surface current as an arrow with its speed in the upper left corner of the map.
fn current(ui: &Ui, map: &egui::Response, view: &LiveView, units: Units, palette: Palette) {
    let velocity = view.model.spec.water.current.at(1.0, view.frame.time_s);
    let speed_m_s = DVec2::new(velocity.x, velocity.y).length();
    let painter = ui.painter_at(map.rect);
    let middle = map.rect.left_top() + vec2(76.0, 26.0);
    let text = if speed_m_s > 1e-3 {
        let along = vec2(velocity.x as f32, -velocity.y as f32) / speed_m_s as f32;
        painter.arrow(middle - along * 14.0, along * 28.0, Stroke::new(2.0, palette.accent));
        let bearing = bearing_degrees(velocity.x, velocity.y);
        format!("{} towards {bearing:.0}°", units.speed(speed_m_s))
    } else {
        "no current".to_owned()
    };
    let font = egui::FontId::proportional(12.0);
    let at = middle + vec2(24.0, 0.0);
    painter.text(at, egui::Align2::LEFT_CENTER, text, font, palette.text);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outline_points_ahead_and_has_the_length_of_the_whale() {
        let north = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
        let found = outline(DVec3::new(5.0, 7.0, -3.0), north, 10.0);
        let [low, high] =
            found.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
                [low.min(at.y), high.max(at.y)]
            });
        assert!((high - 12.0).abs() < 1e-9 && (low - 2.0).abs() < 1e-9, "{low} {high}");
        let sum = found.iter().fold(DVec2::ZERO, |sum, at| sum + *at) / found.len() as f64;
        assert!((sum.x - 5.0).abs() < 1e-9, "both sides alike");
    }

    #[test]
    fn a_copy_has_the_fields_of_its_original_and_another_id() {
        let text = "[[gear]]\nassembly = \"single\"\nheading = \"45 deg\"\n[gear.attributes]\nscope = 1.5\n";
        let mut document = Document::parse(text).unwrap();
        let place = document.push_table("gear", &[]).unwrap();
        copy_fields(&mut document, "gear.0", &format!("gear.{place}")).unwrap();
        for field in ["assembly", "heading", "attributes.scope"] {
            let of = |index: usize| document.get(&format!("gear.{index}.{field}"));
            assert!(of(1).is_some() && of(0) == of(1), "{field}: {}", document.text());
        }
    }
}
