//! Surfaces of a whale by the words that files use: what friction tells apart.

use endline_sdk::{Limb, Region};

use crate::diagnostic::At;
use crate::fields::Fields;
use crate::nearest::hint;
use crate::tree::Content;

/// Surfaces of a whale by the words that files use, from the head aft, then those that stand for several.
pub const WORDS: [&str; 10] = [
    "rostrum", "baleen", "lips", "head", "body", "peduncle", "flippers", "flukes", "edges", "skin",
];

/// The surface that a region's coefficient is filed under.
pub(crate) fn surface_of(region: Region) -> &'static str {
    match region {
        Region::Rostrum => "rostrum",
        Region::Baleen => "baleen",
        Region::Lips => "lips",
        Region::Head => "head",
        _ => "skin",
    }
}

/// Whether one of the words stands for a region; no word at all stands for every one.
pub(crate) fn any_holds(words: &[At<String>], region: Region) -> bool {
    words.is_empty() || words.iter().any(|word| holds(&word.value, region))
}

/// Whether a word stands for a region.
fn holds(word: &str, region: Region) -> bool {
    match word {
        "body" => region == Region::Body,
        "peduncle" => region == Region::Peduncle,
        "flippers" => region.part().limb() == Limb::Flipper,
        "flukes" => region.part().limb() == Limb::Fluke,
        "edges" => region.is_edge(),
        of => surface_of(region) == of,
    }
}

/// Reads a list of surfaces; those it does not know are problems.
pub(crate) fn read<'a>(fields: &Fields<'a>, key: &'a str) -> Vec<At<String>> {
    let Some(node) = fields.get(key) else { return Vec::new() };
    let Content::List(items) = &node.content else {
        let message = format!("`{key}` is {}, not a list of surfaces", node.content.noun());
        fields
            .problems()
            .push(node.place.error(message, "write a list such as [\"baleen\", \"lips\"]"));
        return Vec::new();
    };
    if items.is_empty() {
        fields.problems().push(node.place.error(
            format!("`{key}` is empty"),
            "write a surface such as \"baleen\", or leave it out",
        ));
    }
    let mut words = Vec::new();
    for item in items {
        match &item.content {
            Content::Text(word) if WORDS.contains(&word.as_str()) => {
                words.push(At { value: word.clone(), place: item.place.clone() })
            }
            Content::Text(word) => fields.problems().push(
                item.place.error(format!("`{word}` is no surface of a whale"), hint(word, WORDS)),
            ),
            other => {
                let message = format!("a surface is {}, not a text", other.noun());
                fields.problems().push(item.place.error(message, hint("", WORDS)));
            }
        }
    }
    words
}
