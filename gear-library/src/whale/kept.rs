//! A cache of skins and of their volumes, by form.
//!
//! To displace a given mass, a skin is built five times with different widths. Options of a study,
//! scenarios of a check and files of a library ask for the same few whales again and again. Skin and
//! volume are functions of the form alone, so a cached result is equal to a fresh one, bit for bit.
//! Where the cache is full, the oldest entry goes.

use std::sync::{Arc, Mutex, PoisonError};

use endline_sim::whale::{Measures, Skin};

use super::build_skin;
use super::form::WhaleForm;

/// Skins kept: enough for every whale that some ten threads are at work on, about a megabyte each.
const SKINS: usize = 16;
/// Volumes kept: each whale's fit to its mass takes five, and as many again where its condition is not middling.
const VOLUMES: usize = 256;

static SKIN_OF: Kept<Arc<Skin>> = Kept::new();
static VOLUME_OF: Kept<f64> = Kept::new();

/// The skin of a form, as [`build_skin`] grows it.
#[must_use]
pub fn skin_of(form: &WhaleForm) -> Arc<Skin> {
    SKIN_OF.of(form, SKINS, || Arc::new(build_skin(form)))
}

/// Volume that a form's closed skin holds [m³].
#[must_use]
pub fn volume_of(form: &WhaleForm) -> f64 {
    VOLUME_OF.of(form, VOLUMES, || Measures::of(&build_skin(form), 1.0).volume_m3)
}

/// What was worked out of forms, the latest last.
struct Kept<T>(Mutex<Vec<(WhaleForm, T)>>);

impl<T: Clone> Kept<T> {
    const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    /// What there is of a form, or worked out, while others go on.
    fn of(&self, form: &WhaleForm, most: usize, work_out: impl FnOnce() -> T) -> T {
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, kept)) = lock().iter().find(|(known, _)| known == form) {
            return kept.clone();
        }
        let fresh = work_out();
        let mut kept = lock();
        if kept.len() >= most {
            kept.remove(0);
        }
        kept.push((form.clone(), fresh.clone()));
        fresh
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// More forms than there is room for, the first asked for again at the end: as grown anew each time.
    #[test]
    fn what_is_kept_is_what_would_be_grown() {
        let whale = WhaleForm::right_whale(12.0);
        let wide = |n: usize| WhaleForm { breadth_scale: 1.0 + 0.01 * n as f64, ..whale.clone() };
        for n in (0..SKINS + 2).chain([0, SKINS + 1]) {
            let (kept, grown) = (skin_of(&wide(n)), build_skin(&wide(n)));
            assert!(*kept == grown, "form {n}");
            assert_eq!(
                volume_of(&wide(n)).to_bits(),
                Measures::of(&grown, 1.0).volume_m3.to_bits()
            );
        }
        assert!(Arc::ptr_eq(&skin_of(&wide(0)), &skin_of(&wide(0))));
    }
}
