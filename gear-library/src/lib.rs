//! Gear as files: ropes, traps, buoys, whales and scenarios become a model.
//!
//! ```text
//! text -> tree (values that know their place) -> fields -> items, assemblies, scenario -> assemble -> ModelSpec
//!                                                    \-> every problem, with file, line, column and how to fix it
//! ```
//! The format is described in `docs/gear-format.md`. Nothing else in Endline reads TOML.

mod assemble;
mod assembly;
mod case;
mod diagnostic;
mod document;
mod entry;
mod fields;
mod items;
mod library;
pub mod limits;
mod line;
pub mod names;
mod observation;
mod plugin;
pub mod read;
mod rules;
mod scenario;
mod schema;
mod sources;
mod strength;
mod study;
mod tree;
pub mod units;
pub mod whale;

pub use assemble::{
    Assembled, Hooks, Options, assemble, assemble_traced, box_inertia, buoy_floats, buoy_inertia,
    shell_inertia,
};
pub use assembly::{
    Assembly, Attributes, Make, PartBody, PartJoint, PartLine, PartLink, Parts, Start,
};
pub use case::{Case, CaseHaul, Check, Limit, Measure, Rows, Samples, Table};
pub use diagnostic::{At, Diagnostic, Place, Severity, SourceText, hint};
pub use document::{Document, EditError, Setting, UNSOURCED};
pub use entry::{Confidence, Entry, FORMAT};
pub use fields::{Figure, Range};
pub use items::{
    ActAnimation, ActItem, AgeLaw, BoxGear, Buoy, BuoyPiece, BuoyShape, CHANNELS, Channel,
    Condition, Growth, Joints, Knot, MassLaw, ModelFigures, Point, Rope, RopeFriction, SURFACES,
    SeaSite, WeakLink, WhaleItem, WhaleMesh,
};
pub use library::Library;
pub use line::{Insert, Inserts, LineMake, WeakPlaces, WeakPositions};
pub use observation::{Observation, PathPlace, RopeEnd, SeenSite, Site, Size, Trailing};
pub use plugin::{PLUGIN_FILE, TextGear, TextPlugin};
pub use rules::{Area, Date, Parameter, Rule, RuleDraft, RulePack, Standing, Subject};
pub use scenario::{
    AnswersToTouch, Bed, CurrentOf, CurrentRow, Fixture, FreeBody, FrictionChoice, FrictionOn,
    LineStart, ObstacleOf, PlacedGear, PlacedWhale, PositionOf, ProbeOf, ProbePart, RowHeight,
    Scenario, Sea,
};
pub use schema::{Field, Kind, Word};
pub use sources::Sources;
pub use strength::{StrengthBudget, StrengthFactor, StrengthFigure, WEAK_PLACES};
pub use study::{
    Adapt, Aim, Claim, Counted, Discretisation, Enough, Exposure, HOOKED_TURNS, Law, Level,
    MOST_ENCOUNTERS, ObservedRoutes, ObservedShare, Prior, RegionEvent, RunRule,
    Setting as OptionSetting, Study, StudyEvent, StudyOption, Target, ThreatLabels, ThreatRow,
    library_field, prior_words, referenced_folder,
};
