//! The table that binds keys: what the keyboard gives, what the list of keys shows, both from here.

use egui::{Key, KeyboardShortcut, Modifiers};

use super::desk::Order;
use super::panel_id::PanelId;
use crate::scene::View;

/// When a key holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// At any time, while typing too.
    Always,
    /// While nothing is typed.
    Idle,
    /// While nobody flies and nothing is typed.
    Looking,
    /// While the pilot's hands are on the whale.
    Flying,
}

/// A key and the order it gives.
#[derive(Debug)]
pub struct Binding {
    /// What it does, in the list.
    pub what: &'static str,
    /// The key.
    pub key: KeyboardShortcut,
    /// When it holds.
    pub when: When,
    /// The same on the pad.
    pub pad: &'static str,
    /// The order.
    pub order: Order,
}

const fn bind(
    what: &'static str,
    modifiers: Modifiers,
    key: Key,
    when: When,
    order: Order,
) -> Binding {
    Binding { what, key: KeyboardShortcut::new(modifiers, key), when, pad: "", order }
}

const fn piloted(
    what: &'static str,
    key: Key,
    when: When,
    pad: &'static str,
    order: Order,
) -> Binding {
    Binding { what, key: KeyboardShortcut::new(NONE, key), when, pad, order }
}

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// Every key of the window. Keys that steer stand in [`STEERING`](crate::input::keys::STEERING).
pub static BINDINGS: [Binding; 30] = [
    bind("This list", NONE, Key::F1, When::Always, Order::Show(PanelId::HELP)),
    bind("Every command by name", CTRL, Key::P, When::Always, Order::Commands),
    bind("Save all", CTRL, Key::S, When::Always, Order::Save),
    bind("Undo an edit", CTRL, Key::Z, When::Always, Order::Undo),
    bind("Redo an edit", CTRL_SHIFT, Key::Z, When::Always, Order::Redo),
    bind("Duplicate the chosen entry", CTRL, Key::D, When::Always, Order::Duplicate),
    bind("Take over edited gear", CTRL, Key::Enter, When::Always, Order::Apply),
    bind("Fly the whale, stop flying", CTRL, Key::F, When::Always, Order::Fly),
    piloted("Run, pause; play, stop", Key::Space, When::Idle, "Back", Order::PlayPause),
    bind("One step", NONE, Key::Period, When::Idle, Order::Step),
    piloted("Restart", Key::Backspace, When::Idle, "Start", Order::Reset),
    bind("Play what was run", NONE, Key::P, When::Idle, Order::Replay),
    bind("Slower", NONE, Key::Minus, When::Idle, Order::Slower),
    bind("Faster", NONE, Key::Equals, When::Idle, Order::Faster),
    bind("The first moment", NONE, Key::Home, When::Idle, Order::Seek(0.0)),
    bind("The newest moment", NONE, Key::End, When::Idle, Order::Newest),
    bind("One moment back", NONE, Key::ArrowLeft, When::Looking, Order::Shift(-1)),
    bind("One moment on", NONE, Key::ArrowRight, When::Looking, Order::Shift(1)),
    bind("See everything", NONE, Key::F, When::Looking, Order::Frame),
    bind("Ruler: measure between two places", NONE, Key::R, When::Looking, Order::Ruler),
    bind("From the side", NONE, Key::Num1, When::Looking, Order::Look(View::Side)),
    bind("From above", NONE, Key::Num7, When::Looking, Order::Look(View::Top)),
    bind("From the front", NONE, Key::Num3, When::Looking, Order::Look(View::Front)),
    bind("Orbit", NONE, Key::Num5, When::Looking, Order::Look(View::Orbit)),
    piloted("First, third person", Key::V, When::Flying, "B", Order::Person),
    piloted("Open, close the mouth", Key::M, When::Flying, "A", Order::Mouth),
    piloted("Choose the next act", Key::N, When::Flying, "left stick pressed", Order::NextAct),
    piloted("Weak links on, off", Key::K, When::Idle, "Y", Order::WeakLinks),
    bind("Stop flying", NONE, Key::Escape, When::Flying, Order::Fly),
    bind("Command line of this run", CTRL_SHIFT, Key::C, When::Always, Order::CopyCommandLine),
];

/// What the mouse does in the 3-D view.
pub const MOUSE: [(&str, &str); 4] = [
    ("Read a rope, body or the skin", "click"),
    ("Orbit", "drag"),
    ("Pan", "right drag, or Shift and drag"),
    ("Zoom", "wheel"),
];

/// The key of an order, as menus show it; empty where it has none.
#[must_use]
pub fn keys_of(context: &egui::Context, order: &Order) -> String {
    let bound = BINDINGS.iter().find(|binding| binding.order == *order);
    bound.map_or_else(String::new, |binding| context.format_shortcut(&binding.key))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::keys::STEERING;

    /// Whether two keys may hold at once.
    fn together(a: When, b: When) -> bool {
        !matches!((a, b), (When::Looking, When::Flying) | (When::Flying, When::Looking))
    }

    #[test]
    fn no_key_is_bound_twice() {
        for (index, one) in BINDINGS.iter().enumerate() {
            for other in &BINDINGS[..index] {
                assert!(
                    one.key != other.key || !together(one.when, other.when),
                    "{} and {}",
                    one.what,
                    other.what
                );
            }
            for steer in STEERING.iter().flat_map(|steer| [Some(steer.more), steer.less]).flatten()
            {
                let plain = one.key.modifiers.is_none() && one.when != When::Looking;
                assert!(
                    !(plain && one.key.logical_key == steer),
                    "{} is a key that steers",
                    one.what
                );
            }
        }
    }
}
