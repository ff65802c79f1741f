//! Loads during a haul: the greatest tension of every part, by stage and in all, samples along the endline, and the probability of parting.
//!
//! A piece of rope or a link holds `S Z`, with `S` the mean it delivers where it is loaded (wear, a knot or splice in the
//! segment at it, and weak places) and `Z` normal with mean 1 and the coefficient of variation `c` of its item. With `u = max T/S`
//! over its segments and the haul, it parts with the probability `Φ((u - 1)/c)`. Pieces vary independently, so that one or more part with `1 - Π (1 - pᵢ)`.
//! `T` is one record of one sea: the probability is that over pieces of rope, not over seas.

use endline_sdk::LineEnd;
use endline_sim::haul::{Haul, HaulEvent, LIFTED_M};
use endline_sim::model::{BodyRole, JointKind, Line, Link};
use endline_sim::parting::link_segment;
use statrs::distribution::{ContinuousCDF, Normal};

use super::Made;

/// Time between samples along the endline [s].
const SAMPLE_S: f64 = 1.0;

/// A piece of rope or a link, and the greatest share used of its delivered strength.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// Its id.
    pub id: String,
    /// Segments of it.
    segments: Vec<usize>,
    /// Mean strength of each of them [N].
    holds_n: Vec<f64>,
    /// Coefficient of variation.
    pub variation: f64,
}

/// Greatest load of a part over a time.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Most {
    /// Share used of the mean strength that the place delivers.
    pub used: f64,
    /// Tension there [N].
    pub tension_n: f64,
    /// Mean delivered there [N].
    pub holds_n: f64,
    /// Segment of the gear.
    pub segment: usize,
    /// When [s].
    pub time_s: f64,
    /// Rope hauled then [m].
    pub hauled_m: f64,
}

/// Greatest loads over a time.
#[derive(Clone, Debug, Default)]
pub(super) struct Greatest {
    /// Pull at the hauler [N].
    pub load_n: f64,
    /// When [s].
    pub time_s: f64,
    /// Rope hauled then [m].
    pub hauled_m: f64,
    /// Angle of the line from the vertical at most [rad].
    pub lead_rad: f64,
    /// Bodies that hang, at most.
    pub hanging: usize,
    /// Of each part.
    pub parts: Vec<Most>,
}

/// A stage: up to where something leaves the seabed or comes aboard.
#[derive(Clone, Debug)]
pub(super) struct StageLoads {
    /// The event that ended it.
    pub until: String,
    /// When [s].
    pub time_s: f64,
    /// Rope hauled then [m].
    pub hauled_m: f64,
    /// Greatest loads in it.
    pub greatest: Greatest,
}

/// Tensions along the endline at a time.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    /// [s]
    pub time_s: f64,
    /// [m]
    pub hauled_m: f64,
    /// Pull at the hauler [N].
    pub load_n: f64,
    /// Angle of the line at the block from the vertical [rad].
    pub lead_rad: f64,
    /// Tension of each segment of the endline from the buoy; `None` where it is aboard [N].
    pub tension_n: Vec<Option<f64>>,
}

/// Loads of a haul.
pub(super) struct Loads {
    /// Pieces and links that are loaded.
    pub parts: Vec<Part>,
    /// Segments of the endline from the buoy, with the distance of their middle [m].
    pub along: Vec<(usize, f64)>,
    /// Stages that ended.
    pub stages: Vec<StageLoads>,
    /// Over the haul.
    pub greatest: Greatest,
    /// Samples.
    pub samples: Vec<Sample>,
    /// Work of the hauler [J].
    pub work_j: f64,
    /// Traps aboard.
    pub aboard: usize,
    /// Whether no trap and no anchor is left.
    is_empty: bool,
    stage: Greatest,
    tension_n: Vec<f64>,
}

impl Loads {
    /// No loads yet, for gear hauled from a line's end.
    pub fn new(made: &Made, from: (usize, usize, LineEnd)) -> Self {
        let parts = parts(made, from);
        let greatest =
            Greatest { parts: vec![Most::default(); parts.len()], ..Greatest::default() };
        Self {
            along: along(made, from),
            stages: Vec::new(),
            stage: greatest.clone(),
            greatest,
            samples: Vec::new(),
            work_j: 0.0,
            aboard: 0,
            is_empty: false,
            tension_n: vec![0.0; made.model.segment_count],
            parts,
        }
    }

