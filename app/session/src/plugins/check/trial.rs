//! One call of each function of a plugin with its own defaults.

use endline_sdk::{
    AttributeValue, BodyPart, Contacts, Controls, Descriptor, FrictionModel, FrictionResponse, GearStep, GearType, HookError, MotionInput,
    Region, Site, WhaleMotion,
};

use super::super::info::Hook;

/// Water depths at which a gear type may build itself [m]; one that it takes is enough.
const DEPTHS_M: [f64; 4] = [25.0, 10.0, 80.0, 200.0];

pub(super) fn run(hook: &Hook) -> Result<(), HookError> {
    match hook {
        Hook::Motion(motion) => swim(motion.as_ref()),
        Hook::Friction(friction) => rub(friction.as_ref()),
        Hook::Gear(gear) => build(gear.as_ref()),
    }
}

fn numbers(descriptor: &Descriptor) -> Vec<f64> {
    descriptor.attributes.iter().filter_map(|attribute| attribute.default_value().number()).collect()
}

fn swim(motion: &dyn WhaleMotion) -> Result<(), HookError> {
    let forces = [0.0; BodyPart::ALL.len()];
    let mut state = vec![0.0; motion.descriptor().state_len];
    let input = MotionInput {
        time_s: 0.0,
        dt_s: 0.01,
        length_m: 13.0,
        speed_m_s: 1.0,
        position_m: [0.0, 0.0, -10.0],
        orientation: [0.0, 0.0, 0.0, 1.0],
        controls: Controls { speed: 1.0, yaw: 0.5, ..Controls::default() },
        contact_force_n: &forces,
        contact_port_m: &forces,
    };
    motion.step(&numbers(motion.descriptor()), &input, &mut state).map(drop)
}

fn rub(friction: &dyn FrictionModel) -> Result<(), HookError> {
    let attributes = numbers(friction.descriptor());
    let mut floats = vec![0.0; 3 * friction.descriptor().state_len];
    let contacts = Contacts {
        dt_s: 0.002,
        normal_force_n: &[0.0, 10.0, 100.0],
        normal: &[[0.0, 0.0, 1.0]; 3],
        grain: &[[0.0, 1.0, 0.0]; 3],
        along: &[[1.0, 0.0, 0.0]; 3],
        slip_m: &[[0.0; 3], [1e-6, 0.0, 0.0], [0.0, 0.01, 0.0]],
        length_m: &[0.02; 3],
        coefficient: &[0.3; 3],
        region: &[Region::Body as u32; 3],
        rope: &[0; 3],
        state: &floats.clone(),
    };
    friction.respond(&attributes, &contacts, &mut [FrictionResponse::default(); 3])?;
    friction.advance(&attributes, &contacts, &mut floats)
}

fn build(gear: &dyn GearType) -> Result<(), HookError> {
    let descriptor = gear.descriptor();
    let values: Vec<AttributeValue> = descriptor.attributes.iter().map(|attribute| attribute.default_value()).collect();
    let at = |depth_m| gear.build(&values, &Site { depth_m, current_m_s: [0.3, 0.0] });
    let rig = DEPTHS_M[1..].iter().fold(at(DEPTHS_M[0]), |built, depth| built.or_else(|first| at(*depth).map_err(|_| first)))?;
    let step = GearStep { time_s: 0.0, dt_s: 0.01, end_tension_n: &vec![[0.0; 2]; rig.lines.len()] };
    gear.step(&values, &step, &mut vec![0.0; descriptor.state_len], &mut Vec::new())
}
