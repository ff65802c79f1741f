//! The whale's acts: clips of the library, played over its motion.

use std::sync::Arc;

use endline_sdk::WhaleMotion;
use endline_sim::whale::acts::{Acting, Answer, Clip};

use crate::items::{ActItem, WhaleItem};
use crate::nearest::hint;
use crate::scenario::PlacedWhale;

use super::builder::Builder;

impl Builder<'_> {
    /// The motion with the acts that the scenario names, or all of the library's, and its answer to touch.
    pub fn with_acts(
        &mut self,
        motion: Arc<dyn WhaleMotion>,
        placed: &PlacedWhale,
        whale: &WhaleItem,
    ) -> Arc<dyn WhaleMotion> {
        let clips = self.clips(placed, whale);
        self.check_ids(motion.as_ref(), &clips, placed);
        let own = motion.descriptor().acts.len();
        let answer = placed.answer.as_ref().and_then(|answer| {
            let ids = || clips.iter().map(|clip| clip.id.as_str());
            let Some(at) = ids().position(|id| id == answer.act.value) else {
                let message =
                    format!("the whale has no act `{}` to answer a touch with", answer.act.value);
                self.problems.push(answer.act.place.error(message, hint(&answer.act.value, ids())));
                return None;
            };
            Some(Answer { act: own + at + 1, above_n: answer.above_n, again_s: answer.again_s })
        });
        if clips.is_empty() { motion } else { Arc::new(Acting::new(motion, clips, answer)) }
    }

    /// Clips of the acts the scenario names, or of all.
    fn clips(&mut self, placed: &PlacedWhale, whale: &WhaleItem) -> Vec<Clip> {
        let library = self.library;
        let Some(named) = &placed.acts else {
            self.used.extend(library.acts.iter().flat_map(ActItem::files).map(str::to_owned));
            return library.acts.iter().flat_map(|act| act.clips.iter().cloned()).collect();
        };
        let every =
            || library.acts.iter().flat_map(|act| act.clips.iter().map(move |clip| (act, clip)));
        let mut clips = Vec::new();
        for id in named {
            let Some((act, clip)) = every().find(|(_, clip)| clip.id == id.value) else {
                let known = every().map(|(_, clip)| clip.id.as_str());
                self.problems.push(
                    id.place
                        .error(format!("no act `{}` in acts/", id.value), hint(&id.value, known)),
                );
                continue;
            };
            self.used.extend(act.files().map(str::to_owned));
            self.check_joints(act, whale);
            clips.push(clip.clone());
        }
        clips
    }

    /// An act that a scenario names asks for no more than the whale's joints can do; others are held at the joints' ends.
    fn check_joints(&self, act: &ActItem, whale: &WhaleItem) {
        for (angle, figure) in &act.angles {
            let [least, most] = whale.joints.ranges.of(*angle);
            // A hair of room for a bend shared out between joints.
            if figure.value < least - 1e-9 || figure.value > most + 1e-9 {
                let [value, least, most] = [figure.value, least, most].map(f64::to_degrees);
                let message = format!(
                    "the act asks for {value:.1} deg of {angle:?}, the joint of `{}` turns {least:.1} to {most:.1} deg",
                    whale.entry.id
                );
                let help =
                    format!("keep to that range, or change [joints] in {}", whale.entry.path);
                self.problems.push(figure.place.error(message, help));
            }
        }
    }

    /// Every act has an id of its own, by which a pilot asks for it.
    fn check_ids(&self, motion: &dyn WhaleMotion, clips: &[Clip], placed: &PlacedWhale) {
        let own = motion.descriptor().acts.iter().map(|act| act.id.as_ref());
        let ids: Vec<&str> = own.chain(clips.iter().map(|clip| clip.id.as_str())).collect();
        for (index, id) in ids.iter().enumerate() {
            if ids[..index].contains(id) {
                let named = placed.acts.iter().flatten().rfind(|named| named.value == *id);
                let place = named.map_or(&placed.motion.place, |named| &named.place);
                let help = "name each act once in `acts`, and give files of acts/ ids that the motion's own acts do not have";
                self.problems.push(place.error(format!("two acts are called `{id}`"), help));
            }
        }
    }
}