    /// Takes in a step.
    pub fn record(&mut self, haul: &Haul, made: &Made) {
        self.tension_n.fill(0.0);
        haul.tensions().for_each(|(segment, tension)| self.tension_n[segment] = tension);
        let is_gear = |body: usize| made.model.spec.bodies[body].role != BodyRole::Buoy;
        let hangs = |(body, risen_m): &(usize, f64)| *risen_m > LIFTED_M && is_gear(*body);
        let hanging = haul.risen().filter(hangs).count();
        self.is_empty = !haul.risen().any(|(body, _)| is_gear(body));
        for greatest in [&mut self.greatest, &mut self.stage] {
            greatest.update(haul, hanging, &self.parts, &self.tension_n);
        }
        self.work_j += haul.last_step().work_j;
        self.sample(haul);
        let event = haul.last_step().events.clone();
        event.into_iter().for_each(|event| self.record_event(event, haul, made));
    }

    /// Whether as many traps are aboard as asked, or all traps and anchors.
    pub fn is_done(&self, aboard: Option<usize>) -> bool {
        self.is_empty || aboard.is_some_and(|wanted| self.aboard >= wanted)
    }

    /// Ends the last stage.
    pub fn finish(&mut self, haul: &Haul, made: &Made) {
        for event in haul.last_step().events.clone() {
            if matches!(event, HaulEvent::Aboard(_)) && haul.model().spec.lines.is_empty() {
                self.record_event(event, haul, made);
            }
        }
        if self.stage.load_n > 0.0 {
            self.end_stage("the end".to_owned(), haul);
        }
    }

    fn record_event(&mut self, event: HaulEvent, haul: &Haul, made: &Made) {
        let body = |body: usize| &made.model.spec.bodies[body];
        match event {
            HaulEvent::OffSeabed(index) if self.stages.is_empty() => {
                self.end_stage(format!("{} off the seabed", body(index).id), haul);
            }
            HaulEvent::Aboard(index) => {
                self.aboard += usize::from(body(index).role == BodyRole::Trap);
                self.end_stage(format!("{} aboard", body(index).id), haul);
            }
            HaulEvent::OffSeabed(_) | HaulEvent::Line(_) => {}
        }
    }

    fn end_stage(&mut self, until: String, haul: &Haul) {
        let fresh =
            Greatest { parts: vec![Most::default(); self.parts.len()], ..Greatest::default() };
        let greatest = std::mem::replace(&mut self.stage, fresh);
        let (time_s, hauled_m) = (haul.state().time_s, haul.hauled_m());
        self.stages.push(StageLoads { until, time_s, hauled_m, greatest });
    }

    fn sample(&mut self, haul: &Haul) {
        let time_s = haul.state().time_s;
        if self.samples.last().is_some_and(|last| time_s < last.time_s + SAMPLE_S - 1e-9) {
            return;
        }
        let mut is_out = vec![false; self.tension_n.len()];
        haul.tensions().for_each(|(segment, _)| is_out[segment] = true);
        let at = |(segment, _): &(usize, f64)| is_out[*segment].then_some(self.tension_n[*segment]);
        let tension_n = self.along.iter().map(at).collect();
        let (hauled_m, load_n, lead_rad) =
            (haul.hauled_m(), haul.last_step().load_n, haul.last_step().lead_rad);
        self.samples.push(Sample { time_s, hauled_m, load_n, lead_rad, tension_n });
    }
}

impl Greatest {
    fn update(&mut self, haul: &Haul, hanging: usize, parts: &[Part], tension_n: &[f64]) {
        let (time_s, hauled_m, felt) = (haul.state().time_s, haul.hauled_m(), haul.last_step());
        if felt.load_n > self.load_n {
            (self.load_n, self.time_s, self.hauled_m) = (felt.load_n, time_s, hauled_m);
        }
        self.lead_rad = self.lead_rad.max(felt.lead_rad);
        self.hanging = self.hanging.max(hanging);
        for (part, most) in parts.iter().zip(&mut self.parts) {
            for (segment, holds_n) in part.segments.iter().zip(&part.holds_n) {
                let used = tension_n[*segment] / holds_n;
                if used > most.used {
                    let tension_n = tension_n[*segment];
                    *most = Most {
                        used,
                        tension_n,
                        holds_n: *holds_n,
                        segment: *segment,
                        time_s,
                        hauled_m,
                    };
                }
            }
        }
    }

