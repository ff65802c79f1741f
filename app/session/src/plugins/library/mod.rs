//! The program's side of the C table: from a library file to its plugins as traits.
//!
//! | file | content |
//! |---|---|
//! | `boundary` | all unsafe code: opening a library, reading its structs, calling its functions |
//! | `float_state` | the processor's floating-point state, restored after a library's code |
//!
//! This module checks ABI version, sizes, null pointers, UTF-8 and
//! counts. Whether pointers are valid cannot be checked; therefore a new file is first
//! opened in a child process.

mod boundary;
mod float_state;

use std::borrow::Cow;
use std::path::Path;

use endline_sdk::abi::table::{
    AT_BODY, AT_JOINT, ATTRIBUTE_CHOICE, ATTRIBUTE_COUNT, ATTRIBUTE_ITEM, ATTRIBUTE_NUMBER, AbiAct,
    AbiAttribute, AbiBody, AbiContacts, AbiEntry, AbiFactory, AbiFriction, AbiGear, AbiGearStep,
    AbiJoint, AbiLine, AbiLink, AbiMotion, AbiMotionInput, AbiPlugin, AbiRigEnd, AbiText, AbiValue,
};
use endline_sdk::{
    Act, Attribute, AttributeKind, AttributeValue, BodyKind, Contacts, Descriptor, GearStep,
    HookError, LineEnd, MotionInput, Rig, RigBody, RigEnd, RigJoint, RigLine, RigLink,
};

use boundary::{declarations, text};

use super::info::{Hook, MOST_ACTS, MOST_ATTRIBUTES, Refusal};

const REBUILD: &str = "rebuild the plugin against this version of endline-sdk or endline_plugin.h";
const TELL_AUTHOR: &str = "tell the plugin's author";

/// The content of a library.
#[derive(Clone)]
pub(super) struct LoadedLibrary {
    /// Its description: its author, the sources of its laws and figures; may be empty.
    pub about: String,
    /// Whether it runs in a process of its own.
    pub out_of_process: bool,
    /// Its plugins, and why each is not used that cannot be.
    pub hooks: Vec<Result<Hook, Refusal>>,
}

/// Opens a library, which stays mapped from then on, and gives its plugins. `named` is the path that the library receives as its
/// own place, where `file` is a copy.
pub(super) fn open(file: &Path, named: &Path) -> Result<LoadedLibrary, Refusal> {
    let (about, plugins) = boundary::open(file, named)?;
    Ok(LoadedLibrary {
        about,
        out_of_process: false,
        hooks: plugins.into_iter().map(|plugin| hook(plugin?)).collect(),
    })
}

fn hook(plugin: AbiPlugin) -> Result<Hook, Refusal> {
    let descriptor = read(&plugin)?;
    let id = descriptor.id.to_string();
    boundary::hook(&plugin, descriptor).map_err(|refusal| Refusal { id: Some(id), ..refusal })
}

/// A struct of a library. A later minor version of the ABI may have made it longer.
trait SizedStruct: Sized {
    /// The bytes of it that every plugin of this major version has: those of its first minor version.
    const LEAST: usize = size_of::<Self>();
}

impl SizedStruct for AbiEntry {}
impl SizedStruct for AbiPlugin {}
impl SizedStruct for AbiMotion {}
impl SizedStruct for AbiFriction {}
impl SizedStruct for AbiGear {}

impl SizedStruct for AbiFactory {
    // `about` was added in 3.1.
    const LEAST: usize = std::mem::offset_of!(Self, about);
}

/// The input of a motion in a step, in C; the arrays stay with their owner.
fn raw_motion_input(input: &MotionInput<'_>) -> AbiMotionInput {
    AbiMotionInput {
        struct_size: size_of::<AbiMotionInput>() as u32,
        time_s: input.time_s,
        dt_s: input.dt_s,
        length_m: input.length_m,
        speed_m_s: input.speed_m_s,
        position_m: input.position_m,
        orientation: input.orientation,
        controls: input.controls,
        contact_force_n: input.contact_force_n.as_ptr(),
        body_part_count: input.contact_force_n.len(),
        contact_port_m: input.contact_port_m.as_ptr(),
        thrust_speed_m_s: input.thrust_speed_m_s.unwrap_or(0.0),
        has_thrust: u32::from(input.thrust_speed_m_s.is_some()),
    }
}

/// The input of a gear type in a step, in C; the tensions stay with their owner.
fn raw_gear_step(input: &GearStep<'_>) -> AbiGearStep {
    AbiGearStep {
        struct_size: size_of::<AbiGearStep>() as u32,
        time_s: input.time_s,
        dt_s: input.dt_s,
        line_count: input.end_tension_n.len(),
        end_tension_n: input.end_tension_n.as_ptr(),
    }
}

