//! Keys of the window, given as orders by the table of [`bindings`](super::bindings).

use egui::{Context, Event, Modifiers};

use super::bindings::{BINDINGS, Binding, When};
use super::desk::{Desk, Order};

/// Orders given by keys since the last frame.
pub fn orders(context: &Context, desk: &Desk) -> Vec<Order> {
    if !context.input(|input| input.events.iter().any(|event| matches!(event, Event::Key { .. }))) {
        return Vec::new();
    }
    let typing = context.egui_wants_keyboard_input();
    let holds = |binding: &&Binding| match binding.when {
        // A text being typed has an undo of its own.
        When::Always => !(typing && matches!(binding.order, Order::Undo | Order::Redo)),
        When::Idle => !typing,
        When::Looking => !typing && !desk.flying,
        When::Flying => !typing && desk.flying,
    };
    let mut wanted: Vec<&Binding> = BINDINGS.iter().filter(holds).collect();
    // The one with more modifiers first: Ctrl+Shift+Z is no Ctrl+Z.
    wanted.sort_by_key(|binding| std::cmp::Reverse(count(binding.key.modifiers)));
    // What comes after Ctrl+P in one slow frame is typed into the list of commands.
    let commands = BINDINGS
        .iter()
        .find(|binding| binding.order == Order::Commands)
        .and_then(|binding| place(context, binding));
    let before = |binding: &&Binding| {
        commands
            .is_none_or(|commands| place(context, binding).is_none_or(|place| place <= commands))
    };
    wanted
        .into_iter()
        .filter(before)
        .filter(|binding| context.input_mut(|input| input.consume_shortcut(&binding.key)))
        .map(|binding| binding.order.clone())
        .collect()
}

/// Where among the events of this frame a binding's key was first pressed.
fn place(context: &Context, binding: &Binding) -> Option<usize> {
    let pressed = |event: &Event| matches!(event, Event::Key { key, pressed: true, .. } if *key == binding.key.logical_key);
    context.input(|input| input.events.iter().position(pressed))
}

fn count(modifiers: Modifiers) -> u32 {
    [modifiers.shift, modifiers.command, modifiers.ctrl, modifiers.alt]
        .into_iter()
        .map(u32::from)
        .sum()
}
