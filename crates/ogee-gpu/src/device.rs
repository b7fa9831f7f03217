//! `Device`: the graphics processor that pictures are made on.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use wgpu::{Backends, DeviceType, DownlevelFlags};

use crate::GpuError;
use crate::layout::{PARTS, TEXTURE_WIDTH};

/// How shaders read the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// From storage buffers.
    Buffers,
    /// From textures: quicker on software devices, and there where buffers are not, as in WebGL2.
    Textures,
}

/// Which device is wanted, and how much of it.
#[derive(Clone, Debug)]
pub struct DeviceOptions {
    /// Interfaces to look at.
    pub backends: Backends,
    /// A part of the adapter's name, in any case; the best adapter unless it is given.
    pub name: Option<String>,
    /// Whether a program is to stand for the device, or must not; the best adapter unless it is given.
    pub is_software: Option<bool>,
    /// How shaders read the surface; as the adapter likes it best unless it is given.
    pub storage: Option<Storage>,
    /// What the device is asked for; all that the adapter offers unless it is given.
    /// [`wgpu::Limits::downlevel_webgl2_defaults`] are enough.
    pub limits: Option<wgpu::Limits>,
    /// The most bytes that one binding holds, if less than the limits allow.
    pub most_bytes: Option<u64>,
    /// How long a picture may take before the device is taken for hung.
    pub timeout: Duration,
}

impl Default for DeviceOptions {
    fn default() -> DeviceOptions {
        DeviceOptions {
            backends: Backends::VULKAN | Backends::METAL | Backends::DX12 | Backends::GL,
            name: None,
            is_software: None,
            storage: None,
            limits: None,
            most_bytes: None,
            timeout: Duration::from_secs(60),
        }
    }
}

/// A graphics processor, opened.
#[derive(Debug)]
pub struct Device {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) storage: Storage,
    name: String,
    is_software: bool,
    /// Points that one binding holds: a power of two, so that no net lies in two of them.
    pub(crate) part: u32,
    timeout: Duration,
    /// The first thing that went wrong since it was last asked for.
    fault: Arc<Mutex<Option<GpuError>>>,
}

impl Device {
    /// Opens the best device there is: one with memory of its own before one that shares it, either before software.
    ///
    /// # Errors
    /// If there is none, or it will not be opened with what is asked for.
    pub fn new(options: &DeviceOptions) -> Result<Device, GpuError> {
        let mut adapters = adapters(options.backends - Backends::GL);
        let wanted = options.name.as_deref().unwrap_or_default().to_lowercase();
        let is_wanted = |adapter: &&wgpu::Adapter| {
            let info = adapter.get_info();
            let is_kind =
                options.is_software.is_none_or(|wanted| wanted == (info.device_type == DeviceType::Cpu));
            let fits = options.storage != Some(Storage::Buffers) || has_buffers(adapter, options);
            is_kind && fits && info.name.to_lowercase().contains(&wanted)
        };
        // OpenGL reaches the same devices by a longer way.
        if !adapters.iter().any(|adapter| is_wanted(&adapter)) {
            adapters.extend(self::adapters(options.backends & Backends::GL));
        }
        let Some(adapter) = adapters.iter().filter(is_wanted).min_by_key(|adapter| rank(adapter)) else {
            return Err(no_adapter(options, &adapters));
        };
        let storage = options.storage.unwrap_or_else(|| best_storage(adapter, options));
        let mut limits = limits(adapter, options);
        if let Some(most) = options.most_bytes {
            limits.max_storage_buffer_binding_size = limits.max_storage_buffer_binding_size.min(most);
        }
        let part = part(storage, &limits, options.most_bytes);
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("ogee"),
            required_limits: limits,
            ..Default::default()
        }))
        .map_err(|error| GpuError::Refused { message: error.to_string() })?;
        let fault = Arc::new(Mutex::new(None));
        let errors = Arc::clone(&fault);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            note(&errors, GpuError::Failed { message: error.to_string() });
        }));
        let losses = Arc::clone(&fault);
        device.set_device_lost_callback(move |reason, message| {
            // Closing it is no accident.
            if reason != wgpu::DeviceLostReason::Destroyed {
                note(&losses, GpuError::Lost { message });
            }
        });
        let info = adapter.get_info();
        let name = format!("{} ({})", info.name, info.backend);
        let is_software = info.device_type == DeviceType::Cpu;
        Ok(Device { device, queue, storage, name, is_software, part, timeout: options.timeout, fault })
    }

    /// True if a program stands for the device: the renderer in `f64` does as well.
    pub fn is_software(&self) -> bool {
        self.is_software
    }

    /// The name of the adapter and the interface to it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// How shaders read the surface.
    pub fn storage(&self) -> Storage {
        self.storage
    }

    /// Waits until all that was asked for is done.
    ///
    /// # Errors
    /// If something failed, or it takes too long.
    pub fn finish(&self) -> Result<(), GpuError> {
        // Data wait for a submission to go with.
        self.queue.submit([]);
        let wait = wgpu::PollType::Wait { submission_index: None, timeout: Some(self.timeout) };
        let waited = self.device.poll(wait);
        self.check()?;
        waited.map(|_| ()).map_err(|_| GpuError::Timeout { seconds: self.timeout.as_secs_f64() })
    }

    /// What went wrong since it was last asked for.
    pub(crate) fn check(&self) -> Result<(), GpuError> {
        let mut fault = self.fault.lock().unwrap_or_else(PoisonError::into_inner);
        fault.take().map_or(Ok(()), Err)
    }

    /// The most bytes of one binding of the surface, and of one buffer.
    pub(crate) fn most_bytes(&self) -> u64 {
        let limits = self.device.limits();
        match self.storage {
            Storage::Buffers => limits.max_storage_buffer_binding_size.min(limits.max_buffer_size),
            Storage::Textures => 16 * u64::from(TEXTURE_WIDTH) * u64::from(limits.max_texture_dimension_2d),
        }
    }
}

