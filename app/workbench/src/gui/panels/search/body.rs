//! The body map of an observation, coloured by what was seen on each part; a click selects a part.

use egui::{Align2, Color32, FontId, Painter, Rect, RichText, Sense, Stroke, Ui, vec2};
use endline_gear::{PathPlace, Site};
use endline_sdk::Side;
use endline_session::edit::observation::{self, Range, Sighting};

use super::SearchPanel;
use crate::gui::bodymap::{BodyMap, Edge, Face};
use crate::gui::shared::Shared;
use crate::gui::theme::{Palette, Theme};
use crate::gui::widgets::words::{capital, spoken};

/// The body map with its marks.
#[derive(Default)]
pub(super) struct Map {
    /// Map of the observed animal, with the version of the files it was made for.
    body: Option<(u64, BodyMap)>,
    /// Outline of the selected site on each face.
    outline: Option<(Site, [Vec<Edge>; 4])>,
    hovered: Option<Site>,
}

/// The observation, prepared for drawing.
struct Seen {
    /// For each single site: the site of the observation that covers it, and its state.
    sites: Vec<(Site, Site, Sighting)>,
    /// Wraps of a site, such as `1 – 4`.
    wraps: Vec<(Site, String)>,
    path: Vec<PathPlace>,
    palette: Palette,
}

impl Seen {
    fn of(ui: &Ui, shared: &Shared) -> Self {
        let documents = shared.documents();
        let entry = |single: Site| {
            let site = observation::site_of(documents, single);
            (single, site, observation::sighting_of(documents, site))
        };
        let sites: Vec<(Site, Site, Sighting)> = Site::SINGLE.into_iter().map(entry).collect();
        let wraps = sites.iter().filter_map(|(single, site, sighting)| {
            let [least, most] = observation::range(documents, Range::Wraps(*site));
            let words = if least == most { least } else { format!("{least} – {most}") };
            (sighting.has_rope() && !words.is_empty()).then_some((*single, words))
        });
        let path = observation::places(documents);
        let path = path.iter().filter_map(|place| PathPlace::named(place)).collect();
        Self { wraps: wraps.collect(), sites, path, palette: Theme::palette_of(ui) }
    }

    fn sighting(&self, single: Site) -> (Site, Sighting) {
        let found = self.sites.iter().find(|(own, ..)| *own == single);
        found.map_or((single, Sighting::Nothing), |(_, site, sighting)| (*site, *sighting))
    }
}

/// Draws the map and its legend, and handles hover and click.
pub(super) fn show(ui: &mut Ui, panel: &mut SearchPanel, shared: &Shared) {
    let seen = Seen::of(ui, shared);
    let map = &mut panel.map;
    let version = shared.documents().version();
    if map.body.as_ref().is_none_or(|(known, _)| *known != version) {
        let skin = shared.workbench.observed_skin();
        let same = map.body.take().map(|(_, body)| body);
        let same = same.filter(|body| skin.as_ref().is_some_and(|skin| body.is_of(skin)));
        if same.is_none() {
            map.outline = None;
        }
        map.body = same.or_else(|| skin.map(BodyMap::of)).map(|body| (version, body));
    }
    let Some((_, body)) = &mut map.body else { return };
    let chosen = seen.sighting(panel.chosen).0;
    if map.outline.as_ref().is_none_or(|(of, _)| *of != chosen) {
        let own = |face: Face| body.outline(face, |region| is_of(chosen, Site::of_region(region)));
        map.outline = Some((chosen, Face::ALL.map(own)));
    }
    let outline = map.outline.as_ref().map(|(_, outline)| outline);
    let plain = BodyMap::plain(ui);
    let hovered = map.hovered;
    let colour = |region| {
        let site = Site::of_region(region);
        let own = colour(seen.sighting(site).1, plain, seen.palette);
        if hovered == Some(site) { own.lerp_to_gamma(seen.palette.text, 0.18) } else { own }
    };
    let at = body.faces(ui, Sense::click(), colour, |body, painter, face, rect| {
        let edges = outline.map_or(&[][..], |outline| &outline[face as usize]);
        for [one, other] in edges {
            let ends = [*one, *other].map(|end| rect.center() + end * rect.width());
            painter.line_segment(ends, Stroke::new(1.6, seen.palette.accent));
        }
        if face == Face::Above {
            marks(body, painter, rect, &seen);
        }
    });
    let site = at.map(|(region, _)| Site::of_region(region));
    if map.hovered != site {
        map.hovered = site;
        ui.ctx().request_repaint();
    }
    if let (Some(site), Some((_, true))) = (site, at) {
        panel.chosen = site;
    }
    legend(ui, &seen, plain, site);
}

