//! Values of the sdk as bytes: numbers little-endian, lists and texts behind their length, variants behind their number.

use std::borrow::Cow;

use endline_sdk::{
    Act, Attribute, AttributeKind, AttributeValue, BodyKind, Controls, Descriptor,
    FrictionResponse, GearAction, LineEnd, MotionOutput, Posture, Rig, RigBody, RigEnd, RigJoint,
    RigLine, RigLink, Site,
};

use super::super::info::Refusal;
use super::message::{Answer, Call, ContactArrays, Declared, MotionNow, Opening, Orders, Question};

/// A value that is sent through a pipe.
pub(super) trait Wire: Sized {
    /// Appends the value's bytes.
    fn encode(&self, out: &mut Vec<u8>);

    /// Takes a value off the front; `None` where the bytes are none of this kind.
    fn decode(from: &mut &[u8]) -> Option<Self>;

    /// Appends the bytes of values in a row.
    fn encode_all(values: &[Self], out: &mut Vec<u8>) {
        values.iter().for_each(|value| value.encode(out));
    }

    /// Takes `count` values off the front.
    fn decode_all(count: usize, from: &mut &[u8]) -> Option<Vec<Self>> {
        // A list is no longer than the bytes that are there, whatever it says.
        let mut list = Vec::with_capacity(count.min(from.len()));
        for _ in 0..count {
            list.push(Self::decode(from)?);
        }
        Some(list)
    }
}

macro_rules! numbers {
    ($($number:ty),*) => {$(
        impl Wire for $number {
            fn encode(&self, out: &mut Vec<u8>) {
                out.extend_from_slice(&self.to_le_bytes());
            }

            fn decode(from: &mut &[u8]) -> Option<Self> {
                let (first, rest) = from.split_first_chunk()?;
                *from = rest;
                Some(Self::from_le_bytes(*first))
            }

            // All at once: most of what is said is numbers in a row.
            fn encode_all(values: &[Self], out: &mut Vec<u8>) {
                let begin = out.len();
                out.resize(begin + size_of_val(values), 0);
                let (room, _) = out[begin..].as_chunks_mut();
                room.iter_mut().zip(values).for_each(|(room, value)| *room = value.to_le_bytes());
            }

            fn decode_all(count: usize, from: &mut &[u8]) -> Option<Vec<Self>> {
                let (first, rest) = from.split_at_checked(count.checked_mul(size_of::<Self>())?)?;
                *from = rest;
                let (values, _) = first.as_chunks();
                Some(values.iter().map(|bytes| Self::from_le_bytes(*bytes)).collect())
            }
        }
    )*};
}

/// A struct is its fields, one after the other.
macro_rules! fields {
    ($($name:ty { $($field:ident),* $(,)? })*) => {$(
        impl Wire for $name {
            fn encode(&self, out: &mut Vec<u8>) {
                $(self.$field.encode(out);)*
            }

            fn decode(from: &mut &[u8]) -> Option<Self> {
                Some(Self { $($field: Wire::decode(from)?),* })
            }
        }
    )*};
}

/// An enum is the number of its variant and that one's fields.
macro_rules! variants {
    ($($name:ident { $($tag:literal => $variant:ident { $($field:tt: $bound:ident),* }),* $(,)? })*) => {$(
        impl Wire for $name {
            fn encode(&self, out: &mut Vec<u8>) {
                match self {
                    $(Self::$variant { $($field: $bound),* } => {
                        out.push($tag);
                        $($bound.encode(out);)*
                    })*
                }
            }

            fn decode(from: &mut &[u8]) -> Option<Self> {
                Some(match u8::decode(from)? {
                    $($tag => Self::$variant { $($field: Wire::decode(from)?),* },)*
                    _ => return None,
                })
            }
        }
    )*};
}

numbers!(u8, u32, u64, f64);

impl Wire for bool {
    fn encode(&self, out: &mut Vec<u8>) {
        out.push(u8::from(*self));
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        [false, true].get(usize::from(u8::decode(from)?)).copied()
    }
}

impl Wire for usize {
    fn encode(&self, out: &mut Vec<u8>) {
        (*self as u64).encode(out);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        Self::try_from(u64::decode(from)?).ok()
    }
}

impl<T: Wire> Wire for Vec<T> {
    fn encode(&self, out: &mut Vec<u8>) {
        self.len().encode(out);
        T::encode_all(self, out);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        let length = usize::decode(from)?;
        T::decode_all(length, from)
    }
}

impl<T: Wire + Copy + Default, const N: usize> Wire for [T; N] {
    fn encode(&self, out: &mut Vec<u8>) {
        T::encode_all(self, out);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        let mut array = [T::default(); N];
        for value in &mut array {
            *value = T::decode(from)?;
        }
        Some(array)
    }

    fn encode_all(values: &[Self], out: &mut Vec<u8>) {
        T::encode_all(values.as_flattened(), out);
    }

