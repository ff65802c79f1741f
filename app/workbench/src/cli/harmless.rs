//! Text of files, made harmless for a terminal.

use std::borrow::Cow;
use std::fmt::Write;

/// A text without what a terminal obeys: control characters but for line breaks and tabs, and those that turn the order of writing
/// around, come out as `\u001b`. In JSON this is the same text.
pub(super) fn harmless(text: &str) -> Cow<'_, str> {
    if !text.contains(is_obeyed) {
        return Cow::Borrowed(text);
    }
    let mut plain = String::with_capacity(text.len() + 64);
    for letter in text.chars() {
        if is_obeyed(letter) {
            // Writing to a text cannot fail.
            let _ = write!(plain, "\\u{:04x}", u32::from(letter));
        } else {
            plain.push(letter);
        }
    }
    Cow::Owned(plain)
}

fn is_obeyed(letter: char) -> bool {
    let turns = matches!(letter, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || (letter.is_control() && !matches!(letter, '\n' | '\t'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_terminal_is_told_nothing_and_a_reader_of_json_the_same() {
        let clipboard = "name\u{1b}]52;c;cm0gLXJm\u{7}\u{9b}2J\u{202e}gpj";
        let plain = harmless(clipboard);
        assert!(!plain.contains(is_obeyed), "{plain}");
        let read: String = serde_json::from_str(&format!("\"{plain}\"")).unwrap();
        assert_eq!(read, clipboard);
        let usual = "3/8 in\t\u{b5}m, \u{20ac} and \u{9be8}\n";
        assert!(matches!(harmless(usual), Cow::Borrowed(same) if same == usual));
    }
}
