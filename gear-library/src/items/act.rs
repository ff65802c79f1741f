//! An act of a whale: keys over time, from a file of `acts/`.

use endline_sdk::BodyPart;
use endline_sim::whale::Angle;
use endline_sim::whale::acts::{After, Blend, Clip, Curve, Moves, Side, Track};

use crate::diagnostic::At;
use crate::entry::{self, Entry};
use crate::fields::{Fields, Figure, Problems, Provenance, Range, read_figure};
use crate::items::channel::{CHANNELS, Channel};
use crate::nearest::hint;
use crate::schema::Kind;
use crate::tree::{Content, Node};
use crate::units::Quantity;

use super::ActAnimation;

/// An act, and what else its file gives.
#[derive(Clone, Debug, PartialEq)]
pub struct ActItem {
    /// Its file.
    pub entry: Entry,
    /// The act as numbers; two where the file also gives the mirror image a name.
    pub clips: Vec<Clip>,
    /// Every joint angle that a key asks for [rad].
    pub angles: Vec<(Angle, Figure)>,
    /// Its keys, where they are those of a glTF animation.
    pub animation: Option<ActAnimation>,
}

/// A channel's keys while a file is read: time and figure, for each of its tracks.
struct Keyed {
    channel: &'static Channel,
    keys: Vec<(f64, Vec<Figure>)>,
}

impl ActItem {
    /// Reads an act's file; `None` where something needed is missing, which is reported.
    pub(crate) fn read(node: &Node, id: &str, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let head = entry::header(&fields, Kind::Act.word(), problems);
        let file = head.2.clone();
        let entry = entry::body(&fields, Kind::Act, head, id);
        let after = word(
            &fields,
            "after",
            ("return", After::Return),
            &[("hold", After::Hold), ("repeat", After::Repeat)],
        );
        let blend = word(&fields, "blend", ("replace", Blend::Replace), &[("add", Blend::Add)]);
        let side =
            word(&fields, "side", ("as-written", Side::AsWritten), &[("touched", Side::Touched)]);
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
            blend,
            turn_rate_rad_s: entry.value("turn_rate").unwrap_or(TURN_RATE_RAD_S),
            side,
            ends_at_touch,
        };
        Some(Self { angles: angles(&keyed), clips: with_mirror(clip, mirror), entry, animation })
    }

    /// Every file it is made from.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.entry.path.as_str())
            .chain(self.animation.iter().map(|animation| animation.file.value.as_str()))
    }
}

/// Greatest rate of turn to a bank or climb where a file names none: 15 degrees a second.
const TURN_RATE_RAD_S: f64 = 0.261_799_387_799_149_4;

/// The clip, and its mirror image where that has a name.
fn with_mirror(clip: Clip, mirror: Option<At<String>>) -> Vec<Clip> {
    let other = mirror.map(|id| Clip {
        id: id.value,
        name: format!("{}, mirrored", clip.name),
        side: Side::Mirrored,
        ..clip.clone()
    });
    std::iter::once(clip).chain(other).collect()
}

/// One of a few words; the first where the file has none.
fn word<T: Copy>(
    fields: &Fields<'_>,
    key: &'static str,
    first: (&str, T),
    others: &[(&str, T)],
) -> T {
    let all: Vec<&str> =
        std::iter::once(first.0).chain(others.iter().map(|(word, _)| *word)).collect();
    let Some(given) = fields.word(key, &all) else { return first.1 };
    others.iter().find(|(word, _)| *word == given.value).map_or(first.1, |(_, meaning)| *meaning)
}

/// `ends_at_touch`: true for rope on any part, or a list of parts.
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
                            .error(format!("`{name}` is no part of a whale"), hint(name, names)),
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

/// Every channel that `[[key]]` names, with its keys; and the times of all keys.
fn keys(fields: &Fields<'_>, file: &Provenance) -> (Vec<Keyed>, Vec<At<f64>>) {
    let nodes = fields.tables("key");
    if nodes.is_empty() {
        fields.missing("key", "write at least one [[key]] with `at` and what moves, such as flipper_raise = \"30 deg\"");
    }
    let mut keyed: Vec<Keyed> = Vec::new();
    let mut times: Vec<At<f64>> = Vec::new();
    for node in nodes {
        let key = Fields::of(node, fields.problems());
        if key.get("at").is_none() {
            key.missing(
                "at",
                "write the time of the key since the act began, such as at = \"1.5 s\"",
            );
        }
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

/// The values of a channel in a key: one figure, shared out, or a list with one for each joint or side.
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
        key.problems().push(node.place.error(message, channel.expected()));
        return None;
    }
    let range = Range::Between(channel.range[0], channel.range[1]);
    items
        .iter()
        .map(|item| read_figure(item, channel.quantity, range, file, key.problems()))
        .collect()
}

/// Every joint angle of every key.
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

/// A curve for each joint or side of a channel.
fn tracks(keyed: &Keyed, repeats: bool) -> Vec<Track> {
    let track = |(place, moves): (usize, Moves)| {
        let points: Vec<(f64, f64)> =
            keyed.keys.iter().map(|(at, figures)| (*at, figures[place].value)).collect();
        Track { moves, curve: Curve::through(&points, repeats) }
    };
    keyed.channel.moves().into_iter().enumerate().map(track).collect()
}

/// A clip that repeats must end as it begins: every channel at the first time and at the last, with the same value; a turn may go on.
fn check_closed(keyed: &[Keyed], after: After, length_s: f64, problems: &Problems) {
    if after != After::Repeat {
        return;
    }
    for Keyed { channel, keys } in keyed {
        let [(first_s, first), .., (last_s, last)] = keys.as_slice() else {
            let place = &keys[0].1[0].place;
            problems.push(place.error(
                format!("`{}` stands in one key alone", channel.key),
                "an act that repeats needs it at the start and at the end",
            ));
            continue;
        };
        let place = &last[0].place;
        if *first_s > 0.0 || *last_s < length_s {
            let message = format!(
                "`{}` does not reach from the start to the end of an act that repeats",
                channel.key
            );
            problems.push(place.error(
                message,
                format!("give it in the key at 0 s and in the last key, at {length_s} s"),
            ));
        } else if !channel.turns()
            && first.iter().zip(last).any(|(first, last)| (first.value - last.value).abs() > 1e-9)
        {
            let message =
                format!("`{}` ends elsewhere than it begins, in an act that repeats", channel.key);
            problems.push(place.error(message, "give the last key the values of the first"));
        }
    }
}
