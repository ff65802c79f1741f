//! How files are damaged: bytes, numbers, lines, and pieces of other files; the same seed gives the same damage.

/// Numbers that readers stumble over.
const NUMBERS: [&str; 16] = [
    "0",
    "-0.0",
    "-1",
    "1e300",
    "-1e300",
    "1e-300",
    "5e-324",
    "nan",
    "inf",
    "-inf",
    "9007199254740993",
    "18446744073709551616",
    "1e6",
    "0.1",
    "1e9",
    "-1e15",
];

/// Words of the formats.
const WORDS: [&str; 14] = [
    "[[line]]",
    "[whale]",
    "\"\"",
    "\"\u{0}\"",
    "= {",
    "}",
    "[",
    "\"3/8 in\"",
    "\"1e300 m\"",
    "true",
    "\u{202e}",
    "\"../../x\"",
    "value = ",
    "#",
];

/// Random numbers from a seed (xorshift64*).
#[derive(Clone, Debug)]
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(seed | 1)
    }

    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// A number below `most`; 0 where that is 0.
    pub fn below(&mut self, most: usize) -> usize {
        (self.next() % most.max(1) as u64) as usize
    }

    fn one<'a, T: ?Sized>(&mut self, of: &[&'a T]) -> &'a T {
        of[self.below(of.len())]
    }
}

/// A file damaged in a few places; `other` is one to take pieces from.
pub fn damaged(bytes: &[u8], other: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=dice.below(4) {
        damage(&mut bytes, other, dice);
    }
    bytes
}

fn damage(bytes: &mut Vec<u8>, other: &[u8], dice: &mut Dice) {
    let at = dice.below(bytes.len());
    match dice.below(9) {
        0 if !bytes.is_empty() => bytes[at] ^= 1 << dice.below(8),
        1 if !bytes.is_empty() => bytes[at] = dice.next() as u8,
        2 => bytes.truncate(at),
        3 => {
            let to = (at + 1 + dice.below(64)).min(bytes.len());
            bytes.drain(at.min(to)..to);
        }
        4 => insert(bytes, at, dice.one(&WORDS).as_bytes()),
        5 => {
            let from = dice.below(other.len());
            let to = (from + 1 + dice.below(200)).min(other.len());
            insert(bytes, at, &other[from.min(to)..to]);
        }
        6 => {
            let line = line_at(bytes, at);
            let piece = bytes[line.clone()].repeat(1 + dice.below(3));
            insert(bytes, line.end, &piece);
        }
        7 => {
            let line = line_at(bytes, at);
            bytes.drain(line);
        }
        _ => other_number(bytes, dice),
    }
}

/// Puts another number in the place of one.
pub fn other_number(bytes: &mut Vec<u8>, dice: &mut Dice) {
    let at = dice.below(bytes.len());
    let is_part = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    let Some(from) = bytes[at..].iter().position(u8::is_ascii_digit).map(|from| at + from) else {
        return;
    };
    let length = bytes[from..].iter().take_while(|byte| is_part(byte)).count();
    let old = String::from_utf8_lossy(&bytes[from..from + length]).into_owned();
    let new = match (dice.below(3), old.parse::<f64>()) {
        // A slip of the keyboard: the point a place further on, a digit more, a sign.
        (0 | 1, Ok(value)) => {
            let factors = [10.0, 0.1, -1.0, 100.0, 0.01, 1000.0, 1.5, 0.0];
            format!("{}", value * factors[dice.below(factors.len())])
        }
        _ => dice.one(&NUMBERS).to_owned(),
    };
    bytes.splice(from..from + length, new.bytes());
}

fn insert(bytes: &mut Vec<u8>, at: usize, piece: &[u8]) {
    bytes.splice(at..at, piece.iter().copied());
}

fn line_at(bytes: &[u8], at: usize) -> std::ops::Range<usize> {
    let from = bytes[..at].iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    let to =
        bytes[at..].iter().position(|byte| *byte == b'\n').map_or(bytes.len(), |end| at + end + 1);
    from..to
}
