//! Plain English in code and documents: banned words and phrases, and the length of sentences.
//!
//! A ratchet lists the folders and documents that break a rule, with the number of breaches allowed there.
//! These numbers may only decrease; what is on no list must be clean.

use crate::{none, sources};

/// Files that quote banned language as bad examples.
const EXEMPT: [&str; 2] = ["CONTRIBUTING.md", "tests/tests/tidy/language.rs"];

/// Banned words and phrases, in lower case; `_` in an identifier counts as a space.
const BANNED: [&str; 12] = [
    "told",
    "nobody",
    "mend",
    "mends",
    "mended",
    "goes on",
    "go on",
    "comes to",
    "come to",
    "of none",
    "so many",
    "misses by",
];

/// Folders and files with banned language, and the breaches allowed in each. A file counts to the first entry
/// that its path begins with.
const UNCLEAN: [(&str, usize); 0] = [];

/// Most words of a sentence in a document.
const LONGEST_SENTENCE: usize = 28;

/// Documents with longer sentences, and the number allowed in each.
const LONG_SENTENCES: [(&str, usize); 0] = [];

/// Words that end with a full stop inside a sentence.
const ABBREVIATIONS: [&str; 13] = [
    "al.", "approx.", "cf.", "ch.", "e.g.", "eq.", "etc.", "fig.", "i.e.", "no.", "p.", "pp.",
    "vs.",
];

#[test]
fn code_and_documents_avoid_banned_language() {
    let files = sources(&[".rs", ".toml", ".md", ".glsl", ".wgsl"]);
    let breaches =
        files.iter().filter(|file| !EXEMPT.contains(&file.path.as_str())).flat_map(|file| {
            let found =
                breaches(&file.text, file.path.ends_with(".rs"), file.path.ends_with(".md"));
            found.into_iter().map(|(line, what)| (file.path.as_str(), line, what))
        });
    ratchet(&breaches.collect::<Vec<_>>(), &UNCLEAN, "banned language");
}

#[test]
fn sentences_of_documents_are_short() {
    let mut long = Vec::new();
    let files = sources(&[".md"]);
    for file in files.iter().filter(|file| is_document(&file.path)) {
        for (line, sentence) in sentences(&file.text) {
            let words = words(&sentence);
            if words > LONGEST_SENTENCE {
                long.push((file.path.as_str(), line, format!("{words} words: {sentence}")));
            }
        }
    }
    ratchet(&long, &LONG_SENTENCES, "sentences of more than 28 words");
}

/// Whether the rule on the length of sentences holds for a Markdown file.
fn is_document(path: &str) -> bool {
    path.starts_with("docs/") || ["README.md", "CONTRIBUTING.md"].contains(&path)
}

/// Fails where an entry has more breaches than allowed; prints the counts, by which entries are lowered.
fn ratchet(breaches: &[(&str, usize, String)], allowed: &[(&str, usize)], rule: &str) {
    let entry_of = |path: &str| allowed.iter().position(|(start, _)| path.starts_with(start));
    let mut complaints = Vec::new();
    for entry in (0..allowed.len()).map(Some).chain([None]) {
        let (name, limit) = entry.map_or(("elsewhere", 0), |entry| allowed[entry]);
        let here: Vec<_> = breaches.iter().filter(|(path, ..)| entry_of(path) == entry).collect();
        println!("{rule}, {name}: {} of {limit}", here.len());
        if here.len() > limit {
            complaints.push(format!("{name}: {} breaches, {limit} allowed", here.len()));
            complaints
                .extend(here.iter().map(|(path, line, what)| format!("  {path}:{line}: {what}")));
        }
    }
    none(&complaints, rule);
}

/// Breaches of a text, with their lines.
fn breaches(text: &str, is_rust: bool, is_markdown: bool) -> Vec<(usize, String)> {
    let mut found = banned_phrases(text);
    if is_rust {
        for (line, document) in documentation(text) {
            if document.starts_with("The same") {
                found.push((line, "documentation begins with \"The same\"".to_owned()));
            }
            found.extend(repeated_what(&document, line));
        }
    } else if is_markdown {
        found.extend(repeated_what(text, 1));
    }
    found
}

