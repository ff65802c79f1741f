//! The way of a camera through a film: keys, each an eye at a time, and a smooth passage from one to the next.
//!
//! Between keys at times a and b the camera is that of the first moved towards that of the second by the share
//! s²(3 − 2s), with s = (t − a) / (b − a): it stands still at every key. Both eyes are placed anew at each moment, so
//! that an eye that goes with the whale does so on the way as well.

use super::camera::{Camera, View};

/// Keys nearer to one another than this are one [s].
const SAME_S: f64 = 0.02;

/// Eyes at times, in order.
#[derive(Clone, Debug)]
pub struct CameraPath<E> {
    keys: Vec<(f64, E)>,
}

impl<E> Default for CameraPath<E> {
    fn default() -> Self {
        Self { keys: Vec::new() }
    }
}

impl<E> CameraPath<E> {
    /// Sets the eye at a time [s]; one that is there already is replaced.
    pub fn set(&mut self, time_s: f64, eye: E) {
        self.keys.retain(|(at_s, _)| (at_s - time_s).abs() > SAME_S);
        let place = self.keys.partition_point(|(at_s, _)| *at_s < time_s);
        self.keys.insert(place, (time_s, eye));
    }

    /// Takes every key away.
    pub fn clear(&mut self) {
        self.keys.clear();
    }

    /// Times of the keys [s], in order.
    pub fn times(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        self.keys.iter().map(|(time_s, _)| *time_s)
    }

    /// The camera at a time [s], by what places an eye at that moment; `None` without keys.
    pub fn camera(&self, time_s: f64, place: impl Fn(&E) -> Camera) -> Option<Camera> {
        let next = self.keys.partition_point(|(at_s, _)| *at_s <= time_s);
        let before = next.checked_sub(1).and_then(|before| self.keys.get(before));
        Some(match (before, self.keys.get(next)) {
            (Some((from_s, from)), Some((to_s, to))) => {
                let share = (time_s - from_s) / (to_s - from_s);
                place(from).towards(&place(to), share * share * (3.0 - 2.0 * share))
            }
            (Some((_, eye)), None) | (None, Some((_, eye))) => place(eye),
            (None, None) => return None,
        })
    }
}

impl CameraPath<View> {
    /// Reads `side`, or keys with times in seconds, `side@0,whale@10`.
    ///
    /// # Errors
    /// A view that does not exist, or a time that is no number of seconds.
    pub fn read(text: &str) -> Result<Self, String> {
        let mut path = Self::default();
        for key in text.split(',').map(str::trim) {
            let (name, time) = key.split_once('@').unwrap_or((key, "0"));
            let view = View::named(name).ok_or_else(|| {
                format!("there is no view `{name}`; expected one of {}", View::names())
            })?;
            let time_s: Option<f64> = time.trim_end_matches('s').trim().parse().ok();
            let time_s = time_s.filter(|time_s| *time_s >= 0.0 && time_s.is_finite());
            path.set(
                time_s.ok_or_else(|| {
                    format!("`{key}` has no time: expected seconds after @, such as {name}@10")
                })?,
                view,
            );
        }
        Ok(path)
    }

    /// The view, where there is but one.
    #[must_use]
    pub fn single(&self) -> Option<View> {
        match self.keys.as_slice() {
            [(_, view)] => Some(*view),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn far(distance_m: f64) -> Camera {
        Camera { distance_m, ..Camera::default() }
    }

    #[test]
    fn the_camera_stands_at_its_keys_and_passes_smoothly_between_them() {
        let mut path = CameraPath::default();
        for (time_s, distance_m) in [(10.0, 40.0), (2.0, 10.0), (10.01, 90.0)] {
            path.set(time_s, distance_m);
        }
        assert_eq!(path.times().collect::<Vec<_>>(), [2.0, 10.01]);
        let at = |time_s: f64| path.camera(time_s, |eye| far(*eye)).unwrap().distance_m;
        for (time_s, there_m) in [(0.0, 10.0), (2.0, 10.0), (10.01, 90.0), (99.0, 90.0)] {
            assert!((at(time_s) - there_m).abs() < 1e-9, "{time_s}: {}", at(time_s));
        }
        // Half way, distances are the geometric mean: coming nearer looks even.
        assert!((at(6.005) - 30.0).abs() < 1e-9, "{}", at(6.005));
        let speed = |time_s: f64| (at(time_s + 1e-4) - at(time_s - 1e-4)) / 2e-4;
        assert!(speed(2.001).abs() < 0.01 && speed(6.0) > 5.0, "{} {}", speed(2.001), speed(6.0));
        assert!(CameraPath::<f64>::default().camera(1.0, |eye| far(*eye)).is_none());
    }

    #[test]
    fn views_with_times_are_read_and_bad_ones_say_what_is_wrong() {
        let path = CameraPath::read("side, whale@10 s,first-person@12.5").unwrap();
        assert_eq!(path.times().collect::<Vec<_>>(), [0.0, 10.0, 12.5]);
        assert_eq!(CameraPath::read("top").unwrap().single(), Some(View::Top));
        for (text, words) in [
            ("sid", "no view `sid`"),
            ("side@x", "seconds"),
            ("side@-1", "seconds"),
            ("", "no view"),
        ] {
            let error = CameraPath::read(text).unwrap_err();
            assert!(error.contains(words), "{text}: {error}");
        }
    }
}
