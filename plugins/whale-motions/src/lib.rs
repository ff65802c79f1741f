//! The whale motions of Endline, which convert controls to speed, turn rates and posture.
//!
//! | id | motion |
//! |---|---|
//! | `org.endline.motion.swim` | [`Swim`]: steady swimming with fluke beat and steering |

pub mod swim;

pub use swim::Swim;

endline_sdk::export_plugin! {
    about: "Endline; the gaits and where their figures come from: docs/motions.md";
    motion: Swim::new()
}
