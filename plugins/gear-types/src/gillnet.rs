//! The gillnet string: panels of netting between a headline with floats and a leadline, anchored at both ends.
//!
//! ```text
//!      .---- headline-1 ----+---- headline-2 ---- ... ----.
//!     / bridle-top          | netting-2                     \
//! bridle                    |                            far-bridle
//!   | \ bridle-bottom       |                               / |
//!   |  '---- leadline-1 ----+---- leadline-2 ---- ... ----'   |
//!  anchor-line                                             far-anchor-line
//!  anchor                                                   far-anchor
//! ```
//!
//! Meshes are not modelled. The figures of headline and leadline each include half of the drag, weight and water of the netting
//! (`gear-library/ropes/gillnet-headline.toml`). This is correct for a current across the string; the small drag along it is
//! that of the ropes. Netting lines between the two limit their distance to the height of the net, so that the net leans,
//! sinks and bags in the current and loads its anchors. A whale touches headline, leadline and netting lines, not meshes.
//!
//! Panels, anchors of 22 lb and weak links of 1,100 lbf in the headline follow practice and rules of the
//! northeast United States.

use endline_sdk::{Attribute, BodyKind, Descriptor, HookError, LineEnd, Rig, RigEnd, Site};

use crate::lay::{Endline, FAR, Foot, Lay, Values, depth_of};
use crate::{Laid, Layout};

/// The gear type of an anchored string of gillnet panels.
pub type Gillnet = Laid<NetString>;

/// Layout of [`Gillnet`].
#[derive(Clone, Debug)]
pub struct NetString;

impl Layout for NetString {
    fn descriptor() -> Descriptor {
        let mut attributes = Net::attributes();
        attributes.push(Attribute::count(
            "endlines",
            [0, 2],
            2,
            "Number of endlines: none, one at the near end, or one at each end.",
        ));
        attributes.extend(Endline::attributes("polyball-a1"));
        let help = "Panels of netting between a headline with floats and a leadline, anchored at both \
         ends, with endlines.";
        Descriptor::new("org.endline.gear.gillnet", "Gillnet string", help)
            .with_attributes(attributes)
    }

    fn build(values: &Values<'_>, site: &Site) -> Result<Rig, HookError> {
        let (net, endline) = (Net::read(values)?, Endline::read(values)?);
        let endlines = values.count("endlines")? as usize;
        let mut rig = Lay::default();
        let feet = net.lay(&mut rig, site)?;
        for (foot, prefix) in feet.iter().zip(["", FAR]).take(endlines) {
            endline.lay(&mut rig, foot, site, prefix)?;
        }
        Ok(rig.rig)
    }
}

