//! Which pieces of rope, knots and solids are near each other, by boxes and lists of neighbours.

pub(crate) mod knots;
pub(crate) mod pieces;
pub(crate) mod rope_neighbours;
pub(crate) mod ropes;
pub(crate) mod solids;
