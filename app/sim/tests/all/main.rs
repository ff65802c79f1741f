//! Tests of the physics through the crate's own door: known answers, published figures, invariants.

mod any_gear;
mod balance;
mod bodies_meet;
mod bodies_on_obstacles;
mod bodies_on_seabed;
mod body_on_skin;
mod capstan;
mod dead_whale;
mod edges;
mod end_tension;
mod friction_laws;
mod haul;
mod hitches;
mod kinetic;
mod kinetic_rope;
mod knots;
mod knots_on_ropes;
mod rapier;
mod reference;
mod rope_drag;
mod rope_law;
mod rope_on_bodies;
mod ropes;
mod solids;
mod step_accuracy;
mod water;
