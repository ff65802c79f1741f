//! Text boxes for fields of a file: a value is committed by Enter or when the box loses the focus; an invalid value is red.

use egui::text::{CCursor, CCursorRange};
use egui::{Context, FontId, Id, Key, Rect, Response, RichText, Stroke, TextEdit, Ui, vec2};
use endline_gear::Diagnostic;
use endline_session::edit::Documents;
use endline_session::edit::problems::message;
use endline_session::units::Units;

use super::theme::Theme;

/// Least width of a box that shows a converted value beside its own [points].
const WIDE: f32 = 110.0;

/// Texts about a field: a hint shown while it is empty, and help on hover.
#[derive(Clone, Copy, Debug, Default)]
pub struct Said<'a> {
    /// Shown faintly while the field is empty.
    pub hint: &'a str,
    /// Shown on hover.
    pub help: &'a str,
}

/// A field of an open file.
#[derive(Clone, Copy)]
pub struct Field<'a> {
    /// The open files.
    pub documents: &'a Documents,
    /// Path of the file.
    pub path: &'a str,
    /// Dotted path of the field.
    pub field: &'a str,
}

/// Shows a field as a text box; returns the new value when it is committed. Escape discards it.
pub fn edit(
    ui: &mut Ui,
    documents: &Documents,
    path: &str,
    field: &str,
    width: f32,
    said: Said<'_>,
) -> Option<String> {
    edit_as(ui, edit_id(path, field), Field { documents, path, field }, width, said)
}

/// Shows a field in a second place on screen, under its own id.
pub fn edit_in(
    ui: &mut Ui,
    place: &str,
    field: Field<'_>,
    width: f32,
    said: Said<'_>,
) -> Option<String> {
    edit_as(ui, Id::new((place, field.path, field.field)), field, width, said)
}

/// Key under which the text box that had the focus last is stored.
const FOCUSED: &str = "field that has the focus";

fn edit_as(
    ui: &mut Ui,
    edit_id: Id,
    field: Field<'_>,
    width: f32,
    said: Said<'_>,
) -> Option<String> {
    let Field { documents, path, field } = field;
    let stored = documents.field(path, field).unwrap_or_default();
    let problem = documents.problem_at(path, field);
    let id = typed_id(edit_id);
    let typing = ui.memory(|memory| memory.has_focus(edit_id));
    if typing {
        ui.data_mut(|data| data.insert_temp(Id::new(FOCUSED), edit_id));
    }
    let shown = || if typing { stored.clone() } else { shortened(&stored) };
    let mut typed = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(shown);
    let palette = Theme::palette_of(ui);
    let colour =
        if problem.is_some_and(Diagnostic::is_error) { palette.error } else { palette.text };
    let editor = TextEdit::singleline(&mut typed)
        .id(edit_id)
        .desired_width(width)
        .text_color(colour)
        .clip_text(true);
    let hint = units_shown(ui).instead_of(said.hint);
    let editor = editor.hint_text(hint.as_deref().unwrap_or(said.hint));
    let response = ui.add(editor);
    if response.gained_focus()
        && !ui.input(|input| input.pointer.any_down() || input.pointer.any_released())
    {
        select_all(ui.ctx(), edit_id, &stored);
    }
    outline(ui, &response, problem);
    // The hundreds of narrow boxes of a table have no room for a converted value.
    let wanted = response.rect.width() > WIDE || response.contains_pointer();
    let instead = if wanted && problem.is_none() && !response.has_focus() {
        units_shown(ui).instead_of(&stored)
    } else {
        None
    };
    if let Some(instead) = &instead {
        beside(ui, response.rect, &stored, instead);
    }
    if response.changed() {
        ui.data_mut(|data| data.insert_temp(id, typed.clone()));
    }
    let left = response.lost_focus();
    let converted = instead.map(|instead| format!("{stored} is {instead}"));
    let help = [Some(said.help).filter(|help| !help.is_empty()), converted.as_deref()];
    hover(response, problem, &help.into_iter().flatten().collect::<Vec<_>>().join("\n"));
    if !left {
        return None;
    }
    ui.data_mut(|data| data.remove_temp::<String>(id));
    let escaped = ui.input(|input| input.key_pressed(Key::Escape));
    (!escaped && typed != stored && typed != shortened(&stored)).then_some(typed)
}

/// Rounds a plain number with many digits to four decimals, for a box that is not being edited; returns any other text unchanged.
fn shortened(stored: &str) -> String {
    const MOST: usize = 8;
    let plain = stored.len() > MOST && stored.contains('.');
    match stored.parse::<f64>().ok().filter(|value| plain && (1e-3..1e6).contains(&value.abs())) {
        Some(value) => format!("{value:.4}").trim_end_matches('0').trim_end_matches('.').to_owned(),
        None => stored.to_owned(),
    }
}

/// Sets the units in which values are shown; called once a frame.
pub fn show_in(context: &Context, units: Units) {
    context.data_mut(|data| data.insert_temp(units_id(), units));
}

fn units_shown(ui: &Ui) -> Units {
    ui.data(|data| data.get_temp(units_id())).unwrap_or_default()
}

fn units_id() -> Id {
    Id::new("units that values are shown in")
}

