//! Figures of an event.

use endline_sim::metrics::Event;

use super::View::Table;
use super::{Figure, Quantity, Value};

/// Figures of an event of a run.
pub static EVENT: &[Figure<Event>] = &[
    Figure::new(
        "time_s",
        "time",
        "Time of the event: the end of its step.",
        Quantity::Moment,
        |event: &Event| event.time_s.into(),
    )
    .shown(&[Table]),
    Figure::new(
        "kind",
        "event",
        "Kind of the event, such as `link_parted`.",
        Quantity::Name,
        |event: &Event| event.kind.name().into(),
    )
    .shown(&[Table]),
    Figure::new(
        "subject",
        "of",
        "Id of the object of the event.",
        Quantity::Name,
        |event: &Event| (&event.subject).into(),
    )
    .shown(&[Table]),
    Figure::new("value", "value", "Value of the event.", Quantity::Measured, |event: &Event| {
        Value::Measured { value: event.value, unit: event.kind.unit() }
    })
    .shown(&[Table]),
    Figure::new("unit", "unit", "Unit of the value.", Quantity::Id, |event: &Event| {
        event.kind.unit().into()
    }),
];
