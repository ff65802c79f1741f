//! The tables of the gear library.

use endline_gear::Kind;

/// Kinds with a table, in the order of their tabs.
pub const KINDS: [(Kind, &str); 9] = [
    (Kind::Rope, "Ropes"),
    (Kind::Trap, "Traps"),
    (Kind::Buoy, "Buoys"),
    (Kind::WeakLink, "Weak links"),
    (Kind::Knot, "Knots"),
    (Kind::Anchor, "Anchors"),
    (Kind::Site, "Sites"),
    (Kind::Friction, "Friction"),
    (Kind::Whale, "Whales"),
];
