//! Splits Rust source into tokens: comments are dropped, each literal is one token.

/// What a token is, as far as its shape matters here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// An identifier or a keyword; a raw one without its `r#`.
    Word,
    /// A number, a character, a string or a lifetime.
    Literal,
    /// One punctuation character, or one of `::`, `->`, `=>`.
    Punct,
}

/// A token with the lines it stands on.
#[derive(Clone, Debug)]
pub struct Token {
    /// What it is.
    pub kind: Kind,
    /// Its text; empty for a literal.
    pub text: String,
    /// First line, from 1.
    pub line: usize,
    /// Last line; another one for a string over several lines.
    pub end_line: usize,
}

impl Token {
    /// Whether it is this word or punctuation.
    pub fn is(&self, text: &str) -> bool {
        self.kind != Kind::Literal && self.text == text
    }
}

/// The tokens of a source text.
pub fn tokens(text: &str) -> Vec<Token> {
    let mut lexer = Lexer { bytes: text.as_bytes(), at: 0, line: 1, tokens: Vec::new() };
    while lexer.at < lexer.bytes.len() {
        lexer.next();
    }
    lexer.tokens
}

struct Lexer<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    tokens: Vec<Token>,
}

impl Lexer<'_> {
    /// The byte so many places ahead; 0 behind the end.
    fn peek(&self, ahead: usize) -> u8 {
        self.bytes.get(self.at + ahead).copied().unwrap_or(0)
    }

    fn bump(&mut self) {
        if self.peek(0) == b'\n' {
            self.line += 1;
        }
        self.at += 1;
    }

    fn next(&mut self) {
        match (self.peek(0), self.peek(1)) {
            (space, _) if space.is_ascii_whitespace() => self.bump(),
            (b'/', b'/') => self.skip_while(|byte| byte != b'\n'),
            (b'/', b'*') => self.block_comment(),
            (b'"', _) => self.literal(|lexer| lexer.string()),
            (b'\'', _) => self.literal(Lexer::quote),
            (digit, _) if digit.is_ascii_digit() => self.literal(Lexer::number),
            (byte, _) if is_word(byte) => self.word(),
            _ => self.punct(),
        }
    }

    fn skip_while(&mut self, keep: impl Fn(u8) -> bool) {
        while self.at < self.bytes.len() && keep(self.peek(0)) {
            self.bump();
        }
    }

    fn block_comment(&mut self) {
        let mut depth = 0;
        while self.at < self.bytes.len() {
            match (self.peek(0), self.peek(1)) {
                (b'/', b'*') => depth += 1,
                (b'*', b'/') => depth -= 1,
                _ => {
                    self.bump();
                    continue;
                }
            }
            self.at += 2;
            if depth == 0 {
                return;
            }
        }
    }

    fn literal(&mut self, consume: impl Fn(&mut Self)) {
        let line = self.line;
        consume(self);
        self.push(Kind::Literal, String::new(), line);
    }

    /// Behind any prefix, from the opening quotation mark.
    fn string(&mut self) {
        self.bump();
        while self.at < self.bytes.len() && self.peek(0) != b'"' {
            if self.peek(0) == b'\\' {
                self.bump();
            }
            self.bump();
        }
        self.bump();
    }

    /// From the first `#` or the quotation mark.
    fn raw_string(&mut self) {
        let start = self.at;
        self.skip_while(|byte| byte == b'#');
        let fence = self.at - start;
        self.bump();
        while self.at < self.bytes.len() {
            let closes = self.peek(0) == b'"' && (1..=fence).all(|at| self.peek(at) == b'#');
            self.bump();
            if closes {
                self.at += fence;
                return;
            }
        }
    }

    /// A character or a lifetime.
    fn quote(&mut self) {
        self.bump();
        if self.peek(0) == b'\\' {
            self.bump();
            self.bump();
            self.skip_while(|byte| byte != b'\'');
            self.bump();
            return;
        }
        self.bump();
        // The rest of a character of several bytes, or of a lifetime.
        self.skip_while(|byte| is_word(byte) || byte & 0xC0 == 0x80);
        if self.peek(0) == b'\'' {
            self.bump();
        }
    }

    fn number(&mut self) {
        let is_hex = self.peek(0) == b'0' && self.peek(1) == b'x';
        let mut last = b'0';
        loop {
            let (byte, next) = (self.peek(0), self.peek(1));
            let is_exponent_sign =
                matches!(byte, b'+' | b'-') && matches!(last, b'e' | b'E') && !is_hex;
            let is_point = byte == b'.' && next.is_ascii_digit();
            if !(is_word(byte) || is_exponent_sign || is_point) {
                return;
            }
            last = byte;
            self.bump();
        }
    }

    fn word(&mut self) {
        let (start, line) = (self.at, self.line);
        self.skip_while(is_word);
        let word = String::from_utf8_lossy(&self.bytes[start..self.at]).into_owned();
        let is_raw = matches!(word.as_str(), "r" | "br" | "cr");
        match (self.peek(0), self.peek(1)) {
            (b'"', _) if is_raw => self.literal(Lexer::raw_string),
            (b'#', b'"' | b'#') if is_raw => self.literal(Lexer::raw_string),
            (b'"', _) if matches!(word.as_str(), "b" | "c") => self.literal(Lexer::string),
            (b'\'', _) if word == "b" => self.literal(Lexer::quote),
            (b'#', next) if word == "r" && is_word(next) => {
                self.bump();
                self.word();
            }
            _ => self.push(Kind::Word, word, line),
        }
    }

    fn punct(&mut self) {
        let (first, second) = (self.peek(0), self.peek(1));
        let text = match (first, second) {
            (b':', b':') => "::".to_owned(),
            (b'-', b'>') => "->".to_owned(),
            (b'=', b'>') => "=>".to_owned(),
            _ => char::from(first).to_string(),
        };
        self.at += text.chars().count();
        self.push(Kind::Punct, text, self.line);
    }

    fn push(&mut self, kind: Kind, text: String, line: usize) {
        self.tokens.push(Token { kind, text, line, end_line: self.line });
    }
}

fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte >= 0xC0
}
