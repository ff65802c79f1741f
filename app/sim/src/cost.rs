//! Computing time of a step, by part.
//!
//! The physics reads no clock of its own. The caller may lend one ([`Workspace::lend_clock`](crate::Workspace::lend_clock));
//! the state does not depend on it. It is read where a solver step changes from one part to the next, never per segment.

use strum::VariantArray;

/// Returns the time since a fixed moment [ns].
pub type Clock = fn() -> u64;

/// Part of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, VariantArray)]
pub enum CostPart {
    /// Solution of rope and bodies without contact other than the seabed.
    FreeRope,
    /// Contact detection: broad phase, distances and tests of paths.
    Detection,
    /// Solution of rope in contact with the whale, rope or bodies, with friction.
    Contact,
    /// The whale's motion and posture.
    Whale,
    /// Current and waves at every node and body.
    Water,
    /// Metrics after a step.
    Metrics,
    /// Everything else.
    #[default]
    Other,
}

impl CostPart {
    /// All parts, in the order of reports.
    pub const ALL: &'static [Self] = Self::VARIANTS;
}

/// Computing time by part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    spent_ns: [u64; CostPart::ALL.len()],
}

impl Cost {
    /// Adds time to a part [ns].
    pub fn add_ns(&mut self, part: CostPart, spent_ns: u64) {
        self.spent_ns[part as usize] += spent_ns;
    }

    /// Adds the times of another cost.
    pub fn add(&mut self, other: &Self) {
        for (spent_ns, more_ns) in self.spent_ns.iter_mut().zip(other.spent_ns) {
            *spent_ns += more_ns;
        }
    }

    /// Time of a part [s].
    pub fn of_s(&self, part: CostPart) -> f64 {
        self.spent_ns[part as usize] as f64 / 1e9
    }

    /// Sum of all parts [s].
    pub fn whole_s(&self) -> f64 {
        self.spent_ns.iter().sum::<u64>() as f64 / 1e9
    }
}

/// Measures the time of each part of a step; without a clock it does nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct CostClock {
    pub clock: Option<Clock>,
    /// Of the last step.
    pub cost: Cost,
    /// Current part.
    part: CostPart,
    /// Last reading of the clock [ns]; `None` outside a step.
    read_ns: Option<u64>,
}

impl CostClock {
    /// Begins a step.
    pub fn begin(&mut self) {
        (self.cost, self.part) = (Cost::default(), CostPart::Other);
        self.read_ns = self.clock.map(|clock| clock());
    }

    /// Starts another part; returns the previous one.
    pub fn enter(&mut self, part: CostPart) -> CostPart {
        let before = std::mem::replace(&mut self.part, part);
        if before != part
            && let (Some(clock), Some(read_ns)) = (self.clock, self.read_ns)
        {
            let now_ns = clock();
            self.cost.add_ns(before, now_ns.saturating_sub(read_ns));
            self.read_ns = Some(now_ns);
        }
        before
    }

    /// Ends a step.
    pub fn end(&mut self) {
        if let (Some(clock), Some(read_ns)) = (self.clock, self.read_ns.take()) {
            self.cost.add_ns(self.part, clock().saturating_sub(read_ns));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicU64, Ordering};

    /// A clock that advances by 1 ns with each reading.
    fn ticks() -> u64 {
        static READ: AtomicU64 = AtomicU64::new(0);
        READ.fetch_add(1, Ordering::Relaxed)
    }

    #[test]
    fn parts_sum_to_the_time_from_begin_to_end() {
        let mut clock = CostClock { clock: Some(ticks), ..CostClock::default() };
        clock.begin();
        assert_eq!(clock.enter(CostPart::Detection), CostPart::Other);
        let outer = clock.enter(CostPart::Water);
        clock.enter(outer);
        clock.enter(CostPart::Detection); // the same part: the clock is not read
        clock.enter(CostPart::Contact);
        clock.end();
        let nanoseconds = |part| (clock.cost.of_s(part) * 1e9).round() as u64;
        let parts: Vec<u64> = CostPart::ALL.iter().copied().map(nanoseconds).collect();
        assert_eq!(parts, [0, 2, 1, 0, 1, 0, 1]);
        assert!((clock.cost.whole_s() - 5e-9).abs() < 1e-15);
        clock.enter(CostPart::Whale);
        assert!((clock.cost.whole_s() - 5e-9).abs() < 1e-15, "no time is added between steps");
    }

    #[test]
    fn parts_are_listed_in_the_order_of_their_numbers() {
        for (place, part) in CostPart::ALL.iter().copied().enumerate() {
            assert_eq!(part as usize, place);
        }
    }
}
