//! Commands in the 3-D view.

use endline_session::command::info::{ready, require};
use endline_session::command::{Choice, FileQuestion, Make, When};

use super::WindowInfo;
use super::action::{ViewAction, ViewVerb, WindowCommand};
use crate::gui::files::stem;
use crate::gui::inspector::worst_m;
use crate::gui::shared::Shared;
use crate::scene::draw::MOST_PANES;
use crate::scene::film::has_ffmpeg;
use crate::scene::{Picked, View};

/// The actions in the 3-D view, declared.
pub(super) fn commands() -> Vec<WindowInfo> {
    vec![
        WindowInfo::plain(ViewAction::Frame).with_key("F", When::NotFlying).only_if(shown),
        look(View::Side, "view.side", "View side", "Looks from the side.", "1"),
        look(View::Top, "view.top", "View top", "Looks from above.", "7"),
        look(View::Front, "view.front", "View front", "Looks from the front.", "3"),
        look(
            View::Orbit,
            "view.orbit",
            "View orbit",
            "Looks from where the view was turned to.",
            "5",
        ),
        WindowInfo::of(
            ViewVerb::Look,
            Make::Choices(|_| {
                let choice = |view: View| {
                    Choice::new(view.name().replace('-', " "), ViewAction::Look(view).into())
                };
                View::OF_WHALE.into_iter().map(choice).collect()
            }),
        ),
        WindowInfo::of(
            ViewVerb::Split,
            Make::Choices(|_| {
                (1..=MOST_PANES)
                    .map(|count| Choice::new(count.to_string(), ViewAction::Split(count).into()))
                    .collect()
            }),
        ),
        WindowInfo::of(
            ViewVerb::SavePicture,
            Make::File {
                question: |shared| {
                    let scenario = stem(shared.workbench.project().documents.scenario_path());
                    let time_s = shared.workbench.view().map_or(0.0, |view| view.frame.time_s);
                    let name = format!("{scenario}-{time_s:.0}-s.png");
                    FileQuestion::write("picture", &["png"], name)
                },
                command: |_, file| ViewAction::SavePicture(file).into(),
            },
        )
        .only_if(shown),
        WindowInfo::of(
            ViewVerb::SaveFilm,
            Make::File {
                question: |shared| {
                    let scenario = stem(shared.workbench.project().documents.scenario_path());
                    film_question(&scenario, has_ffmpeg())
                },
                command: |_, file| ViewAction::SaveFilm(file).into(),
            },
        )
        .only_if(can_film),
        WindowInfo::plain(ViewAction::CancelFilm).only_if(films),
        WindowInfo::plain(ViewAction::SetKey).with_key("I", When::NotFlying).only_if(shown),
        WindowInfo::plain(ViewAction::ClearKeys)
            .only_if(|shared| require(shared.selection.camera_keys > 0, "the camera has no keys")),
        WindowInfo::plain(ViewAction::Pose),
        WindowInfo::plain(ViewAction::Ruler).with_key("R", When::NotFlying),
        WindowInfo::of(ViewVerb::Inspect, Make::Choices(inspected)).only_if(shown),
        WindowInfo::plain(ViewAction::LetGo).only_if(|shared| {
            require(shared.selection.inspects, "nothing is inspected or measured")
        }),
    ]
}

/// The question for the file of a film; a GIF needs no other program.
fn film_question(scenario: &str, has_ffmpeg: bool) -> FileQuestion {
    let extensions: &[&str] =
        if has_ffmpeg { &["mp4", "webm", "gif"] } else { &["gif", "mp4", "webm"] };
    FileQuestion::write("film", extensions, format!("{scenario}.{}", extensions[0]))
}

/// The command that looks at everything from one side.
fn look(
    view: View,
    id: &'static str,
    name: &'static str,
    help: &'static str,
    key: &'static str,
) -> WindowInfo {
    let make = Make::Plain(ViewAction::Look(view).into());
    WindowInfo::new(id, name, help, make).with_key(key, When::NotFlying)
}

/// A run has moments to film, and no film is being made.
fn can_film(shared: &Shared) -> Result<(), String> {
    shown(shared)?;
    let has_run = shared.workbench.view().is_some_and(|view| view.newest_s > 0.0);
    match (&shared.film, has_run) {
        (Some(_), _) => Err("a film is being made".to_owned()),
        (None, false) => Err("nothing has been run yet".to_owned()),
        (None, true) => Ok(()),
    }
}

fn films(shared: &Shared) -> Result<(), String> {
    require(shared.film.is_some(), "no film is being made")
}

/// Whether there is something to see.
pub(super) fn shown(shared: &Shared) -> Result<(), String> {
    ready(&shared.workbench)
}

/// Each line where its tension is greatest now, and each body.
fn inspected(shared: &Shared) -> Vec<Choice<WindowCommand>> {
    let Some(view) = shared.workbench.view() else { return Vec::new() };
    let spec = &view.model.spec;
    let lines = spec.lines.iter().enumerate().map(|(line, of)| {
        let picked = Picked::Rope { line, at_m: worst_m(&view.model, &view.frame, line) };
        Choice::new(format!("line {}", of.id), ViewAction::Inspect(picked).into())
    });
    let bodies = spec.bodies.iter().enumerate().map(|(index, body)| {
        Choice::new(body.id.clone(), ViewAction::Inspect(Picked::Body(index)).into())
    });
    lines.chain(bodies).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_is_proposed_in_a_format_that_can_be_written() {
        assert_eq!(film_question("trawl", true).file_name, "trawl.mp4");
        let without = film_question("trawl", false);
        assert_eq!((without.file_name.as_str(), without.extensions[0]), ("trawl.gif", "gif"));
    }
}
