//! Stages of a study that adapts (`[adapt]`): which encounters are drawn from which fitted proposals.
//!
//! The encounters before the first number of `after` are stage 0, drawn from the priors and the proposals of the file. The proposals of
//! a further stage are fitted to the first four fifths of the encounters before it, as far as these ended in the event, with any option
//! (`encounters/fitted.rs`). The numbers are part of the study's hash and the fit depends on rows alone, so that any number of
//! machines draws the same encounters, and an interrupted study continues. A stage begins once the blocks of these four fifths are
//! stored; the last fifth is run meanwhile, because a single encounter can take a hundred times as long as most.

use std::sync::Arc;

use endline_gear::{Adapt, Study, StudyEvent};

use crate::encounters::Encounter;
use crate::encounters::fitted::{Fitted, Held};
use crate::error::Error;
use crate::table::Table;
use crate::task::lock;

use super::folder::Folder;
use super::prepared::PreparedStudy;
use super::runs::Runs;
use super::stats::{EventIndicators, Route};

/// The stage of an encounter.
pub(super) fn stage_of(study: &Study, index: u32) -> usize {
    let after = study.adapt.iter().flat_map(|adapt| &adapt.after);
    after.filter(|after| u64::from(index) >= **after).count()
}

/// Number of encounters to which the proposals of a stage are fitted, by the number of encounters before the stage: four fifths, rounded
/// up.
pub(super) fn fitted_to(before: u32) -> u32 {
    before - before / 5
}

/// Number of encounters to which the proposals of a stage are fitted; 0 for the first.
fn fitted_before(study: &Study, stage: usize) -> u32 {
    let after = study.adapt.as_ref().and_then(|adapt| adapt.after.get(stage.checked_sub(1)?));
    after.map_or(0, |after| fitted_to(u32::try_from(*after).unwrap_or(u32::MAX)))
}

/// The encounters that may be run: those before the first stage whose proposals cannot be fitted because a block is not stored.
pub(super) fn open_until(study: &Study, is_stored: impl Fn(u32) -> bool) -> u32 {
    let Some(Adapt { after, .. }) = &study.adapt else { return u32::MAX };
    let mut ends = after.iter().map(|after| u32::try_from(*after).unwrap_or(u32::MAX));
    ends.find(|end| !(0..fitted_to(*end)).all(&is_stored)).unwrap_or(u32::MAX)
}

impl PreparedStudy {
    /// Encounter `index` of the study, from the results in a folder on which its stage depends.
    /// Errors: blocks of earlier stages that are missing or damaged.
    pub fn encounter(&self, folder: &Folder, index: u32) -> Result<Encounter, Error> {
        let stage = stage_of(&self.study, index);
        while lock(&self.fitted).len() < stage {
            self.fit_next(folder, index)?;
        }
        Ok(match stage.checked_sub(1) {
            None => Encounter::of(&self.study, index),
            Some(place) => {
                let fitted = Arc::clone(&lock(&self.fitted)[place]);
                Encounter::with(&self.study, index, &fitted)
            }
        })
    }

    /// Encounter `index` of the first stage, which needs no results.
    /// Errors: an encounter of a later stage.
    pub fn first_stage(&self, index: u32) -> Result<Encounter, Error> {
        if stage_of(&self.study, index) > 0 {
            return Err(Error::Message(format!(
                "{}: encounter {index} is drawn from proposals fitted to earlier encounters; name the folder of their results with --out",
                self.study.place.source.path
            )));
        }
        Ok(Encounter::of(&self.study, index))
    }

    /// Fits the proposals of the next stage, unless another thread does.
    fn fit_next(&self, folder: &Folder, index: u32) -> Result<(), Error> {
        let known = lock(&self.fitted).clone();
        let own = fitted_before(&self.study, known.len() + 1);
        let mut table = Table::default();
        for block in 0..folder.blocks_of(own) {
            if !folder.is_stored(block) {
                let message = format!(
                    "encounter {index} is drawn from proposals fitted to encounters 0 to {}, and encounter {block} has not been run; run the study first",
                    own - 1
                );
                return Err(Error::at(&folder.path, message));
            }
            folder.append(block, &mut table)?;
        }
        let runs = Runs::read(table).map_err(|wrong| Error::at(&folder.path, wrong.to_string()))?;
        let held = self.held(&runs, own, &known);
        let mut fitted = lock(&self.fitted);
        if fitted.len() == known.len() {
            fitted.push(Arc::new(Fitted::to(&self.study, &held)));
        }
        Ok(())
    }

