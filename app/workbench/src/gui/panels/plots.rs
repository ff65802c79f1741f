//! Plots of the run, one below the other; written to files as pictures and tables.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{Rect, ScrollArea, Ui};

use crate::gui::charts::{Chart, Kind};
use crate::gui::desk::{Desk, Order};
use crate::gui::order::Dialog;
use crate::gui::panel::Panel;
use crate::gui::panel_id::PanelId;
use crate::gui::widgets::plot::{DrawnCharts, HEAD, LEAST, chart};
use crate::gui::{chart_svg, widgets};

/// Plots of the run.
pub struct PlotsPanel {
    /// The kinds shown.
    kinds: Vec<Kind>,
    drawn: DrawnCharts,
    /// A PNG to be cut from the window as it is drawn next.
    picture: Option<PathBuf>,
    /// The file that waits for the window's picture, and the part of it that is the plots.
    waiting: Option<(PathBuf, Rect)>,
}

impl Default for PlotsPanel {
    fn default() -> Self {
        Self {
            kinds: vec![Kind::Tension, Kind::Force, Kind::Wraps],
            drawn: DrawnCharts::default(),
            picture: None,
            waiting: None,
        }
    }
}

impl Panel for PlotsPanel {
    fn id(&self) -> PanelId {
        PanelId::PLOTS
    }

    fn ui(&mut self, ui: &mut Ui, desk: &mut Desk) {
        if desk.view.is_none() {
            return widgets::nothing(ui, "No run yet.");
        }
        self.toolbar(ui, desk);
        if self.kinds.is_empty() {
            return widgets::nothing(ui, "Choose what to plot above.");
        }
        self.photograph(ui, desk);
        let height = (ui.available_height() / self.kinds.len() as f32 - HEAD).max(LEAST);
        let compared = if desk.other().is_some() { "; A solid, B dashed" } else { "" };
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for kind in self.kinds.clone() {
                let along = kind == Kind::Along;
                let note = if along { "; shaded from least to greatest so far" } else { "" };
                let title = format!("{}{note}{compared}", kind.title());
                self.drawn.show(ui, desk, kind, &title, height);
            }
        });
    }
}

impl PlotsPanel {
    fn toolbar(&mut self, ui: &mut Ui, desk: &mut Desk) {
        ui.horizontal_wrapped(|ui| {
            for kind in Kind::ALL {
                let mut on = self.kinds.contains(&kind);
                if ui.toggle_value(&mut on, kind.title()).changed() {
                    let shown = |known: &Kind| {
                        if *known == kind { on } else { self.kinds.contains(known) }
                    };
                    self.kinds = Kind::ALL.into_iter().filter(shown).collect();
                }
            }
            ui.menu_button("Save ⏷", |ui| {
                for (text, ending) in
                    [("As SVG …", "svg"), ("As PNG …", "png"), ("As CSV …", "csv")]
                {
                    if ui.button(text).clicked() {
                        desk.orders.push(Order::Ask(Dialog::ExportPlots(ending)));
                        ui.close();
                    }
                }
            });
        });
    }

    /// Writes the plots shown: as SVG, or as PNG or CSV by the file's ending. A PNG is cut from the window when the panel is
    /// drawn next.
    pub fn export(&mut self, desk: &mut Desk, path: &Path) {
        let ends =
            |with: &str| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(with));
        if ends("png") {
            self.picture = Some(path.to_owned());
            return;
        }
        let charts = self.charts(desk);
        let text = if ends("csv") {
            Ok(charts.iter().map(Chart::csv).collect())
        } else {
            chart_svg::svg(&charts)
        };
        let written = text.and_then(|text: String| write(path, text.as_bytes()));
        desk.notice_saved(path, written);
    }

    /// The charts shown, for writing.
    fn charts(&self, desk: &Desk) -> Vec<Chart> {
        let Some(view) = &desk.view else { return Vec::new() };
        let (other, units) = (desk.other_view(), desk.preferences.units);
        self.kinds.iter().map(|kind| chart(*kind, view, other.as_deref(), units)).collect()
    }

    /// Cuts the plots out of a picture of the window.
    fn photograph(&mut self, ui: &Ui, desk: &mut Desk) {
        if let Some(path) = self.picture.take() {
            self.waiting = Some((path, ui.available_rect_before_wrap()));
            let command = egui::ViewportCommand::Screenshot(egui::UserData::default());
            ui.ctx().send_viewport_cmd(command);
        }
        let shot = |event: &egui::Event| match event {
            egui::Event::Screenshot { image, .. } => Some(Arc::clone(image)),
            _ => None,
        };
        let Some(image) = ui.input(|input| input.events.iter().find_map(shot)) else { return };
        let Some((path, rect)) = self.waiting.take() else { return };
        let cut = image.region(&rect, Some(ui.ctx().pixels_per_point()));
        let written = png_of(&cut).and_then(|bytes| write(&path, &bytes));
        desk.notice_saved(&path, written);
    }
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    endline_session::save::atomically(path, bytes).map_err(|error| error.to_string())
}

fn png_of(image: &egui::ColorImage) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let side = |pixels: usize| u32::try_from(pixels).map_err(|error| error.to_string());
    let mut encoder = png::Encoder::new(&mut bytes, side(image.size[0])?, side(image.size[1])?);
    encoder.set_color(png::ColorType::Rgba);
    let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
    writer.write_image_data(image.as_raw()).map_err(|error| error.to_string())?;
    writer.finish().map_err(|error| error.to_string())?;
    Ok(bytes)
}
