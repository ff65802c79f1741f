//! A window without a screen, and the time of its frames.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use eframe::App as _;
use egui::{Event, Pos2, RawInput, Rect, vec2};
use egui_dock::{DockState, NodeIndex};
use endline_session::edit::Documents;
use endline_session::live::engine;
use endline_workbench::gui::app::App;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::shared::Shared;
use endline_workbench::input::Pilot;
use endline_workbench::scene::draw::Canvas;

use crate::common::linked;

/// CPU time of this thread since its start [s].
pub fn thread_cpu_s() -> f64 {
    cpu_time::ThreadTime::now().as_duration().as_secs_f64()
}

/// A window without a screen.
pub struct Screen {
    pub context: egui::Context,
    pub app: App,
    frame: eframe::Frame,
    time_s: f64,
    woken: Arc<AtomicBool>,
}

impl Screen {
    pub fn new(documents: Documents) -> Self {
        let context = egui::Context::default();
        let creation = eframe::CreationContext::_new_kittest(context.clone());
        let woken = Arc::new(AtomicBool::new(false));
        let waker = {
            let woken = Arc::clone(&woken);
            Arc::new(move || woken.store(true, Ordering::Release))
        };
        let mut app = App::new(
            &creation,
            Shared::new(documents, linked(), engine::live(), waker, Pilot::default()),
        );
        // With a canvas the view makes its triangles as with a graphics card; they are not drawn.
        app.panels.view.drawn[0].canvas = Some(Arc::new(Mutex::new(Canvas::default())));
        Self { context, app, frame: eframe::Frame::_new_kittest(), time_s: 0.0, woken }
    }

    /// Draws one frame with these inputs. Returns its CPU time [s]: logic, panels, triangles of the scene, tessellation.
    pub fn frame(&mut self, events: Vec<Event>) -> f64 {
        self.time_s += 1.0 / 60.0;
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(1920.0, 1080.0))),
            time: Some(self.time_s),
            events,
            focused: true,
            ..RawInput::default()
        };
        self.woken.store(false, Ordering::Release);
        let start = thread_cpu_s();
        let (app, frame) = (&mut self.app, &mut self.frame);
        let mut output = self.context.run_ui(input, |ui| {
            app.logic(&ui.ctx().clone(), frame);
            app.ui(ui, frame);
        });
        let shapes =
            self.context.tessellate(std::mem::take(&mut output.shapes), output.pixels_per_point);
        let spent = thread_cpu_s() - start;
        // There is no screen for them.
        output.textures_delta.clear();
        drop(shapes);
        spent
    }

    /// Draws a number of frames without input.
    pub fn settle(&mut self, frames: u32) {
        for _ in 0..frames {
            self.frame(Vec::new());
        }
    }

    /// Draws repeatedly until a condition holds.
    #[track_caller]
    pub fn wait(&mut self, so: impl Fn(&App) -> bool) {
        let patience = Instant::now() + Duration::from_secs(300);
        while !so(&self.app) {
            assert!(
                Instant::now() < patience,
                "timeout: {:?} {:?}",
                self.app.shared.workbench.status(),
                self.app.shared.workbench.notice()
            );
            std::thread::sleep(Duration::from_millis(25));
            self.frame(Vec::new());
        }
    }

    /// Waits until another thread requests a frame, at most half a second.
    pub fn sleep_until_woken(&self) {
        let patience = Instant::now() + Duration::from_millis(500);
        while !self.woken.load(Ordering::Acquire) && Instant::now() < patience {
            std::thread::sleep(Duration::from_micros(200));
        }
    }

    /// Times of a number of frames that each show a different moment of the run [s].
    pub fn moments(&mut self, count: usize) -> Vec<f64> {
        let (mut times, mut shown) = (Vec::new(), std::ptr::null());
        let patience = Instant::now() + Duration::from_secs(120);
        while times.len() < count {
            assert!(
                Instant::now() < patience,
                "{} moments: {:?}",
                times.len(),
                self.app.shared.workbench.status()
            );
            self.sleep_until_woken();
            let spent = self.frame(Vec::new());
            let now = self
                .app
                .shared
                .workbench
                .view()
                .map_or(std::ptr::null(), |view| Arc::as_ptr(&view.frame));
            if now != shown {
                times.push(spent);
            }
            shown = now;
        }
        times
    }

    /// Opens every panel in its own place, four in a row.
    pub fn open_all(&mut self) {
        let ids: Vec<Vec<String>> =
            PanelId::ALL.iter().map(|panel| vec![panel.id().to_owned()]).collect();
        let rows: Vec<&[Vec<String>]> = ids.chunks(4).collect();
        let mut dock = DockState::new(rows[0][0].clone());
        let tree = dock.main_surface_mut();
        let mut heads = vec![NodeIndex::root()];
        for (index, row) in rows.iter().enumerate().skip(1) {
            let share = 1.0 / (rows.len() - index + 1) as f32;
            let last = heads.len() - 1;
            let [above, below] = tree.split_below(heads[last], share, row[0].clone());
            heads[last] = above;
            heads.push(below);
        }
        for (row, head) in rows.iter().zip(heads) {
            let mut at = head;
            for (index, panel) in row.iter().enumerate().skip(1) {
                [_, at] = tree.split_right(at, 1.0 / (row.len() - index + 1) as f32, panel.clone());
            }
        }
        self.app.dock = dock;
    }

    /// Opens only one panel.
    pub fn open_alone(&mut self, panel: PanelId) {
        self.app.dock = DockState::new(vec![panel.id().to_owned()]);
    }
}
