//! Commands in the 3-D view.

use endline_session::command::{Choice, FileQuestion, Make, Shortcut, When};

use super::WindowInfo;
use super::action::{ViewAction, WindowCommand};
use crate::gui::files::stem;
use crate::gui::inspector::worst_m;
use crate::gui::shared::Shared;
use crate::scene::draw::MOST_PANES;
use crate::scene::{Picked, View};

/// The actions in the 3-D view, declared.
pub static COMMANDS: &[WindowInfo] = &[
    WindowInfo::new(
        "view.frame",
        "See everything",
        "Brings the gear and the whale into sight.",
        Make::Plain(|| ViewAction::Frame.into()),
    )
    .with_keys(&[Shortcut::new("F", When::NotFlying)])
    .only_if(shown),
    WindowInfo::new(
        "view.side",
        "View side",
        "Looks from the side.",
        Make::Plain(|| ViewAction::Look(View::Side).into()),
    )
    .with_keys(&[Shortcut::new("1", When::NotFlying)]),
    WindowInfo::new(
        "view.top",
        "View top",
        "Looks from above.",
        Make::Plain(|| ViewAction::Look(View::Top).into()),
    )
    .with_keys(&[Shortcut::new("7", When::NotFlying)]),
    WindowInfo::new(
        "view.front",
        "View front",
        "Looks from the front.",
        Make::Plain(|| ViewAction::Look(View::Front).into()),
    )
    .with_keys(&[Shortcut::new("3", When::NotFlying)]),
    WindowInfo::new(
        "view.orbit",
        "View orbit",
        "Looks from where the view was turned to.",
        Make::Plain(|| ViewAction::Look(View::Orbit).into()),
    )
    .with_keys(&[Shortcut::new("5", When::NotFlying)]),
    WindowInfo::new(
        "view.look",
        "View",
        "Looks at the whale, or from it, and goes with it.",
        Make::Choices(|_| {
            let choice = |view: View| {
                Choice::new(view.name().replace('-', " "), ViewAction::Look(view).into())
            };
            View::OF_WHALE.into_iter().map(choice).collect()
        }),
    ),
    WindowInfo::new(
        "view.split",
        "Views at once:",
        "Shows this number of views of the same moment side by side.",
        Make::Choices(|_| {
            (1..=MOST_PANES)
                .map(|count| Choice::new(count.to_string(), ViewAction::Split(count).into()))
                .collect()
        }),
    ),
    WindowInfo::new(
        "view.save-picture",
        "Save a picture of the view",
        "Draws what the chosen view shows at full size, 1920 by 1080, into a PNG file.",
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
    WindowInfo::new(
        "view.save-film",
        "Save a film of the run",
        "Draws the run from its start by the camera keys, or as the chosen view shows it, 1280 by 720 at 20 pictures a second, into a GIF, or by ffmpeg into MP4 or WebM. The window can be used meanwhile.",
        Make::File {
            question: |shared| {
                let scenario = stem(shared.workbench.project().documents.scenario_path());
                FileQuestion::write("film", &["mp4", "webm", "gif"], format!("{scenario}.mp4"))
            },
            command: |_, file| ViewAction::SaveFilm(file).into(),
        },
    )
    .only_if(can_film),
    WindowInfo::new(
        "view.cancel-film",
        "Cancel the film",
        "Ends the film that is being made; the pictures drawn so far stay.",
        Make::Plain(|| ViewAction::CancelFilm.into()),
    )
    .only_if(films),
    WindowInfo::new(
        "view.set-key",
        "Set a camera key",
        "Notes what the chosen view shows at this moment: a film goes from key to key.",
        Make::Plain(|| ViewAction::SetKey.into()),
    )
    .with_keys(&[Shortcut::new("I", When::NotFlying)])
    .only_if(shown),
    WindowInfo::new(
        "view.clear-keys",
        "Clear the camera keys",
        "Takes the keys of the camera away: a film is seen as the view is now.",
        Make::Plain(|| ViewAction::ClearKeys.into()),
    )
    .only_if(|shared| match shared.selection.camera_keys {
        0 => Err("the camera has no keys".to_owned()),
        _ => Ok(()),
    }),
    WindowInfo::new(
        "view.pose",
        "Drag the whale's start",
        "Shows handles that move where the whale starts, how deep, and where it heads; or hides them.",
        Make::Plain(|| ViewAction::Pose.into()),
    ),
    WindowInfo::new(
        "view.ruler",
        "Ruler",
        "Lets two clicks measure between two places, straight and along the rope; or lets a click inspect again.",
        Make::Plain(|| ViewAction::Ruler.into()),
    )
    .with_keys(&[Shortcut::new("R", When::NotFlying)]),
    WindowInfo::new(
        "view.inspect",
        "Read",
        "Shows the properties of a body, or of a line where its tension is greatest.",
        Make::Choices(inspected),
    )
    .only_if(shown),
    WindowInfo::new(
        "view.let-go",
        "Clear the inspector and the ruler",
        "Takes the properties and the measure away.",
        Make::Plain(|| ViewAction::LetGo.into()),
    )
    .only_if(|shared| match shared.selection.inspects {
        true => Ok(()),
        false => Err("nothing is inspected or measured".to_owned()),
    }),
];

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
    shared.film.as_ref().map(drop).ok_or_else(|| "no film is being made".to_owned())
}

/// Whether there is something to see.
pub(super) fn shown(shared: &Shared) -> Result<(), String> {
    shared.workbench.view().map(|_| ()).ok_or_else(|| "no run is there yet".to_owned())
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
