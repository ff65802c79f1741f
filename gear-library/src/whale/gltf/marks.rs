//! What is seen at a vertex, as a vertex colour: one colour for each mark, the nearest one when read.

use endline_sim::whale::Mark;

/// Marks and their colours: red, green, blue.
const COLOURS: [(Mark, [f32; 3]); 6] = [
    (Mark::Skin, [1.0, 1.0, 1.0]),
    (Mark::Callosity, [1.0, 0.8, 0.4]),
    (Mark::Baleen, [0.4, 0.4, 0.2]),
    (Mark::Mouth, [1.0, 0.4, 0.5]),
    (Mark::White, [0.6, 0.9, 1.0]),
    (Mark::Eye, [0.1, 0.1, 0.1]),
];

/// The colour of a mark.
pub(super) fn colour(mark: Mark) -> [f32; 3] {
    COLOURS.iter().find(|(own, _)| *own == mark).map_or([1.0; 3], |(_, colour)| *colour)
}

/// The mark whose colour is nearest.
pub(super) fn nearest(colour: &[f64]) -> Mark {
    let off = |own: &[f32; 3]| {
        own.iter()
            .zip(colour)
            .map(|(own, seen)| (f64::from(*own) - seen) * (f64::from(*own) - seen))
            .sum::<f64>()
    };
    let near = COLOURS.iter().min_by(|left, right| off(&left.1).total_cmp(&off(&right.1)));
    near.map_or_else(Mark::default, |(mark, _)| *mark)
}