/// Sentences with two "what"; `first` is the number of the text's first line.
fn repeated_what(text: &str, first: usize) -> Vec<(usize, String)> {
    let is_what = |word: &str| word.eq_ignore_ascii_case("what");
    let twice = |sentence: &str| {
        sentence
            .split(|letter: char| !letter.is_alphanumeric())
            .filter(|word| is_what(word))
            .count()
            > 1
    };
    let all = sentences(text).into_iter().filter(|(_, sentence)| twice(sentence));
    all.map(|(line, sentence)| (first + line - 1, format!("\"what\" twice: {sentence}"))).collect()
}

/// Banned words and phrases in a text, in comments, strings and identifiers alike, across line breaks too.
fn banned_phrases(text: &str) -> Vec<(usize, String)> {
    let (mut joined, mut starts) = (String::new(), Vec::new());
    for line in text.lines() {
        starts.push(joined.len());
        let line = line.trim().trim_start_matches(['/', '#', '!', '>']).trim_end_matches('\\');
        joined.push_str(line.trim());
        joined.push(' ');
    }
    let joined = joined.replace('_', " ");
    let lower = joined.to_ascii_lowercase();
    let mut found: Vec<(usize, String)> = Vec::new();
    for phrase in BANNED {
        for (at, _) in lower.match_indices(phrase).filter(|(at, _)| is_whole(&joined, *at, phrase))
        {
            found.push((starts.partition_point(|start| *start <= at), format!("\"{phrase}\"")));
        }
    }
    found.sort();
    found
}

/// Whether a phrase at a place of a text is a word of its own; `IsTold` holds the word "told".
fn is_whole(text: &str, at: usize, phrase: &str) -> bool {
    let (before, after) =
        (text[..at].chars().next_back(), text[at + phrase.len()..].chars().next());
    let is_capital = text[at..].starts_with(|letter: char| letter.is_uppercase());
    let begins = before
        .is_none_or(|letter| !letter.is_alphabetic() || (is_capital && letter.is_lowercase()));
    begins && after.is_none_or(|letter| !letter.is_lowercase())
}

/// Each item's documentation in Rust code, as Markdown, with its first line.
fn documentation(text: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    let mut continues = false;
    for (number, line) in text.lines().enumerate() {
        let line = line.trim_start();
        let document = line.strip_prefix("///").or_else(|| line.strip_prefix("//!"));
        if let Some(document) = document {
            let document = document.strip_prefix(' ').unwrap_or(document);
            match found.last_mut().filter(|_| continues) {
                Some((_, before)) => before.extend(["\n", document]),
                None => found.push((number + 1, document.to_owned())),
            }
        }
        continues = document.is_some();
    }
    found
}

/// Sentences of a Markdown text with the lines where they begin, without code blocks, tables, headings and
/// pictures.
/// An item of a list is a sentence of its own.
fn sentences(markdown: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let (mut paragraph, mut in_code): (Vec<(usize, &str)>, bool) = (Vec::new(), false);
    for (number, line) in markdown.lines().enumerate() {
        let line = line.trim();
        let is_fence = line.starts_with("```");
        in_code ^= is_fence;
        let is_prose =
            !(is_fence || in_code || line.is_empty() || line.starts_with(['|', '#', '<', '!']));
        let item = list_item(line);
        if !is_prose || item.is_some() {
            split(&std::mem::take(&mut paragraph), &mut found);
        }
        if is_prose {
            paragraph.push((number + 1, item.unwrap_or(line)));
        }
    }
    split(&paragraph, &mut found);
    found
}

/// The text of a list's item.
fn list_item(line: &str) -> Option<&str> {
    let bullet = line.strip_prefix("- ").or_else(|| line.strip_prefix("* "));
    let number = || {
        let (number, rest) = line.split_once(". ")?;
        number.bytes().all(|digit| digit.is_ascii_digit()).then_some(rest)
    };
    bullet.or_else(number)
}

