//! Building a rig from the parts of a gear type without code.

use endline_sdk::{
    AttributeValue, Descriptor, GearType, HookError, Rig, RigBody, RigEnd, RigJoint, RigLine,
    RigLink, Site,
};

use super::{Body, Joint, Line, Link, Part, Place, TextGear};
use crate::plugin::expression::Expression;
use crate::plugin::words::Words;

/// Most parts of one row.
const MOST_IN_ROW: f64 = 1000.0;

/// Attributes and depth, while a rig is built.
struct Values<'a> {
    attributes: &'a [AttributeValue],
    /// In the order of the names: attributes, depth, count in the row.
    numbers: Vec<f64>,
}

impl Values<'_> {
    fn text(&self, words: &Words) -> String {
        words.text(&self.numbers, self.attributes)
    }

    fn number(&self, expression: &Expression, what: &str, id: &str) -> Result<f64, HookError> {
        let value = expression.value(&self.numbers);
        if value.is_finite() {
            Ok(value)
        } else {
            Err(HookError::new(format!(
                "`{what}` of `{id}` comes to {value} with these attributes"
            )))
        }
    }

    fn place(&self, place: &Place, id: &str) -> Result<[f64; 3], HookError> {
        let [x, y, height] = &place.0;
        let (x, y, height) = (
            self.number(x, "position", id)?,
            self.number(y, "position", id)?,
            self.number(height, "height", id)?,
        );
        let depth_m = self.numbers[self.numbers.len() - 2];
        Ok([x, y, depth_m * (height - 1.0)])
    }

    /// Does something once for each part of a row, with its id.
    fn row(
        &mut self,
        part: &Part,
        mut add: impl FnMut(&Self, String) -> Result<(), HookError>,
    ) -> Result<(), HookError> {
        let last = self.numbers.len() - 1;
        self.numbers[last] = 1.0;
        let count = self.number(&part.repeat, "repeat", &self.text(&part.id))?.floor();
        if count > MOST_IN_ROW {
            return Err(HookError::new(format!(
                "`repeat` of `{}` comes to {count}, more than {MOST_IN_ROW}",
                self.text(&part.id)
            )));
        }
        while self.numbers[last] <= count {
            add(self, self.text(&part.id))?;
            self.numbers[last] += 1.0;
        }
        Ok(())
    }
}

impl GearType for TextGear {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn build(&self, attributes: &[AttributeValue], site: &Site) -> Result<Rig, HookError> {
        let mut numbers: Vec<f64> =
            attributes.iter().map(|value| value.number().unwrap_or(f64::NAN)).collect();
        numbers.extend([site.depth_m, 1.0]);
        let (mut values, mut rig) = (Values { attributes, numbers }, Rig::default());
        self.add_places(&mut values, &mut rig)?;
        self.add_lines(&mut values, &mut rig)?;
        self.add_links(&mut values, &mut rig)?;
        Ok(rig)
    }
}

impl TextGear {
    fn add_places(&self, values: &mut Values<'_>, rig: &mut Rig) -> Result<(), HookError> {
        for Body { part, kind, item, place } in &self.bodies {
            values.row(part, |values, id| {
                let position_m = values.place(place, &id)?;
                rig.bodies.push(RigBody { id, kind: *kind, item: values.text(item), position_m });
                Ok(())
            })?;
        }
        for Joint { part, place } in &self.joints {
            values.row(part, |values, id| {
                let position_m = values.place(place, &id)?;
                rig.joints.push(RigJoint { id, position_m });
                Ok(())
            })?;
        }
        Ok(())
    }

    fn add_lines(&self, values: &mut Values<'_>, rig: &mut Rig) -> Result<(), HookError> {
        let joints: Vec<String> = rig.joints.iter().map(|joint| joint.id.clone()).collect();
        let end =
            |id: String| if joints.contains(&id) { RigEnd::Joint(id) } else { RigEnd::Body(id) };
        for Line { part, rope, ends, length } in &self.lines {
            values.row(part, |values, id| {
                let [from, to] = [&ends[0], &ends[1]].map(|words| end(values.text(words)));
                let length_m = values.number(length, "length", &id)?;
                let (rope, laid_m) = (values.text(rope), Vec::new());
                rig.lines.push(RigLine { id, rope, from, to, length_m, laid_m });
                Ok(())
            })?;
        }
        Ok(())
    }

    fn add_links(&self, values: &mut Values<'_>, rig: &mut Rig) -> Result<(), HookError> {
        for Link { part, item, line, end } in &self.links {
            values.row(part, |values, id| {
                let item = values.text(item);
                // An attribute that names no weak link leaves it out.
                if !item.is_empty() {
                    rig.links.push(RigLink { id, item, line: values.text(line), end: *end });
                }
                Ok(())
            })?;
        }
        Ok(())
    }
}
