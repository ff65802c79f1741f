//! The functions of a file: how long they are and how many arguments they take.

use std::collections::BTreeSet;

use super::code::{group_length, turn};
use super::tokens::{Kind, Token};

/// A function with a body.
pub struct Function {
    /// Its name.
    pub name: String,
    /// Line of its `fn`, from 1.
    pub line: usize,
    /// Lines from `fn` to the closing brace, both counted.
    pub lines: usize,
    /// Lines between the braces without blank lines and comments, as clippy's `too_many_lines` counts.
    pub body_lines: usize,
    /// Arguments without `self`; an anonymous tuple counts as its members.
    ///
    /// 0 for `extern "C"`: the boundary to plugins decides what such a function takes.
    pub arguments: usize,
}

/// All functions with a body, those inside others too.
pub fn functions(tokens: &[Token]) -> Vec<Function> {
    let starts = (0..tokens.len()).filter(|&at| tokens[at].is("fn"));
    starts
        .filter_map(|at| {
            let is_foreign = at >= 2 && tokens[at - 2].is("extern");
            let mut found = function(&tokens[at..])?;
            found.arguments *= usize::from(!is_foreign);
            Some(found)
        })
        .collect()
}

/// The function whose `fn` comes first; `None` for a pointer's type and for a function without a body.
fn function(tokens: &[Token]) -> Option<Function> {
    let name = tokens.get(1).filter(|token| token.kind == Kind::Word)?;
    let open = 2 + generics_length(&tokens[2..]);
    let close = open + group_length(tokens.get(open..)?);
    let body = close + body_start(&tokens[close..])?;
    let end = body + group_length(&tokens[body..]);
    let (line, last) = (tokens[0].line, tokens[end - 1].end_line);
    let inner = &tokens[body + 1..end - 1];
    let written: BTreeSet<usize> =
        inner.iter().flat_map(|token| token.line..=token.end_line).collect();
    let braces = [tokens[body].line, last];
    Some(Function {
        name: name.text.clone(),
        line,
        lines: last - line + 1,
        body_lines: written.iter().filter(|line| !braces.contains(line)).count(),
        arguments: arguments(&tokens[open + 1..close - 1]),
    })
}

/// Number of tokens of `<..>`; 0 where there is none.
fn generics_length(tokens: &[Token]) -> usize {
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate() {
        depth += angle(token);
        if depth == 0 {
            return if at == 0 { 0 } else { at + 1 };
        }
    }
    tokens.len()
}

fn angle(token: &Token) -> i32 {
    match token.text.as_str() {
        "<" => 1,
        ">" => -1,
        _ => 0,
    }
}

/// Where the body's brace is, behind the arguments; `None` where a `;` comes first.
fn body_start(tokens: &[Token]) -> Option<usize> {
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate() {
        if depth == 0 && token.is("{") {
            return Some(at);
        }
        depth += turn(token);
        if depth < 0 || (depth == 0 && token.is(";")) {
            return None;
        }
    }
    None
}

/// Counts what stands between the parentheses of a function, without `self`.
fn arguments(tokens: &[Token]) -> usize {
    let counts = parts(tokens).into_iter().map(|argument| {
        let colon = argument.iter().position(|token| token.is(":"));
        let is_self = argument[..colon.unwrap_or(argument.len())].last()?.is("self");
        (!is_self).then(|| colon.map_or(1, |colon| members(&argument[colon + 1..])))
    });
    counts.flatten().sum()
}

/// How many values a type is: those of a tuple, of a reference to one too; else 1.
fn members(of_type: &[Token]) -> usize {
    let is_prefix = |token: &Token| {
        token.is("&") || token.is("mut") || token.kind == Kind::Literal && token.text.is_empty()
    };
    let bare =
        of_type.iter().position(|token| !is_prefix(token)).map_or(&[][..], |at| &of_type[at..]);
    if !bare.first().is_some_and(|token| token.is("(")) {
        return 1;
    }
    let inside = &bare[1..group_length(bare) - 1];
    parts(inside).into_iter().map(members).sum::<usize>().max(1)
}

/// Splits at the commas that stand in no bracket.
pub fn parts(tokens: &[Token]) -> Vec<&[Token]> {
    let mut depth = 0;
    let all = tokens.split(|token| {
        depth += turn(token) + angle(token);
        depth == 0 && token.is(",")
    });
    all.filter(|part| !part.is_empty()).collect()
}
