//! Pictures on a graphics processor.

use std::time::Instant;

use ogee_gpu::{Device, DeviceOptions, GpuError, GpuSurface, Renderer};
use ogee_render::{Picture, Scene};

use crate::subject::Subject;

/// A picture, the name of the adapter that made it, and how long opening it and sending the surface took.
pub(crate) type Drawn = (Picture, String, f64);

/// Why a graphics processor is not the one to ask.
pub(crate) enum Unfit {
    /// It does not know patches of parts.
    Patches,
    /// Nor the caps of lenses and poles.
    Caps,
    /// It is a program, and another does as well.
    Software(String),
    /// There is none, or it failed.
    Device(GpuError),
}

/// Draws a scene; `even_software` on adapters that are programs too.
pub(crate) fn draw(subject: &Subject, scene: &Scene, even_software: bool) -> Result<Drawn, Unfit> {
    if subject.has_caps() {
        return Err(Unfit::Caps);
    }
    let start = Instant::now();
    let device = Device::new(&DeviceOptions::default()).map_err(Unfit::Device)?;
    if device.is_software() && !even_software {
        return Err(Unfit::Software(device.name().to_owned()));
    }
    let drawn = subject.look_at_limit(|view| {
        let renderer = Renderer::new(&device)?;
        let surface = GpuSurface::new(&device, view)?;
        let upload = start.elapsed().as_secs_f64();
        let picture = renderer.render(&surface, scene)?;
        Ok((picture, device.name().to_owned(), upload))
    });
    drawn.ok_or(Unfit::Patches)?.map_err(Unfit::Device)
}
