//! What a gillnet string is made of: attributes and their values.

use endline_sdk::{Attribute, HookError};

use crate::lay::Values;

/// The string without its endlines.
pub(super) struct Net<'a> {
    /// How many panels.
    pub(super) panels: u32,
    /// Length of a panel's headline [m].
    pub(super) panel_m: f64,
    /// Height of the net, taut [m].
    pub(super) height_m: f64,
    /// Rope of the headline.
    pub(super) headline: &'a str,
    /// Rope of the leadline.
    pub(super) leadline: &'a str,
    /// Rope that stands for a stretch of netting.
    pub(super) netting: &'a str,
    /// Number of netting lines that represent a panel.
    pub(super) lines_a_panel: u32,
    /// How much longer headline and leadline are than what they lie along [1].
    pub(super) slack: f64,
    /// Weak link at each panel; empty for none.
    pub(super) panel_link: &'a str,
    /// Length of each bridle leg [m].
    pub(super) bridle_m: f64,
    /// Rope of bridles and anchor lines.
    pub(super) bridle_rope: &'a str,
    /// Anchor at each end.
    pub(super) anchor: &'a str,
    /// Length of each anchor line [m].
    pub(super) anchor_line_m: f64,
}

impl<'a> Net<'a> {
    /// The attributes of panels, bridles and anchors, in the order in which a file lists them.
    pub(super) fn attributes() -> Vec<Attribute> {
        let mut attributes = panel_attributes();
        attributes.extend(anchoring_attributes());
        attributes
    }

    /// The string that the values ask for.
    ///
    /// # Errors
    /// With a message that names the attribute to fix.
    pub(super) fn read(values: &Values<'a>) -> Result<Self, HookError> {
        let net = Self {
            panels: values.count("panels")?,
            panel_m: values.number("panel_length")?,
            height_m: values.number("net_height")?,
            headline: values.needed("headline")?,
            leadline: values.needed("leadline")?,
            netting: values.needed("netting")?,
            lines_a_panel: values.count("netting_lines")?,
            slack: values.number("slack")?,
            panel_link: values.item("panel_link")?,
            bridle_m: values.number("bridle")?,
            bridle_rope: values.needed("bridle_rope")?,
            anchor: values.needed("anchor")?,
            anchor_line_m: values.number("anchor_line")?,
        };
        if net.bridle_m < 0.6 * net.height_m {
            let (bridle, height) = (net.bridle_m, net.height_m);
            return Err(HookError::new(format!(
                "attribute `bridle`: legs of {bridle} m do not reach up a net of {height} m; give \
                 them 0.6 times `net_height` or more"
            )));
        }
        Ok(net)
    }
}

/// Panels: how many, how large, and of which ropes.
fn panel_attributes() -> Vec<Attribute> {
    vec![
        Attribute::count("panels", [1, 40], 3, "Number of panels of netting."),
        Attribute::number(
            "panel_length",
            "m",
            [5.0, 500.0],
            91.44,
            "Length of a panel's headline; 300 ft by default.",
        ),
        Attribute::number(
            "net_height",
            "m",
            [0.5, 30.0],
            3.0,
            "Height of the net from leadline to headline, the netting taut.",
        ),
        Attribute::item(
            "headline",
            "ropes",
            "gillnet-headline",
            "Headline with its floats and half of the netting.",
        ),
        Attribute::item(
            "leadline",
            "ropes",
            "gillnet-leadline",
            "Leadline with the other half of the netting.",
        ),
        Attribute::item(
            "netting",
            "ropes",
            "gillnet-netting",
            "The twine of a stretch of net, gathered in one line.",
        ),
        Attribute::count(
            "netting_lines",
            [1, 100],
            6,
            "Number of netting lines that represent a panel.",
        ),
        Attribute::number(
            "slack",
            "1",
            [0.0, 0.5],
            0.01,
            "Excess length of headline and leadline over the distance that they span, as a share.",
        ),
    ]
}

/// Weak links between panels, bridles and anchors.
fn anchoring_attributes() -> Vec<Attribute> {
    vec![
        Attribute::item(
            "panel_link",
            "weak-links",
            "wl-1100",
            "Weak link in the headline at each panel; empty for none.",
        ),
        Attribute::number(
            "bridle",
            "m",
            [1.0, 50.0],
            4.0,
            "Length of each bridle leg from headline and leadline to the anchor line.",
        ),
        Attribute::item("bridle_rope", "ropes", "sink-7-16", "Rope of bridles and anchor lines."),
        Attribute::item("anchor", "anchors", "danforth-22lb", "Anchor at each end."),
        Attribute::number("anchor_line", "m", [1.0, 500.0], 20.0, "Length of each anchor line."),
    ]
}
