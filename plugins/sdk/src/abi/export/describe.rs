//! Descriptors of plugins as structs of the C table.

use std::ffi::c_void;

use super::Exported;
use super::pointers::size;
use crate::abi::table::*;
use crate::hook::{Act, Attribute, AttributeKind, Descriptor};

/// The identity of a plugin, and the table of its functions; the plugin itself is never freed.
pub(super) fn plugin(plugin: Exported) -> AbiPlugin {
    /// A plugin that is never freed, and its address.
    fn leaked<T>(plugin: T) -> (&'static T, *const c_void) {
        let plugin = &*Box::leak(Box::new(plugin));
        (plugin, (&raw const *plugin).cast())
    }
    match plugin {
        Exported::Motion(plugin) => {
            let (plugin, context) = leaked(plugin);
            let table = (&raw const super::motion::TABLE).cast();
            describe(KIND_MOTION, plugin.descriptor(), context, table)
        }
        Exported::Friction(plugin) => {
            let (plugin, context) = leaked(plugin);
            let table = (&raw const super::friction::TABLE).cast();
            describe(KIND_FRICTION, plugin.descriptor(), context, table)
        }
        Exported::Gear(plugin) => {
            let (plugin, context) = leaked(plugin);
            let table = (&raw const super::gear::TABLE).cast();
            describe(KIND_GEAR, plugin.descriptor(), context, table)
        }
    }
}

fn describe(
    kind: u32,
    descriptor: &'static Descriptor,
    context: *const c_void,
    table: *const c_void,
) -> AbiPlugin {
    let attributes = Vec::leak(descriptor.attributes.iter().map(describe_attribute).collect());
    let acts = Vec::leak(descriptor.acts.iter().map(describe_act).collect());
    AbiPlugin {
        struct_size: size::<AbiPlugin>(),
        kind,
        id: AbiText::of(&descriptor.id),
        version: AbiText::of(&descriptor.version),
        name: AbiText::of(&descriptor.name),
        help: AbiText::of(&descriptor.help),
        attributes: attributes.as_ptr(),
        attribute_count: attributes.len(),
        state_len: descriptor.state_len,
        context,
        table,
        acts: acts.as_ptr(),
        act_count: acts.len(),
    }
}

fn describe_act(act: &'static Act) -> AbiAct {
    AbiAct { id: AbiText::of(&act.id), name: AbiText::of(&act.name), help: AbiText::of(&act.help) }
}

fn describe_attribute(attribute: &'static Attribute) -> AbiAttribute {
    let mut described = AbiAttribute {
        key: AbiText::of(&attribute.key),
        unit: AbiText::of(&attribute.unit),
        help: AbiText::of(&attribute.help),
        kind: ATTRIBUTE_NUMBER,
        least: 0.0,
        greatest: 0.0,
        default_number: 0.0,
        library: AbiText::of(""),
        default_item: AbiText::of(""),
    };
    match &attribute.kind {
        AttributeKind::Number { min, max, default } => {
            (described.least, described.greatest, described.default_number) =
                (*min, *max, *default);
        }
        AttributeKind::Count { min, max, default } => {
            described.kind = ATTRIBUTE_COUNT;
            (described.least, described.greatest, described.default_number) =
                (f64::from(*min), f64::from(*max), f64::from(*default));
        }
        AttributeKind::Choice { words, default } => {
            described.kind = ATTRIBUTE_CHOICE;
            let words: &'static str = String::leak(words.join("|"));
            (described.library, described.default_item) =
                (AbiText::of(words), AbiText::of(default));
        }
        AttributeKind::Item { library, default } => {
            described.kind = ATTRIBUTE_ITEM;
            (described.library, described.default_item) =
                (AbiText::of(library), AbiText::of(default));
        }
    }
    described
}
