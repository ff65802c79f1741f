//! What the modules of a crate declare, import and name.

use std::collections::{BTreeMap, BTreeSet};

use super::code::{Place, group_length};
use super::functions::parts;
use super::tokens::{Kind, Token};
use super::tree::Crate;

/// A path of names from the crate's root, or as written in a file.
pub type Path = Vec<String>;

/// A module: a file, or a part of one.
#[derive(Default)]
pub struct Module {
    /// Its file, by place in the crate.
    pub file: usize,
    /// Items that it defines.
    pub items: BTreeSet<String>,
    /// What `use` brings in: name here, and path as written.
    pub imports: BTreeMap<String, Path>,
    /// What `use path::*` brings in: paths as written.
    pub globs: Vec<Path>,
    /// Every path that it names, those of `use` too.
    pub named: BTreeSet<Path>,
}

/// Reads what each module of a crate declares, imports and names, by path from its root.
pub fn modules(of: &Crate) -> BTreeMap<Path, Module> {
    let mut modules = BTreeMap::<Path, Module>::new();
    for (index, file) in of.files.iter().enumerate() {
        let (tokens, mut place, mut at) = (&file.code.tokens, Place::default(), 0);
        while at < tokens.len() {
            place.step(tokens, at);
            let path = [file.module.clone(), place.modules()].concat();
            let module = modules.entry(path).or_default();
            module.file = index;
            if tokens[at].is("use") {
                at += module.take_use(&tokens[at + 1..]);
            } else {
                module.take_item(tokens, at, &place);
                module.take_path(tokens, at);
            }
            at += 1;
        }
        modules.entry(file.module.clone()).or_default().file = index;
    }
    modules
}

const ITEMS: [&str; 9] =
    ["struct", "enum", "union", "trait", "fn", "const", "static", "type", "macro_rules"];

impl Module {
    fn take_item(&mut self, tokens: &[Token], at: usize, place: &Place) {
        if !place.is_item_level() || !ITEMS.iter().any(|item| tokens[at].is(item)) {
            return;
        }
        let skipped = |token: &&Token| token.is("!") || token.is("mut") || token.is("_");
        let name = tokens[at + 1..].iter().find(|token| !skipped(token));
        self.items.extend(name.map(|name| name.text.clone()));
    }

    /// A path in the middle of code, or a lone name that a glob may have brought in.
    fn take_path(&mut self, tokens: &[Token], at: usize) {
        let before = |text| at > 0 && tokens[at - 1].is(text);
        if tokens[at].kind != Kind::Word || before("::") || before(".") || before("fn") {
            return;
        }
        let path = written_path(&tokens[at..]);
        let behind = tokens.get(at + 2 * path.len() - 1);
        let is_type = path[0].starts_with(char::is_uppercase);
        let is_called = behind.is_some_and(|token| token.is("(") || token.is("!"));
        if path.len() > 1 || is_type || is_called {
            self.named.insert(path);
        }
    }

    /// Reads the tree behind `use` and gives the number of its tokens.
    fn take_use(&mut self, tokens: &[Token]) -> usize {
        let end = tokens.iter().position(|token| token.is(";")).unwrap_or(tokens.len());
        self.take_tree(&tokens[..end], &[]);
        end
    }

    fn take_tree(&mut self, tokens: &[Token], prefix: &[String]) {
        if tokens.first().is_some_and(|token| token.is("::")) {
            return;
        }
        let words = tokens.iter().take_while(|token| token.kind == Kind::Word || token.is("::"));
        let words: Vec<&Token> = words.collect();
        let behind = &tokens[words.len()..];
        let (own, alias) = own_and_alias(&words);
        let path = [prefix, &own].concat();
        match behind.first() {
            Some(brace) if brace.is("{") => {
                let inside = &behind[1..group_length(behind) - 1];
                for part in parts(inside) {
                    self.take_tree(part, &path);
                }
            }
            Some(star) if star.is("*") => {
                // As an item that cannot be seen: it names the module's file.
                self.named.insert([path.as_slice(), &["*".to_owned()]].concat());
                self.globs.push(path);
            }
            _ => self.import(path, alias),
        }
    }

    fn import(&mut self, mut path: Path, alias: Option<String>) {
        if path.last().is_some_and(|last| last == "self") && path.len() > 1 {
            path.pop();
        }
        let Some(name) = alias.or_else(|| path.last().cloned()) else { return };
        self.named.insert(path.clone());
        self.imports.insert(name, path);
    }
}

/// Splits `path as name` behind `use`.
fn own_and_alias(words: &[&Token]) -> (Path, Option<String>) {
    let named = words.iter().position(|token| token.is("as"));
    let path = &words[..named.unwrap_or(words.len())];
    let names = path.iter().filter(|token| token.kind == Kind::Word);
    let alias = named.and_then(|at| words.get(at + 1)).map(|token| token.text.clone());
    (names.map(|token| token.text.clone()).collect(), alias)
}

/// The names joined by `::` at the start of some tokens.
fn written_path(tokens: &[Token]) -> Path {
    let mut path = vec![tokens[0].text.clone()];
    for pair in tokens[1..].chunks_exact(2) {
        if !pair[0].is("::") || pair[1].kind != Kind::Word {
            break;
        }
        path.push(pair[1].text.clone());
    }
    path
}
