//! The moments of a run as tables for programs that analyse data: each a file, as Parquet, Arrow or comma-separated values.
//!
//! | table | rows |
//! |---|---|
//! | `nodes` | every node of every line, at every moment |
//! | `segments` | every segment of every line |
//! | `bodies` | every body: traps, buoys, anchors |
//! | `whale` | the whale, where the scenario has one |
//! | `contacts` | every place where rope presses on skin |
//! | `probes` | the moments, with a column for each probe, where the scenario has one |
//! | `columns` | unit and meaning of every column of the others |
//!
//! Units are SI and stand in the names. x points east, y north, z up; z = 0 is the mean sea surface.
//!
//! Arrow files have the IPC file format, also called Feather 2, uncompressed, so that a program maps them into memory.
//! Equal tables give equal bytes. Format: <https://arrow.apache.org/docs/format/Columnar.html>

use std::collections::HashMap;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use arrow_array::builder::StringDictionaryBuilder;
use arrow_array::types::Int32Type;
use arrow_array::{ArrayRef, BooleanArray, Float64Array, Int64Array, RecordBatch};
use arrow_ipc::writer::FileWriter;
use arrow_schema::{ArrowError, Field, Schema};
use endline_sim::metrics::{reading, unit as probe_unit};
use endline_sim::model::Probe;
use endline_sim::state::State;
use endline_sim::{ContactPoint, DQuat, DVec3, Frame, Model};

use crate::save;
use crate::table::{Column, Table, parquet};

/// Format of tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableFormat {
    /// Apache Parquet; texts by dictionary, zstd inside.
    Parquet,
    /// Apache Arrow; texts by dictionary, uncompressed.
    Arrow,
    /// Comma-separated values, RFC 4180.
    Csv,
}

/// The moments of a run.
#[derive(Clone, Copy)]
pub struct Moments<'a> {
    /// Its model.
    pub model: &'a Model,
    /// Its moments.
    pub frames: &'a [Arc<Frame>],
    /// The readings of the probes at each of them, from [`readings`].
    pub readings: &'a [Vec<f64>],
}

/// The readings of all probes in a state.
pub fn readings(model: &Model, state: &State) -> Vec<f64> {
    model.spec.probes.iter().map(|probe| reading(model, state, probe.target)).collect()
}

/// A table that is written, with the unit and meaning of its columns.
struct RunTable {
    name: &'static str,
    columns: Vec<TableColumn>,
}

