//! A source file without what is compiled for tests only.

use super::tokens::{Token, tokens};

/// The tokens of a file that ships, and how long the file is.
pub struct Code {
    /// Tokens outside `#[cfg(test)]` items.
    pub tokens: Vec<Token>,
    /// Lines of the file, without those of `#[cfg(test)]` items.
    pub lines: usize,
}

/// Reads a source text; `None` where `#![cfg(test)]` says that the whole file is of tests.
pub fn code(text: &str) -> Option<Code> {
    let all = tokens(text);
    let (mut kept, mut test_lines, mut at) = (Vec::new(), 0, 0);
    while at < all.len() {
        match attribute(&all[at..]) {
            Some(found) if found.is_test && found.is_inner => return None,
            Some(found) if found.is_test => {
                let end = item_end(&all, at);
                test_lines += all[end - 1].end_line - all[at].line + 1;
                at = end;
            }
            Some(found) => {
                kept.extend_from_slice(&all[at..at + found.length]);
                at += found.length;
            }
            None => {
                kept.push(all[at].clone());
                at += 1;
            }
        }
    }
    Some(Code { tokens: kept, lines: text.lines().count().saturating_sub(test_lines) })
}

/// An attribute at the start of some tokens.
struct Attribute {
    /// Number of its tokens.
    length: usize,
    /// `#![..]`, which speaks of what it stands in.
    is_inner: bool,
    /// `#[cfg(test)]`, alone or among other conditions.
    is_test: bool,
}

fn attribute(tokens: &[Token]) -> Option<Attribute> {
    let is_inner = tokens.get(1).is_some_and(|token| token.is("!"));
    let open = if is_inner { 2 } else { 1 };
    if !tokens[0].is("#") || !tokens.get(open)?.is("[") {
        return None;
    }
    let length = open + group_length(&tokens[open..]);
    let inside = &tokens[open + 1..length];
    let has = |word: &str| inside.iter().any(|token| token.is(word));
    let is_test = inside[0].is("cfg") && has("test") && !has("not");
    Some(Attribute { length, is_inner, is_test })
}

/// Number of tokens from an opening bracket to its closing one, both counted.
pub fn group_length(tokens: &[Token]) -> usize {
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate() {
        depth += turn(token);
        if depth == 0 {
            return at + 1;
        }
    }
    tokens.len()
}

/// +1 for an opening bracket, -1 for a closing one, 0 for all else.
pub fn turn(token: &Token) -> i32 {
    match token.text.as_str() {
        "(" | "[" | "{" => 1,
        ")" | "]" | "}" => -1,
        _ => 0,
    }
}

/// One behind the last token of the item, field or statement whose attributes begin here.
fn item_end(tokens: &[Token], start: usize) -> usize {
    let mut at = start;
    while let Some(found) = tokens.get(at).and_then(|_| attribute(&tokens[at..])) {
        at += found.length;
    }
    let mut depth = 0;
    while at < tokens.len() {
        let token = &tokens[at];
        depth += turn(token);
        if depth < 0 {
            return at;
        }
        at += 1;
        if depth == 0 && (token.is("}") || token.is(";") || token.is(",")) {
            return at;
        }
    }
    at
}

/// Where one is in a file while walking over its tokens.
#[derive(Default)]
pub struct Place {
    depth: i32,
    /// Modules written out in this file that are open here, each with the depth inside it.
    open: Vec<(String, i32)>,
}

impl Place {
    /// Takes in the next token.
    pub fn step(&mut self, tokens: &[Token], at: usize) {
        self.depth += turn(&tokens[at]);
        if tokens[at].is("{") && at >= 2 && tokens[at - 2].is("mod") {
            self.open.push((tokens[at - 1].text.clone(), self.depth));
        }
        self.open.retain(|(_, inside)| *inside <= self.depth);
    }

    /// Names of the modules that are open here, the outermost first.
    pub fn modules(&self) -> Vec<String> {
        self.open.iter().map(|(name, _)| name.clone()).collect()
    }

    /// Whether an item here is an item of its module, not of a function or a type.
    pub fn is_item_level(&self) -> bool {
        self.depth == self.open.last().map_or(0, |(_, inside)| *inside)
    }
}
