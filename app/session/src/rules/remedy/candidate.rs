//! An edit of an assembly's file before anybody has tried it.

use endline_gear::{Document, Setting};
use schemars::JsonSchema;
use serde::Serialize;

/// A field that an edit changes.
#[derive(Clone, Debug, Eq, JsonSchema, PartialEq, Serialize)]
pub struct Change {
    /// Its dotted path in the assembly's file, such as `lines.endline-top.inserts.first`.
    pub field: String,
    /// What stands there; none where it is new.
    pub before: Option<String>,
    /// What will stand there; none where it is taken out.
    pub after: Option<String>,
}

/// A step of an edit.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// A value put at a path, whatever stood there.
    Put(String, String),
    /// A field taken out, where it is there.
    Remove(String),
    /// A table added to a list, such as a `body`.
    Add(&'static str, Vec<(&'static str, String)>),
    /// A table taken out of a list by its `id`.
    Drop(&'static str, String),
}

/// An edit of an assembly's file.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    /// What it does, in a sentence.
    pub says: String,
    /// Its steps, in order.
    pub steps: Vec<Step>,
}

impl Candidate {
    pub fn new(says: String) -> Self {
        Self { says, steps: Vec::new() }
    }

    /// With a value put at a path.
    pub fn put(mut self, field: impl Into<String>, value: impl Into<String>) -> Self {
        self.steps.push(Step::Put(field.into(), value.into()));
        self
    }

    /// With a field taken out.
    pub fn remove(mut self, field: impl Into<String>) -> Self {
        self.steps.push(Step::Remove(field.into()));
        self
    }

    /// Makes the edit; what it changed, field by field.
    ///
    /// # Errors
    /// Where the file has no such place.
    pub fn apply(&self, document: &mut Document) -> Result<Vec<Change>, String> {
        let mut changes = Vec::new();
        for step in &self.steps {
            step.apply(document, &mut changes)?;
        }
        changes.retain(|change| change.before != change.after);
        Ok(changes)
    }
}

impl Step {
    fn apply(&self, document: &mut Document, changes: &mut Vec<Change>) -> Result<(), String> {
        match self {
            Self::Put(field, value) => {
                let before = document.get(field);
                document.put(field, &Setting::plain(value)).map_err(|error| error.message)?;
                changes.push(Change { field: field.clone(), before, after: Some(value.clone()) });
            }
            Self::Remove(field) if document.has(field) => {
                let before = document.get(field);
                document.remove(field).map_err(|error| error.message)?;
                changes.push(Change { field: field.clone(), before, after: None });
            }
            Self::Remove(_) => {}
            Self::Add(list, fields) => {
                let texts: Vec<(&str, &str)> =
                    fields.iter().map(|(key, value)| (*key, value.as_str())).collect();
                let index = document.push_table(list, &texts).map_err(|error| error.message)?;
                changes.extend(fields.iter().map(|(key, value)| Change {
                    field: format!("{list}.{index}.{key}"),
                    before: None,
                    after: Some(value.clone()),
                }));
            }
            Self::Drop(list, id) => {
                let own = |index: &usize| {
                    document.get(&format!("{list}.{index}.id")).as_ref() == Some(id)
                };
                let index = (0..document.count(list)).find(own);
                let index = index.ok_or_else(|| format!("there is no {list} `{id}`"))?;
                document.remove_table(list, index).map_err(|error| error.message)?;
                let field = format!("{list}.{index}");
                changes.push(Change { field, before: Some(id.clone()), after: None });
            }
        }
        Ok(())
    }
}