    /// The part with the greatest share of its delivered strength.
    pub fn nearest(&self) -> Option<(usize, &Most)> {
        let taut = self.parts.iter().enumerate().filter(|(_, most)| most.used > 0.0);
        taut.max_by(|one, other| one.1.used.total_cmp(&other.1.used))
    }

    /// Probability that any part parts.
    pub fn parts(&self, parts: &[Part]) -> f64 {
        probability_of_any(
            self.parts.iter().zip(parts).map(|(most, part)| probability(most.used, part.variation)),
        )
    }
}

/// Pieces and links of the gear; the link at the buoy hangs above the block.
fn parts(made: &Made, from: (usize, usize, LineEnd)) -> Vec<Part> {
    let model = &made.model;
    let variation = |id: &str| {
        made.budget(id)
            .and_then(|budget| budget.variation.as_ref())
            .map_or(0.0, |figure| figure.value)
    };
    let lengths_m: Vec<f64> =
        model.spec.lines.iter().flat_map(|line| &line.segments_m).copied().collect();
    let of_line = |(index, line): (usize, &Line)| Part {
        id: line.id.clone(),
        segments: model.line_segments[index].clone().collect(),
        holds_n: model.weakest(index, &lengths_m).map(|weakest| weakest.strength_n).collect(),
        variation: variation(&line.id),
    };
    let lines = model.spec.lines.iter().enumerate().map(of_line);
    let is_below = |link: &&Link| (link.line, link.end) != (from.1, from.2);
    let links = model.spec.links.iter().filter(is_below).map(|link| Part {
        id: link.id.clone(),
        segments: vec![link_segment(model, link)],
        holds_n: vec![link.rating_n],
        variation: variation(&link.id),
    });
    lines.chain(links).collect()
}

/// Segments of the endline from the buoy down to a body or a branch, with the distance of their middle [m].
fn along(made: &Made, (_, mut line, mut at): (usize, usize, LineEnd)) -> Vec<(usize, f64)> {
    let (model, mut along, mut from_buoy_m) = (&made.model, Vec::new(), 0.0);
    loop {
        let of = &model.spec.lines[line];
        let mut segments: Vec<usize> = model.line_segments[line].clone().collect();
        if at == LineEnd::B {
            segments.reverse();
        }
        for segment in segments {
            let length_m = of.segments_m[segment - model.line_segments[line].start];
            along.push((segment, from_buoy_m + 0.5 * length_m));
            from_buoy_m += length_m;
        }
        let far = if at == LineEnd::A { of.to } else { of.from };
        let meets = model.spec.lines.iter().enumerate();
        let next: Vec<(usize, LineEnd)> = meets
            .filter(|(index, other)| *index != line && [other.from, other.to].contains(&far))
            .map(|(index, other)| (index, if other.from == far { LineEnd::A } else { LineEnd::B }))
            .collect();
        match (&model.spec.joints[far].kind, next.as_slice()) {
            (JointKind::Free, [only]) if along.len() < model.segment_count => (line, at) = *only,
            _ => return along,
        }
    }
}

/// Probability that a part parts under a load that is this share of its mean strength, by the strength's coefficient of variation.
pub fn probability(used: f64, variation: f64) -> f64 {
    match Normal::new(1.0, variation) {
        Ok(law) if variation > 0.0 => law.cdf(used),
        _ => f64::from(u8::from(used >= 1.0)),
    }
}

/// Probability that at least one of parts parts.
pub fn probability_of_any(probabilities: impl IntoIterator<Item = f64>) -> f64 {
    // 1 - Π(1 - p), which keeps small ones: ln(1 - p) summed.
    -probabilities.into_iter().map(|p| (-p).ln_1p()).sum::<f64>().exp_m1()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_at_its_mean_parts_in_one_haul_of_two_and_at_two_deviations_below_in_one_of_44() {
        assert!((probability(1.0, 0.12) - 0.5).abs() < 1e-12);
        assert!((probability(0.76, 0.12) - 0.022_750).abs() < 1e-6);
        assert!((probability(0.99, 0.0), probability(1.0, 0.0)) == (0.0, 1.0));
    }

    #[test]
    fn any_of_several_is_one_less_none_and_keeps_what_is_small() {
        assert!((probability_of_any([0.1, 0.2, 0.3]) - (1.0 - 0.9 * 0.8 * 0.7)).abs() < 1e-12);
        assert!((probability_of_any([1e-18, 2e-18]) / 3e-18 - 1.0).abs() < 1e-9);
        assert!((probability_of_any([0.2, 1.0]) - 1.0).abs() < 1e-12);
    }
}
