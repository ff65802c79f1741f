//! Themes: colours and styles of the window, dark (default) or light, with one accent colour.

use egui::{Color32, CornerRadius, FontFamily, FontId, Margin, Stroke, TextStyle, Vec2, Visuals};
use egui_dock::Style as DockStyle;
use serde::{Deserialize, Serialize};

/// Dark or light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Theme {
    /// Light text on dark.
    #[default]
    Dark,
    /// Dark text on light.
    Light,
}

/// The colours of a theme.
#[derive(Clone, Copy, Debug)]
pub struct Palette {
    /// Background behind panels.
    pub ground: Color32,
    /// Background of panels.
    pub panel: Color32,
    /// Background of fields and tables.
    pub field: Color32,
    /// Buttons.
    pub button: Color32,
    /// Buttons under the pointer.
    pub hover: Color32,
    /// Thin lines.
    pub line: Color32,
    /// Text.
    pub text: Color32,
    /// Secondary text.
    pub faint: Color32,
    /// Links, main buttons and the selection.
    pub accent: Color32,
    /// Text on the accent.
    pub on_accent: Color32,
    /// Errors.
    pub error: Color32,
    /// Warnings.
    pub warning: Color32,
    /// Success.
    pub good: Color32,
}

impl Theme {
    /// Its colours.
    pub fn palette(self) -> Palette {
        let rgb = Color32::from_rgb;
        match self {
            Self::Dark => Palette {
                ground: rgb(0x11, 0x17, 0x1b),
                panel: rgb(0x19, 0x21, 0x26),
                field: rgb(0x12, 0x19, 0x1d),
                button: rgb(0x27, 0x33, 0x3a),
                hover: rgb(0x32, 0x41, 0x4a),
                line: rgb(0x2c, 0x38, 0x3f),
                text: rgb(0xd8, 0xe1, 0xe5),
                faint: rgb(0x8f, 0xa1, 0xaa),
                accent: rgb(0x4f, 0xb6, 0xcb),
                on_accent: rgb(0x07, 0x1c, 0x22),
                error: rgb(0xff, 0x7b, 0x72),
                warning: rgb(0xe6, 0xb4, 0x50),
                good: rgb(0x6f, 0xc2, 0x8b),
            },
            Self::Light => Palette {
                ground: rgb(0xdd, 0xe4, 0xe7),
                panel: rgb(0xf4, 0xf7, 0xf8),
                field: rgb(0xff, 0xff, 0xff),
                button: rgb(0xe2, 0xe9, 0xec),
                hover: rgb(0xd3, 0xde, 0xe2),
                line: rgb(0xc6, 0xd1, 0xd6),
                text: rgb(0x1b, 0x26, 0x2c),
                faint: rgb(0x54, 0x66, 0x70),
                accent: rgb(0x09, 0x6a, 0x80),
                on_accent: rgb(0xff, 0xff, 0xff),
                error: rgb(0xb3, 0x26, 0x1e),
                warning: rgb(0x8a, 0x5a, 0x00),
                good: rgb(0x1a, 0x6e, 0x3a),
            },
        }
    }

    /// The colours of the theme in which a ui is drawn.
    pub fn palette_of(ui: &egui::Ui) -> Palette {
        if ui.visuals().dark_mode { Self::Dark.palette() } else { Self::Light.palette() }
    }

    /// Applies the theme to a context.
    pub fn apply(self, context: &egui::Context) {
        context.set_theme(if self == Self::Dark { egui::Theme::Dark } else { egui::Theme::Light });
        let visuals = self.visuals();
        context.all_styles_mut(|style| {
            style.visuals = visuals.clone();
            style.spacing.item_spacing = Vec2::new(7.0, 5.0);
            style.spacing.button_padding = Vec2::new(9.0, 3.0);
            style.spacing.interact_size = Vec2::new(34.0, 22.0);
            style.spacing.menu_margin = Margin::same(6);
            style.spacing.combo_width = 150.0;
            style.interaction.selectable_labels = false;
            style.text_styles = text_styles();
        });
    }

    fn visuals(self) -> Visuals {
        let palette = self.palette();
        let mut visuals = if self == Self::Dark { Visuals::dark() } else { Visuals::light() };
        visuals.panel_fill = palette.panel;
        visuals.window_fill = palette.panel;
        visuals.extreme_bg_color = palette.field;
        visuals.text_edit_bg_color = Some(palette.field);
        visuals.faint_bg_color = palette.ground.lerp_to_gamma(palette.panel, 0.55);
        visuals.window_stroke = Stroke::new(1.0, palette.line);
        visuals.hyperlink_color = palette.accent;
        visuals.error_fg_color = palette.error;
        visuals.warn_fg_color = palette.warning;
        visuals.weak_text_color = Some(palette.faint);
        visuals.selection.bg_fill = palette.accent.gamma_multiply(0.35);
        visuals.selection.stroke = Stroke::new(1.0, palette.accent);
        self.style_widgets(&mut visuals);
        visuals
    }

