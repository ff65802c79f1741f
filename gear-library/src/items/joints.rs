//! Ranges of a whale's joints: the table `[joints]` of its file.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use endline_sdk::{Posture, SPINE_JOINTS};
use endline_sim::whale::{Angle, JointRanges};

use crate::fields::{Fields, Figure, Provenance, Range, provenance_over, read_figure};
use crate::tree::{Content, Node};
use crate::units::Quantity;

/// The spine's axes in the order of [`Angle::SPINE`]: symmetric bends, limited at each joint and in total.
const SPINE: [&str; Angle::SPINE.len()] = ["spine_pitch", "spine_yaw", "spine_roll"];

/// Name in the file, and angle by side.
type Paired = (&'static str, fn(usize) -> Angle);

/// The other angles, equal on both sides.
const PAIRED: [Paired; 8] = [
    ("fluke_pitch", |_| Angle::FlukePitch),
    ("fluke_flex", Angle::FlukeFlex),
    ("flipper_sweep", Angle::FlipperSweep),
    ("flipper_raise", Angle::FlipperRaise),
    ("flipper_twist", Angle::FlipperTwist),
    ("flipper_flex", Angle::FlipperFlex),
    ("jaw", |_| Angle::Jaw),
    ("lips", Angle::Lips),
];

/// Joint ranges of a whale with their figures.
#[derive(Clone, Debug, PartialEq)]
pub struct Joints {
    /// The ranges [rad].
    pub ranges: JointRanges,
    /// Figures by name, such as `spine_yaw.each.3`, `spine_yaw.total` or `jaw.most`.
    pub figures: Vec<(String, Figure)>,
}

impl Joints {
    /// Reads `[joints]`; `None` if a figure is missing or wrong, which is reported.
    pub(super) fn read(fields: &Fields<'_>, file: &Provenance) -> Option<Self> {
        let Some(table) = fields.table("joints") else {
            fields.missing(
                "joints",
                "write a table [joints] with the range of each joint, such as jaw = { least = \"0 deg\", most = \"25 deg\" }",
            );
            return None;
        };
        let of_all = provenance_over(&table, file);
        let ranges = JointRanges {
            least: Posture::default(),
            most: Posture::default(),
            spine_total: [0.0; 3],
        };
        let mut joints = Self { ranges, figures: Vec::new() };
        let spine = SPINE
            .iter()
            .enumerate()
            .map(|(axis, name)| joints.spine(&table, axis, name, &of_all).is_some());
        let mut complete: Vec<bool> = spine.collect();
        complete.extend(
            PAIRED.iter().map(|(name, angle)| joints.pair(&table, name, *angle, &of_all).is_some()),
        );
        table.finish();
        complete.into_iter().all(|read| read).then_some(joints)
    }

    /// `spine_yaw = { each = ["5 deg", …], total = "75 deg" }`.
    fn spine(
        &mut self,
        table: &Fields<'_>,
        axis: usize,
        name: &'static str,
        of_all: &Provenance,
    ) -> Option<()> {
        let example = format!(
            "{name} = {{ each = [\"5 deg\", … {SPINE_JOINTS} in all, from the neck aft], total = \"60 deg\" }}"
        );
        let inner = open(table, name, &example)?;
        let row = provenance_over(&inner, of_all);
        let total = bound(&inner, "total", Range::Between(0.0, TAU), &row);
        let each = each(&inner, inner.get("each"), &row, &example);
        inner.finish();
        let (total, each) = (total?, each?);
        self.ranges.spine_total[axis] = total.value;
        for (joint, figure) in each.iter().enumerate() {
            self.ranges.set(Angle::SPINE[axis](joint), [-figure.value, figure.value]);
        }
        self.figures.push((format!("{name}.total"), total));
        self.figures.extend(
            each.into_iter()
                .enumerate()
                .map(|(joint, figure)| (format!("{name}.each.{joint}"), figure)),
        );
        Some(())
    }

    /// `jaw = { least = "0 deg", most = "25 deg" }`.
    fn pair(
        &mut self,
        table: &Fields<'_>,
        name: &'static str,
        angle: fn(usize) -> Angle,
        of_all: &Provenance,
    ) -> Option<()> {
        let inner =
            open(table, name, &format!("{name} = {{ least = \"-10 deg\", most = \"10 deg\" }}"))?;
        let row = provenance_over(&inner, of_all);
        let least = bound(&inner, "least", Range::Between(-PI, 0.0), &row);
        let most = bound(&inner, "most", Range::Between(0.0, PI), &row);
        inner.finish();
        let (least, most) = (least?, most?);
        for side in 0..2 {
            self.ranges.set(angle(side), [least.value, most.value]);
        }
        self.figures.extend([(format!("{name}.least"), least), (format!("{name}.most"), most)]);
        Some(())
    }
}

fn open<'a>(table: &Fields<'a>, name: &'a str, example: &str) -> Option<Fields<'a>> {
    let inner = table.table(name);
    if inner.is_none() {
        table.missing(name, format!("write {example}"));
    }
    inner
}

fn bound(inner: &Fields<'_>, key: &'static str, range: Range, row: &Provenance) -> Option<Figure> {
    inner.require(key, "expected an angle such as 10 deg; the rest posture is 0");
    inner.figure(key, Quantity::Angle, range, row)
}

fn each(
    inner: &Fields<'_>,
    list: Option<&Node>,
    row: &Provenance,
    example: &str,
) -> Option<Vec<Figure>> {
    let Some(Node { content: Content::List(items), place }) = list else {
        inner.missing("each", format!("write {example}"));
        return None;
    };
    if items.len() != SPINE_JOINTS {
        let message = format!("`each` has {} angles", items.len());
        return inner.refuse(place.error(
            message,
            format!("write {SPINE_JOINTS}, one for each spine joint from the neck aft"),
        ));
    }
    let range = Range::Between(0.0, FRAC_PI_2);
    let read: Vec<_> = items
        .iter()
        .map(|item| read_figure(item, Quantity::Angle, range, row, inner.problems()))
        .collect();
    read.into_iter().collect()
}
