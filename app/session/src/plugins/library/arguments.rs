//! What a plugin's functions are called with: values of this program as C sees them.

use endline_sdk::abi::table::{
    ATTRIBUTE_CHOICE, ATTRIBUTE_COUNT, ATTRIBUTE_ITEM, ATTRIBUTE_NUMBER, AbiContacts, AbiGearStep,
    AbiMotionInput, AbiText, AbiValue,
};
use endline_sdk::{
    AttributeKind, AttributeValue, Contacts, Descriptor, GearStep, HookError, MotionInput,
};

/// What a motion is given each step, as C sees it; the arrays stay with their owner.
pub(super) fn raw_motion_input(input: &MotionInput<'_>) -> AbiMotionInput {
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
    }
}

/// What a gear type is given each step, as C sees it; the tensions stay with their owner.
pub(super) fn raw_gear_step(input: &GearStep<'_>) -> AbiGearStep {
    AbiGearStep {
        struct_size: size_of::<AbiGearStep>() as u32,
        time_s: input.time_s,
        dt_s: input.dt_s,
        line_count: input.end_tension_n.len(),
        end_tension_n: input.end_tension_n.as_ptr(),
    }
}

/// The contacts as C sees them; an error where array lengths do not agree, for C would read past them.
pub(super) fn raw_contacts(
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
pub(super) fn raw_values(descriptor: &Descriptor, values: &[AttributeValue]) -> Vec<AbiValue> {
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
