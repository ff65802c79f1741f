//! Messages between the program and a plugin's process, and their frames.
//!
//! | sender | message |
//! |---|---|
//! | program | [`Orders`]: which bytes to open |
//! | process | [`Opening`]: the content of the library |
//! | program | [`Question`]: a call of one of the plugins |
//! | process | [`Answer`]: the result of the call |
//!
//! Questions and answers alternate until the program closes the pipe. Each is a frame (`frame.rs`).

use std::io::{self, Read, Write};

use endline_sdk::{
    AttributeValue, BodyPart, Contacts, Controls, Descriptor, FrictionResponse, GearAction,
    MotionInput, MotionOutput, Rig, Site,
};

use super::super::info::Refusal;
use super::wire::Wire;

/// The library that a process opens.
pub(super) struct Orders {
    /// Version of the program: another one sends other messages.
    pub version: String,
    /// The file's path, as the library receives it.
    pub file: String,
    /// The bytes of the library, which were hashed and allowed.
    pub bytes: Vec<u8>,
}

/// The result.
pub(super) enum Opening {
    /// The description of the library, and its plugins.
    Opened {
        /// Author and sources.
        about: String,
        /// Its plugins, in order.
        plugins: Vec<Declared>,
    },
    /// Why it cannot be used.
    Refused(Refusal),
}

/// One plugin of a library.
pub(super) enum Declared {
    /// A whale motion.
    Motion(Descriptor),
    /// A friction model.
    Friction(Descriptor),
    /// A gear type.
    Gear(Descriptor),
    /// One that cannot be used.
    Refused(Refusal),
}

/// A call of a plugin.
pub(super) struct Question {
    /// Place of the plugin among those of its library.
    pub plugin: u32,
    /// Function and arguments.
    pub call: Call,
}

/// A function with its arguments.
pub(super) enum Call {
    /// Whale motion.
    Move { attributes: Vec<f64>, input: Box<MotionNow>, state: Vec<f64> },
    /// Friction: forces of one solver pass.
    Respond { attributes: Vec<f64>, contacts: Box<ContactArrays> },
    /// Friction: floats after a step.
    Advance { attributes: Vec<f64>, contacts: Box<ContactArrays> },
    /// Gear type: parts and connections.
    Build { attributes: Vec<AttributeValue>, site: Site },
    /// Gear type: a step.
    Step {
        attributes: Vec<AttributeValue>,
        time_s: f64,
        dt_s: f64,
        end_tension_n: Vec<[f64; 2]>,
        state: Vec<f64>,
    },
}

/// The result of a call.
pub(super) enum Answer {
    Moved {
        output: Box<MotionOutput>,
        state: Vec<f64>,
    },
    Responses(Vec<FrictionResponse>),
    Floats(Vec<f64>),
    Built(Rig),
    Acted {
        actions: Vec<GearAction>,
        state: Vec<f64>,
    },
    /// The plugin's own error.
    Fault(String),
}

/// [`MotionInput`] with arrays of its own.
pub(super) struct MotionNow {
    pub time_s: f64,
    pub dt_s: f64,
    pub length_m: f64,
    pub speed_m_s: f64,
    pub position_m: [f64; 3],
    pub orientation: [f64; 4],
    pub controls: Controls,
    pub contact_force_n: [f64; BodyPart::ALL.len()],
    pub contact_port_m: [f64; BodyPart::ALL.len()],
    pub thrust_speed_m_s: Option<f64>,
}

/// [`Contacts`] with arrays of its own.
pub(super) struct ContactArrays {
    pub dt_s: f64,
    pub normal_force_n: Vec<f64>,
    pub normal: Vec<[f64; 3]>,
    pub grain: Vec<[f64; 3]>,
    pub along: Vec<[f64; 3]>,
    pub slip_m: Vec<[f64; 3]>,
    pub length_m: Vec<f64>,
    pub coefficient: Vec<f64>,
    pub region: Vec<u32>,
    pub rope: Vec<u32>,
    pub state: Vec<f64>,
}

impl From<&MotionInput<'_>> for MotionNow {
    fn from(input: &MotionInput<'_>) -> Self {
        Self {
            time_s: input.time_s,
            dt_s: input.dt_s,
            length_m: input.length_m,
            speed_m_s: input.speed_m_s,
            position_m: input.position_m,
            orientation: input.orientation,
            controls: input.controls,
            contact_force_n: *input.contact_force_n,
            contact_port_m: *input.contact_port_m,
            thrust_speed_m_s: input.thrust_speed_m_s,
        }
    }
}

impl MotionNow {
    /// As a motion takes it.
    pub fn lent(&self) -> MotionInput<'_> {
        MotionInput {
            time_s: self.time_s,
            dt_s: self.dt_s,
            length_m: self.length_m,
            speed_m_s: self.speed_m_s,
            position_m: self.position_m,
            orientation: self.orientation,
            controls: self.controls,
            contact_force_n: &self.contact_force_n,
            contact_port_m: &self.contact_port_m,
            thrust_speed_m_s: self.thrust_speed_m_s,
        }
    }
}

impl From<&Contacts<'_>> for ContactArrays {
    fn from(contacts: &Contacts<'_>) -> Self {
        Self {
            dt_s: contacts.dt_s,
            normal_force_n: contacts.normal_force_n.to_vec(),
            normal: contacts.normal.to_vec(),
            grain: contacts.grain.to_vec(),
            along: contacts.along.to_vec(),
            slip_m: contacts.slip_m.to_vec(),
            length_m: contacts.length_m.to_vec(),
            coefficient: contacts.coefficient.to_vec(),
            region: contacts.region.to_vec(),
            rope: contacts.rope.to_vec(),
            state: contacts.state.to_vec(),
        }
    }
}

impl ContactArrays {
    /// As a friction model takes them.
    pub fn lent(&self) -> Contacts<'_> {
        Contacts {
            dt_s: self.dt_s,
            normal_force_n: &self.normal_force_n,
            normal: &self.normal,
            grain: &self.grain,
            along: &self.along,
            slip_m: &self.slip_m,
            length_m: &self.length_m,
            coefficient: &self.coefficient,
            region: &self.region,
            rope: &self.rope,
            state: &self.state,
        }
    }
}

/// Longest frame that is read [bytes]: room for a library, the longest message.
const LONGEST: u64 = 600 << 20;

/// Writes a frame and sends it off. `room` is used for its bytes.
pub(super) fn send<T: Wire>(
    value: &T,
    pipe: &mut impl Write,
    room: &mut Vec<u8>,
) -> io::Result<()> {
    room.clear();
    0_u64.encode(room);
    value.encode(room);
    let length = (room.len() - size_of::<u64>()) as u64;
    room[..size_of::<u64>()].copy_from_slice(&length.to_le_bytes());
    pipe.write_all(room)?;
    pipe.flush()
}

/// Reads a frame. `room` is used for its bytes.
pub(super) fn receive<T: Wire>(pipe: &mut impl Read, room: &mut Vec<u8>) -> io::Result<T> {
    let mut length = [0; size_of::<u64>()];
    pipe.read_exact(&mut length)?;
    let length = u64::from_le_bytes(length);
    if length > LONGEST {
        return Err(io::ErrorKind::InvalidData.into());
    }
    room.clear();
    // Memory is taken as bytes come, not as the length says.
    pipe.take(length).read_to_end(room)?;
    if room.len() as u64 != length {
        return Err(io::ErrorKind::UnexpectedEof.into());
    }
    let mut rest = room.as_slice();
    let value = T::decode(&mut rest).filter(|_| rest.is_empty());
    value.ok_or_else(|| io::ErrorKind::InvalidData.into())
}
