//! Numbers of sites: the places on the rope at which friction keeps something from step to step.
//!
//! From the highest bit down, a number holds the segment, the piece of it, which contact point of the piece, and which face of skin.

use std::ops::Range;

/// Bits below the segment.
pub(crate) const SEGMENT_BITS: u32 = 20;
/// Bits that name the face.
pub(crate) const FACE_BITS: u32 = 2;
/// Bits that name the contact point within its piece, and the face.
pub(crate) const PIECE_BITS: u32 = 3 + FACE_BITS;
/// Most contact points of a piece.
pub(crate) const MOST_POINTS: usize = 1 << (PIECE_BITS - FACE_BITS);

/// The segment a site lies on.
pub(crate) fn segment_of(site: u64) -> usize {
    (site >> SEGMENT_BITS) as usize
}

/// A site whose segment, where it is among these, has moved by one place up or down.
pub(crate) fn shift_site(site: u64, segments: Range<usize>, by: i64) -> u64 {
    if segments.contains(&segment_of(site)) {
        site.wrapping_add_signed(by << SEGMENT_BITS)
    } else {
        site
    }
}
