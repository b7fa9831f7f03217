//! Graphics adapters in tables 1 and 2.

use std::time::Instant;

use anyhow::Result;
use ogee::quality::LimitView;
use ogee_gpu::{Device, DeviceOptions, GpuError, GpuSurface, Pass, Prepared, Renderer};
use ogee_render::{Sampling, Scene};

use super::interrogation::covering;
use super::timing::{Column, Columns, LEVELS, SIDES, SMALL_AND_LARGE, spread};

/// The best adapter in software and the best in hardware, and which of them there is not.
pub(super) fn adapters(surface: &LimitView<'_>) -> Result<(Vec<Columns>, Vec<String>)> {
    let (mut found, mut lacks) = (Vec::new(), Vec::new());
    for (name, is_software) in [("software", true), ("GPU", false)] {
        match Device::new(&DeviceOptions { is_software: Some(is_software), ..DeviceOptions::default() }) {
            Ok(device) => found.push(columns(name, &device, surface)?),
            Err(GpuError::NoAdapter { .. }) => {
                let what = if is_software { "an adapter in software" } else { "a graphics processor" };
                lacks.push(format!("the columns of {what}: none was found"));
            }
            Err(error) => return Err(error.into()),
        }
    }
    Ok((found, lacks))
}

fn columns(name: &str, device: &Device, surface: &LimitView<'_>) -> Result<Columns> {
    let renderer = Renderer::new(device)?;
    let on_device = GpuSurface::new(device, surface)?;
    let column = |what: String, cells: Vec<String>| Column { heading: format!("{name}: {what}"), cells };
    let meshes = |side: u32| {
        LEVELS.map(|level| Scene { sampling: Sampling::Parameters(level), ..covering(surface, side) })
    };

    let uploads = meshes(SMALL_AND_LARGE[0]).map(|scene| {
        timed(|| {
            let on_device = GpuSurface::new(device, surface)?;
            renderer.prepare(&on_device, &scene)?;
            Ok(device.finish()?)
        })
    });
    let mut first = vec![column("upload".to_owned(), uploads.into_iter().collect::<Result<_>>()?)];
    for side in SMALL_AND_LARGE {
        let cells = meshes(side).map(|scene| {
            let prepared = renderer.prepare(&on_device, &scene)?;
            prepared.set_limit(None);
            pass(device, &prepared, Pass::Parameter)
        });
        first.push(column(format!("ids, {side} x {side}"), cells.into_iter().collect::<Result<_>>()?));
    }

    let mut second = Vec::new();
    for (what, timed_pass, sampling) in [
        ("position", Pass::Position, Sampling::Parameters(2)),
        ("colour", Pass::Colour, Sampling::Parameters(2)),
        ("fused", Pass::Fused, Sampling::Exact),
    ] {
        let cells = SIDES.map(|side| {
            let scene = Scene { sampling, ..covering(surface, side) };
            let prepared = renderer.prepare(&on_device, &scene)?;
            prepared.set_limit(None);
            // What the pass reads.
            for earlier in [Pass::Parameter, Pass::Position] {
                prepared.run(earlier);
            }
            pass(device, &prepared, timed_pass)
        });
        second.push(column(what.to_owned(), cells.into_iter().collect::<Result<_>>()?));
    }
    Ok(Columns { device: format!("{name}: {}", device.name()), first, second })
}

fn pass(device: &Device, prepared: &Prepared<'_>, pass: Pass) -> Result<String> {
    timed(|| {
        prepared.run(pass);
        Ok(device.finish()?)
    })
}

/// Milliseconds of what is done ten times, after once.
fn timed(mut run: impl FnMut() -> Result<()>) -> Result<String> {
    run()?;
    let times: Result<Vec<f64>> = (0..10)
        .map(|_| {
            let start = Instant::now();
            run()?;
            Ok(start.elapsed().as_secs_f64())
        })
        .collect();
    Ok(spread(&times?, |&time| time))
}
