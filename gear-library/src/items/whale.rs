//! A whale of the library: its form, growth and skin.
//!
//! The skin is built from the measures, or read from a mesh beside the file: `mesh = "my-whale.glb"`.

use std::sync::Arc;

use endline_sdk::SPINE_JOINTS;
use endline_sim::DVec3;
use endline_sim::whale::Skin;
use serde::de::DeserializeOwned;
use serde::de::value::MapDeserializer;

use crate::diagnostic::At;
use crate::entry::{self, Entry};
use crate::fields::{Fields, Figure, Problems, Provenance, Range, provenance_over, read_figure};
use crate::schema::Kind;
use crate::sources::Sources;
use crate::tree::{Content, Node};
use crate::units::Quantity;
use crate::whale::{Station, WhaleForm, gltf, scaled, skin_of};

use super::{Joints, gltf_beside};

/// Density of a neutrally buoyant whale [kg/m³].
const SEA_WATER_KG_M3: f64 = 1025.0;

/// A whale: its figures and its form.
#[derive(Clone, Debug, PartialEq)]
pub struct WhaleItem {
    /// Its file.
    pub entry: Entry,
    /// Form at its own length, in average condition.
    pub form: WhaleForm,
    /// Growth laws.
    pub growth: Growth,
    shares: WhaleForm,
    /// Figures of the body sections: at, width, dorsal, ventral of each.
    pub sections: Vec<[Figure; 4]>,
    /// Mass over displaced volume [kg/m³].
    pub density_kg_m3: f64,
    /// Joint ranges.
    pub joints: Joints,
    /// Its own mesh, which replaces the one built from its measures.
    pub mesh: Option<WhaleMesh>,
    /// Greatest speed it can swim [m/s].
    pub burst_speed_m_s: f64,
    /// Stiffness of skin and blubber under rope, by length of rope [N/m²].
    pub contact_stiffness_n_m2: f64,
}

impl WhaleItem {
    /// Reads a whale's file; `None` if a figure is missing, which is reported.
    pub(crate) fn read(node: &Node, id: &str, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let head = entry::header(&fields, Kind::Whale.word(), problems);
        let file = head.2.clone();
        let entry = entry::body(&fields, Kind::Whale, head, id);
        let sections = sections(&fields, &file);
        let spine = spine(&fields, &file);
        let joints = Joints::read(&fields, &file);
        let mesh = WhaleMesh::read(&fields);
        fields.finish();
        let sections = sections?;
        let shares = form(&entry, &sections, spine?)?;
        let growth = Growth::of(&entry);
        if growth.mass.is_none() && entry.value("breadth_scale").is_none() {
            let help = "write [mass] with `length`, `mass` and `exponent`, from which the breadth follows, or `breadth_scale`";
            problems.push(node.place.error("both `mass` and `breadth_scale` are missing", help));
        }
        let density_kg_m3 = entry.value("density").unwrap_or(SEA_WATER_KG_M3);
        Some(Self {
            form: grown(&shares, &growth, density_kg_m3, shares.length_m),
            growth,
            shares,
            density_kg_m3,
            joints: joints?,
            mesh,
            burst_speed_m_s: entry.value("burst_speed")?,
            contact_stiffness_n_m2: entry.value("contact_stiffness")?,
            sections,
            entry,
        })
    }

    /// Form at another length, in average condition.
    pub fn form_at(&self, length_m: f64) -> WhaleForm {
        grown(&self.shares, &self.growth, self.density_kg_m3, length_m)
    }

    /// Port eye of the straight whale at a length, in its frame: at the corner of the mouth, at half the width of that section and at the level
    /// of the snout; an estimate [m].
    pub fn eye_m(&self, length_m: f64) -> DVec3 {
        let mut form = WhaleForm { length_m, ..self.shares.clone() };
        self.growth.proportion(&mut form);
        let at = form.head.mouth;
        length_m * DVec3::new(0.5 - at, 0.5 * width_at(&form.stations, at), 0.0)
    }
}

