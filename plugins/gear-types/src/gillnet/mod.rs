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
//! The netting is not modelled mesh by mesh. Headline and leadline each carry half of its drag, weight
//! and water, as the figures of those ropes say (`gear-library/ropes/gillnet-headline.toml`). That is
//! right for a current across the string; the small drag along it is that of the ropes. Netting lines
//! stand between the two, each for a stretch of net, and hold them no further apart than the net is
//! high. So the net leans, sinks and bags in the current and pulls on its anchors as a whole. A whale
//! meets headline, leadline and netting lines, not meshes.
//!
//! Panels, anchors of 22 lb and weak links of 1,100 lbf in the headline follow practice and rules of the
//! northeast United States.

mod net;

use endline_sdk::{
    Attribute, AttributeValue, BodyKind, Descriptor, GearType, HookError, LineEnd, Rig, RigEnd,
    Site,
};

use crate::lay::{Endline, FAR, Foot, Lay, Values, depth_of};
use net::Net;

/// The gear type of an anchored string of gillnet panels.
#[derive(Clone, Debug)]
pub struct Gillnet {
    descriptor: Descriptor,
}

impl Gillnet {
    /// The gear type with its descriptor.
    #[must_use]
    pub fn new() -> Self {
        Self { descriptor: descriptor() }
    }
}

impl Default for Gillnet {
    fn default() -> Self {
        Self::new()
    }
}

impl GearType for Gillnet {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        let values = Values::new(&self.descriptor.attributes, attributes);
        let (net, endline) = (Net::read(&values)?, Endline::read(&values)?);
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
    /// Puts the string on the seabed; answers its anchors, near and far.
    fn lay(&self, into: &mut Lay, site: &Site) -> Result<[Foot; 2], HookError> {
        let bed_m = -depth_of(site)?;
        if self.height_m > -0.9 * bed_m {
            let message = format!(
                "attribute `net_height`: {} m in water of {} m; it must stay below the surface",
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
            _ => Err(HookError::new("attribute `panels`: a string has one panel at least")),
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

fn descriptor() -> Descriptor {
    let mut attributes = Net::attributes();
    attributes.push(Attribute::count(
        "endlines",
        [0, 2],
        2,
        "Number of endlines: none, one at the near end, or one at each end.",
    ));
    attributes.extend(Endline::attributes("polyball-a1"));
    Descriptor {
        id: "org.endline.gear.gillnet".into(),
        version: env!("CARGO_PKG_VERSION").into(),
        name: "Gillnet string".into(),
        help: "Panels of netting between a headline with floats and a leadline, anchored at both \
         ends, with endlines."
            .into(),
        attributes,
        state_len: 0,
        acts: Vec::new(),
    }
}
