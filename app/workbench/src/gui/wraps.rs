//! Rope about the whale, wrap by wrap, at the moment shown.

use endline_sdk::BodyPart;
use endline_session::live::{Channel, LiveView};
use endline_sim::metrics::EventKind;

/// Fewer turns than this are rope that bends round a part, not a wrap to list [turns].
const LEAST: f64 = 0.25;

/// Rope about one part.
#[derive(Clone, Debug, PartialEq)]
pub struct Wrap {
    /// The part.
    pub part: BodyPart,
    /// How far it turns about the part [turns].
    pub turns: f64,
    /// Since when it has turned at least half round without a break [s].
    pub since_s: Option<f64>,
    /// Rope in contact [m].
    pub touching_m: f64,
    /// Lines that touch the part, by id, the longest contact first, with its length [m].
    pub lines: Vec<(String, f64)>,
}

/// Every wrap at the moment shown, most turns first.
#[must_use]
pub fn wraps(view: &LiveView) -> Vec<Wrap> {
    let all = BodyPart::ALL.into_iter().map(|part| Wrap {
        part,
        turns: turns(view, part),
        since_s: since_s(view, part),
        touching_m: 0.0,
        lines: Vec::new(),
    });
    let mut found: Vec<Wrap> = all.filter(|wrap| wrap.turns >= LEAST).collect();
    for wrap in &mut found {
        wrap.lines = lines(view, wrap.part);
        wrap.touching_m = wrap.lines.iter().map(|(_, length_m)| length_m).sum();
    }
    found.sort_by(|a, b| b.turns.total_cmp(&a.turns));
    found
}

/// Turns about a part at the moment shown: of the newest as measured, else of the sample before.
#[must_use]
pub fn turns(view: &LiveView, part: BodyPart) -> f64 {
    let now = || {
        let whale = view.summary.as_ref()?.whale.as_ref()?;
        Some(whale.regions.iter().find(|region| region.part == part)?.wraps)
    };
    let kept = || {
        let shown_s = view.frame.time_s + 1e-9;
        let samples = view.history.samples(Channel::Wraps(part).index());
        samples.take_while(|(time_s, _)| *time_s <= shown_s).last().map(|(_, turns)| turns)
    };
    let turns = if view.sought { kept() } else { now() };
    turns.unwrap_or(0.0)
}

/// When the turns about a part last came to a half, of events up to the moment shown.
fn since_s(view: &LiveView, part: BodyPart) -> Option<f64> {
    let mut since_s = None;
    for event in view
        .events
        .iter()
        .filter(|event| event.time_s <= view.frame.time_s && event.subject == part.name())
    {
        match event.kind {
            EventKind::Wrap => since_s = since_s.or(Some(event.time_s)),
            EventKind::WrapUndone if event.value <= 0.5 => since_s = None,
            _ => {}
        }
    }
    since_s
}

fn lines(view: &LiveView, part: BodyPart) -> Vec<(String, f64)> {
    let mut lengths_m = vec![0.0; view.model.spec.lines.len()];
    for contact in view
        .frame
        .contacts
        .iter()
        .filter(|contact| contact.region.part() == part && contact.normal_force_n > 0.0)
    {
        lengths_m[contact.line] += contact.length_m;
    }
    let touching =
        view.model.spec.lines.iter().zip(lengths_m).filter(|(_, length_m)| *length_m > 0.0);
    let mut lines: Vec<(String, f64)> =
        touching.map(|(line, length_m)| (line.id.clone(), length_m)).collect();
    lines.sort_by(|a, b| b.1.total_cmp(&a.1));
    lines
}
