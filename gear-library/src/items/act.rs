//! An act of a whale: keys over time, from a file of `acts/`.
//!
//! The keys are written under `[[key]]`, or read from a glTF animation beside the file: `animation = "my-act.glb"`.

use endline_sdk::BodyPart;
use endline_sim::whale::Angle;
use endline_sim::whale::acts::{After, Blend, Clip, Curve, Moves, Side, Track};

use crate::diagnostic::{At, hint};
use crate::entry::{self, Confidence, Entry};
use crate::fields::{Fields, Figure, Problems, Provenance, Range, read_figure};
use crate::schema::Kind;
use crate::sources::Sources;
use crate::tree::{Content, Node};
use crate::units::Quantity;
use crate::whale::WhaleForm;
use crate::whale::bones::Skeleton;
use crate::whale::gltf::{self, Animation};
use crate::whale::trunk::Sections;

use super::channel::{CHANNELS, Channel};
use super::gltf_beside;

/// An act as read from its file.
#[derive(Clone, Debug, PartialEq)]
pub struct ActItem {
    /// Its file.
    pub entry: Entry,
    /// The act as numbers; a second clip if the file names the mirror image.
    pub clips: Vec<Clip>,
    /// Every joint angle that a key sets [rad].
    pub angles: Vec<(Angle, Figure)>,
    /// The glTF animation that holds its keys, if it has one.
    pub animation: Option<ActAnimation>,
}

/// Keys of a channel: time, and a figure for each track.
struct Keyed {
    channel: &'static Channel,
    keys: Vec<(f64, Vec<Figure>)>,
}

impl ActItem {
    /// Reads an act's file; `None` if a required field is missing, which is reported.
    pub(crate) fn read(node: &Node, id: &str, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let head = entry::header(&fields, Kind::Act.word(), problems);
        let file = head.2.clone();
        let entry = entry::body(&fields, Kind::Act, head, id);
        let afters = [("return", After::Return), ("hold", After::Hold), ("repeat", After::Repeat)];
        let after = fields.choice("after", &afters).map_or(After::Return, |after| after.value);
        let blend = fields.choice("blend", &[("replace", Blend::Replace), ("add", Blend::Add)]);
        let sides = [("as-written", Side::AsWritten), ("touched", Side::Touched)];
        let side = fields.choice("side", &sides);
        let mirror = fields.text("mirrored_as");
        let ends_at_touch = parts(&fields);
        let animation = ActAnimation::read(&fields, &file);
        let (keyed, times) = if fields.get("animation").is_some() {
            (Vec::new(), Vec::new())
        } else {
            keys(&fields, &file)
        };
        fields.finish();
        let length_s = if animation.is_some() { 0.0 } else { times.last()?.value };
        check_closed(&keyed, after, length_s, problems);
        let clip = Clip {
            id: id.to_owned(),
            name: entry.name.clone(),
            help: entry.notes.clone(),
            tracks: keyed.iter().flat_map(|keyed| tracks(keyed, after == After::Repeat)).collect(),
            length_s,
            after,
            fade_s: entry.value("fade")?,
            blend: blend.map_or(Blend::Replace, |blend| blend.value),
            turn_rate_rad_s: entry.value("turn_rate").unwrap_or(TURN_RATE_RAD_S),
            side: side.map_or(Side::AsWritten, |side| side.value),
            ends_at_touch,
        };
        Some(Self { angles: angles(&keyed), clips: with_mirror(clip, mirror), entry, animation })
    }

    /// Paths of its files.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.entry.path.as_str())
            .chain(self.animation.iter().map(|animation| animation.file.value.as_str()))
    }
}

/// Default of the greatest rate of turn to a bank or climb: 15 degrees per second.
const TURN_RATE_RAD_S: f64 = 0.261_799_387_799_149_4;

/// The clip, and its mirror image if that has a name.
fn with_mirror(clip: Clip, mirror: Option<At<String>>) -> Vec<Clip> {
    let other = mirror.map(|id| Clip {
        id: id.value,
        name: format!("{}, mirrored", clip.name),
        side: Side::Mirrored,
        ..clip.clone()
    });
    std::iter::once(clip).chain(other).collect()
}

