//! Parts of a rig as a gear type of a library hands them over.

use endline_sdk::abi::table::{
    AT_BODY, AT_JOINT, AbiBody, AbiJoint, AbiLine, AbiLink, AbiRigEnd, AbiText,
};
use endline_sdk::{BodyKind, LineEnd, Rig, RigBody, RigEnd, RigJoint, RigLine, RigLink};

/// Reads a text of a library; `None` where it is not sound.
pub(super) type ReadText = fn(AbiText) -> Option<String>;

/// Adds a body; `None` where it is not sound.
pub(super) fn body(rig: &mut Rig, body: &AbiBody, text: ReadText) -> Option<()> {
    let kinds = [BodyKind::Trap, BodyKind::Buoy, BodyKind::Anchor];
    let kind = kinds.into_iter().find(|kind| *kind as u32 == body.kind)?;
    let (id, item) = (text(body.id)?, text(body.item)?);
    rig.bodies.push(RigBody { id, kind, item, position_m: body.position_m });
    Some(())
}

/// Adds a joint; `None` where it is not sound.
pub(super) fn joint(rig: &mut Rig, joint: &AbiJoint, text: ReadText) -> Option<()> {
    rig.joints.push(RigJoint { id: text(joint.id)?, position_m: joint.position_m });
    Some(())
}

/// Adds a line; `None` where it is not sound.
pub(super) fn line(rig: &mut Rig, line: &AbiLine, text: ReadText) -> Option<()> {
    let (from, to) = (rig_end(line.from, text)?, rig_end(line.to, text)?);
    let (id, rope) = (text(line.id)?, text(line.rope)?);
    rig.lines.push(RigLine { id, rope, from, to, length_m: line.length_m, laid_m: Vec::new() });
    Some(())
}

/// Adds a weak link; `None` where it is not sound.
pub(super) fn link(rig: &mut Rig, link: &AbiLink, text: ReadText) -> Option<()> {
    let (id, item, line) = (text(link.id)?, text(link.item)?, text(link.line)?);
    rig.links.push(RigLink { id, item, line, end: line_end(link.end)? });
    Some(())
}

fn rig_end(end: AbiRigEnd, text: ReadText) -> Option<RigEnd> {
    match end.at {
        AT_BODY => text(end.id).map(RigEnd::Body),
        AT_JOINT => text(end.id).map(RigEnd::Joint),
        _ => None,
    }
}

/// The end of a line by its number.
pub(super) fn line_end(end: u32) -> Option<LineEnd> {
    [LineEnd::A, LineEnd::B].into_iter().find(|known| *known as u32 == end)
}