/// Form at a length: edges and callosities scale with it; head and mass follow their own laws.
fn grown(shares: &WhaleForm, growth: &Growth, density_kg_m3: f64, length_m: f64) -> WhaleForm {
    let scale = length_m / shares.length_m;
    let mut form = shares.clone();
    form.length_m = length_m;
    form.flippers.edge_radius_m *= scale;
    form.flukes.edge_radius_m *= scale;
    form.head.callosity_m *= scale;
    growth.proportion(&mut form);
    match &growth.mass {
        Some(law) => form.displacing(law.mass_kg(length_m) / density_kg_m3),
        None => form,
    }
}

/// The rows of `[sections]`, from snout to notch.
fn sections(fields: &Fields<'_>, file: &Provenance) -> Option<Vec<[Figure; 4]>> {
    let help = "write at least four body sections as rows of [sections], such as { at = 0.1, width = 0.149, dorsal = 0.063, ventral = -0.060 }";
    let Some(table) = fields.table("sections") else {
        fields.missing("sections", help);
        return None;
    };
    let of_all = provenance_over(&table, file);
    let count = table.tables("rows").len();
    let sections = table.each("rows", |row| section(row, &of_all));
    table.finish();
    if count < 4 {
        table.missing("rows", help);
    }
    if count < 4 || sections.len() < count {
        return None;
    }
    for pair in sections.windows(2).filter(|pair| pair[1][0].value <= pair[0][0].value) {
        let place = &pair[1][0].place;
        fields.problems().push(place.error(
            "body sections are not in rising order of `at`",
            "put them in order from snout to fluke notch",
        ));
    }
    Some(sections)
}

fn section(fields: &Fields<'_>, file: &Provenance) -> Option<[Figure; 4]> {
    let row = provenance_over(fields, file);
    let ratio = |key: &'static str, range| {
        fields.require(key, "expected a share of body length, such as 0.149");
        fields.figure(key, Quantity::Ratio, range, &row)
    };
    let at = ratio("at", Range::Between(0.0, 1.0));
    let width = ratio("width", Range::Between(0.0, 1.0));
    let dorsal = ratio("dorsal", Range::Between(-0.5, 0.5));
    let ventral = ratio("ventral", Range::Between(-0.5, 0.5));
    if let (Some(dorsal), Some(ventral)) = (&dorsal, &ventral)
        && ventral.value > dorsal.value
    {
        fields.problems().push(ventral.place.error(
            "`ventral` is above `dorsal`",
            "heights are measured from the level of the snout, and the belly is lower than the back",
        ));
    }
    Some([at?, width?, dorsal?, ventral?])
}

/// Reads the places of the spine joints.
fn spine(fields: &Fields<'_>, file: &Provenance) -> Option<[f64; SPINE_JOINTS]> {
    let help = format!(
        "write [spine] with `joints`, {SPINE_JOINTS} shares of length from the neck aft, and their source and confidence"
    );
    let Some(spine) = fields.table("spine") else {
        fields.missing("spine", help);
        return None;
    };
    let row = provenance_over(&spine, file);
    let joints = spine_joints(spine.get("joints"), &row, &spine, help);
    spine.finish();
    joints
}

fn spine_joints(
    joints: Option<&Node>,
    row: &Provenance,
    spine: &Fields<'_>,
    help: String,
) -> Option<[f64; SPINE_JOINTS]> {
    let Some(Node { content: Content::List(items), place }) = joints else {
        spine.missing("joints", help);
        return None;
    };
    let read: Vec<_> = items
        .iter()
        .map(|item| {
            read_figure(item, Quantity::Ratio, Range::Between(0.0, 1.0), row, spine.problems())
        })
        .collect();
    let values: Vec<f64> =
        read.into_iter().map(|figure| figure.map(|figure| figure.value)).collect::<Option<_>>()?;
    let rising = values.windows(2).all(|pair| pair[1] > pair[0]);
    match values.try_into() {
        Ok(joints) if rising => Some(joints),
        _ => spine.refuse(place.error("`joints` is not a rising list of the right length", help)),
    }
}