/// Splits a paragraph into its sentences: one ends where a word ends with a full stop, question mark or exclamation
/// mark and the next begins with no small letter, or where its line ends as well.
fn split(paragraph: &[(usize, &str)], found: &mut Vec<(usize, String)>) {
    let mut words = paragraph
        .iter()
        .flat_map(|(number, line)| {
            let spaced = line.split_whitespace().count();
            let words = line.split_whitespace().enumerate();
            words.map(move |(index, word)| (*number, word, index + 1 == spaced))
        })
        .peekable();
    let (mut sentence, mut begun, mut ticks): (Vec<&str>, usize, usize) = (Vec::new(), 0, 0);
    while let Some((number, word, is_last)) = words.next() {
        if sentence.is_empty() {
            begun = number;
        }
        sentence.push(word);
        ticks += word.matches('`').count();
        let next_is_small =
            words.peek().is_some_and(|(_, next, _)| next.starts_with(char::is_lowercase));
        if ticks % 2 == 0 && ends_sentence(word) && (is_last || !next_is_small) {
            found.push((begun, std::mem::take(&mut sentence).join(" ")));
        }
    }
    if !sentence.is_empty() {
        found.push((begun, sentence.join(" ")));
    }
}

/// Whether a sentence may end with this word.
fn ends_sentence(word: &str) -> bool {
    let bare = word.trim_end_matches([')', ']', '"', '*', '”']);
    let lower = bare.trim_start_matches(['(', '[', '"', '*']).to_lowercase();
    let is_initial = bare.len() == 2 && bare.starts_with(char::is_uppercase);
    bare.ends_with(['.', '!', '?']) && !is_initial && !ABBREVIATIONS.contains(&lower.as_str())
}

/// Words of a sentence. Code between backquotes and a link's address count as one word and none.
fn words(sentence: &str) -> usize {
    let without_code: String = sentence
        .split('`')
        .enumerate()
        .map(|(at, part)| if at % 2 == 0 { part } else { "code" })
        .collect();
    let mut parts = without_code.split("](");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        text.push_str(part.split_once(')').map_or("", |(_, rest)| rest));
    }
    text.split_whitespace().filter(|word| word.contains(char::is_alphanumeric)).count()
}

#[test]
fn banned_phrases_are_found_as_words() {
    let text = "// It goes\n// on, as IsTold says.\nfn is_told() {}\nlet x = \"so \\\n many\";\n\
                // Recommended: amend, goes on_board's untold.";
    let found = banned_phrases(text);
    let lines: Vec<(usize, &str)> =
        found.iter().map(|(line, what)| (*line, what.as_str())).collect();
    assert_eq!(
        lines,
        [
            (1, "\"goes on\""),
            (2, "\"told\""),
            (3, "\"told\""),
            (4, "\"so many\""),
            (6, "\"goes on\"")
        ]
    );
}

#[test]
fn documentation_is_checked_for_its_first_words_and_for_what_twice() {
    let text = "/// The same as before.\nfn a() {}\n/// Not\n/// The same. Do what\n/// is what.\nfn b() {}\n";
    let found = breaches(text, true, false);
    assert_eq!(found.iter().map(|(line, _)| *line).collect::<Vec<_>>(), [1, 4]);
    assert_eq!(breaches("What is it? What is that?", false, true), []);
    assert_eq!(breaches("What is what?", false, true).len(), 1);
}

#[test]
fn sentences_are_split_and_counted() {
    let text = "# Not. This.\nOne `a. B` is (e.g. Two) here. Three at 0.5 m.\nnext line goes\nover: two lines\n\n\
                - An item\n- by J. Smith et al. Another. \"Quoted.\" Last\n```\nno. Code.\n```\n| no. | Table. |\n";
    let found = sentences(text);
    let expected = [
        (2, "One `a. B` is (e.g. Two) here.", 6),
        (2, "Three at 0.5 m.", 4),
        (3, "next line goes over: two lines", 6),
        (6, "An item", 2),
        (7, "by J. Smith et al. Another.", 6),
        (7, "\"Quoted.\"", 1),
        (7, "Last", 1),
    ];
    assert_eq!(
        found.iter().map(|(line, text)| (*line, text.as_str(), words(text))).collect::<Vec<_>>(),
        expected
    );
    assert_eq!(words("See [two words](a/b.md#c-d) – and **this**."), 5);
}