    /// The encounters before `count` that ended in the event with an option, the baseline first, with their routes there.
    fn held(&self, runs: &Runs, count: u32, fitted: &[Arc<Fitted>]) -> Vec<Held> {
        let event =
            self.study.adapt.as_ref().map_or(StudyEvent::Entangled, |adapt| adapt.event.clone());
        let first = std::iter::once(self.baseline);
        let order = first.chain((0..self.options.len()).filter(|option| *option != self.baseline));
        let by_option: Vec<(EventIndicators, Vec<Option<Route>>)> = order
            .map(|option| {
                let id = &self.options[option].id;
                let indicators = EventIndicators::of(runs, id, &event);
                (indicators, runs.by_encounter(id, |run| Some(Route::of(run))))
            })
            .collect();
        let route = |index: u32| {
            by_option.iter().find_map(|(indicators, routes)| {
                let place = index as usize;
                let occurred = (*indicators.0.get(place)?)?.occurred;
                if occurred { *routes.get(place)? } else { None }
            })
        };
        let none = Arc::new(Fitted::default());
        let held = |index: u32| {
            let route = route(index)?;
            let stage = stage_of(&self.study, index);
            let of_stage = stage.checked_sub(1).map_or(&none, |place| &fitted[place]);
            let Encounter { drawn, weight, .. } = Encounter::with(&self.study, index, of_stage);
            Some(Held { drawn, weight, route: route as usize })
        };
        (0..count).filter_map(held).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use crate::campaign::control::Control;
    use crate::campaign::pool::Shard;
    use crate::study::tests::Place;
    use crate::study::{batch, merge};
    use crate::table::{Cell, Row};

    use super::*;

    /// The small study with a second stage from encounter 20 on.
    fn place(name: &str) -> Place {
        let place = Place::new(name);
        let text = fs::read_to_string(place.study()).unwrap();
        let adapts = "[adapt]\nafter = [20]\nevent = \"entangled\"\n\n[encounter.";
        fs::write(place.study(), text.replace("[encounter.", adapts)).unwrap();
        place
    }

    /// Rows of an encounter, in which a whale is held if the drag area drawn is great.
    fn rows(opened: &PreparedStudy, index: u32) -> Vec<Row> {
        let encounter = Encounter::of(&opened.study, index);
        let area_m2 = encounter.drawn.iter().find_map(|drawn| drawn.number).unwrap();
        let mut rows = opened.rows(encounter, &|| true).unwrap();
        for (name, cell) in rows.iter_mut().flatten() {
            if name == "outcome" {
                *cell = Cell::Text(if area_m2 > 0.26 { "entangled" } else { "shed" }.into());
            }
        }
        rows
    }

    #[test]
    fn a_stage_is_drawn_from_what_earlier_stages_held_and_from_nothing_else() {
        let place = place("adapt");
        let opened = place.open();
        let folder = Folder::open(&place.0.join("results"), &opened).unwrap();
        for block in 0..15 {
            folder.write(block, rows(&opened, block)).unwrap();
        }
        let open = |folder: &Folder| open_until(&opened.study, |encounter| folder.has(encounter));
        assert_eq!(open(&folder), 20);
        let missing = opened.encounter(&folder, 20).unwrap_err().to_string();
        assert!(missing.contains("encounter 15 has not been run"), "{missing}");
        assert!(opened.encounter(&folder, 19).is_ok(), "the first stage needs no results");
        folder.write(15, rows(&opened, 15)).unwrap();
        assert_eq!(open(&folder), u32::MAX, "the last fifth is not needed");
        let drawn = |opened: &PreparedStudy| -> Vec<Encounter> {
            (20..200).map(|index| opened.encounter(&folder, index).unwrap()).collect()
        };
        let own = drawn(&opened);
        assert_eq!(own, drawn(&place.open()), "another process draws the same");
        let great = |encounter: &&Encounter| encounter.number("body.0.drag_area").unwrap() > 0.26;
        let often = own.iter().filter(great).count() as f64 / own.len() as f64;
        assert!(often > 0.35, "{often}: a fifth under the prior");
        assert!(own.iter().all(|one| one.weight > 0.0 && one.weight <= 1.0 / 0.15 + 1e-9));
        let alone = opened.first_stage(20).unwrap_err().to_string();
        assert!(alone.contains("--out"), "{alone}");
    }

    #[test]
    fn threads_and_interruptions_change_no_byte_and_shards_are_refused() {
        let place = place("adapt-threads");
        let opened = place.open();
        let tables = [(1, "one"), (3, "three")].map(|(threads, name)| {
            let folder = Folder::open(&place.0.join(name), &opened).unwrap();
            // An interruption within the first stage.
            let first = folder.first(7);
            batch::run(&opened, &first, Shard::WHOLE, threads, &Control::default()).unwrap();
            batch::run(&opened, &folder, Shard::WHOLE, threads, &Control::default()).unwrap();
            merge::merge(&opened, &folder).unwrap().table().csv()
        });
        assert_eq!(tables[0], tables[1]);
        let folder = Folder::open(&place.0.join("shard"), &opened).unwrap();
        let shard = Shard { part: 0, of: 2 };
        let refused = batch::run(&opened, &folder, shard, 1, &Control::default()).unwrap_err();
        assert!(refused.to_string().contains("cannot be divided into shards"), "{refused}");
    }
}