/// `ends_at_touch`: true (rope on any part), or a list of parts.
fn parts(fields: &Fields<'_>) -> [bool; BodyPart::ALL.len()] {
    let mut ends = [false; BodyPart::ALL.len()];
    let Some(node) = fields.get("ends_at_touch") else { return ends };
    let names = BodyPart::ALL.map(BodyPart::name);
    let help = || {
        format!("write true, or a list of parts such as [\"head\"]; parts are {}", names.join(", "))
    };
    match &node.content {
        Content::Flag(any) => ends = [*any; BodyPart::ALL.len()],
        Content::List(items) => {
            for item in items {
                let name = if let Content::Text(name) = &item.content { name.as_str() } else { "" };
                match names.iter().position(|known| *known == name) {
                    Some(part) => ends[part] = true,
                    None => fields.problems().push(
                        item.place
                            .error(format!("`{name}` is not a part of a whale"), hint(name, names)),
                    ),
                }
            }
        }
        other => fields
            .problems()
            .push(node.place.error(format!("`ends_at_touch` is {}", other.noun()), help())),
    }
    ends
}

/// The channels used in `[[key]]` with their keys, and the times of all keys.
fn keys(fields: &Fields<'_>, file: &Provenance) -> (Vec<Keyed>, Vec<At<f64>>) {
    let nodes = fields.tables("key");
    if nodes.is_empty() {
        fields.missing("key", "write at least one [[key]] with `at` and what moves, such as flipper_raise = \"30 deg\"");
    }
    let mut keyed: Vec<Keyed> = Vec::new();
    let mut times: Vec<At<f64>> = Vec::new();
    for node in nodes {
        let key = Fields::of(node, fields.problems());
        key.require("at", "write the time since the start of the act, such as at = \"1.5 s\"");
        let at = key.figure("at", Quantity::Time, Range::Between(0.0, 3600.0), file);
        for channel in CHANNELS {
            let read = channel_key(&key, channel, file);
            let (Some(at), Some(figures)) = (&at, read) else { continue };
            match keyed.iter_mut().find(|known| known.channel.key == channel.key) {
                Some(known) => known.keys.push((at.value, figures)),
                None => keyed.push(Keyed { channel, keys: vec![(at.value, figures)] }),
            }
        }
        key.finish();
        let Some(at) = at else { continue };
        if times.last().is_some_and(|earlier| earlier.value >= at.value) {
            fields.problems().push(
                at.place
                    .error("keys are not in rising order of `at`", "put them in the order of time"),
            );
        }
        times.push(At { value: at.value, place: at.place });
    }
    (keyed, times)
}

/// Values of a channel in a key: one figure that is distributed, or a list with one value per joint or side.
fn channel_key<'a>(
    key: &Fields<'a>,
    channel: &'static Channel,
    file: &Provenance,
) -> Option<Vec<Figure>> {
    let node = key.get(channel.key)?;
    let places = channel.places();
    let Content::List(items) = &node.content else {
        let shares = channel.shares();
        let most = shares.iter().copied().fold(0.0, f64::max);
        let range = Range::Between(channel.range[0] / most, channel.range[1] / most);
        let figure = read_figure(node, channel.quantity, range, file, key.problems())?;
        return Some(
            shares
                .iter()
                .map(|share| Figure { value: share * figure.value, ..figure.clone() })
                .collect(),
        );
    };
    if items.len() != places || places == 1 {
        let message = format!("`{}` has {} values", channel.key, items.len());
        return key.refuse(node.place.error(message, channel.expected()));
    }
    let range = Range::Between(channel.range[0], channel.range[1]);
    items
        .iter()
        .map(|item| read_figure(item, channel.quantity, range, file, key.problems()))
        .collect()
}

/// The joint angles of all keys.
fn angles(keyed: &[Keyed]) -> Vec<(Angle, Figure)> {
    let of_key = |keyed: &Keyed, figures: &[Figure]| -> Vec<(Angle, Figure)> {
        let moved = keyed.channel.moves().into_iter().zip(figures);
        moved
            .filter_map(|(moves, figure)| {
                if let Moves::Angle(angle) = moves { Some((angle, figure.clone())) } else { None }
            })
            .collect()
    };
    keyed
        .iter()
        .flat_map(|keyed| keyed.keys.iter().flat_map(move |(_, figures)| of_key(keyed, figures)))
        .collect()
}

/// One curve per joint or side of a channel.
fn tracks(keyed: &Keyed, repeats: bool) -> Vec<Track> {
    let track = |(place, moves): (usize, Moves)| {
        let points: Vec<(f64, f64)> =
            keyed.keys.iter().map(|(at, figures)| (*at, figures[place].value)).collect();
        Track { moves, curve: Curve::through(&points, repeats) }
    };
    keyed.channel.moves().into_iter().enumerate().map(track).collect()
}

