//! Tables of the library as text: CSV written and read, and cells pasted from a spreadsheet.
//!
//! A column is named by its field's key (`diameter`) or by its heading on screen (`Diameter`), a row
//! by its `id`. Values are as typed, with their unit. Rows and columns that cannot be used are
//! listed in [`Taken::left_out`].

use super::documents::Documents;
use super::figures;
use super::saving::slug;
use endline_gear::{Confidence, Document, Kind, Setting};

/// Columns before the kind's own.
const FIRST: [&str; 2] = ["id", "name"];
/// Text columns after them.
const LAST: [&str; 3] = ["notes", "source", "confidence"];

/// Source of figures that a table changes, until a better one is given.
const FROM_A_TABLE: &str = "taken from a table";

/// The result of reading a table.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Taken {
    /// Entries changed.
    pub changed: usize,
    /// Entries added.
    pub added: usize,
    /// Rows and columns that were left out, each with the reason.
    pub left_out: Vec<String>,
}

impl Taken {
    /// The result in a sentence.
    pub fn sentence(&self) -> String {
        let mut text = format!("{} changed, {} added", self.changed, self.added);
        if !self.left_out.is_empty() {
            text += &format!("; left out: {}", self.left_out.join("; "));
        }
        text
    }
}

/// Keys of a kind's columns, in the order written.
pub fn columns(kind: Kind) -> Vec<&'static str> {
    let words = kind.words().iter().map(|word| word.key);
    let figures = kind.fields().iter().map(|field| field.key);
    FIRST.into_iter().chain(words).chain(figures).chain(LAST).collect()
}

/// A kind's table as CSV, one row for each of `paths`.
pub fn to_csv(documents: &Documents, kind: Kind, paths: &[String]) -> String {
    written(documents, kind, paths, b',')
}

/// A kind's table with tabs between cells, as spreadsheets paste it from the clipboard.
pub fn to_tabs(documents: &Documents, kind: Kind, paths: &[String]) -> String {
    written(documents, kind, paths, b'\t')
}

fn written(documents: &Documents, kind: Kind, paths: &[String], delimiter: u8) -> String {
    let mut writer = csv::WriterBuilder::new().delimiter(delimiter).from_writer(Vec::new());
    let columns = columns(kind);
    let cell = |path: &str, key: &str| {
        if key == "id" {
            id_of(path).to_owned()
        } else {
            documents.field(path, key).unwrap_or_default()
        }
    };
    let mut rows = vec![columns.iter().map(|key| (*key).to_owned()).collect::<Vec<_>>()];
    rows.extend(paths.iter().map(|path| columns.iter().map(|key| cell(path, key)).collect()));
    // Writing to memory cannot fail.
    let written = rows.iter().try_for_each(|row| writer.write_record(row));
    let bytes = written.ok().and_then(|()| writer.into_inner().ok()).unwrap_or_default();
    String::from_utf8(bytes).unwrap_or_default()
}

/// Id of a library file's path.
pub fn id_of(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path).trim_end_matches(".toml")
}

/// Cells of a text from a file or the clipboard: tabs where there are any, else commas or semicolons.
/// Errors: with the line where it is no table.
pub fn cells(text: &str) -> Result<Vec<Vec<String>>, String> {
    let head = text.lines().next().unwrap_or_default();
    let delimiter = [b'\t', b',', b';']
        .into_iter()
        .find(|mark| head.as_bytes().contains(mark))
        .unwrap_or(b'\t');
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(delimiter)
        .from_reader(text.as_bytes());
    let row = |record: Result<csv::StringRecord, csv::Error>| {
        let record = record.map_err(|error| format!("the table cannot be read: {error}"))?;
        Ok(record
            .iter()
            .map(|cell| cell.trim().trim_start_matches('\u{feff}').to_owned())
            .collect())
    };
    reader.records().map(row).collect()
}

/// Whether a first row names columns.
pub fn is_head(kind: Kind, row: &[String]) -> bool {
    row.iter().filter(|cell| key_of(kind, cell).is_some()).count() * 2 > row.len()
}

/// The key that a column's head means.
fn key_of(kind: Kind, head: &str) -> Option<&'static str> {
    let plain = |text: &str| text.to_lowercase().replace([' ', '.', '-'], "_");
    // Older tables call the column `sureness`.
    let head = if plain(head.trim()) == "sureness" { "confidence" } else { head.trim() };
    columns(kind).into_iter().find(|key| plain(key) == plain(head))
}