/// Name, unit, meaning and values of a column.
type TableColumn = (&'static str, &'static str, &'static str, Column);

/// Writes all tables of a run's moments into a folder; `about` names the run and the program. Returns the number of rows of each.
pub fn write(
    folder: &Path,
    format: TableFormat,
    moments: &Moments<'_>,
    about: &[(String, String)],
) -> Result<Vec<(&'static str, usize)>, String> {
    let &Moments { model, frames, .. } = moments;
    std::fs::create_dir_all(folder)
        .map_err(|error| format!("{}: cannot be made: {error}", folder.display()))?;
    let tables = [
        nodes(model, frames),
        segments(model, frames),
        bodies(model, frames),
        whale(frames),
        contacts(model, frames),
    ];
    let probes = probes(moments);
    let columns = ("columns", columns(&tables, &probes), about.to_vec());
    let tables = tables.into_iter().map(|table| table.with_tags(about));
    let probes = (!probes.is_empty()).then(|| probes_with_tags(moments, probes, about));
    let mut rows = Vec::new();
    for (name, table, tags) in tables.chain(probes).chain([columns]) {
        let (ending, bytes) = match format {
            TableFormat::Csv => ("csv", table.csv().into_bytes()),
            TableFormat::Parquet => {
                let bytes = parquet::write(&table, &tags);
                ("parquet", bytes.map_err(|error| format!("{name}: {error}"))?)
            }
            TableFormat::Arrow => {
                let bytes = arrow(&table, &tags);
                ("arrow", bytes.map_err(|error| format!("{name}: {error}"))?)
            }
        };
        let file = folder.join(format!("{name}.{ending}"));
        save::atomically(&file, &bytes)
            .map_err(|error| format!("{}: cannot be written: {error}", file.display()))?;
        rows.push((name, table.rows()));
    }
    Ok(rows)
}

impl RunTable {
    /// Name, table, and the file's metadata: the run, and the units and meanings of its columns.
    fn with_tags(self, about: &[(String, String)]) -> (&'static str, Table, Vec<(String, String)>) {
        let (mut columns, mut tags) = (Vec::new(), about.to_vec());
        for (name, unit, meaning, column) in self.columns {
            tags.push((format!("{name}.unit"), unit.to_owned()));
            tags.push((format!("{name}.meaning"), meaning.to_owned()));
            columns.push((name.to_owned(), column));
        }
        (self.name, Table { columns }, tags)
    }
}

/// A column of the table of probes: name, unit, meaning and values.
struct ProbeColumn {
    name: String,
    unit: &'static str,
    meaning: String,
    values: Column,
}

/// A column for each probe.
fn probes(moments: &Moments<'_>) -> Vec<ProbeColumn> {
    let of = |(place, probe): (usize, &Probe)| {
        let unit = probe_unit(probe.target);
        ProbeColumn {
            name: format!("{}_{}", probe.id, unit.replace('/', "_")),
            unit,
            meaning: format!("reading of the probe `{}`", probe.id),
            values: reals(moments.readings.iter().map(|of_moment| of_moment[place])),
        }
    };
    moments.model.spec.probes.iter().enumerate().map(of).collect()
}

/// The table of probes with the metadata of its file.
fn probes_with_tags(
    moments: &Moments<'_>,
    probes: Vec<ProbeColumn>,
    about: &[(String, String)],
) -> (&'static str, Table, Vec<(String, String)>) {
    let columns = vec![time(moments.frames, |_| 1)];
    let (name, mut table, mut tags) = RunTable { name: "probes", columns }.with_tags(about);
    for ProbeColumn { name, unit, meaning, values } in probes {
        tags.push((format!("{name}.unit"), unit.to_owned()));
        tags.push((format!("{name}.meaning"), meaning));
        table.columns.push((name, values));
    }
    (name, table, tags)
}

/// The table of all columns, with units and meanings.
fn columns(tables: &[RunTable], probes: &[ProbeColumn]) -> Table {
    let of_tables = tables.iter().flat_map(|table| {
        table.columns.iter().map(|(name, unit, meaning, _)| [table.name, *name, *unit, *meaning])
    });
    let (name, unit, meaning, _) = time(&[], |_| 0);
    let of_time = (!probes.is_empty()).then_some(["probes", name, unit, meaning]);
    let of_probes = probes.iter().map(|ProbeColumn { name, unit, meaning, .. }| {
        ["probes", name.as_str(), *unit, meaning.as_str()]
    });
    let all: Vec<[&str; 4]> = of_tables.chain(of_time).chain(of_probes).collect();
    let texts = |place: usize| Column::Text(all.iter().map(|row| row[place].to_owned()).collect());
    let heads = ["table", "column", "unit", "meaning"].into_iter().enumerate();
    Table { columns: heads.map(|(place, head)| (head.to_owned(), texts(place))).collect() }
}

fn nodes(model: &Model, frames: &[Arc<Frame>]) -> RunTable {
    let at = of_lines(model, &model.line_nodes);
    let places = || frames.iter().flat_map(|frame| frame.nodes.iter().copied());
    let [x, y, z] = axes(places);
    let node = wholes(frames, &at, |(_, place)| *place);
    RunTable {
        name: "nodes",
        columns: vec![
            time(frames, |_| at.len()),
            ("line", "", "id of the line", texts(frames, &at, |(line, _)| line.clone())),
            ("node", "", "place along the line, 0 at its beginning", node),
            ("x_m", "m", "east", x),
            ("y_m", "m", "north", y),
            ("z_m", "m", "up, from the mean sea surface", z),
        ],
    }
}

fn segments(model: &Model, frames: &[Arc<Frame>]) -> RunTable {
    let at = of_lines(model, &model.line_segments);
    let meaning = "place along the line, from node of the same number to the next";
    let segment = wholes(frames, &at, |(_, place)| *place);
    let tension = reals(frames.iter().flat_map(|frame| frame.tension_n.iter().copied()));
    let length = reals(frames.iter().flat_map(|frame| frame.segment_length_m.iter().copied()));
    let is_cut = Column::Flag(frames.iter().flat_map(|frame| frame.cut.iter().copied()).collect());
    RunTable {
        name: "segments",
        columns: vec![
            time(frames, |_| at.len()),
            ("line", "", "id of the line", texts(frames, &at, |(line, _)| line.clone())),
            ("segment", "", meaning, segment),
            ("tension_N", "N", "tension; none in slack rope", tension),
            ("length_m", "m", "unstretched length", length),
            ("is_cut", "", "whether it has parted", is_cut),
        ],
    }
}

fn bodies(model: &Model, frames: &[Arc<Frame>]) -> RunTable {
    let ids: Vec<String> = model.spec.bodies.iter().map(|body| body.id.clone()).collect();
    let all = || frames.iter().flat_map(|frame| frame.bodies.iter());
    let [x, y, z] = axes(|| all().map(|body| body.0));
    let turned = turns(|| all().map(|body| body.1));
    let mut columns = vec![
        time(frames, |_| ids.len()),
        ("body", "", "id of the body", texts(frames, &ids, String::clone)),
        ("x_m", "m", "east", x),
        ("y_m", "m", "north", y),
        ("z_m", "m", "up, from the mean sea surface", z),
    ];
    columns.extend(turned);
    RunTable { name: "bodies", columns }
}

fn whale(frames: &[Arc<Frame>]) -> RunTable {
    let all = || frames.iter().filter_map(|frame| frame.whale.as_ref());
    let [x, y, z] = axes(|| all().map(|whale| whale.position));
    let turned = turns(|| all().map(|whale| whale.orientation));
    let mut columns = vec![
        time(frames, |frame| usize::from(frame.whale.is_some())),
        ("x_m", "m", "east, of the origin of the whale's axes", x),
        ("y_m", "m", "north", y),
        ("z_m", "m", "up, from the mean sea surface", z),
        ("speed_m_s", "m/s", "speed through the water", reals(all().map(|whale| whale.speed_m_s))),
    ];
    columns.extend(turned);
    RunTable { name: "whale", columns }
}

fn contacts(model: &Model, frames: &[Arc<Frame>]) -> RunTable {
    let all = || frames.iter().flat_map(|frame| &frame.contacts);
    let [x, y, z] = axes(|| all().map(|at| at.position));
    let [nx, ny, nz] = axes(|| all().map(|at| at.normal));
    let [fx, fy, fz] = axes(|| all().map(|at| at.friction_n));
    let line = |at: &ContactPoint| model.spec.lines[at.line].id.clone();
    let place = |at: &ContactPoint| whole(at.segment - model.line_segments[at.line].start);
    let segment = Column::Whole(all().map(place).collect());
    let region = Column::Text(all().map(|at| at.region.name().to_owned()).collect());
    let [force, length] =
        [reals(all().map(|at| at.normal_force_n)), reals(all().map(|at| at.length_m))];
    RunTable {
        name: "contacts",
        columns: vec![
            time(frames, |frame| frame.contacts.len()),
            ("line", "", "id of the line", Column::Text(all().map(line).collect())),
            ("segment", "", "place of the segment along the line", segment),
            ("region", "", "region of the skin", region),
            ("x_m", "m", "east", x),
            ("y_m", "m", "north", y),
            ("z_m", "m", "up, from the mean sea surface", z),
            ("normal_x", "", "unit vector from skin to rope", nx),
            ("normal_y", "", "unit vector from skin to rope", ny),
            ("normal_z", "", "unit vector from skin to rope", nz),
            ("normal_force_N", "N", "force of skin on rope along the normal", force),
            ("friction_x_N", "N", "friction force of skin on rope", fx),
            ("friction_y_N", "N", "friction force of skin on rope", fy),
            ("friction_z_N", "N", "friction force of skin on rope", fz),
            ("length_m", "m", "length of rope that it stands for", length),
        ],
    }
}

/// Line and place along it of every node, or segment, in the order of a frame.
fn of_lines(model: &Model, ranges: &[Range<usize>]) -> Vec<(String, i64)> {
    let lines = model.spec.lines.iter().zip(ranges);
    lines
        .flat_map(|(line, range)| (0..range.len()).map(|place| (line.id.clone(), whole(place))))
        .collect()
}

/// The time of every row; `rows` of each moment.
fn time(frames: &[Arc<Frame>], rows: impl Fn(&Frame) -> usize) -> TableColumn {
    let times = frames.iter().flat_map(|frame| std::iter::repeat_n(frame.time_s, rows(frame)));
    ("time_s", "s", "simulated time", reals(times))
}

fn texts<T>(frames: &[Arc<Frame>], of: &[T], text: impl Fn(&T) -> String) -> Column {
    Column::Text(frames.iter().flat_map(|_| of.iter().map(&text)).collect())
}

fn wholes<T>(frames: &[Arc<Frame>], of: &[T], number: impl Fn(&T) -> i64) -> Column {
    Column::Whole(frames.iter().flat_map(|_| of.iter().map(&number)).collect())
}

fn reals(numbers: impl Iterator<Item = f64>) -> Column {
    Column::Real(numbers.map(Some).collect())
}

fn axes<I: Iterator<Item = DVec3>>(all: impl Fn() -> I) -> [Column; 3] {
    [0, 1, 2].map(|axis| reals(all().map(move |at| at[axis])))
}

/// Columns of the quaternion that turns a body's axes to those of the world.
fn turns<I: Iterator<Item = DQuat>>(all: impl Fn() -> I) -> [TableColumn; 4] {
    let meaning = "quaternion from the body's axes to the world's";
    let part = |part: usize| reals(all().map(move |turn| turn.to_array()[part]));
    [("qx", 0), ("qy", 1), ("qz", 2), ("qw", 3)]
        .map(|(name, place)| (name, "", meaning, part(place)))
}

fn whole(number: usize) -> i64 {
    i64::try_from(number).unwrap_or(i64::MAX)
}

/// The bytes of a file. The tag `c.unit` stands with column `c` under the name `unit`, and so for every other tag of a
/// column; the other tags stand with the table.
fn arrow(table: &Table, tags: &[(String, String)]) -> Result<Vec<u8>, ArrowError> {
    let (mut fields, mut arrays) = (Vec::new(), Vec::new());
    for (name, column) in &table.columns {
        let array = array(column)?;
        let may_lack = matches!(column, Column::Real(_));
        let field = Field::new(name, array.data_type().clone(), may_lack);
        let own =
            |(key, text): &(String, String)| Some((about(name, key)?.to_owned(), text.clone()));
        fields.push(field.with_metadata(tags.iter().filter_map(own).collect::<HashMap<_, _>>()));
        arrays.push(array);
    }
    let of_one = |key: &str| table.columns.iter().any(|(name, _)| about(name, key).is_some());
    let of_table: HashMap<_, _> = tags.iter().filter(|(key, _)| !of_one(key)).cloned().collect();
    let schema = Arc::new(Schema::new_with_metadata(fields, of_table));
    let batch = RecordBatch::try_new(Arc::clone(&schema), arrays)?;
    let mut file = FileWriter::try_new(Vec::new(), &schema)?;
    file.write(&batch)?;
    file.into_inner()
}

/// The values of a column; texts by dictionary.
fn array(column: &Column) -> Result<ArrayRef, ArrowError> {
    Ok(match column {
        Column::Whole(values) => Arc::new(Int64Array::from(values.clone())),
        Column::Real(values) => Arc::new(Float64Array::from(values.clone())),
        Column::Flag(values) => Arc::new(BooleanArray::from(values.clone())),
        Column::Text(values) => {
            let mut texts = StringDictionaryBuilder::<Int32Type>::new();
            for text in values {
                texts.append(text)?;
            }
            Arc::new(texts.finish())
        }
    })
}

/// What a tag describes of a column, as `unit` of `x_m.unit`; none where it describes something else.
fn about<'a>(name: &str, key: &'a str) -> Option<&'a str> {
    key.strip_prefix(name)?.strip_prefix('.')
}

