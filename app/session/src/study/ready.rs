//! The options of an encounter, each assembled when it is first asked for.

use std::cell::OnceCell;

use crate::source::Prepared;

use super::open::Opened;
use crate::encounters::Encounter;

/// An encounter and its options.
pub(super) struct Ready<'a> {
    pub(super) opened: &'a Opened,
    pub(super) encounter: Encounter,
    options: Vec<OnceCell<Result<Prepared, String>>>,
}

impl<'a> Ready<'a> {
    pub(super) fn new(opened: &'a Opened, index: u32) -> Self {
        let options = opened.options.iter().map(|_| OnceCell::new()).collect();
        Self { opened, encounter: Encounter::of(&opened.study, index), options }
    }

    /// An option ready to run, or why it is not.
    pub(super) fn option(&self, option: usize) -> Result<&Prepared, String> {
        let made =
            || self.opened.prepare(option, &self.encounter).map_err(|error| error.to_string());
        self.options[option].get_or_init(made).as_ref().map_err(Clone::clone)
    }
}
