//! What a plugin of a library declares of itself: its descriptor, attributes and acts.

use std::borrow::Cow;

use endline_sdk::abi::table::{
    ATTRIBUTE_CHOICE, ATTRIBUTE_COUNT, ATTRIBUTE_ITEM, ATTRIBUTE_NUMBER, AbiAct, AbiAttribute,
    AbiPlugin,
};
use endline_sdk::{Act, Attribute, AttributeKind, Descriptor};

use super::super::declared::{MOST_ACTS, MOST_ATTRIBUTES};
use super::super::info::Refusal;
use super::boundary::{declarations, text};
use super::{REBUILD, TELL_AUTHOR};

/// What a plugin of a library declares of itself.
pub(super) fn read(plugin: &AbiPlugin) -> Result<Descriptor, Refusal> {
    if plugin.attribute_count > MOST_ATTRIBUTES {
        return Err(Refusal::new(
            format!("it declares {} attributes", plugin.attribute_count),
            TELL_AUTHOR,
        ));
    }
    if plugin.act_count > MOST_ACTS {
        return Err(Refusal::new(format!("it declares {} acts", plugin.act_count), TELL_AUTHOR));
    }
    let (attributes, acts) = declarations(plugin);
    Ok(Descriptor {
        id: text(plugin.id)?,
        version: text(plugin.version)?,
        name: text(plugin.name)?,
        help: text(plugin.help)?,
        attributes: attributes.iter().map(read_attribute).collect::<Result<_, _>>()?,
        state_len: plugin.state_len,
        acts: acts.iter().map(read_act).collect::<Result<_, _>>()?,
    })
}

fn read_act(raw: &AbiAct) -> Result<Act, Refusal> {
    Ok(Act { id: text(raw.id)?, name: text(raw.name)?, help: text(raw.help)? })
}

fn read_attribute(raw: &AbiAttribute) -> Result<Attribute, Refusal> {
    let kind = match raw.kind {
        ATTRIBUTE_NUMBER => {
            AttributeKind::Number { min: raw.least, max: raw.greatest, default: raw.default_number }
        }
        ATTRIBUTE_COUNT => read_count(raw)?,
        ATTRIBUTE_CHOICE => {
            let words =
                text(raw.library)?.split('|').map(|word| Cow::Owned(word.to_owned())).collect();
            AttributeKind::Choice { words, default: text(raw.default_item)? }
        }
        ATTRIBUTE_ITEM => {
            AttributeKind::Item { library: text(raw.library)?, default: text(raw.default_item)? }
        }
        other => {
            return Err(Refusal::new(
                format!("it declares an attribute of unknown kind {other}"),
                REBUILD,
            ));
        }
    };
    Ok(Attribute { key: text(raw.key)?, unit: text(raw.unit)?, help: text(raw.help)?, kind })
}

fn read_count(raw: &AbiAttribute) -> Result<AttributeKind, Refusal> {
    let whole = |number: f64| {
        if number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number) {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "looked at in the line before"
            )]
            return Ok(number as u32);
        }
        Err(Refusal::new(
            format!("it declares a count with the figure {number}, which is no whole number"),
            TELL_AUTHOR,
        ))
    };
    Ok(AttributeKind::Count {
        min: whole(raw.least)?,
        max: whole(raw.greatest)?,
        default: whole(raw.default_number)?,
    })
}
