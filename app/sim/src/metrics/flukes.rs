//! Fluke beat: frequency, excursion and Strouhal number.
//!
//! `St = f A / U`, with `f` the frequency of the beats [Hz], `A` the mean excursion of the fluke tips from top to bottom [m]
//! and `U` the mean speed through the water [m/s].
//!
//! The height is the mean of the two fluke tips on the skin, in the whale's frame; a beat is from one top to the next. A
//! reversal counts after the tips have returned by [`TURN_SHARE`] of the body length, which excludes small oscillations. Glides
//! before the first top and after the last are not part of the means.
//!
//! Reference: Taylor, Nudds and Thomas 2003, Nature 425, 707-711 (swimmers have 0.2 to 0.4).

use std::sync::Arc;

use glam::{DAffine3, DQuat, DVec3};

use super::summary::BeatSummary;
use crate::state::WhaleState;
use crate::whale::{Skin, pose, skin_vertex};

/// Return of the tips after which a reversal counts, as a share of body length; estimate.
pub const TURN_SHARE: f64 = 0.02;

/// Meter of the fluke beat.
#[derive(Clone, Debug)]
pub(super) struct FlukeMeter {
    skin: Arc<Skin>,
    /// Vertices of the fluke tips, left and right; `None` for a skin without flukes.
    tips: Option<[usize; 2]>,
    /// Return after which a reversal counts [m].
    turn_m: f64,
    bones: Vec<DAffine3>,
    /// Whether the tips move up.
    rising: bool,
    /// Extremum of the current movement: height [m], time [s], distance swum [m].
    farthest: Option<[f64; 3]>,
    /// Distance swum through the water [m].
    swum_m: f64,
    /// First top: time [s] and distance swum [m].
    first: Option<[f64; 2]>,
    /// Last top: time [s] and distance swum [m].
    last: [f64; 2],
    /// Height of the last top and bottom [m].
    ends: [f64; 2],
    beats: u32,
    /// Sum of the excursions of all beats [m].
    ways_m: f64,
}

impl FlukeMeter {
    pub(super) fn new(skin: &Arc<Skin>, length_m: f64) -> Self {
        Self {
            tips: tips(skin),
            skin: Arc::clone(skin),
            turn_m: TURN_SHARE * length_m,
            bones: Vec::with_capacity(skin.bones.len()),
            rising: true,
            farthest: None,
            swum_m: 0.0,
            first: None,
            last: [0.0; 2],
            ends: [0.0; 2],
            beats: 0,
            ways_m: 0.0,
        }
    }

    pub(super) fn fold(&mut self, whale: &WhaleState, time_s: f64, dt_s: f64) {
        self.swum_m += whale.speed_m_s * dt_s;
        let Some(tips) = self.tips else { return };
        pose(&self.skin, DVec3::ZERO, DQuat::IDENTITY, &whale.posture, &mut self.bones);
        let height_m =
            0.5 * tips.map(|tip| skin_vertex(&self.skin, &self.bones, tip).z).iter().sum::<f64>();
        self.follow([height_m, time_s, self.swum_m]);
    }

    /// Adds a height of the tips [m] with its time [s] and the distance swum [m].
    fn follow(&mut self, now: [f64; 3]) {
        let farthest = self.farthest.get_or_insert(now);
        let up = if self.rising { 1.0 } else { -1.0 };
        if up * (now[0] - farthest[0]) >= 0.0 {
            *farthest = now;
        } else if up * (farthest[0] - now[0]) > self.turn_m {
            let turned = *farthest;
            self.farthest = Some(now);
            if self.rising {
                self.top(turned)
            } else {
                self.ends[1] = turned[0]
            }
            self.rising = !self.rising;
        }
    }

    /// Adds a top of the tips.
    fn top(&mut self, [height_m, time_s, swum_m]: [f64; 3]) {
        if self.first.is_none() {
            self.first = Some([time_s, swum_m]);
        } else {
            self.beats += 1;
            self.ways_m += 0.5 * (self.ends[0] + height_m) - self.ends[1];
        }
        self.ends[0] = height_m;
        self.last = [time_s, swum_m];
    }

    /// Mean beat so far; `None` before the first whole beat.
    pub(super) fn summary(&self) -> Option<BeatSummary> {
        let (from, beats) = (self.first.filter(|_| self.beats > 0)?, f64::from(self.beats));
        let time_s = self.last[0] - from[0];
        let (frequency_hz, excursion_m, speed_m_s) =
            (beats / time_s, self.ways_m / beats, (self.last[1] - from[1]) / time_s);
        let strouhal = (speed_m_s > 0.0).then(|| frequency_hz * excursion_m / speed_m_s);
        Some(BeatSummary { beats: self.beats, frequency_hz, excursion_m, speed_m_s, strouhal })
    }
}

/// Outermost vertices of the left and right fluke.
fn tips(skin: &Skin) -> Option<[usize; 2]> {
    let moved_by = |vertex: usize, name: &str| {
        let heaviest = skin.weights[vertex].iter().max_by(|a, b| a.1.total_cmp(&b.1));
        heaviest.is_some_and(|(bone, _)| skin.bones[usize::from(*bone)].name == name)
    };
    let tip = |name: &str| {
        let of_bone = (0..skin.vertices.len()).filter(|vertex| moved_by(*vertex, name));
        of_bone.max_by(|a, b| skin.vertices[*a].y.abs().total_cmp(&skin.vertices[*b].y.abs()))
    };
    Some([tip("left_fluke_tip")?, tip("right_fluke_tip")?])
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// A sine of known frequency and amplitude with a small oscillation, at a known speed.
    #[test]
    fn frequency_excursion_and_strouhal_number_of_a_sine_are_found() {
        let mut meter = FlukeMeter::new(&Arc::new(Skin::default()), 10.0);
        let (f, way, u, dt) = (0.13, 2.0, 1.2, 0.01);
        for step in 0..12_000 {
            let t = f64::from(step) * dt;
            let height = 0.5 * way * libm::sin(TAU * f * t) + 0.03 * libm::sin(TAU * 3.1 * t);
            meter.follow([height, t, u * t]);
        }
        let beat = meter.summary().unwrap();
        assert_eq!(beat.beats, 15, "tops at 0.25, 1.25 to 15.25 of 15.6 periods");
        assert!((beat.frequency_hz / f - 1.0).abs() < 0.01, "{}", beat.frequency_hz);
        assert!((way..way + 0.13).contains(&beat.excursion_m), "{}", beat.excursion_m);
        assert!((beat.speed_m_s - u).abs() < 1e-9);
        assert!((beat.strouhal.unwrap() - beat.frequency_hz * beat.excursion_m / u).abs() < 1e-12);
    }

    #[test]
    fn a_whale_that_does_not_beat_has_no_beat() {
        let mut meter = FlukeMeter::new(&Arc::new(Skin::default()), 10.0);
        (0..1000).for_each(|step| {
            meter.follow([0.05 * libm::sin(f64::from(step)), f64::from(step), f64::from(step)])
        });
        assert_eq!(meter.summary(), None);
    }
}
