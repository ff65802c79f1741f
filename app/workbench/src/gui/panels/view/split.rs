//! How the 3-D view is split into panes.

use egui::Rect;

/// Between two panes [points].
const GAP: f32 = 3.0;

/// A pane and what it shows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pane {
    /// 0 for the run, 1 for the one it is compared with.
    pub(super) run: usize,
    /// Its eye.
    pub(super) slot: usize,
    /// Where it lies.
    pub(super) rect: Rect,
}

/// Where panes lie: beside one another, and one above the other from three on.
pub(super) fn places(rect: Rect, count: usize) -> Vec<Rect> {
    let middle = rect.center();
    let left = rect.with_max_x(middle.x - GAP / 2.0);
    let right = rect.with_min_x(middle.x + GAP / 2.0);
    let halves =
        |side: Rect| [side.with_max_y(middle.y - GAP / 2.0), side.with_min_y(middle.y + GAP / 2.0)];
    match count {
        0 | 1 => vec![rect],
        2 => vec![left, right],
        3 => std::iter::once(left).chain(halves(right)).collect(),
        _ => {
            let ([a, c], [b, d]) = (halves(left), halves(right));
            vec![a, b, c, d]
        }
    }
}
