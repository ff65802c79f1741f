//! Which part of a library's structs this program can count on.

use endline_sdk::abi::table::{AbiEntry, AbiFactory, AbiFriction, AbiGear, AbiMotion, AbiPlugin};

/// A struct that a library hands over. A later minor version of the ABI may have made it longer.
pub(super) trait HandedOver {
    /// The bytes of it that every plugin of this major version has: those of its first minor version.
    const LEAST: usize;
}

impl HandedOver for AbiEntry {
    const LEAST: usize = size_of::<Self>();
}

impl HandedOver for AbiFactory {
    // `about` came with 3.1.
    const LEAST: usize = std::mem::offset_of!(Self, about);
}

impl HandedOver for AbiPlugin {
    const LEAST: usize = size_of::<Self>();
}

impl HandedOver for AbiMotion {
    const LEAST: usize = size_of::<Self>();
}

impl HandedOver for AbiFriction {
    const LEAST: usize = size_of::<Self>();
}

impl HandedOver for AbiGear {
    const LEAST: usize = size_of::<Self>();
}