fn note(fault: &Mutex<Option<GpuError>>, error: GpuError) {
    fault.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
}

/// All adapters that some interfaces reach.
fn adapters(backends: Backends) -> Vec<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    pollster::block_on(wgpu::Instance::new(descriptor).enumerate_adapters(backends))
}

fn limits(adapter: &wgpu::Adapter, options: &DeviceOptions) -> wgpu::Limits {
    options.limits.clone().unwrap_or_else(|| adapter.limits())
}

/// Whether fragment shaders of an adapter read as many buffers as a surface has.
fn has_buffers(adapter: &wgpu::Adapter, options: &DeviceOptions) -> bool {
    adapter.get_downlevel_capabilities().flags.contains(DownlevelFlags::FRAGMENT_STORAGE)
        && limits(adapter, options).max_storage_buffers_per_shader_stage as usize >= 4 + PARTS
}

/// What shaders of an adapter read quickest. Software reads buffers one number after the other, texels several at a time: a
/// third of the time.
fn best_storage(adapter: &wgpu::Adapter, options: &DeviceOptions) -> Storage {
    let is_software = adapter.get_info().device_type == DeviceType::Cpu;
    if has_buffers(adapter, options) && !is_software { Storage::Buffers } else { Storage::Textures }
}

/// The best is least.
fn rank(adapter: &wgpu::Adapter) -> u32 {
    match adapter.get_info().device_type {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    }
}

/// How many points a binding holds.
fn part(storage: Storage, limits: &wgpu::Limits, most_bytes: Option<u64>) -> u32 {
    let bytes = match storage {
        Storage::Buffers => limits.max_storage_buffer_binding_size.min(limits.max_buffer_size),
        Storage::Textures => 16 * u64::from(TEXTURE_WIDTH) * u64::from(limits.max_texture_dimension_2d),
    };
    let points = bytes.min(most_bytes.unwrap_or(u64::MAX)) / 16;
    // Numbers of points have 32 bits, and all parts together have to be counted.
    1 << points.clamp(u64::from(TEXTURE_WIDTH), 1 << 29).ilog2()
}

fn no_adapter(options: &DeviceOptions, adapters: &[wgpu::Adapter]) -> GpuError {
    let backends: Vec<String> = options.backends.iter_names().map(|(name, _)| name.to_lowercase()).collect();
    let kind = match options.is_software {
        None => "an adapter",
        Some(true) => "an adapter in software",
        Some(false) => "an adapter that is no software",
    };
    let name = options.name.as_ref().map(|name| format!(" named \"{name}\"")).unwrap_or_default();
    let storage = options.storage.filter(|&storage| storage == Storage::Buffers);
    let with = storage.map(|_| " with storage buffers in fragment shaders").unwrap_or_default();
    let found: Vec<String> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
    GpuError::NoAdapter {
        wanted: format!("{kind}{name}{with} through {}", backends.join(", ")),
        found: if found.is_empty() { "none at all".into() } else { found.join(", ") },
    }
}

#[cfg(test)]
mod tests {
    use ogee::quality::LimitView;
    use ogee::{Level, LimitSurface, PatchTable, shapes};

    use super::*;
    use crate::{GpuSurface, Renderer};

    #[test]
    fn a_device_that_is_gone_is_an_error() {
        let Ok(device) = Device::new(&DeviceOptions::default()) else {
            println!("skipped: no adapter");
            return;
        };
        let mesh = shapes::cube();
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let limit = LimitSurface::new(&table, &mesh.points);
        let view = LimitView::new(&level, &limit);
        let renderer = Renderer::new(&device).unwrap();
        let surface = GpuSurface::new(&device, &view).unwrap();
        device.device.destroy();
        let scene = ogee_render::Scene::of(&view, [64, 64]);
        let error = renderer.render(&surface, &scene).unwrap_err();
        assert!(["device_lost", "device_failed"].contains(&error.code()), "{error}");
    }
}
