//! Where the computing time of a step goes.
//!
//! The physics reads no clock of its own. Who calls it may lend one ([`Workspace::lend_clock`](crate::Workspace::lend_clock)), and no
//! number of a state depends on what that tells. It is read where a solver step goes from one part to the next, never for a segment.

/// Nanoseconds since a moment that stays the same [ns].
pub type Clock = fn() -> u64;

/// What the time of a step goes to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CostPart {
    /// Solving rope and bodies that touch nothing but water and seabed.
    FreeRope,
    /// Looking for skin, rope and bodies near rope, measuring distances and proving paths free.
    Detection,
    /// Solving rope that touches the whale, rope or bodies, with friction.
    Contact,
    /// The whale's motion and posture.
    Whale,
    /// Current and waves at every node and body.
    Water,
    /// What is measured after a step.
    Metrics,
    /// All else.
    #[default]
    Other,
}

impl CostPart {
    /// All of them, in the order in which they are told.
    pub const ALL: [Self; 7] = [
        Self::FreeRope,
        Self::Detection,
        Self::Contact,
        Self::Whale,
        Self::Water,
        Self::Metrics,
        Self::Other,
    ];
}

/// Computing time by what it went to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    spent_ns: [u64; CostPart::ALL.len()],
}

impl Cost {
    /// Adds time to a part [ns].
    pub fn add_ns(&mut self, part: CostPart, spent_ns: u64) {
        self.spent_ns[part as usize] += spent_ns;
    }

    /// Adds all that another tells.
    pub fn add(&mut self, other: &Self) {
        for (spent_ns, more_ns) in self.spent_ns.iter_mut().zip(other.spent_ns) {
            *spent_ns += more_ns;
        }
    }

    /// Time that went to a part [s].
    #[must_use]
    pub fn of_s(&self, part: CostPart) -> f64 {
        self.spent_ns[part as usize] as f64 / 1e9
    }

    /// Time of all parts [s].
    #[must_use]
    pub fn whole_s(&self) -> f64 {
        self.spent_ns.iter().sum::<u64>() as f64 / 1e9
    }
}

/// Takes the time from one part of a step to the next; without a clock it does nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct CostClock {
    pub clock: Option<Clock>,
    /// Of the last step.
    pub cost: Cost,
    /// The part that is being worked on.
    part: CostPart,
    /// When the clock was read last [ns]; `None` outside of a step.
    read_ns: Option<u64>,
}

impl CostClock {
    /// Begins a step.
    pub fn begin(&mut self) {
        (self.cost, self.part) = (Cost::default(), CostPart::Other);
        self.read_ns = self.clock.map(|clock| clock());
    }

    /// Goes on with another part; gives the one so far.
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

    /// A clock that goes on by one with each reading.
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
        assert_eq!(CostPart::ALL.map(nanoseconds), [0, 2, 1, 0, 1, 0, 1]);
        assert!((clock.cost.whole_s() - 5e-9).abs() < 1e-15);
        clock.enter(CostPart::Whale);
        assert!((clock.cost.whole_s() - 5e-9).abs() < 1e-15, "nothing is taken between steps");
    }

    #[test]
    fn parts_are_told_in_the_order_in_which_they_are_kept() {
        for (place, part) in CostPart::ALL.into_iter().enumerate() {
            assert_eq!(part as usize, place);
        }
    }
}
