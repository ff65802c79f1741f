//! Keys of the window, given as orders.

use egui::{Context, Key, KeyboardShortcut, Modifiers};

use super::desk::{Desk, Order};
use super::layout::Panel;
use crate::scene::View;

/// Orders given by keys since the last frame.
pub fn orders(context: &Context, desk: &mut Desk) -> Vec<Order> {
    let mut orders = shortcuts(context);
    if !context.egui_wants_keyboard_input() {
        orders.extend(plain(context));
        if desk.flying {
            orders.extend(flying(context, desk));
        } else {
            views(context, desk);
        }
    }
    orders
}

/// Keys that work even while typing.
fn shortcuts(context: &Context) -> Vec<Order> {
    let ctrl = Modifiers::COMMAND;
    let table = [
        (ctrl | Modifiers::SHIFT, Key::Z, Order::Redo),
        (ctrl, Key::Z, Order::Undo),
        (ctrl, Key::Y, Order::Redo),
        (ctrl, Key::S, Order::Save),
        (ctrl, Key::Enter, Order::Apply),
        (ctrl, Key::F, Order::Fly),
        (ctrl, Key::P, Order::Commands),
        (Modifiers::NONE, Key::F1, Order::Show(Panel::Help)),
    ];
    let typing = context.egui_wants_keyboard_input();
    let pressed = |(modifiers, key, order): (Modifiers, Key, Order)| {
        // A text being typed has an undo of its own.
        let own = typing && matches!(order, Order::Undo | Order::Redo);
        (!own && context.input_mut(|input| input.consume_shortcut(&KeyboardShortcut::new(modifiers, key)))).then_some(order)
    };
    table.into_iter().filter_map(pressed).collect()
}

/// Keys of the run.
fn plain(context: &Context) -> Vec<Order> {
    let table = [(Key::Space, vec![Order::PlayPause]), (Key::Period, vec![Order::Step]), (Key::Backspace, vec![Order::Reset])];
    table.into_iter().filter(|(key, _)| take(context, *key)).flat_map(|(_, orders)| orders).collect()
}

fn take(context: &Context, key: Key) -> bool {
    context.input_mut(|input| input.consume_key(Modifiers::NONE, key))
}

/// Keys of the pilot besides steering.
fn flying(context: &Context, desk: &mut Desk) -> Vec<Order> {
    if take(context, Key::M) {
        desk.pilot.toggle_mouth();
    }
    let table = [(Key::V, Order::Person), (Key::N, Order::NextAct), (Key::K, Order::WeakLinks), (Key::Escape, Order::Fly)];
    table.into_iter().filter(|(key, _)| take(context, *key)).map(|(_, order)| order).collect()
}

/// Keys of the 3-D view.
fn views(context: &Context, desk: &mut Desk) {
    let table = [(Key::Num1, View::Side), (Key::Num7, View::Top), (Key::Num3, View::Front), (Key::Num5, View::Orbit)];
    for (key, view) in table {
        if take(context, key) {
            desk.view3d.look(view);
        }
    }
    if take(context, Key::F) {
        (desk.view3d.follow, desk.view3d.frame_again) = (false, true);
    }
}