fn form(
    entry: &Entry,
    sections: &[[Figure; 4]],
    spine_joints: [f64; SPINE_JOINTS],
) -> Option<WhaleForm> {
    let value = |key| entry.value(key);
    let station = |[at, width, dorsal, ventral]: &[Figure; 4]| Station {
        at: at.value,
        width: width.value,
        dorsal: dorsal.value,
        ventral: ventral.value,
    };
    Some(WhaleForm {
        length_m: value("length")?,
        stations: sections.iter().map(station).collect(),
        breadth_scale: value("breadth_scale").unwrap_or(1.0),
        girth: vec![[0.0, 1.0]],
        head: table(entry, "head")?,
        peduncle_start: value("peduncle_start")?,
        spine_joints,
        flippers: table(entry, "flippers")?,
        flukes: table(entry, "flukes")?,
    })
}

/// The figures of a table of the file, such as `flippers.span`, as the fields of a type.
fn table<T: DeserializeOwned>(entry: &Entry, name: &str) -> Option<T> {
    let key = |key: &'static str| key.strip_prefix(name)?.strip_prefix('.');
    let figures = entry.figures.iter();
    let fields = figures.filter_map(|(field, figure)| Some((key(field.key)?, figure.value)));
    T::deserialize(MapDeserializer::<_, serde::de::value::Error>::new(fields)).ok()
}

/// Laws of growth of a whale of the library.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Length added to the mouth's share of body length [m].
    pub mouth_offset_m: f64,
    /// Length added to the baleen's share of body length [m].
    pub baleen_offset_m: f64,
    /// Width of the head at a tenth of length: share of length, and an added length [m].
    pub head_width: Option<[f64; 2]>,
    /// Mass by length; without it `breadth_scale` applies.
    pub mass: Option<MassLaw>,
    /// Length by age.
    pub age: Option<AgeLaw>,
}

/// `M = mass (L / length)^exponent` of a whale in average condition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassLaw {
    /// Reference length [m].
    pub length_m: f64,
    /// Mass at the reference length [kg].
    pub mass_kg: f64,
    /// Exponent of length [1].
    pub exponent: f64,
}

/// `L = at_one + per_tenfold log10(age)` from one year on, linear from the length at birth before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AgeLaw {
    /// Length at birth [m].
    pub birth_m: f64,
    /// Length at one year [m].
    pub at_one_m: f64,
    /// Growth per tenfold age [m].
    pub per_tenfold_m: f64,
}

/// Shortest baleen, that of a newborn calf [share of length].
const LEAST_BALEEN: f64 = 0.03;
/// Transition from the width of the head to that of the table [share of length].
const HEAD_WIDTH: [f64; 2] = [0.1, 0.3];
/// A year [s].
pub(crate) const YEAR_S: f64 = 365.25 * 86_400.0;

