//! Editing without a screen: the open texts with undo, their problems, recovery after a crash, and
//! edits that change several fields at once.
//!
//! | module | what |
//! |---|---|
//! | [`documents`] | every open text: library files, the scenario, the study, the observation |
//! | `texts` | texts as they stand and as their files have them |
//! | `figures` | figures typed: their sources, and what follows from them |
//! | `history` | undo and redo |
//! | [`problems`] | located problems of the texts |
//! | [`saving`] | texts written to their files, none over what someone else wrote since; names of files |
//! | [`bundled`] | files that came with the program, saved as copies of the user's own |
//! | [`recovery`] | unsaved edits kept for the case of a crash |
//! | `option` | options of a study, made from unsaved edits or another assembly |
//! | [`library_table`] | tables of the library as CSV and from a spreadsheet |
//! | [`assembly`] | parts of an assembly added, split and joined |
//! | [`scenario`] | one field of a scenario, with the fields that depend on it |
//! | [`observation`] | sightings of an observation, and its path of rope |
//! | [`pilot_program`] | entries of the scenario's pilot program |

pub mod assembly;
pub mod bundled;
pub mod documents;
mod figures;
mod history;
pub mod library_table;
pub mod observation;
mod option;
pub mod pilot_program;
pub mod problems;
pub mod recovery;
pub mod saving;
pub mod scenario;
mod texts;

pub use documents::Documents;