fn is_of(site: Site, single: Site) -> bool {
    site.singles().contains(&single)
}

/// Colour of a body part, stronger with greater certainty.
fn colour(sighting: Sighting, plain: Color32, palette: Palette) -> Color32 {
    match sighting {
        Sighting::Nothing => plain,
        Sighting::Hidden => palette.ground.lerp_to_gamma(plain, 0.25),
        Sighting::Seen(present) => {
            // The colours of the dark theme are light enough for filling.
            let Palette { warning, good, .. } = Theme::Dark.palette();
            let end = if present > 0.5 { warning } else { good };
            let sure = (2.0 * present - 1.0).abs() as f32;
            plain.lerp_to_gamma(end, 0.25 + 0.75 * sure)
        }
    }
}

/// Draws wraps beside their parts, and the path of the rope by numbers.
fn marks(body: &BodyMap, painter: &Painter, rect: Rect, seen: &Seen) {
    let palette = seen.palette;
    for (single, words) in &seen.wraps {
        let is_it = |region| Site::of_region(region) == *single;
        if let Some(middle) = body.middle(Face::Above, rect, is_it, None) {
            // Below the part, so that the part stays visible.
            badge(
                painter,
                middle + vec2(0.0, 17.0),
                &format!("{words} ×"),
                palette.panel,
                palette.text,
            );
        }
    }
    let place = |place: &PathPlace| {
        let is_it = |region| is_of(place.site, Site::of_region(region));
        let port = place.side.map(|side| side == Side::Left);
        body.middle(Face::Above, rect, is_it, port)
    };
    let places: Vec<_> = seen.path.iter().filter_map(place).collect();
    for pair in places.windows(2) {
        painter.line_segment([pair[0], pair[1]], Stroke::new(1.6, palette.error));
    }
    for (number, at) in places.iter().enumerate() {
        badge(painter, *at, &(number + 1).to_string(), palette.error, palette.panel);
    }
}

fn badge(painter: &Painter, at: egui::Pos2, words: &str, ground: Color32, text: Color32) {
    let galley = painter.layout_no_wrap(words.to_owned(), FontId::proportional(11.0), text);
    let rect = Rect::from_center_size(at, galley.size() + vec2(8.0, 2.0));
    painter.rect_filled(rect, 6.0, ground.gamma_multiply(0.9));
    painter.galley(Align2::CENTER_CENTER.anchor_size(at, galley.size()).min, galley, text);
}

/// Draws the legend and the state of the part under the pointer.
fn legend(ui: &mut Ui, seen: &Seen, plain: Color32, hovered: Option<Site>) {
    let palette = seen.palette;
    ui.horizontal_wrapped(|ui| {
        let meanings = [
            (Sighting::Seen(1.0), "rope"),
            (Sighting::Seen(0.0), "no rope"),
            (Sighting::Hidden, "hidden"),
            (Sighting::Nothing, "unknown"),
        ];
        for (sighting, words) in meanings {
            let (rect, _) = ui.allocate_exact_size(vec2(11.0, 11.0), Sense::hover());
            ui.painter().rect(
                rect,
                2.0,
                colour(sighting, plain, palette),
                Stroke::new(1.0, palette.faint),
                egui::StrokeKind::Inside,
            );
            ui.label(RichText::new(words).small().color(palette.faint));
        }
        let words = hovered.map_or_else(
            || "click a part to describe it".to_owned(),
            |single| {
                let (site, sighting) = seen.sighting(single);
                format!("{}: {}", capital(&spoken(site.name())), in_words(sighting))
            },
        );
        ui.label(RichText::new(format!("·  {words}")).small().color(palette.text));
    });
}

/// State of a part in words.
fn in_words(sighting: Sighting) -> String {
    match sighting {
        Sighting::Nothing => "unknown".to_owned(),
        Sighting::Hidden => "hidden from view".to_owned(),
        Sighting::Seen(present) => {
            let what = if present > 0.5 { "rope" } else { "no rope" };
            format!("{what}, {:.0} % sure", 100.0 * present.max(1.0 - present))
        }
    }
}
