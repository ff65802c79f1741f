//! Values as bytes: numbers little-endian, lists and texts behind their length, variants behind their number.

use std::borrow::Cow;

/// A value that goes over a pipe.
pub(super) trait Wire: Sized {
    /// Appends the value's bytes.
    fn put(&self, out: &mut Vec<u8>);

    /// Takes a value off the front; `None` where the bytes are none of this kind.
    fn take(from: &mut &[u8]) -> Option<Self>;

    /// Appends the bytes of values in a row.
    fn put_all(values: &[Self], out: &mut Vec<u8>) {
        values.iter().for_each(|value| value.put(out));
    }

    /// Takes so many values off the front.
    fn take_all(count: usize, from: &mut &[u8]) -> Option<Vec<Self>> {
        // A list is no longer than the bytes that are there, whatever it says.
        let mut list = Vec::with_capacity(count.min(from.len()));
        for _ in 0..count {
            list.push(Self::take(from)?);
        }
        Some(list)
    }
}

macro_rules! numbers {
    ($($number:ty),*) => {$(
        impl Wire for $number {
            fn put(&self, out: &mut Vec<u8>) {
                out.extend_from_slice(&self.to_le_bytes());
            }

            fn take(from: &mut &[u8]) -> Option<Self> {
                let (first, rest) = from.split_first_chunk()?;
                *from = rest;
                Some(Self::from_le_bytes(*first))
            }

            // All at once: most of what is said is numbers in a row.
            fn put_all(values: &[Self], out: &mut Vec<u8>) {
                let begin = out.len();
                out.resize(begin + size_of_val(values), 0);
                let (room, _) = out[begin..].as_chunks_mut();
                room.iter_mut().zip(values).for_each(|(room, value)| *room = value.to_le_bytes());
            }

            fn take_all(count: usize, from: &mut &[u8]) -> Option<Vec<Self>> {
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
            fn put(&self, out: &mut Vec<u8>) {
                $(self.$field.put(out);)*
            }

            fn take(from: &mut &[u8]) -> Option<Self> {
                Some(Self { $($field: Wire::take(from)?),* })
            }
        }
    )*};
}

/// An enum is the number of its variant and that one's fields.
macro_rules! variants {
    ($($name:ident { $($tag:literal => $variant:ident { $($field:tt: $bound:ident),* }),* $(,)? })*) => {$(
        impl Wire for $name {
            fn put(&self, out: &mut Vec<u8>) {
                match self {
                    $(Self::$variant { $($field: $bound),* } => {
                        out.push($tag);
                        $($bound.put(out);)*
                    })*
                }
            }

            fn take(from: &mut &[u8]) -> Option<Self> {
                Some(match u8::take(from)? {
                    $($tag => Self::$variant { $($field: Wire::take(from)?),* },)*
                    _ => return None,
                })
            }
        }
    )*};
}

pub(super) use {fields, variants};

numbers!(u8, u32, u64, f64);

impl Wire for bool {
    fn put(&self, out: &mut Vec<u8>) {
        out.push(u8::from(*self));
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        [false, true].get(usize::from(u8::take(from)?)).copied()
    }
}

impl Wire for usize {
    fn put(&self, out: &mut Vec<u8>) {
        (*self as u64).put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Self::try_from(u64::take(from)?).ok()
    }
}

impl<T: Wire> Wire for Vec<T> {
    fn put(&self, out: &mut Vec<u8>) {
        self.len().put(out);
        T::put_all(self, out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let length = usize::take(from)?;
        T::take_all(length, from)
    }
}

impl<T: Wire + Copy + Default, const N: usize> Wire for [T; N] {
    fn put(&self, out: &mut Vec<u8>) {
        T::put_all(self, out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let mut array = [T::default(); N];
        for value in &mut array {
            *value = T::take(from)?;
        }
        Some(array)
    }

    fn put_all(values: &[Self], out: &mut Vec<u8>) {
        T::put_all(values.as_flattened(), out);
    }

    fn take_all(count: usize, from: &mut &[u8]) -> Option<Vec<Self>> {
        let flat = T::take_all(count.checked_mul(N)?, from)?;
        let (arrays, _) = flat.as_chunks();
        Some(arrays.to_vec())
    }
}

impl<T: Wire> Wire for Option<T> {
    fn put(&self, out: &mut Vec<u8>) {
        self.is_some().put(out);
        self.iter().for_each(|value| value.put(out));
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(if bool::take(from)? { Some(T::take(from)?) } else { None })
    }
}

impl<T: Wire> Wire for Box<T> {
    fn put(&self, out: &mut Vec<u8>) {
        T::put(self, out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        T::take(from).map(Self::new)
    }
}

impl Wire for String {
    fn put(&self, out: &mut Vec<u8>) {
        self.len().put(out);
        out.extend_from_slice(self.as_bytes());
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let length = usize::take(from)?;
        let (text, rest) = from.split_at_checked(length)?;
        *from = rest;
        Self::from_utf8(text.to_vec()).ok()
    }
}

impl Wire for Cow<'static, str> {
    fn put(&self, out: &mut Vec<u8>) {
        self.len().put(out);
        out.extend_from_slice(self.as_bytes());
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        String::take(from).map(Cow::Owned)
    }
}

#[cfg(test)]
mod tests {
    use endline_sdk::{AttributeValue, FrictionResponse, LineEnd, Rig, RigEnd, RigLine, RigLink};

    use super::super::message::{Answer, Call, ContactArrays, Question};
    use super::*;

    fn bytes_of(value: &impl Wire) -> Vec<u8> {
        let mut bytes = Vec::new();
        value.put(&mut bytes);
        bytes
    }

    fn back<T: Wire>(mut bytes: &[u8]) -> Option<T> {
        T::take(&mut bytes).filter(|_| bytes.is_empty())
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