impl Growth {
    /// The laws of a checked file.
    pub(crate) fn of(entry: &Entry) -> Self {
        let value = |key: &str| entry.value(key);
        let all =
            |[one, two, three]: [&'static str; 3]| Some([value(one)?, value(two)?, value(three)?]);
        Self {
            mouth_offset_m: value("head.mouth_offset").unwrap_or(0.0),
            baleen_offset_m: value("head.baleen_offset").unwrap_or(0.0),
            head_width: value("head.width")
                .map(|share| [share, value("head.width_offset").unwrap_or(0.0)]),
            mass: all(["mass.length", "mass.mass", "mass.exponent"])
                .map(|[length_m, mass_kg, exponent]| MassLaw { length_m, mass_kg, exponent }),
            age: all(["age.birth", "age.one_year", "age.tenfold"]).map(
                |[birth_m, at_one_m, per_tenfold_m]| AgeLaw { birth_m, at_one_m, per_tenfold_m },
            ),
        }
    }

    /// Applies the growth laws to a form whose measures are shares of its length.
    pub(crate) fn proportion(&self, form: &mut WhaleForm) {
        let length_m = form.length_m;
        form.head.mouth = (form.head.mouth + self.mouth_offset_m / length_m).clamp(0.08, 0.4);
        form.head.baleen = (form.head.baleen + self.baleen_offset_m / length_m)
            .max(LEAST_BALEEN.min(form.head.baleen));
        if let Some([share, offset_m]) = self.head_width {
            let wide = share + offset_m / length_m;
            let table = width_at(&form.stations, HEAD_WIDTH[0]);
            let factor = (wide / table.max(1e-6)).clamp(0.5, 1.5);
            for station in &mut form.stations {
                let [from, to] = HEAD_WIDTH;
                let left = ((to - station.at) / (to - from)).clamp(0.0, 1.0);
                station.width *= 1.0 + (factor - 1.0) * left;
            }
        }
    }
}

impl MassLaw {
    /// Mass of a whale in average condition [kg].
    pub fn mass_kg(&self, length_m: f64) -> f64 {
        self.mass_kg * libm::pow(length_m / self.length_m, self.exponent)
    }
}

impl AgeLaw {
    /// Length at an age [m].
    pub fn length_m(&self, age_s: f64) -> f64 {
        let years = age_s / YEAR_S;
        if years < 1.0 {
            self.birth_m + (self.at_one_m - self.birth_m) * years.max(0.0)
        } else {
            self.at_one_m + self.per_tenfold_m * libm::log10(years)
        }
    }
}

/// Width by linear interpolation in the table [share of length].
fn width_at(stations: &[Station], at: f64) -> f64 {
    let between = stations.windows(2).find(|pair| pair[0].at <= at && at <= pair[1].at);
    between.map_or(0.0, |pair| {
        pair[0].width
            + (pair[1].width - pair[0].width) * (at - pair[0].at) / (pair[1].at - pair[0].at)
    })
}

/// A whale's own mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct WhaleMesh {
    /// Path of its file, relative to the library's folder.
    pub file: At<String>,
    /// Its skin at the whale's own length; `None` until the file has been read.
    pub skin: Option<Arc<Skin>>,
}

impl WhaleMesh {
    /// Reads the key `mesh`.
    pub(super) fn read(fields: &Fields<'_>) -> Option<Self> {
        gltf_beside(fields, "mesh").map(|file| Self { file, skin: None })
    }
}

impl WhaleItem {
    /// Skin at a length [m].
    pub fn skin_at(&self, length_m: f64) -> Skin {
        Arc::unwrap_or_clone(self.skin_for(length_m, 1.0, false))
    }

    /// Skin at a length [m], in a condition (volume over that of average condition), and late in pregnancy or not.
    /// A mesh of its own is only scaled.
    pub fn skin_for(&self, length_m: f64, condition: f64, pregnant: bool) -> Arc<Skin> {
        if let Some(skin) = self.mesh.as_ref().and_then(|mesh| mesh.skin.as_deref()) {
            return Arc::new(scaled(skin, length_m / self.form.length_m));
        }
        let form = self.form_at(length_m).in_condition(condition);
        skin_of(&if pregnant { form.pregnant() } else { form })
    }

    /// Reads its mesh, if it has one; returns false after a failure, which is reported.
    pub(crate) fn load_mesh(&mut self, sources: &Sources, problems: &Problems) -> bool {
        let Some(mesh) = &mut self.mesh else { return true };
        let (path, place) = (&mesh.file.value, &mesh.file.place);
        let Some(bytes) = sources.named_mesh(&mesh.file, problems) else { return false };
        match gltf::read(bytes, &skin_of(&self.form)) {
            Ok(skin) => mesh.skin = Some(Arc::new(skin)),
            Err(faults) => problems.extend(
                faults
                    .into_iter()
                    .map(|fault| place.error(format!("`{path}` {}", fault.message), fault.help)),
            ),
        }
        mesh.skin.is_some()
    }
}
