//! The keys of an act from its glTF animation.

use endline_sim::whale::acts::{After, Curve, Moves, Track};

use crate::confidence::Confidence;
use crate::fields::{Figure, Problems};
use crate::nearest::hint;
use crate::sources::Sources;
use crate::whale::WhaleForm;
use crate::whale::bones::Skeleton;
use crate::whale::gltf::{self, Animation};
use crate::whale::section::Sections;

use super::{ActAnimation, ActItem};

/// How far an act that repeats may end from where it begins [rad].
const CLOSED_RAD: f64 = 1e-3;
/// Length of the whale whose bones the animation turns [m]; angles are the same at every length.
const ANY_LENGTH_M: f64 = 13.7;

impl ActItem {
    /// Reads its animation, where it has one; false where that fails, with the problem reported.
    pub(crate) fn load_animation(&mut self, sources: &Sources, problems: &Problems) -> bool {
        let Some(asked) = self.animation.clone() else { return true };
        let (path, place) = (&asked.file.value, &asked.file.place);
        let Some(bytes) = sources.mesh(path) else {
            problems.push(place.error(
                format!("there is no file `{path}`"),
                hint(path, sources.meshes().map(|(path, _)| path)),
            ));
            return false;
        };
        let form = WhaleForm::right_whale(ANY_LENGTH_M);
        let bones = Skeleton::of(&form, &Sections::of(&form)).bones;
        match gltf::read_animation(
            bytes,
            asked.clip.as_ref().map(|clip| clip.value.as_str()),
            &bones,
        ) {
            Ok(animation) => self.take(&asked, &animation, problems),
            Err(fault) => {
                problems.push(place.error(format!("`{path}` {}", fault.message), fault.help));
                false
            }
        }
    }

    fn take(&mut self, asked: &ActAnimation, animation: &Animation, problems: &Problems) -> bool {
        let repeats = self.clips.iter().any(|clip| clip.after == After::Repeat);
        let open = |values: &[f64]| {
            values
                .first()
                .zip(values.last())
                .is_some_and(|(first, last)| (first - last).abs() > CLOSED_RAD)
        };
        if let Some((angle, _)) =
            animation.angles.iter().find(|(_, values)| repeats && open(values))
        {
            let message = format!(
                "`{}` ends elsewhere than it begins, in an act that repeats",
                angle.name().0
            );
            problems
                .push(asked.file.place.error(message, "give the last key the pose of the first"));
            return false;
        }
        let track = |(angle, values): &(_, Vec<f64>)| {
            let points: Vec<(f64, f64)> =
                animation.times_s.iter().copied().zip(values.iter().copied()).collect();
            Track { moves: Moves::Angle(*angle), curve: Curve::through(&points, repeats) }
        };
        for clip in &mut self.clips {
            clip.tracks = animation.angles.iter().map(track).collect();
            clip.length_s = animation.times_s.last().copied().unwrap_or(0.0);
        }
        let figure = |value: f64| Figure {
            value,
            text: format!("{:.1} deg", value.to_degrees()),
            source: asked.source.clone().unwrap_or_default(),
            confidence: asked.confidence.unwrap_or(Confidence::Estimate),
            place: asked.file.place.clone(),
        };
        let ends = |values: &[f64]| {
            [f64::min, f64::max].map(|pick| values.iter().copied().fold(values[0], pick))
        };
        self.angles = animation
            .angles
            .iter()
            .flat_map(|(angle, values)| ends(values).map(|value| (*angle, figure(value))))
            .collect();
        true
    }
}
