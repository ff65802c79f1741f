//! The energy that friction takes from rope at one contact, and gives back to it.
//!
//! A law of friction stores energy in its bristles and gives back no more than it took, so from a contact's first touch on
//! `given <= taken`, with work `f . s` of the force on the rope over its slip, booked by sign. Beyond that stands
//! an allowance: where segments of rope change their length, a bristle is carried over to a longer or shorter piece, and what it stores
//! changes by as much, at most by 25 mm over 10 mm, the longest and the shortest piece near an edge. A law that drives the rope
//! passes the allowance within its first strokes.

/// Times what was taken that may be given back.
const MOST_RETURNED: f64 = 3.0;
/// What may be given back of nothing, for rounding [J].
const OF_NOTHING_J: f64 = 1e-3;

/// Energy taken from the rope and given to it since first touch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Account {
    pub taken_j: f64,
    pub given_j: f64,
}

impl Account {
    /// Books the work of a step; what is wrong where more has been given than can have been taken.
    pub fn book(&mut self, work_j: f64) -> Result<(), String> {
        if work_j <= 0.0 {
            self.taken_j -= work_j;
            return Ok(());
        }
        self.given_j += work_j;
        let Self { taken_j, given_j } = *self;
        if given_j <= MOST_RETURNED * taken_j + OF_NOTHING_J {
            return Ok(());
        }
        Err(format!(
            "its friction adds energy: at one contact it has given the rope {given_j:.3} J, of {taken_j:.3} J that it took"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_stored_may_come_back_and_no_more() {
        let mut account = Account::default();
        for work in [-2.0, 1.0, -0.5, 1.4] {
            account.book(work).unwrap();
        }
        assert_eq!(account, Account { taken_j: 2.5, given_j: 2.4 });
        let fault = account.book(6.0).unwrap_err();
        assert!(fault.contains("adds energy") && fault.contains("8.400 J, of 2.500 J"), "{fault}");
        assert!(Account::default().book(2e-3).is_err());
    }
}
