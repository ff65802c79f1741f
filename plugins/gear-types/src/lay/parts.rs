//! A rig in the making: parts go in, the ends by which lines name them come out.

use endline_sdk::{BodyKind, LineEnd, Rig, RigBody, RigEnd, RigJoint, RigLine, RigLink};

/// A rig in the making.
#[derive(Clone, Debug, Default)]
pub struct Lay {
    /// The parts so far.
    pub rig: Rig,
}

impl Lay {
    /// Puts in a trap, buoy or anchor with its first guess of place [m].
    pub fn body(&mut self, id: &str, kind: BodyKind, item: &str, position_m: [f64; 3]) -> RigEnd {
        self.rig.bodies.push(RigBody { id: id.into(), kind, item: item.into(), position_m });
        RigEnd::Body(id.into())
    }

    /// Puts in a splice with its first guess of place [m].
    pub fn joint(&mut self, id: &str, position_m: [f64; 3]) -> RigEnd {
        self.rig.joints.push(RigJoint { id: id.into(), position_m });
        RigEnd::Joint(id.into())
    }

    /// Puts in a line, straight at first.
    pub fn line(&mut self, id: &str, rope: &str, ends: [RigEnd; 2], length_m: f64) {
        self.line_along(id, rope, ends, length_m, Vec::new());
    }

    /// Puts in a line that lies along a way at first [m].
    pub fn line_along(
        &mut self,
        id: &str,
        rope: &str,
        [from, to]: [RigEnd; 2],
        length_m: f64,
        laid_m: Vec<[f64; 3]>,
    ) {
        self.rig.lines.push(RigLine {
            id: id.into(),
            rope: rope.into(),
            from,
            to,
            length_m,
            laid_m,
        });
    }

    /// Puts in a weak link or release, where an item is named.
    pub fn link(&mut self, id: &str, item: &str, line: &str, end: LineEnd) {
        if !item.is_empty() {
            self.rig.links.push(RigLink {
                id: id.into(),
                item: item.into(),
                line: line.into(),
                end,
            });
        }
    }
}