    fn decode_all(count: usize, from: &mut &[u8]) -> Option<Vec<Self>> {
        let flat = T::decode_all(count.checked_mul(N)?, from)?;
        let (arrays, _) = flat.as_chunks();
        Some(arrays.to_vec())
    }
}

impl<T: Wire> Wire for Option<T> {
    fn encode(&self, out: &mut Vec<u8>) {
        self.is_some().encode(out);
        self.iter().for_each(|value| value.encode(out));
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        Some(if bool::decode(from)? { Some(T::decode(from)?) } else { None })
    }
}

impl<T: Wire> Wire for Box<T> {
    fn encode(&self, out: &mut Vec<u8>) {
        T::encode(self, out);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        T::decode(from).map(Self::new)
    }
}

impl Wire for String {
    fn encode(&self, out: &mut Vec<u8>) {
        self.len().encode(out);
        out.extend_from_slice(self.as_bytes());
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        Self::from_utf8(Vec::decode(from)?).ok()
    }
}

impl Wire for Cow<'static, str> {
    fn encode(&self, out: &mut Vec<u8>) {
        self.len().encode(out);
        out.extend_from_slice(self.as_bytes());
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        String::decode(from).map(Cow::Owned)
    }
}

fields! {
    Orders { version, file, bytes }
    Refusal { id, reason, help }
    Question { plugin, call }
    MotionNow {
        time_s, dt_s, length_m, speed_m_s, position_m, orientation, controls, contact_force_n, contact_port_m,
        thrust_speed_m_s,
    }
    ContactArrays {
        dt_s, normal_force_n, normal, grain, along, slip_m, length_m, coefficient, region, rope, state,
    }
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
        4 => Step {
            attributes: attributes, time_s: time_s, dt_s: dt_s, end_tension_n: tensions, state: state
        },
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

#[cfg(test)]
mod tests {
    use endline_sdk::{AttributeValue, FrictionResponse, LineEnd, Rig, RigEnd, RigLine, RigLink};

    use super::super::message::{Answer, Call, ContactArrays, Question};
    use super::*;

    fn bytes_of(value: &impl Wire) -> Vec<u8> {
        let mut bytes = Vec::new();
        value.encode(&mut bytes);
        bytes
    }

    fn back<T: Wire>(mut bytes: &[u8]) -> Option<T> {
        T::decode(&mut bytes).filter(|_| bytes.is_empty())
    }

    fn contacts(count: usize) -> ContactArrays {
        let vectors = |by: f64| (0..count).map(|at| [by, at as f64, -0.0]).collect::<Vec<_>>();
        ContactArrays {
            dt_s: f64::MIN_POSITIVE,
            normal_force_n: vec![f64::NAN; count],
            normal: vectors(0.5),
            grain: vectors(1.5),
            along: vectors(f64::INFINITY),
            slip_m: vectors(1e-300),
            length_m: vec![0.025; count],
            coefficient: vec![0.2; count],
            region: vec![7; count],
            rope: vec![u32::MAX; count],
            state: vec![1e-6; 3 * count],
        }
    }

    #[test]
    fn what_is_said_comes_back_to_the_bit() {
        let attributes = vec![1.0, f64::from_bits(0x7ff8_5eed_0e4d_11e5)];
        let question = Question {
            plugin: 3,
            call: Call::Respond { attributes, contacts: Box::new(contacts(5)) },
        };
        let bytes = bytes_of(&question);
        assert_eq!(bytes_of(&back::<Question>(&bytes).unwrap()), bytes);

        let line = RigLine {
            id: "endline".into(),
            rope: "sink".into(),
            from: RigEnd::Body("trap-1:bridle".into()),
            to: RigEnd::Joint("splice".into()),
            length_m: 36.576,
            laid_m: vec![[1.0, 2.0, 3.0]; 2],
        };
        let link =
            RigLink { id: "l".into(), item: "i".into(), line: "endline".into(), end: LineEnd::B };
        let rig = Rig { lines: vec![line], links: vec![link], ..Rig::default() };
        let Some(Answer::Built(again)) = back(&bytes_of(&Answer::Built(rig.clone()))) else {
            panic!("no rig")
        };
        assert_eq!(again, rig);
        let values = vec![AttributeValue::Number(-0.0), AttributeValue::Item("\u{e9}".into())];
        assert_eq!(back::<Vec<AttributeValue>>(&bytes_of(&values)), Some(values));
    }

    #[test]
    fn damaged_bytes_are_no_value_and_take_no_memory() {
        let sound = bytes_of(&Answer::Responses(vec![FrictionResponse::default(); 4]));
        for end in 0..sound.len() {
            assert!(back::<Answer>(&sound[..end]).is_none(), "{end} of {} bytes", sound.len());
        }
        for at in 0..16 {
            for value in 0..=255 {
                let mut bytes = sound.clone();
                bytes[at] = value;
                // Another kind of answer, or none; a list of as many as there is memory is none.
                if let Some(answer) = back::<Answer>(&bytes) {
                    assert_eq!(bytes_of(&answer), bytes);
                }
            }
        }
    }
}
