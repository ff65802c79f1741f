//! Gear as files: ropes, traps, buoys, whales and scenarios become a model.

pub mod whale;
