//! Vertices that a file has split become one again.
//!
//! A program splits vertices where materials, normals or texture seams meet. Those with the same place and weights are one, so that
//! the skin closes; lips that touch but hang on different bones stay two. A file that is closed as it stands is left as it is.

use std::collections::BTreeMap;

use endline_sim::whale::Skin;

/// What is the same in vertices that are one: bits of place and weights.
type Key = ([u64; 3], [(u16, u64); 4]);

/// The skin with split vertices welded, and without the triangles that this leaves no area.
pub(super) fn weld(skin: &Skin) -> Skin {
    // Minus zero is zero.
    let bits = |number: f64| (number + 0.0).to_bits();
    let mut known: BTreeMap<Key, u32> = BTreeMap::new();
    let mut welded = Skin { bones: skin.bones.clone(), ..Skin::default() };
    let mut numbers = Vec::with_capacity(skin.vertices.len());
    for ((place, weights), mark) in skin.vertices.iter().zip(&skin.weights).zip(&skin.marks) {
        let key = (place.to_array().map(bits), weights.map(|(bone, weight)| (bone, bits(weight))));
        numbers.push(*known.entry(key).or_insert_with(|| {
            welded.vertices.push(*place);
            welded.weights.push(*weights);
            welded.marks.push(*mark);
            u32::try_from(welded.vertices.len() - 1).unwrap_or(u32::MAX)
        }));
    }
    for (triangle, region) in skin.triangles.iter().zip(&skin.regions) {
        let [a, b, c] = triangle.map(|corner| numbers[corner as usize]);
        if a != b && b != c && c != a {
            welded.triangles.push([a, b, c]);
            welded.regions.push(*region);
        }
    }
    welded
}
