//! OpenGL without a display: an EGL off-screen surface, for pictures and tests.
//!
//! A request for an OpenGL context calls a C library, so this file may use `unsafe`. Each block states why its call is sound.
#![expect(unsafe_code, reason = "making an OpenGL context calls the system's EGL library")]

use std::ffi::CStr;
use std::num::NonZeroU32;
use std::sync::Arc;

use glutin::api::egl::config::Config;
use glutin::api::egl::context::PossiblyCurrentContext;
use glutin::api::egl::device::Device;
use glutin::api::egl::display::Display;
use glutin::api::egl::surface::Surface;
use glutin::config::{ConfigSurfaceTypes, ConfigTemplateBuilder};
use glutin::context::{ContextApi, ContextAttributesBuilder, Version};
use glutin::display::GlDisplay;
use glutin::prelude::*;
use glutin::surface::{PbufferSurface, SurfaceAttributesBuilder};
use three_d::context::Context as Gl;

/// An off-screen surface with its OpenGL context, current on the thread that made it.
pub struct Offscreen {
    /// OpenGL on the surface.
    pub gl: Arc<Gl>,
    _context: PossiblyCurrentContext,
    _surface: Surface<PbufferSurface>,
}

impl Offscreen {
    /// A surface of `size` pixels on the first device that has one.
    /// Errors: the reason, and the packages that are needed.
    pub fn new(size: [u32; 2]) -> Result<Self, String> {
        let explain = |reason: String| {
            format!(
                "no OpenGL to draw with ({reason}); pictures need EGL, on Debian the packages libegl1 and libgl1-mesa-dri"
            )
        };
        let devices = Device::query_devices().map_err(|error| explain(error.to_string()))?;
        let mut reason = "no device".to_string();
        for device in devices {
            match Self::on(&device, size) {
                Ok(made) => return Ok(made),
                Err(error) => reason = error.to_string(),
            }
        }
        Err(explain(reason))
    }

    fn on(device: &Device, size: [u32; 2]) -> Result<Self, glutin::error::Error> {
        // SAFETY: no native display handle is passed, so none can dangle.
        let display = unsafe { Display::with_device(device, None) }?;
        let config = first_config(&display)?;
        let wanted = ContextAttributesBuilder::new()
            .with_context_api(ContextApi::OpenGl(Some(Version::new(3, 3))))
            .build(None);
        // SAFETY: `config` comes from this display, and no native window handle is passed.
        let context = unsafe { display.create_context(&config, &wanted) }?;
        let side = |pixels: u32| NonZeroU32::new(pixels).unwrap_or(NonZeroU32::MIN);
        let wanted =
            SurfaceAttributesBuilder::<PbufferSurface>::new().build(side(size[0]), side(size[1]));
        // SAFETY: `config` comes from this display.
        let surface = unsafe { display.create_pbuffer_surface(&config, &wanted) }?;
        let context = context.make_current(&surface)?;
        // SAFETY: the context is current on this thread, and the display returns the addresses of its own functions.
        let gl =
            unsafe { Gl::from_loader_function_cstr(|name: &CStr| display.get_proc_address(name)) };
        Ok(Self { gl: Arc::new(gl), _context: context, _surface: surface })
    }
}

fn first_config(display: &Display) -> Result<Config, glutin::error::Error> {
    let wanted = ConfigTemplateBuilder::new()
        .with_surface_type(ConfigSurfaceTypes::PBUFFER)
        .with_alpha_size(8)
        .with_depth_size(24)
        .build();
    // SAFETY: the template names no native window, so nothing in it can dangle.
    let mut configs = unsafe { display.find_configs(wanted) }?;
    configs.next().ok_or_else(|| glutin::error::ErrorKind::BadConfig.into())
}