impl Net<'_> {
    /// Lays the string on the seabed; returns its anchors, near and far.
    fn lay(&self, into: &mut Lay, site: &Site) -> Result<[Foot; 2], HookError> {
        let bed_m = -depth_of(site)?;
        if self.height_m > -0.9 * bed_m {
            let message = format!(
                "attribute `net_height`: {} m in water of {} m; it must be below the surface",
                self.height_m, -bed_m
            );
            return Err(HookError::new(message));
        }
        let (spans, chord) = (self.panels * self.lines_a_panel, self.chord_m());
        let mut columns: Vec<[RigEnd; 2]> = Vec::new();
        for column in 0..=spans {
            let x = -self.lead_m() - f64::from(column) * chord;
            let ends = self.lay_column(into, column, [x, bed_m]);
            if let Some([low, high]) = columns.last() {
                self.lay_span(
                    into,
                    column,
                    [low.clone(), ends[0].clone()],
                    [high.clone(), ends[1].clone()],
                );
            }
            columns.push(ends);
        }
        let length_m = 2.0 * self.lead_m() + f64::from(spans) * chord;
        match (columns.first(), columns.last()) {
            (Some(near), Some(far)) => Ok([
                self.lay_end(into, "", near, [0.0, -1.0], bed_m),
                self.lay_end(into, FAR, far, [-length_m, 1.0], bed_m),
            ]),
            _ => Err(HookError::new("attribute `panels`: a string has at least one panel")),
        }
    }

    /// Distance along the string from one netting line to the next [m].
    fn chord_m(&self) -> f64 {
        self.span_m() / (1.0 + self.slack)
    }

    /// Headline from one netting line to the next [m].
    fn span_m(&self) -> f64 {
        self.panel_m / f64::from(self.lines_a_panel)
    }

    /// Distance along the string from the anchor to the bridle's joint [m].
    fn reach_m(&self) -> f64 {
        self.anchor_line_m / (1.0 + self.slack)
    }

    /// Distance along the string from an anchor to the netting [m].
    fn lead_m(&self) -> f64 {
        self.reach_m() + 0.8 * self.bridle_m
    }

    /// A netting line with its joints in leadline and headline.
    fn lay_column(&self, into: &mut Lay, column: u32, [x, bed_m]: [f64; 2]) -> [RigEnd; 2] {
        let low = into.joint(&format!("lead-{column}"), [x, 0.0, bed_m]);
        let high = into.joint(&format!("head-{column}"), [x, 0.0, bed_m + 0.95 * self.height_m]);
        into.line(
            &format!("netting-{column}"),
            self.netting,
            [low.clone(), high.clone()],
            self.height_m,
        );
        [low, high]
    }

    /// Leadline and headline up to a column; at the start of a panel the headline has its weak link.
    fn lay_span(&self, into: &mut Lay, column: u32, low: [RigEnd; 2], high: [RigEnd; 2]) {
        let (headline, first) = (format!("headline-{column}"), column - 1);
        into.line(&format!("leadline-{column}"), self.leadline, low, self.span_m());
        into.line(&headline, self.headline, high, self.span_m());
        if first.is_multiple_of(self.lines_a_panel) {
            into.link(
                &format!("panel-link-{}", first / self.lines_a_panel + 1),
                self.panel_link,
                &headline,
                LineEnd::A,
            );
        }
    }

    /// Bridle, anchor line and anchor beyond the end of the netting; `sense` is that of x from the anchor to the net.
    fn lay_end(
        &self,
        into: &mut Lay,
        prefix: &str,
        [low, high]: &[RigEnd; 2],
        [x, sense]: [f64; 2],
        bed_m: f64,
    ) -> Foot {
        let (at_m, named) = ([x, 0.0, bed_m], |id: &str| format!("{prefix}{id}"));
        let bridle = into.joint(
            &named("bridle"),
            [x + sense * self.reach_m(), 0.0, bed_m + 0.3 * self.height_m],
        );
        into.line(
            &named("bridle-top"),
            self.bridle_rope,
            [bridle.clone(), high.clone()],
            self.bridle_m,
        );
        into.line(
            &named("bridle-bottom"),
            self.bridle_rope,
            [bridle.clone(), low.clone()],
            self.bridle_m,
        );
        let anchor = into.body(&named("anchor"), BodyKind::Anchor, self.anchor, at_m);
        into.line(
            &named("anchor-line"),
            self.bridle_rope,
            [anchor.clone(), bridle],
            self.anchor_line_m,
        );
        Foot { end: anchor.clone(), at_m, body: anchor, body_at_m: at_m }
    }
}

/// The string without its endlines.
struct Net<'a> {
    /// Number of panels.
    panels: u32,
    /// Length of a panel's headline [m].
    panel_m: f64,
    /// Height of the net, taut [m].
    height_m: f64,
    /// Rope of the headline.
    headline: &'a str,
    /// Rope of the leadline.
    leadline: &'a str,
    /// Rope of a netting line.
    netting: &'a str,
    /// Number of netting lines of a panel.
    lines_a_panel: u32,
    /// Excess length of headline and leadline over their distance, as a share [1].
    slack: f64,
    /// Weak link at each panel; empty for none.
    panel_link: &'a str,
    /// Length of each bridle leg [m].
    bridle_m: f64,
    /// Rope of bridles and anchor lines.
    bridle_rope: &'a str,
    /// Anchor at each end.
    anchor: &'a str,
    /// Length of each anchor line [m].
    anchor_line_m: f64,
}

impl<'a> Net<'a> {
    /// The attributes of panels, bridles and anchors, in the order in which a file lists them.
    fn attributes() -> Vec<Attribute> {
        let mut attributes = panel_attributes();
        attributes.extend(anchoring_attributes());
        attributes
    }

    /// The string of the attribute values.
    ///
    /// # Errors
    /// With a message that names the attribute to fix.
    fn read(values: &Values<'a>) -> Result<Self, HookError> {
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
                "attribute `bridle`: legs of {bridle} m do not reach up a net of {height} m; write at least 0.6 times `net_height`"
            )));
        }
        Ok(net)
    }
}

/// Attributes of panels: number, size and ropes.
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
            "The twine of a section of net, gathered in one line.",
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
