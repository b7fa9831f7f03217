//! Textures that passes write into: four numbers of 32 bits for each pixel. Those are bits of whole numbers and of others alike,
//! since not every device can draw into textures of the others.

use ogee_render::shade::palette;

use crate::GpuError;
use crate::device::Device;
use crate::layout::NO_SURFACE;
use crate::shaders::Entry;

pub(crate) const TARGET: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;
pub(crate) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// A texture to draw into.
#[derive(Debug)]
pub(crate) struct Target {
    pub(crate) texture: wgpu::Texture,
    pub(crate) view: wgpu::TextureView,
}

impl Target {
    /// # Errors
    /// If the device takes no texture of this size.
    pub(crate) fn new(device: &Device, size: [u32; 2]) -> Result<Target, GpuError> {
        let most = u64::from(device.device.limits().max_texture_dimension_2d);
        let count = u64::from(size[0].max(size[1]));
        if count > most {
            return Err(GpuError::TooLarge { what: "sides", count, unit: "pixels", most });
        }
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC;
        let texture = texture(device, size, TARGET, usage);
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Ok(Target { texture, view })
    }

    /// Cleared to what a pixel without surface holds.
    pub(crate) fn attachment(&self, entry: Entry) -> wgpu::RenderPassColorAttachment<'_> {
        let [r, g, b] = palette::BACKGROUND.map(|x| f64::from(x.to_bits()));
        let empty = match entry.is_coloured() {
            true => wgpu::Color { r, g, b, a: f64::from(NO_SURFACE) },
            false => wgpu::Color::TRANSPARENT,
        };
        wgpu::RenderPassColorAttachment {
            view: &self.view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(empty), store: wgpu::StoreOp::Store },
        }
    }
}

/// A texture of depths.
pub(crate) fn depth(device: &Device, size: [u32; 2]) -> wgpu::TextureView {
    let texture = texture(device, size, DEPTH, wgpu::TextureUsages::RENDER_ATTACHMENT);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

fn texture(
    device: &Device,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    device.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}