/// Reads a table with a heading row into the library: a row of a known id (or name) changes that
/// entry, any other row adds one.
/// Errors: where the text is no table or its first row names no known column.
pub fn import(documents: &mut Documents, kind: Kind, text: &str) -> Result<Taken, String> {
    let rows = cells(text)?;
    let (head, body) = rows.split_first().ok_or("the table is empty")?;
    if !is_head(kind, head) {
        return Err(format!(
            "the first row must name the columns, such as {}",
            columns(kind)[..4].join(", ")
        ));
    }
    let keys: Vec<Option<&'static str>> = head.iter().map(|cell| key_of(kind, cell)).collect();
    let mut taken = Taken::default();
    for (cell, _) in head.iter().zip(&keys).filter(|(_, key)| key.is_none()) {
        taken.left_out.push(format!("column `{cell}` is none of {}/", kind.folder()));
    }
    let mut texts: Vec<(String, String)> = Vec::new();
    for (number, row) in
        body.iter().enumerate().filter(|(_, row)| row.iter().any(|cell| !cell.is_empty()))
    {
        let cells: Vec<(&'static str, &str)> = keys
            .iter()
            .zip(row)
            .filter_map(|(key, cell)| Some(((*key)?, cell.as_str())))
            .filter(|(_, cell)| !cell.is_empty())
            .collect();
        match of_row(documents, kind, &cells, &texts) {
            Ok((path, text, known)) => {
                taken.changed += usize::from(known && documents.text(&path) != Some(text.as_str()));
                taken.added += usize::from(!known);
                texts.push((path, text));
            }
            Err(why) => taken.left_out.push(format!("row {}: {why}", number + 2)),
        }
    }
    documents.put_all(texts);
    Ok(taken)
}

/// Path and new text of a row's entry, and whether the entry existed.
fn of_row(
    documents: &Documents,
    kind: Kind,
    cells: &[(&'static str, &str)],
    before: &[(String, String)],
) -> Result<(String, String, bool), String> {
    let cell = |wanted: &str| cells.iter().find(|(key, _)| *key == wanted).map(|(_, cell)| *cell);
    let (id, name) = (cell("id"), cell("name"));
    let by_name = |name: &str| {
        documents
            .files(kind.folder())
            .find(|path| documents.field(path, "name").as_deref() == Some(name))
            .map(str::to_owned)
    };
    let path = match (id, name) {
        (Some(id), _) => format!("{}/{}.toml", kind.folder(), slug(id)),
        (None, Some(name)) => {
            by_name(name).unwrap_or_else(|| format!("{}/{}.toml", kind.folder(), slug(name)))
        }
        (None, None) => return Err("it has neither id nor name".into()),
    };
    if before.iter().any(|(taken, _)| *taken == path) {
        return Err(format!("`{}` is there twice", id_of(&path)));
    }
    let known = documents.text(&path);
    let mut document = match known {
        Some(text) => Document::parse(text),
        None => Document::parse(&fresh(kind, name.or(id).unwrap_or_default())),
    }
    .map_err(|error| error.to_string())?;
    let (source, sure) = provenance(&document, cell("source"), cell("confidence"));
    for (key, cell) in cells.iter().filter(|(key, _)| *key != "id") {
        let same = document.get(key).as_deref() == Some(*cell);
        let figure = kind.fields().iter().any(|field| field.key == *key);
        let written = match (document.has(key), figure) {
            _ if same => Ok(()),
            (true, true) => document.set_figure(key, cell, &source, sure),
            (true, false) => document.set(key, cell),
            (false, true) => document.put(key, &Setting::plain(cell)),
            (false, false) => document.put(key, &Setting::text(cell)),
        };
        written.map_err(|error| format!("{key}: {error}"))?;
    }
    Ok((path.clone(), document.text(), known.is_some()))
}

/// Source of the figures that a row changes: that of the row, unless it repeats the source of the old figures.
fn provenance(
    document: &Document,
    source: Option<&str>,
    confidence: Option<&str>,
) -> (String, Confidence) {
    match source.filter(|source| document.get("source").as_deref() != Some(source)) {
        Some(source) => {
            let sure = confidence.and_then(Confidence::from_word);
            let sure =
                sure.filter(|sure| *sure != Confidence::Assumed).unwrap_or(Confidence::Estimate);
            (source.to_owned(), sure)
        }
        None => (FROM_A_TABLE.to_owned(), Confidence::Estimate),
    }
}

/// The text of a new entry without its figures. Its source is the table, until a better one is given.
fn fresh(kind: Kind, name: &str) -> String {
    let name = name.replace(['"', '\\'], "'");
    format!(
        "format = 1\nkind = \"{}\"\nname = \"{name}\"\nnotes = \"\"\nsource = \"{FROM_A_TABLE}\"\nconfidence = \"estimate\"\n",
        kind.word()
    )
}

/// Writes cells into a table from one cell on: to the right over `keys`, downwards over `paths`.
/// Cells beyond the edges are listed as left out.
/// Errors: where a cell cannot be set; nothing is then changed.
pub fn spread(
    documents: &mut Documents,
    paths: &[String],
    keys: &[&str],
    cells: &[Vec<String>],
) -> Result<Taken, String> {
    let mut taken = Taken::default();
    let mut texts = Vec::new();
    for (path, row) in paths.iter().zip(cells) {
        let mut document = documents.document(path)?;
        for (key, cell) in keys.iter().zip(row).filter(|(_, cell)| !cell.is_empty()) {
            figures::set(&mut document, path, key, cell)
                .map_err(|error| format!("{path}: {key}: {error}"))?;
        }
        taken.changed += usize::from(documents.text(path) != Some(document.text().as_str()));
        texts.push((path.clone(), document.text()));
    }
    if cells.len() > paths.len() {
        taken.left_out.push(format!("{} rows below the table", cells.len() - paths.len()));
    }
    let widest = cells.iter().map(Vec::len).max().unwrap_or(0);
    if widest > keys.len() {
        taken.left_out.push(format!("{} columns right of the table", widest - keys.len()));
    }
    documents.put_all(texts);
    Ok(taken)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spreadsheets_cells_are_read_with_tabs_quotes_and_line_breaks() {
        let rows = cells("id\tname\r\nx\t\"two\nlines\"\r\n").unwrap();
        assert_eq!(
            rows,
            [vec!["id".to_owned(), "name".into()], vec!["x".into(), "two\nlines".into()]]
        );
        assert_eq!(cells("\u{feff}a;b\n1;2").unwrap()[0], ["a", "b"]);
        assert_eq!(cells("\"1,700 lbf\",x").unwrap()[0], ["1,700 lbf", "x"]);
    }

    #[test]
    fn heads_are_known_as_keys_and_as_titles() {
        let head = |cells: &[&str]| {
            is_head(Kind::Rope, &cells.iter().map(|cell| (*cell).to_owned()).collect::<Vec<_>>())
        };
        assert!(head(&["id", "Diameter", "Stretch at break"]));
        assert!(!head(&["3/8 in", "1,700 lbf"]));
    }
}
