//! The functions of a gear type.

use std::ffi::c_void;

use super::guard::guarded;
use super::pointers::{array, array_mut, known_part, size, text};
use crate::abi::table::*;
use crate::gear::{
    BodyKind, GearAction, GearStep, GearType, Rig, RigBody, RigEnd, RigJoint, RigLine, RigLink,
    Site,
};
use crate::hook::{AttributeValue, HookError};

/// The functions of every gear type of this library.
pub(super) static TABLE: AbiGear =
    AbiGear { struct_size: size::<AbiGear>(), build: Some(gear_build), step: Some(gear_step) };

/// # Safety
/// As [`AbiGear::build`] promises.
unsafe extern "C" fn gear_build(
    context: *const c_void,
    values: *const AbiValue,
    value_count: usize,
    site: *const Site,
    rig: *const AbiRigHost,
    message: *mut AbiMessage,
) -> i32 {
    guarded(message, || {
        // SAFETY: guaranteed by the caller.
        unsafe {
            let plugin = &*context.cast::<Box<dyn GearType>>();
            let built = plugin.build(&attribute_values(array(values, value_count)), &*site)?;
            hand_over(&built, &known_part(rig))
        }
    })
}

/// # Safety
/// As [`AbiGear::step`] promises.
unsafe extern "C" fn gear_step(
    context: *const c_void,
    values: *const AbiValue,
    value_count: usize,
    input: *const AbiGearStep,
    state: *mut f64,
    state_len: usize,
    actions: *const AbiActionHost,
    message: *mut AbiMessage,
) -> i32 {
    guarded(message, || {
        // SAFETY: guaranteed by the caller.
        unsafe {
            let (plugin, raw) = (&*context.cast::<Box<dyn GearType>>(), known_part(input));
            let step = GearStep {
                time_s: raw.time_s,
                dt_s: raw.dt_s,
                end_tension_n: array(raw.end_tension_n, raw.line_count),
            };
            let mut wanted = Vec::new();
            plugin.step(
                &attribute_values(array(values, value_count)),
                &step,
                array_mut(state, state_len),
                &mut wanted,
            )?;
            let host = known_part(actions);
            wanted.iter().try_for_each(|action| act(action, &host))
        }
    })
}

/// # Safety
/// The values' texts live through this call.
unsafe fn attribute_values(values: &[AbiValue]) -> Vec<AttributeValue> {
    let value = |value: &AbiValue| match value.kind {
        // SAFETY: guaranteed by the caller.
        ATTRIBUTE_ITEM => AttributeValue::Item(unsafe { text(value.item) }.into_owned()),
        // SAFETY: guaranteed by the caller.
        ATTRIBUTE_CHOICE => AttributeValue::Choice(unsafe { text(value.item) }.into_owned()),
        _ => AttributeValue::Number(value.number),
    };
    values.iter().map(value).collect()
}

/// Passes a rig to the program, part by part.
///
/// # Safety
/// `host` holds the program's functions.
unsafe fn hand_over(rig: &Rig, host: &AbiRigHost) -> Result<(), HookError> {
    // SAFETY: each function is called as the table says, with structs that live through the call.
    unsafe {
        for body in &rig.bodies {
            taken(host.add_body.map(|add| add(host.host, &raw_body(body))))?;
        }
        for joint in &rig.joints {
            taken(host.add_joint.map(|add| add(host.host, &raw_joint(joint))))?;
        }
        for line in &rig.lines {
            taken(host.add_line.map(|add| add(host.host, &raw_line(line))))?;
            let laid = &line.laid_m;
            if !laid.is_empty() {
                taken(
                    host.lay_line.map(|lay| {
                        lay(host.host, AbiText::of(&line.id), laid.as_ptr(), laid.len())
                    }),
                )?;
            }
        }
        for link in &rig.links {
            taken(host.add_link.map(|add| add(host.host, &raw_link(link))))?;
        }
    }
    Ok(())
}

/// # Safety
/// `host` holds the program's functions.
unsafe fn act(action: &GearAction, host: &AbiActionHost) -> Result<(), HookError> {
    // SAFETY: each function is called as the table says.
    taken(unsafe {
        match *action {
            GearAction::CutLine { line, end } => {
                host.cut_line.map(|cut| cut(host.host, line, end as u32))
            }
            GearAction::ReleaseLink { link } => {
                host.release_link.map(|release| release(host.host, link))
            }
        }
    })
}

fn taken(status: Option<i32>) -> Result<(), HookError> {
    if status == Some(STATUS_OK) {
        Ok(())
    } else {
        Err(HookError::new("the program rejected the data of the gear type"))
    }
}

fn raw_body(body: &RigBody) -> AbiBody {
    let kind = match body.kind {
        BodyKind::Trap => BODY_TRAP,
        BodyKind::Buoy => BODY_BUOY,
        BodyKind::Anchor => BODY_ANCHOR,
    };
    AbiBody {
        id: AbiText::of(&body.id),
        kind,
        item: AbiText::of(&body.item),
        position_m: body.position_m,
    }
}

fn raw_joint(joint: &RigJoint) -> AbiJoint {
    AbiJoint { id: AbiText::of(&joint.id), position_m: joint.position_m }
}

fn raw_line(line: &RigLine) -> AbiLine {
    AbiLine {
        id: AbiText::of(&line.id),
        rope: AbiText::of(&line.rope),
        from: raw_end(&line.from),
        to: raw_end(&line.to),
        length_m: line.length_m,
    }
}

fn raw_end(end: &RigEnd) -> AbiRigEnd {
    match end {
        RigEnd::Body(id) => AbiRigEnd { at: AT_BODY, id: AbiText::of(id) },
        RigEnd::Joint(id) => AbiRigEnd { at: AT_JOINT, id: AbiText::of(id) },
    }
}

fn raw_link(link: &RigLink) -> AbiLink {
    AbiLink {
        id: AbiText::of(&link.id),
        item: AbiText::of(&link.item),
        line: AbiText::of(&link.line),
        end: link.end as u32,
    }
}
