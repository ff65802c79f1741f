//! A library file of any kind as read: id, name, texts and figures; levels of confidence.

use strum::{IntoStaticStr, VariantArray};

use crate::diagnostic::{At, Place};
use crate::fields::{Fields, Figure, Problems, Provenance, provenance};
use crate::items::{BuoyPiece, Point, pieces, points};
use crate::limits;
use crate::schema::{Field, Kind};
use crate::tree::Node;

/// The version of the file format of this program.
pub const FORMAT: u64 = 1;

/// An item of the library, or one written into a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Kind.
    pub kind: Kind,
    /// Id: the file's name without `.toml`.
    pub id: String,
    /// Path of its file, relative to the library's folder.
    pub path: String,
    /// Name shown to the user.
    pub name: String,
    /// Remarks shown to the user; may be empty.
    pub notes: String,
    /// Texts such as a rope's material.
    pub words: Vec<(&'static str, At<String>)>,
    /// Figures, in the order of the kind's fields.
    pub figures: Vec<(&'static Field, Figure)>,
    /// Pieces fixed to a buoy's float.
    pub pieces: Vec<BuoyPiece>,
    /// Additional points for lines on a trap, buoy or anchor.
    pub points: Vec<Point>,
    /// Its place.
    pub place: Place,
}

impl Entry {
    /// A figure by its key.
    pub fn figure(&self, key: &str) -> Option<&Figure> {
        self.figures.iter().find(|(field, _)| field.key == key).map(|(_, figure)| figure)
    }

    /// The SI value of a figure by its key.
    pub fn value(&self, key: &str) -> Option<f64> {
        self.figure(key).map(|figure| figure.value)
    }

    /// A text by its key.
    pub fn word(&self, key: &str) -> Option<&At<String>> {
        self.words.iter().find(|(name, _)| *name == key).map(|(_, word)| word)
    }
}

/// Reads the heading of a file: format, kind, name, notes; returns name, notes, and source and confidence.
pub fn header(
    fields: &Fields<'_>,
    word: &str,
    problems: &Problems,
) -> (String, String, Provenance) {
    match fields.count("format", &limits::FORMAT) {
        Some(format) if format.value > FORMAT => {
            let help = format!("this program reads format {FORMAT}; open it with a newer one");
            problems.push(
                format
                    .place
                    .error(format!("format {} is newer than this program", format.value), help),
            );
        }
        Some(_) => {}
        None if fields.get("format").is_none() => {
            fields.missing("format", format!("write format = {FORMAT}"))
        }
        None => {}
    }
    if fields
        .need_text("kind", &format!("write kind = \"{word}\""))
        .is_some_and(|kind| kind.value != word)
    {
        fields.word("kind", &[word]);
    }
    let name = fields
        .need_text("name", "write a name in quotes")
        .map(|name| name.value)
        .unwrap_or_default();
    let notes = fields.text("notes").map(|notes| notes.value).unwrap_or_default();
    (name, notes, provenance(fields))
}

/// Reads the texts and figures of a kind; problems are reported.
pub fn body(
    fields: &Fields<'_>,
    kind: Kind,
    head: (String, String, Provenance),
    id: &str,
) -> Entry {
    let (name, notes, file) = head;
    let mut words = Vec::new();
    for word in kind.words() {
        let text = fields.need_text(word.key, word.help);
        let text = if word.allowed.is_empty() { text } else { fields.word(word.key, word.allowed) };
        words.extend(text.map(|text| (word.key, text)));
    }
    let (path, place) = (fields.place.source.path.clone(), fields.place.clone());
    let points = if matches!(kind, Kind::Trap | Kind::Buoy | Kind::Anchor) {
        points(fields, &file)
    } else {
        Vec::new()
    };
    let pieces = if kind == Kind::Buoy { pieces(fields, &file) } else { Vec::new() };
    Entry {
        kind,
        id: id.to_owned(),
        path,
        name,
        notes,
        words,
        figures: figures(fields, kind.fields(), &file),
        pieces,
        points,
        place,
    }
}

/// Optional tables; a present one must be complete.
const OPTIONAL_TABLES: [&str; 2] = ["mass", "age"];

/// Reads figures in the order of the schema; `head.mouth` is read from the table `head`.
fn figures(
    fields: &Fields<'_>,
    schema: &'static [Field],
    file: &Provenance,
) -> Vec<(&'static Field, Figure)> {
    let mut read = Vec::new();
    let mut open: Option<(&str, Option<Fields<'_>>)> = None;
    for field in schema {
        let Some((table, key)) = field.key.split_once('.') else {
            read.extend(one(fields, field, field.key, file).map(|figure| (field, figure)));
            continue;
        };
        if open.as_ref().is_none_or(|(name, _)| *name != table) {
            close(open.take(), fields);
            open = Some((table, fields.table(table)));
        }
        if let Some((_, Some(inner))) = &open {
            read.extend(one(inner, field, key, file).map(|figure| (field, figure)));
        }
    }
    close(open, fields);
    read
}

fn one(
    fields: &Fields<'_>,
    field: &'static Field,
    key: &'static str,
    file: &Provenance,
) -> Option<Figure> {
    if field.needed && fields.get(key).is_none() {
        fields.missing(key, format!("{}: {}", field.help, field.quantity.expected()));
    }
    fields.figure(key, field.quantity, field.range, file)
}

fn close(open: Option<(&str, Option<Fields<'_>>)>, outer: &Fields<'_>) {
    match open {
        Some((_, Some(inner))) => inner.finish(),
        Some((table, None)) if !OPTIONAL_TABLES.contains(&table) => {
            outer.missing(table, format!("write a table [{table}]"))
        }
        _ => {}
    }
}

/// Reads a whole file of figures; unknown keys are reported.
pub fn read(node: &Node, kind: Kind, id: &str, problems: &Problems) -> Entry {
    let fields = Fields::of(node, problems);
    let head = header(&fields, kind.word(), problems);
    let entry = body(&fields, kind, head, id);
    fields.finish();
    entry
}

/// The key of the confidence in older files.
pub(crate) const FORMER_CONFIDENCE: &str = "sureness";

/// Confidence in a figure or distribution, from high to low.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "snake_case")]
pub enum Confidence {
    /// Measured, or stated as measured by its source.
    Measured,
    /// Published by a maker, a dealer or a handbook, which does not describe the measurement.
    Catalogue,
    /// Computed from measured figures.
    Derived,
    /// An engineering estimate, from similar cases.
    Estimate,
    /// Assumed, without measurement or source.
    Assumed,
}

impl Confidence {
    /// All levels, from high to low.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Words of figures; an assumption has no source, which a figure needs.
    pub(crate) const OF_FIGURES: [&'static str; 4] =
        ["measured", "catalogue", "derived", "estimate"];

    /// Words of distributions.
    pub(crate) const OF_PRIORS: [&'static str; 5] =
        ["measured", "catalogue", "derived", "estimate", "assumed"];

    /// Its word in files.
    pub fn word(self) -> &'static str {
        self.into()
    }

    /// The level of a word.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|confidence| confidence.word() == word)
    }
}
