//! Undo and redo: what each edit changed.

/// Number of edits that undo can take back.
const DEPTH: usize = 500;

/// One change of one text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Change {
    pub(super) path: String,
    /// The text before; `None` where the file is new.
    pub(super) before: Option<String>,
    /// The text after; `None` where the file is removed.
    pub(super) after: Option<String>,
}

/// Changes made together: one undo takes all of them back.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Edit {
    changes: Vec<Change>,
    /// The field held by a slider while it moves; the next value of the field joins this edit.
    held: Option<String>,
}

/// The edits made, and the edits taken back.
#[derive(Debug, Default)]
pub(super) struct History {
    undo: Vec<Edit>,
    redo: Vec<Edit>,
}

impl History {
    /// Adds an edit; edits taken back before it can no longer be redone.
    pub(super) fn record(&mut self, changes: Vec<Change>) {
        if self.undo.len() == DEPTH {
            self.undo.remove(0);
        }
        self.undo.push(Edit { changes, held: None });
        self.redo.clear();
    }

    /// Moves the last edit to the edits that can be redone; returns its changes.
    pub(super) fn undo(&mut self) -> Option<&[Change]> {
        self.redo.push(self.undo.pop()?);
        self.redo.last().map(|edit| edit.changes.as_slice())
    }

    /// Moves the edit taken back last to the edits that can be undone; returns its changes.
    pub(super) fn redo(&mut self) -> Option<&[Change]> {
        self.undo.push(self.redo.pop()?);
        self.undo.last().map(|edit| edit.changes.as_slice())
    }

    /// Whether there is an edit to undo, and one to redo.
    pub(super) fn can_undo_redo(&self) -> (bool, bool) {
        (!self.undo.is_empty(), !self.redo.is_empty())
    }

    /// Whether the last edit belongs to a control of this field that is still moving.
    pub(super) fn is_held(&self, field: &str) -> bool {
        self.undo.last().is_some_and(|edit| edit.held.as_deref() == Some(field))
    }

    /// Marks the last edit as made by a control that is still moving.
    pub(super) fn hold(&mut self, field: String) {
        if let Some(last) = self.undo.last_mut() {
            last.held = Some(field);
        }
    }

    /// Joins the last edit to the edit before it, which changed the same texts.
    pub(super) fn join(&mut self) {
        let Some(mut last) = self.undo.pop() else { return };
        if let Some(first) = self.undo.pop() {
            for (change, earlier) in last.changes.iter_mut().zip(first.changes) {
                change.before = earlier.before;
            }
        }
        self.undo.push(last);
    }

    /// The control was released: its next value is an edit of its own.
    pub(super) fn release(&mut self) {
        if let Some(last) = self.undo.last_mut() {
            last.held = None;
        }
    }

    /// Forgets every edit that changed a text.
    pub(super) fn forget(&mut self, path: &str) {
        let elsewhere = |edit: &Edit| edit.changes.iter().all(|change| change.path != path);
        self.undo.retain(elsewhere);
        self.redo.retain(elsewhere);
    }
}
