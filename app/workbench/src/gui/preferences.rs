//! What a user prefers, kept between sessions.

use endline_session::workbench::Preferences as WorkbenchPreferences;
use serde::{Deserialize, Serialize};

use super::theme::Theme;
use crate::input::Mapping;

/// What a user prefers of the window.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// Dark or light.
    pub theme: Theme,
    /// Whether pushing the stick puts the nose down.
    pub invert_pitch: bool,
    /// What the pad does.
    pub mapping: Mapping,
    /// Size of everything on screen, 1 for usual; larger for a projector.
    pub scale: Scale,
}

/// Preferences of window and workbench, as they are kept in one place.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Kept {
    /// Those of the window.
    #[serde(flatten)]
    pub window: Preferences,
    /// Those of the workbench.
    #[serde(flatten)]
    pub workbench: WorkbenchPreferences,
}

/// Size of everything on screen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scale(pub f32);

impl Default for Scale {
    fn default() -> Self {
        Self(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn preferences_of_window_and_workbench_are_kept_in_one_text_and_read_from_an_older_one() {
        let text = r#"{"theme":"Light","units":"Noaa","invert_pitch":true,"scale":1.5,"recent":["a.toml"]}"#;
        let kept: Kept = serde_json::from_str(text).unwrap();
        assert_eq!((kept.window.theme, kept.window.scale), (Theme::Light, Scale(1.5)));
        assert_eq!(kept.workbench.recent, [std::path::PathBuf::from("a.toml")]);
        let again: Kept = serde_json::from_str(&serde_json::to_string(&kept).unwrap()).unwrap();
        assert_eq!((again.window, again.workbench), (kept.window, kept.workbench));
    }
}
