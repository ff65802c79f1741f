//! The known name a misspelt one was meant for.

/// The nearest of `known`, where it is near enough to be meant: at most a third of its letters differ.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = name.to_lowercase();
    let distance = |other: &str| strsim::damerau_levenshtein(&lower, &other.to_lowercase());
    let near = |other: &&str| distance(other) <= (other.chars().count().max(2)).div_ceil(3);
    known.into_iter().filter(near).min_by_key(|other| distance(other))
}

/// `; did you mean …?`, or else `; known are …`, to end a message with.
pub fn hint<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    match nearest(name, known.iter().copied()) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None if known.is_empty() => "there is none to choose from".to_owned(),
        None => format!("known names are {}", known.join(", ")),
    }
}
