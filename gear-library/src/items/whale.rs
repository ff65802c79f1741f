//! A whale of the library.

use endline_sdk::SPINE_JOINTS;

use crate::entry::{self, Entry};
use crate::fields::{Fields, Figure, Problems, Provenance, Range, provenance_over, read_figure};
use crate::items::growth::Growth;
use crate::schema::Kind;
use crate::tree::{Content, Node};
use crate::units::Quantity;
use crate::whale::{FlipperForm, FlukesForm, HeadForm, Station, WhaleForm};

use super::{Joints, WhaleMesh};

/// Density of a whale that neither sinks nor rises [kg/m³].
const SEA_WATER_KG_M3: f64 = 1025.0;

/// A whale: its measures, with source and confidence, and its form.
#[derive(Clone, Debug, PartialEq)]
pub struct WhaleItem {
    /// Its file.
    pub entry: Entry,
    /// Its form at its own length, in middling condition.
    pub form: WhaleForm,
    /// How its body changes with length.
    pub growth: Growth,
    shares: WhaleForm,
    /// Figures of the body sections: at, width, dorsal, ventral of each.
    pub sections: Vec<[Figure; 4]>,
    /// Mass over displaced volume [kg/m³].
    pub density_kg_m3: f64,
    /// How far its joints turn.
    pub joints: Joints,
    /// Its own mesh, in place of one made from its measures.
    pub mesh: Option<WhaleMesh>,
    /// Greatest speed it can swim [m/s].
    pub burst_speed_m_s: f64,
    /// Stiffness of skin and blubber under rope, by length of rope [N/m²].
    pub contact_stiffness_n_m2: f64,
}

impl WhaleItem {
    /// Reads a whale's file; `None` where a figure is missing, which is reported.
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
            problems.push(node.place.error("neither `mass` nor `breadth_scale` is there", help));
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

    /// Its form at another length, in middling condition.
    #[must_use]
    pub fn form_at(&self, length_m: f64) -> WhaleForm {
        grown(&self.shares, &self.growth, self.density_kg_m3, length_m)
    }
}

/// A form at a length: edges and callosities grow with it, the head and the mass by their own laws.
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
    let nodes = table.tables("rows");
    table.finish();
    if nodes.len() < 4 {
        table.missing("rows", help);
        return None;
    }
    let read: Vec<_> = nodes.iter().map(|node| section(node, &of_all, fields.problems())).collect();
    let sections = read.into_iter().collect::<Option<Vec<_>>>()?;
    for pair in sections.windows(2).filter(|pair| pair[1][0].value <= pair[0][0].value) {
        let place = &pair[1][0].place;
        fields.problems().push(place.error(
            "body sections are not in rising order of `at`",
            "put them in order from snout to fluke notch",
        ));
    }
    Some(sections)
}

fn section(node: &Node, file: &Provenance, problems: &Problems) -> Option<[Figure; 4]> {
    let fields = Fields::of(node, problems);
    let row = provenance_over(&fields, file);
    let ratio = |key: &'static str, range| {
        if fields.get(key).is_none() {
            fields.missing(key, "expected a share of body length, such as 0.149");
        }
        fields.figure(key, Quantity::Ratio, range, &row)
    };
    let at = ratio("at", Range::Between(0.0, 1.0));
    let width = ratio("width", Range::Between(0.0, 1.0));
    let dorsal = ratio("dorsal", Range::Between(-0.5, 0.5));
    let ventral = ratio("ventral", Range::Between(-0.5, 0.5));
    fields.finish();
    if let (Some(dorsal), Some(ventral)) = (&dorsal, &ventral)
        && ventral.value > dorsal.value
    {
        problems.push(ventral.place.error(
            "`ventral` is above `dorsal`",
            "heights are above the snout's level: the belly is the lower one",
        ));
    }
    Some([at?, width?, dorsal?, ventral?])
}

/// The places of the spine joints: a list as `value`, with source and confidence.
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
        _ => {
            spine
                .problems()
                .push(place.error("`joints` is not a rising list of the right length", help));
            None
        }
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
        head: HeadForm {
            share: value("head.share")?,
            mouth: value("head.mouth")?,
            rostrum_width: value("head.rostrum_width")?,
            lip_arch: value("head.lip_arch")?,
            baleen: value("head.baleen")?,
            callosity_m: value("head.callosities").unwrap_or(0.0),
        },
        peduncle_start: value("peduncle_start")?,
        spine_joints,
        flippers: flippers(entry)?,
        flukes: flukes(entry)?,
    })
}

fn flippers(entry: &Entry) -> Option<FlipperForm> {
    let value = |key| entry.value(key);
    Some(FlipperForm {
        insertion: value("flippers.insertion")?,
        insertion_height: value("flippers.insertion_height")?,
        span: value("flippers.span")?,
        root_chord: value("flippers.root_chord")?,
        max_chord: value("flippers.max_chord")?,
        max_chord_at: value("flippers.max_chord_at")?,
        tip_chord: value("flippers.tip_chord")?,
        thickness: value("flippers.thickness")?,
        tip_thickness: value("flippers.tip_thickness")?,
        sweep: value("flippers.sweep")?,
        droop: value("flippers.droop")?,
        edge_radius_m: value("flippers.edge_radius")?,
    })
}

fn flukes(entry: &Entry) -> Option<FlukesForm> {
    let value = |key| entry.value(key);
    Some(FlukesForm {
        span: value("flukes.span")?,
        root_chord: value("flukes.root_chord")?,
        tip_chord: value("flukes.tip_chord")?,
        sweep: value("flukes.sweep")?,
        thickness: value("flukes.thickness")?,
        tip_thickness: value("flukes.tip_thickness")?,
        notch: value("flukes.notch")?,
        height: value("flukes.height")?,
        edge_radius_m: value("flukes.edge_radius")?,
    })
}