/// Writes the converted value at the right of its box, if both fit. The file is not changed.
fn beside(ui: &Ui, rect: Rect, stored: &str, instead: &str) {
    /// Margins, the gap between both values, and the width of the confidence letter at the right.
    const ROOM: f32 = 40.0;
    let (colour, font) = (Theme::palette_of(ui).faint, FontId::proportional(11.5));
    let painter = ui.painter();
    let own = painter.layout_no_wrap(stored.to_owned(), FontId::proportional(13.5), colour);
    let text = painter.layout_no_wrap(instead.to_owned(), font, colour);
    if own.size().x + text.size().x + ROOM < rect.width() {
        let right = rect.right_center() - vec2(6.0 + text.size().x, 0.5 * text.size().y);
        painter.galley(right, text, colour);
    }
}

/// Selects the content of a text box that was reached by keys, so that typing replaces it.
fn select_all(context: &Context, edit_id: Id, text: &str) {
    let mut state = TextEdit::load_state(context, edit_id).unwrap_or_default();
    let end = CCursor::new(text.chars().count());
    state.cursor.set_char_range(Some(CCursorRange::two(CCursor::default(), end)));
    state.store(context, edit_id);
}

/// Moves the focus to the text box of a field and selects its content.
pub fn go_to(context: &Context, documents: &Documents, path: &str, field: &str) {
    let id = edit_id(path, field);
    context.memory_mut(|memory| memory.request_focus(id));
    select_all(context, id, &documents.field(path, field).unwrap_or_default());
}

/// Whether the text box with the focus belongs to a field and nothing was typed into it.
pub fn is_untouched(context: &Context) -> bool {
    let Some(focused) = context.memory(egui::Memory::focused) else { return false };
    context.data(|data| {
        data.get_temp(Id::new(FOCUSED)) == Some(focused)
            && data.get_temp::<String>(typed_id(focused)).is_none()
    })
}

/// Id of the uncommitted content of a text box.
fn typed_id(edit_id: Id) -> Id {
    edit_id.with("typed")
}

/// Id of the text box of a field.
pub fn edit_id(path: &str, field: &str) -> Id {
    Id::new(("field", path, field))
}

/// Discards the uncommitted content of a field.
pub fn forget(ui: &Ui, path: &str, field: &str) {
    ui.data_mut(|data| data.remove_temp::<String>(typed_id(edit_id(path, field))));
    ui.memory_mut(|memory| memory.surrender_focus(edit_id(path, field)));
}

fn outline(ui: &Ui, response: &Response, problem: Option<&Diagnostic>) {
    if let Some(problem) = problem {
        let palette = Theme::palette_of(ui);
        let colour = if problem.is_error() { palette.error } else { palette.warning };
        ui.painter().rect_stroke(
            response.rect,
            4.0,
            Stroke::new(1.5, colour),
            egui::StrokeKind::Inside,
        );
    }
}

fn hover(response: Response, problem: Option<&Diagnostic>, help: &str) {
    // The pointer is on at most one of the hundreds of boxes of a table.
    if !response.contains_pointer() {
        return;
    }
    let text = match problem {
        Some(problem) => message(problem),
        None => help.to_owned(),
    };
    if !text.is_empty() {
        response.on_hover_text(text);
    }
}

/// Shows a list of ids for a field; returns the id that was selected.
pub fn choose(
    ui: &mut Ui,
    documents: &Documents,
    path: &str,
    field: &str,
    choices: &[(String, String)],
    width: f32,
) -> Option<String> {
    let field = Field { documents, path, field };
    choose_described(ui, field, choices, str::to_owned, width)
}

/// Shows a choice of a field's value, with a description of each choice on hover; returns another value that is chosen.
pub fn choose_described(
    ui: &mut Ui,
    Field { documents, path, field }: Field<'_>,
    choices: &[(String, String)],
    describe: impl Fn(&str) -> String,
    width: f32,
) -> Option<String> {
    let stored = documents.field(path, field).unwrap_or_default();
    let shown = choices
        .iter()
        .find(|(id, _)| *id == stored)
        .map_or(stored.clone(), |(_, name)| name.clone());
    let mut taken = None;
    let mut selected = RichText::new(&shown);
    // As in a text box, what an empty field stands for is faint.
    if stored.is_empty() {
        selected = selected.color(Theme::palette_of(ui).faint);
    }
    let combo = egui::ComboBox::from_id_salt(("choice", path, field))
        .width(width)
        .truncate()
        .selected_text(selected);
    let response = combo.show_ui(ui, |ui| {
        for (id, name) in choices {
            if ui.selectable_label(*id == stored, name).on_hover_text(describe(id)).clicked() {
                taken = Some(id.clone());
            }
        }
    });
    outline(ui, &response.response, documents.problem_at(path, field));
    // A narrow panel truncates a long name.
    if !shown.is_empty() {
        let mut whole = shown;
        let about = describe(&stored);
        // Without a description of its own, a choice is described by its id.
        if !about.is_empty() && about != stored {
            whole = format!("{whole}\n{about}");
        }
        response.response.on_hover_text(whole);
    }
    taken.filter(|id| *id != stored)
}

#[cfg(test)]
mod tests {
    use super::shortened;

    #[test]
    fn only_plain_numbers_of_many_digits_are_shortened() {
        for (stored, shown) in [
            ("0.3333333333333333", "0.3333"),
            ("12.500000001", "12.5"),
            ("0.5", "0.5"),
            ("123456789", "123456789"),
            ("0.00012345678", "0.00012345678"),
            ("0.3333333333 m", "0.3333333333 m"),
            ("sink-3-8.rope", "sink-3-8.rope"),
        ] {
            assert_eq!(shortened(stored), shown);
        }
    }
}
