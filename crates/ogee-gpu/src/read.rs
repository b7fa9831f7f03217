//! What passes have written, back from the device.

use std::sync::mpsc;

use crate::GpuError;
use crate::device::Device;
use crate::targets::Target;

/// Four numbers for each pixel, row by row from the top left.
#[derive(Debug)]
pub(crate) struct Texels(Vec<[u32; 4]>);

impl Texels {
    /// The first three numbers, which are a colour, a point or a vector.
    pub(crate) fn colours(&self) -> impl Iterator<Item = [f32; 3]> {
        self.0.iter().map(|&[red, green, blue, _]| [red, green, blue].map(f32::from_bits))
    }

    /// The last number.
    pub(crate) fn values(&self) -> impl Iterator<Item = u32> {
        self.0.iter().map(|texel| texel[3])
    }
}

impl Target {
    /// # Errors
    /// If the device takes no buffer of this size, fails or does not answer.
    pub(crate) fn read(&self, device: &Device) -> Result<Texels, GpuError> {
        let (width, height) = (self.texture.width(), self.texture.height());
        let row = (16 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let (count, most) = (u64::from(row) * u64::from(height), device.device.limits().max_buffer_size);
        if count > most {
            return Err(GpuError::TooLarge { what: "pictures", count, unit: "bytes", most });
        }
        let buffer = device.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture"),
            size: count,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row),
                    rows_per_image: None,
                },
            },
            self.texture.size(),
        );
        device.queue.submit([encoder.finish()]);
        let (sender, mapped) = mpsc::channel();
        buffer.slice(..).map_async(wgpu::MapMode::Read, move |result| {
            // Nobody listens after a timeout.
            let _ = sender.send(result.is_ok());
        });
        device.finish()?;
        let failed = || GpuError::Failed { message: "a picture could not be read back".into() };
        if mapped.try_recv() != Ok(true) {
            return Err(failed());
        }
        let bytes = buffer.slice(..).get_mapped_range().map_err(|_| failed())?;
        let rows = bytes.chunks_exact(row as usize);
        let texels = rows.flat_map(|row| {
            row[..16 * width as usize].chunks_exact(16).map(bytemuck::pod_read_unaligned::<[u32; 4]>)
        });
        Ok(Texels(texels.collect()))
    }
}
