//! The bytes of everything that is said, field by field (`wire.rs`).

use endline_sdk::{
    Act, Attribute, AttributeKind, AttributeValue, BodyKind, Controls, Descriptor,
    FrictionResponse, GearAction, LineEnd, MotionOutput, Posture, Rig, RigBody, RigEnd, RigJoint,
    RigLine, RigLink, Site,
};

use super::message::{
    Answer, Call, ContactArrays, Declared, GearNow, MotionNow, Opening, Orders, Question, Refused,
};
use super::wire::{Wire, fields, variants};

fields! {
    Orders { version, file, bytes }
    Refused { id, reason, help }
    Question { plugin, call }
    MotionNow {
        time_s, dt_s, length_m, speed_m_s, position_m, orientation, controls, contact_force_n, contact_port_m,
    }
    ContactArrays {
        dt_s, normal_force_n, normal, grain, along, slip_m, length_m, coefficient, region, rope, state,
    }
    GearNow { time_s, dt_s, end_tension_n }
    Descriptor { id, version, name, help, attributes, state_len, acts }
    Attribute { key, unit, help, kind }
    Act { id, name, help }
    Controls {
        speed, pitch, roll, yaw, burst, mouth, flipper_raise, flipper_twist, flipper_sweep, act,
    }
    MotionOutput { speed_m_s, turn_rate_rad_s, posture }
    Posture {
        spine_pitch, spine_yaw, spine_roll, fluke_pitch, fluke_flex, flipper_sweep, flipper_raise,
        flipper_twist, flipper_flex, jaw, lips,
    }
    FrictionResponse { force_n, by_slip, by_normal_force }
    Site { depth_m, current_m_s }
    Rig { bodies, joints, lines, links }
    RigBody { id, kind, item, position_m }
    RigJoint { id, position_m }
    RigLine { id, rope, from, to, length_m, laid_m }
    RigLink { id, item, line, end }
}

variants! {
    Opening {
        0 => Opened { about: about, plugins: plugins },
        1 => Refused { 0: why },
    }
    Declared {
        0 => Motion { 0: descriptor },
        1 => Friction { 0: descriptor },
        2 => Gear { 0: descriptor },
        3 => Refused { 0: why },
    }
    Call {
        0 => Move { attributes: attributes, input: input, state: state },
        1 => Respond { attributes: attributes, contacts: contacts },
        2 => Advance { attributes: attributes, contacts: contacts },
        3 => Build { attributes: attributes, site: site },
        4 => Step { attributes: attributes, input: input, state: state },
    }
    Answer {
        0 => Moved { output: output, state: state },
        1 => Responses { 0: list },
        2 => Floats { 0: list },
        3 => Built { 0: rig },
        4 => Acted { actions: actions, state: state },
        5 => Fault { 0: message },
    }
    AttributeKind {
        0 => Number { min: min, max: max, default: default },
        1 => Count { min: min, max: max, default: default },
        2 => Choice { words: words, default: default },
        3 => Item { library: library, default: default },
    }
    AttributeValue {
        0 => Number { 0: number },
        1 => Choice { 0: word },
        2 => Item { 0: id },
    }
    BodyKind { 0 => Trap {}, 1 => Buoy {}, 2 => Anchor {} }
    RigEnd { 0 => Body { 0: id }, 1 => Joint { 0: id } }
    LineEnd { 0 => A {}, 1 => B {} }
    GearAction {
        0 => CutLine { line: line, end: end },
        1 => ReleaseLink { link: link },
    }
}
