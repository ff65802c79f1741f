//! The parametric whale: a table of body sections and a few fin measures in, a skinned mesh out.

pub mod form;

pub use form::{FlipperForm, FlukesForm, HeadForm, Station, WhaleForm};