/// The contacts as C sees them; an error where array lengths do not agree, for C would read past them.
fn raw_contacts(
    contacts: &Contacts<'_>,
    state_len: usize,
    room: usize,
    needed: usize,
) -> Result<AbiContacts, HookError> {
    let count = contacts.len();
    let vectors =
        [contacts.normal.len(), contacts.grain.len(), contacts.along.len(), contacts.slip_m.len()];
    let numbers = [
        contacts.length_m.len(),
        contacts.coefficient.len(),
        contacts.region.len(),
        contacts.rope.len(),
    ];
    if vectors.iter().chain(&numbers).any(|length| *length != count)
        || contacts.state.len() != count * state_len
        || room != needed
    {
        return Err(HookError::new("the arrays of contacts differ in length"));
    }
    Ok(AbiContacts {
        struct_size: size_of::<AbiContacts>() as u32,
        count,
        dt_s: contacts.dt_s,
        normal_force_n: contacts.normal_force_n.as_ptr(),
        normal: contacts.normal.as_ptr(),
        grain: contacts.grain.as_ptr(),
        along: contacts.along.as_ptr(),
        slip_m: contacts.slip_m.as_ptr(),
        length_m: contacts.length_m.as_ptr(),
        coefficient: contacts.coefficient.as_ptr(),
        region: contacts.region.as_ptr(),
        rope: contacts.rope.as_ptr(),
        state: contacts.state.as_ptr(),
        state_len,
    })
}

/// The values of a gear type's attributes as C sees them; the texts stay with their owner.
fn raw_values(descriptor: &Descriptor, values: &[AttributeValue]) -> Vec<AbiValue> {
    let is_count = |index: usize| {
        descriptor
            .attributes
            .get(index)
            .is_some_and(|known| matches!(known.kind, AttributeKind::Count { .. }))
    };
    let raw = |(index, value): (usize, &AttributeValue)| match value {
        AttributeValue::Number(number) => {
            let kind = if is_count(index) { ATTRIBUTE_COUNT } else { ATTRIBUTE_NUMBER };
            AbiValue { kind, number: *number, item: AbiText::of("") }
        }
        AttributeValue::Choice(word) => {
            AbiValue { kind: ATTRIBUTE_CHOICE, number: 0.0, item: AbiText::of(word) }
        }
        AttributeValue::Item(id) => {
            AbiValue { kind: ATTRIBUTE_ITEM, number: 0.0, item: AbiText::of(id) }
        }
    };
    values.iter().enumerate().map(raw).collect()
}

/// The descriptor of a plugin of a library.
fn read(plugin: &AbiPlugin) -> Result<Descriptor, Refusal> {
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
    let act = |raw: &AbiAct| -> Result<Act, Refusal> {
        Ok(Act { id: text(raw.id)?, name: text(raw.name)?, help: text(raw.help)? })
    };
    Ok(Descriptor {
        id: text(plugin.id)?,
        version: text(plugin.version)?,
        name: text(plugin.name)?,
        help: text(plugin.help)?,
        attributes: attributes.iter().map(read_attribute).collect::<Result<_, _>>()?,
        state_len: plugin.state_len,
        acts: acts.iter().map(act).collect::<Result<_, _>>()?,
    })
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
                reason = "checked in the line before"
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

/// Reads a text of a library; `None` where it is not sound.
type ReadText = fn(AbiText) -> Option<String>;

/// Adds a body; `None` where it is not sound.
fn rig_body(rig: &mut Rig, body: &AbiBody, text: ReadText) -> Option<()> {
    let kinds = [BodyKind::Trap, BodyKind::Buoy, BodyKind::Anchor];
    let kind = kinds.into_iter().find(|kind| *kind as u32 == body.kind)?;
    let (id, item) = (text(body.id)?, text(body.item)?);
    rig.bodies.push(RigBody { id, kind, item, position_m: body.position_m });
    Some(())
}

/// Adds a joint; `None` where it is not sound.
fn rig_joint(rig: &mut Rig, joint: &AbiJoint, text: ReadText) -> Option<()> {
    rig.joints.push(RigJoint { id: text(joint.id)?, position_m: joint.position_m });
    Some(())
}

/// Adds a line; `None` where it is not sound.
fn rig_line(rig: &mut Rig, line: &AbiLine, text: ReadText) -> Option<()> {
    let (from, to) = (rig_end(line.from, text)?, rig_end(line.to, text)?);
    let (id, rope) = (text(line.id)?, text(line.rope)?);
    rig.lines.push(RigLine { id, rope, from, to, length_m: line.length_m, laid_m: Vec::new() });
    Some(())
}

/// Adds a weak link; `None` where it is not sound.
fn rig_link(rig: &mut Rig, link: &AbiLink, text: ReadText) -> Option<()> {
    let (id, item, line) = (text(link.id)?, text(link.item)?, text(link.line)?);
    rig.links.push(RigLink { id, item, line, end: rig_line_end(link.end)? });
    Some(())
}

fn rig_end(end: AbiRigEnd, text: ReadText) -> Option<RigEnd> {
    match end.at {
        AT_BODY => text(end.id).map(RigEnd::Body),
        AT_JOINT => text(end.id).map(RigEnd::Joint),
        _ => None,
    }
}

/// The end of a line by its number.
fn rig_line_end(end: u32) -> Option<LineEnd> {
    [LineEnd::A, LineEnd::B].into_iter().find(|known| *known as u32 == end)
}
