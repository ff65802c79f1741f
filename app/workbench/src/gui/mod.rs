//! The window of the workbench, drawn with egui.
//!
//! The window holds no state of a simulation: it reads the newest [`LiveView`](endline_session::live::LiveView) and sends commands.
//! Panels draw from what they [share](shared::Shared) and give [commands](command).

pub mod app;
pub mod bars;
pub mod bodymap;
pub mod command;
pub mod fields;
pub mod files;
pub mod inspector;
pub mod layout;
pub mod palette;
pub mod panel;
pub mod panels;
pub mod pictures;
pub mod questions;
pub mod scenario_fields;
pub mod shared;
pub mod theme;
pub mod widgets;

use std::path::PathBuf;
use std::sync::Arc;

use endline_session::edit::Documents;
use endline_session::task::Waker;
use endline_session::workbench::Folders;
use endline_session::{live, load_with, locate};

use crate::embedded;
use crate::input::{GilrsPads, PadSource, Pilot};
use app::App;
use shared::Shared;

/// Options for the start of the workbench.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Folder of the gear library; `None` searches for it.
    pub library: Option<PathBuf>,
    /// Scenario to open; `None` opens `hello-endline` of the library.
    pub scenario: Option<PathBuf>,
    /// Folders to search for plugins.
    pub plugins: Vec<PathBuf>,
    /// File for layout and preferences; `None` selects one in the user's data folder.
    pub settings: Option<PathBuf>,
}

/// Opens the workbench and returns when its window is closed.
pub fn open(options: Options) -> Result<(), String> {
    let root = locate::library(options.scenario.as_deref(), options.library.as_deref())?;
    let scenario = options.scenario.unwrap_or_else(|| root.join("scenarios/hello-endline.toml"));
    let documents = Documents::open(&root, &scenario)?;
    let mut loader = embedded::plugin_loader(&options.plugins);
    let (host, refused) = load_with(&mut loader);
    let native = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("Endline")
            .with_inner_size([1500.0, 940.0])
            .with_min_inner_size([900.0, 600.0])
            .with_app_id("endline")
            .with_icon(icon()),
        renderer: eframe::Renderer::Glow,
        persistence_path: options.settings.clone(),
        ..eframe::NativeOptions::default()
    };
    // Recordings and results are stored in the folder of the settings.
    let data = match options.settings.as_deref().and_then(std::path::Path::parent) {
        Some(folder) => Some(folder.to_owned()),
        None => eframe::storage_dir("endline"),
    };
    let create = move |creation: &eframe::CreationContext<'_>| {
        let host = Arc::new(host);
        let context = creation.egui_ctx.clone();
        let waker: Waker = Arc::new(move || context.request_repaint());
        let mut shared =
            Shared::new(documents, host, live::engine::live(), waker, Pilot::new(pads()));
        shared.workbench.load_plugins_with(loader, Arc::new(load_with), refused);
        if let Some(folder) = &data {
            shared.workbench.write_to(Folders::within(folder));
            shared.pages = Some(folder.join("documents"));
        }
        let app: Box<dyn eframe::App> = Box::new(App::new(creation, shared));
        Ok(app)
    };
    eframe::run_native("endline", native, Box::new(create))
        .map_err(|error| format!("no window can be opened: {error}"))
}

/// The window's icon. If it cannot be decoded, an empty icon makes the system use its own.
fn icon() -> egui::IconData {
    const PNG: &[u8] =
        include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/icon/endline.png"));
    eframe::icon_data::from_png_bytes(PNG).unwrap_or_default()
}

/// The pads of this machine; `None` if the system gives no access, so that only the keyboard steers.
fn pads() -> Option<Box<dyn PadSource>> {
    let pads: Box<dyn PadSource> = Box::new(GilrsPads::new().ok()?);
    Some(pads)
}