#[cfg(test)]
mod tests {
    use arrow_array::cast::AsArray;
    use arrow_array::types::Float64Type;
    use arrow_array::{Array, StringArray};
    use arrow_ipc::reader::FileReader;

    use super::*;

    #[test]
    fn a_table_comes_back_with_its_units_and_its_bytes_are_its_own() {
        let texts = ["top", "bottom", "top", ""].map(str::to_owned);
        let numbers = vec![Some(1.5), None, Some(-0.0), Some(f64::MIN_POSITIVE)];
        let table = Table {
            columns: vec![
                ("node".to_owned(), Column::Whole(vec![0, -1, i64::MAX, 3])),
                ("tension_N".to_owned(), Column::Real(numbers.clone())),
                ("line".to_owned(), Column::Text(texts.to_vec())),
                ("is_cut".to_owned(), Column::Flag(vec![true, false, false, true])),
            ],
        };
        let tags =
            [("tension_N.unit", "N"), ("tension_N.meaning", "tension"), ("program", "endline")]
                .map(|(key, text)| (key.to_owned(), text.to_owned()));
        let bytes = arrow(&table, &tags).unwrap();
        assert_eq!(bytes, arrow(&table, &tags).unwrap());

        let mut file = FileReader::try_new(std::io::Cursor::new(bytes), None).unwrap();
        let schema = file.schema();
        assert_eq!(
            schema.metadata(),
            &HashMap::from([("program".to_owned(), "endline".to_owned())])
        );
        let field = schema.field_with_name("tension_N").unwrap();
        assert_eq!(field.metadata().get("unit").map(String::as_str), Some("N"));
        assert_eq!(field.metadata().len(), 2);
        let batch = file.next().unwrap().unwrap();
        let read: Vec<_> = batch["tension_N"].as_primitive::<Float64Type>().iter().collect();
        assert_eq!(
            read.iter().map(|number| number.map(f64::to_bits)).collect::<Vec<_>>(),
            numbers.iter().map(|number| number.map(f64::to_bits)).collect::<Vec<_>>()
        );
        let lines = batch["line"].as_dictionary::<Int32Type>();
        let lines = lines.downcast_dict::<StringArray>().unwrap();
        assert_eq!(lines.values().len(), 3, "each text stands once");
        assert!(lines.into_iter().map(Option::unwrap).eq(texts.iter().map(String::as_str)));
        assert_eq!(batch.num_rows(), 4);
        assert!(file.next().is_none());
    }
}
