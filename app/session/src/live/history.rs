//! What is kept of the whale over time, for plots: depth, speed, wraps and force on each part.

use endline_sdk::BodyPart;
use endline_sim::ContactPoint;

use crate::run::Run;

const PARTS: usize = BodyPart::ALL.len();

/// A value kept over time; its index is where it stands in a sample of [`LiveView::history`](super::LiveView::history).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Depth of the whale's middle [m].
    Depth,
    /// Its speed through the water [m/s].
    Speed,
    /// Wraps on a part [turns].
    Wraps(BodyPart),
    /// Greatest sum of normal forces on a part since the sample before [N].
    Force(BodyPart),
}

impl Channel {
    /// Where it stands in a sample.
    #[must_use]
    pub fn index(self) -> usize {
        match self {
            Self::Depth => 0,
            Self::Speed => 1,
            Self::Wraps(part) => 2 + part as usize,
            Self::Force(part) => 2 + PARTS + part as usize,
        }
    }
}

/// Greatest force on each part since the last sample.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    peak_n: [f64; PARTS],
}

impl Watch {
    /// Takes in the contacts of a step.
    pub(super) fn fold(&mut self, contacts: &[ContactPoint]) {
        let mut now_n = [0.0; PARTS];
        for contact in contacts {
            now_n[contact.region.part() as usize] += contact.normal_force_n.max(0.0);
        }
        self.peak_n.iter_mut().zip(now_n).for_each(|(peak, now)| *peak = peak.max(now));
    }

    /// The sample of a run's moment; forces begin anew. Empty where there is no whale.
    pub(super) fn sample(&mut self, run: &Run) -> Vec<f64> {
        let peak_n = std::mem::take(&mut self.peak_n);
        let Some((whale, summary)) = run.state().whale.as_ref().zip(run.summary().whale) else {
            return Vec::new();
        };
        let mut sample = vec![-whale.position.z, whale.speed_m_s];
        sample.extend(summary.regions.iter().map(|region| region.wraps));
        sample.extend(peak_n);
        sample
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_channel_has_a_place_of_its_own() {
        let parts = || BodyPart::ALL.into_iter();
        let all = [Channel::Depth, Channel::Speed]
            .into_iter()
            .chain(parts().map(Channel::Wraps))
            .chain(parts().map(Channel::Force));
        let places: Vec<usize> = all.map(Channel::index).collect();
        assert_eq!(places, (0..2 + 2 * PARTS).collect::<Vec<_>>());
    }
}