/// A repeated clip must end as it begins: each channel has equal values at the first and the last time, except for turns.
fn check_closed(keyed: &[Keyed], after: After, length_s: f64, problems: &Problems) {
    if after != After::Repeat {
        return;
    }
    for Keyed { channel, keys } in keyed {
        let [(first_s, first), .., (last_s, last)] = keys.as_slice() else {
            let place = &keys[0].1[0].place;
            problems.push(place.error(
                format!("`{}` occurs in only one key", channel.key),
                "a repeated act needs it at the start and at the end",
            ));
            continue;
        };
        let place = &last[0].place;
        if *first_s > 0.0 || *last_s < length_s {
            let message =
                format!("`{}` does not cover a repeated act from start to end", channel.key);
            problems.push(place.error(
                message,
                format!("write it in the key at 0 s and in the last key, at {length_s} s"),
            ));
        } else if !channel.turns()
            && first.iter().zip(last).any(|(first, last)| (first.value - last.value).abs() > 1e-9)
        {
            let message = format!(
                "`{}` has different values at the start and the end of a repeated act",
                channel.key
            );
            problems
                .push(place.error(message, "write the values of the first key in the last key"));
        }
    }
}

/// Greatest difference between the start and the end of a repeated act [rad].
const CLOSED_RAD: f64 = 1e-3;
/// Length of the whale by whose bones an animation is read [m]; the angles do not depend on it.
const ANY_LENGTH_M: f64 = 13.7;

impl ActItem {
    /// Reads its animation, if it has one; returns false after a failure, which is reported.
    pub(crate) fn load_animation(&mut self, sources: &Sources, problems: &Problems) -> bool {
        let Some(source) = self.animation.clone() else { return true };
        let Some(bytes) = sources.named_mesh(&source.file, problems) else { return false };
        let form = WhaleForm::right_whale(ANY_LENGTH_M);
        let bones = Skeleton::of(&form, &Sections::of(&form)).bones;
        match gltf::read_animation(
            bytes,
            source.clip.as_ref().map(|clip| clip.value.as_str()),
            &bones,
        ) {
            Ok(animation) => self.set_animation(&source, &animation, problems),
            Err(fault) => {
                let message = format!("`{}` {}", source.file.value, fault.message);
                problems.push(source.file.place.error(message, fault.help));
                false
            }
        }
    }

    fn set_animation(
        &mut self,
        source: &ActAnimation,
        animation: &Animation,
        problems: &Problems,
    ) -> bool {
        let repeats = self.clips.iter().any(|clip| clip.after == After::Repeat);
        let open = |values: &[f64]| {
            values
                .first()
                .zip(values.last())
                .is_some_and(|(first, last)| (first - last).abs() > CLOSED_RAD)
        };
        if let Some((angle, _)) =
            animation.angles.iter().find(|(_, values)| repeats && open(values))
        {
            let message = format!(
                "`{}` has different values at the start and the end of a repeated act",
                angle.name().0
            );
            problems.push(
                source.file.place.error(message, "write the pose of the first key in the last key"),
            );
            return false;
        }
        let track = |(angle, values): &(_, Vec<f64>)| {
            let points: Vec<(f64, f64)> =
                animation.times_s.iter().copied().zip(values.iter().copied()).collect();
            Track { moves: Moves::Angle(*angle), curve: Curve::through(&points, repeats) }
        };
        for clip in &mut self.clips {
            clip.tracks = animation.angles.iter().map(track).collect();
            clip.length_s = animation.times_s.last().copied().unwrap_or(0.0);
        }
        let figure = |value: f64| Figure {
            value,
            text: format!("{:.1} deg", value.to_degrees()),
            source: source.source.clone().unwrap_or_default(),
            confidence: source.confidence.unwrap_or(Confidence::Estimate),
            place: source.file.place.clone(),
        };
        let ends = |values: &[f64]| {
            [f64::min, f64::max].map(|pick| values.iter().copied().fold(values[0], pick))
        };
        self.angles = animation
            .angles
            .iter()
            .flat_map(|(angle, values)| ends(values).map(|value| (*angle, figure(value))))
            .collect();
        true
    }
}

/// The glTF animation that replaces `[[key]]`.
#[derive(Clone, Debug, PartialEq)]
pub struct ActAnimation {
    /// Path of the file, relative to the library's folder.
    pub file: At<String>,
    /// Name of the animation; `None` for the only one.
    pub clip: Option<At<String>>,
    /// Source of its angles.
    pub(super) source: Option<String>,
    /// Confidence in its angles.
    pub(super) confidence: Option<Confidence>,
}

impl ActAnimation {
    /// Reads the keys `animation` and `clip`.
    pub(super) fn read(fields: &Fields<'_>, file: &Provenance) -> Option<Self> {
        let clip = fields.text("clip");
        let animation = gltf_beside(fields, "animation")?;
        if let Some(key) = fields.get("key") {
            fields.problems().push(
                key.place.error("both `animation` and [[key]] are present", "remove one of them"),
            );
        }
        Some(Self {
            file: animation,
            clip,
            source: file.source.clone(),
            confidence: file.confidence,
        })
    }
}