    fn style_widgets(self, visuals: &mut Visuals) {
        let palette = self.palette();
        let widgets = &mut visuals.widgets;
        for widget in [
            &mut widgets.noninteractive,
            &mut widgets.inactive,
            &mut widgets.hovered,
            &mut widgets.active,
            &mut widgets.open,
        ] {
            widget.corner_radius = CornerRadius::same(4);
            widget.fg_stroke = Stroke::new(1.0, palette.text);
            widget.bg_fill = palette.button;
            widget.weak_bg_fill = palette.button;
            widget.bg_stroke = Stroke::NONE;
            widget.expansion = 0.0;
        }
        widgets.noninteractive.bg_stroke = Stroke::new(1.0, palette.line);
        widgets.inactive.bg_stroke = Stroke::new(1.0, palette.line);
        for widget in [&mut widgets.hovered, &mut widgets.open] {
            (widget.bg_fill, widget.weak_bg_fill) = (palette.hover, palette.hover);
            widget.bg_stroke = Stroke::new(1.0, palette.faint.gamma_multiply(0.7));
        }
        (widgets.active.bg_fill, widgets.active.weak_bg_fill) = (palette.hover, palette.hover);
        widgets.active.bg_stroke = Stroke::new(1.0, palette.accent);
    }

    /// Style of the dock in this theme.
    pub fn dock(self, egui_style: &egui::Style) -> DockStyle {
        let palette = self.palette();
        let mut style = DockStyle::from_egui(egui_style);
        style.main_surface_border_stroke = Stroke::NONE;
        style.separator.width = 4.0;
        style.separator.color_idle = palette.ground;
        style.separator.color_hovered = palette.accent.gamma_multiply(0.6);
        style.separator.color_dragged = palette.accent;
        style.tab_bar.bg_fill = palette.ground;
        style.tab_bar.height = 27.0;
        style.tab_bar.hline_color = palette.line;
        style.tab_bar.corner_radius = CornerRadius::ZERO;
        style.tab.tab_body.bg_fill = palette.panel;
        style.tab.tab_body.stroke = Stroke::NONE;
        style.tab.tab_body.inner_margin = Margin::same(8);
        style.tab.hline_below_active_tab_name = false;
        let tab = &mut style.tab;
        for kind in [
            &mut tab.active,
            &mut tab.focused,
            &mut tab.hovered,
            &mut tab.inactive,
            &mut tab.active_with_kb_focus,
            &mut tab.focused_with_kb_focus,
            &mut tab.inactive_with_kb_focus,
        ] {
            kind.outline_color = Color32::TRANSPARENT;
            kind.corner_radius = CornerRadius { nw: 4, ne: 4, sw: 0, se: 0 };
            (kind.bg_fill, kind.text_color) = (palette.panel, palette.text);
        }
        for kind in [&mut tab.inactive, &mut tab.inactive_with_kb_focus] {
            (kind.bg_fill, kind.text_color) = (palette.ground, palette.faint);
        }
        (tab.hovered.bg_fill, tab.hovered.text_color) = (palette.button, palette.text);
        (tab.focused.text_color, tab.focused_with_kb_focus.text_color) =
            (palette.accent, palette.accent);
        style
    }
}

fn text_styles() -> std::collections::BTreeMap<TextStyle, FontId> {
    [
        (TextStyle::Small, FontId::new(11.0, FontFamily::Proportional)),
        (TextStyle::Body, FontId::new(13.0, FontFamily::Proportional)),
        (TextStyle::Button, FontId::new(13.0, FontFamily::Proportional)),
        (TextStyle::Heading, FontId::new(16.0, FontFamily::Proportional)),
        (TextStyle::Monospace, FontId::new(12.5, FontFamily::Monospace)),
    ]
    .into()
}

/// Draws the main button of a group, filled with the accent colour.
pub fn primary(ui: &mut egui::Ui, enabled: bool, text: &str) -> egui::Response {
    let palette = Theme::palette_of(ui);
    let label =
        egui::RichText::new(text).color(if enabled { palette.on_accent } else { palette.faint });
    let fill = if enabled { palette.accent } else { palette.button };
    ui.add_enabled(enabled, egui::Button::new(label).fill(fill))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contrast of two colours (WCAG 2).
    fn contrast(a: Color32, b: Color32) -> f64 {
        let luminance = |colour: Color32| {
            let linear = |part: u8| {
                let part = f64::from(part) / 255.0;
                if part <= 0.040_45 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
            };
            0.2126 * linear(colour.r()) + 0.7152 * linear(colour.g()) + 0.0722 * linear(colour.b())
        };
        let (high, low) = (luminance(a).max(luminance(b)), luminance(a).min(luminance(b)));
        (high + 0.05) / (low + 0.05)
    }

    #[test]
    fn every_text_colour_has_the_contrast_of_wcag_on_its_background() {
        for theme in [Theme::Dark, Theme::Light] {
            let palette = theme.palette();
            for ground in [palette.panel, palette.field, palette.ground] {
                for text in [
                    palette.text,
                    palette.faint,
                    palette.accent,
                    palette.error,
                    palette.warning,
                    palette.good,
                ] {
                    assert!(
                        contrast(text, ground) >= 4.5,
                        "{theme:?}: {text:?} on {ground:?} is {:.2}",
                        contrast(text, ground)
                    );
                }
            }
            assert!(contrast(palette.on_accent, palette.accent) >= 4.5);
        }
    }
}
