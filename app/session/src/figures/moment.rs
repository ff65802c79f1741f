//! Figures of the moment that the workbench shows.

use endline_sim::frame::WhaleFrame;

use super::View::Compare;
use super::{Figure, Quantity};
use crate::live::LiveView;

fn whale(view: &LiveView, read: fn(&WhaleFrame) -> f64) -> Option<f64> {
    view.frame.whale.as_ref().map(read)
}

/// Figures of the moment shown.
pub static MOMENT: &[Figure<LiveView>] = &[
    Figure::new(
        "time_s",
        "time",
        "Time of the moment shown.",
        Quantity::Moment,
        |view: &LiveView| view.frame.time_s.into(),
    )
    .not_in_json()
    .shown(&[Compare]),
    Figure::new(
        "greatest_tension_N",
        "greatest tension",
        "Greatest tension of any segment at the moment shown.",
        Quantity::Force,
        |view: &LiveView| view.frame.tension_n.iter().copied().reduce(f64::max).into(),
    )
    .not_in_json()
    .shown(&[Compare]),
    Figure::new(
        "whale_depth_m",
        "depth of the whale",
        "Depth of the whale at the moment shown.",
        Quantity::Depth,
        |view: &LiveView| whale(view, |whale| -whale.position.z).into(),
    )
    .not_in_json()
    .shown(&[Compare]),
    Figure::new(
        "whale_speed_m_s",
        "speed of the whale",
        "Speed of the whale at the moment shown.",
        Quantity::Speed,
        |view: &LiveView| whale(view, |whale| whale.speed_m_s).into(),
    )
    .not_in_json()
    .shown(&[Compare]),
];
