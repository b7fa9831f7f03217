//! `GpuSurface`: a surface on the device.

use ogee::quality::{Layout, LimitView, Side, Surface, bounding_box};

use crate::GpuError;
use crate::device::{Device, Storage};
use crate::flat::Flat;
use crate::frame::Frame;
use crate::layout::{BORDER, NET_POINTS, PARTS, Square, TEXTURE_WIDTH};

/// The limit surface of a cage on a device.
#[derive(Debug)]
pub struct GpuSurface<'a> {
    pub(crate) view: &'a LimitView<'a>,
    pub(crate) frame: Frame,
    pub(crate) bindings: wgpu::BindGroup,
    /// Over how many bindings its control points are spread.
    pub(crate) parts: u32,
    bytes: u64,
}

impl<'a> GpuSurface<'a> {
    /// Writes a surface as shaders read it and sends it to the device.
    ///
    /// # Errors
    /// If it is larger than the device takes.
    pub fn new(device: &Device, view: &'a LimitView<'a>) -> Result<GpuSurface<'a>, GpuError> {
        let frame = Frame::new(bounding_box(view).unwrap_or_default());
        let flat = Flat::new(view.surface(), &frame);
        let squares: Vec<Square> =
            (0..view.layout().squares().len() as u32).map(|number| square(view.layout(), number)).collect();
        let part = device.part as usize;
        if flat.points.len() > PARTS * part {
            return Err(GpuError::TooLarge {
                what: "patches",
                count: flat.points.len() as u64 / u64::from(NET_POINTS),
                unit: "nets",
                most: (PARTS * part) as u64 / u64::from(NET_POINTS),
            });
        }
        let parts = flat.points.len().div_ceil(part).max(1) as u32;
        let mut points = flat.points.chunks(part);
        let mut data: Vec<Data<'_>> = vec![
            Data::whole("faces", bytemuck::cast_slice(&flat.faces)),
            Data::whole("nodes", bytemuck::cast_slice(&flat.nodes)),
            Data::whole("chains", bytemuck::cast_slice(&flat.tails)),
            Data::whole("squares", bytemuck::cast_slice(&squares)),
        ];
        data.extend((0..PARTS).map(|_| Data {
            name: "points",
            bytes: bytemuck::cast_slice(points.next().unwrap_or_default()),
            is_float: true,
        }));
        let bytes = data.iter().map(|data| data.bytes.len() as u64).sum();
        let layout = layout(device);
        let bindings = match device.storage {
            Storage::Buffers => {
                let buffers = data.iter().map(|data| data.buffer(device)).collect::<Result<Vec<_>, _>>()?;
                bind(device, &layout, buffers.iter().map(wgpu::Buffer::as_entire_binding))
            }
            Storage::Textures => {
                let views = data.iter().map(|data| data.texture(device)).collect::<Result<Vec<_>, _>>()?;
                bind(device, &layout, views.iter().map(wgpu::BindingResource::TextureView))
            }
        };
        device.check()?;
        Ok(GpuSurface { view, frame, bindings, parts, bytes })
    }

    /// How much of the device's memory it takes.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }
}

fn square(layout: &Layout, number: u32) -> Square {
    let square = &layout.squares()[number as usize];
    let sides = (0..4).filter(|&side| square.edges[side]).map(|side| 1 << side).sum();
    let across = [0, 1, 2, 3].map(|side| {
        let across = layout.across(Side { square: number, side });
        across.map_or(BORDER, |Side { square, side }| 4 * square + side)
    });
    Square {
        corner: square.corner.parameters().map(|x| x as f32),
        size: square.size.map(|x| x as f32),
        face: square.corner.parametric_face() as u32,
        sides,
        unused: [0; 2],
        across,
    }
}

/// How the surface is bound, for all shaders of a device.
pub(crate) fn layout(device: &Device) -> wgpu::BindGroupLayout {
    let entry = |binding: usize| wgpu::BindGroupLayoutEntry {
        binding: binding as u32,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: match device.storage {
            Storage::Buffers => wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: true },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            Storage::Textures => texture_type(binding >= 4),
        },
        count: None,
    };
    let entries: Vec<_> = (0..4 + PARTS).map(entry).collect();
    device.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("surface"),
        entries: &entries,
    })
}

/// A texture that shaders load numbers from.
pub(crate) fn texture_type(is_float: bool) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type: match is_float {
            true => wgpu::TextureSampleType::Float { filterable: false },
            false => wgpu::TextureSampleType::Uint,
        },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }
}

/// A group of what is bound one after the other.
pub(crate) fn bind<'a>(
    device: &Device,
    layout: &wgpu::BindGroupLayout,
    resources: impl Iterator<Item = wgpu::BindingResource<'a>>,
) -> wgpu::BindGroup {
    let entries: Vec<_> =
        (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
    device.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}

/// Words of sixteen bytes on their way to the device.
pub(crate) struct Data<'a> {
    pub(crate) name: &'static str,
    pub(crate) bytes: &'a [u8],
    pub(crate) is_float: bool,
}

impl<'a> Data<'a> {
    /// Whole numbers, or bits of others.
    fn whole(name: &'static str, bytes: &'a [u8]) -> Data<'a> {
        Data { name, bytes, is_float: false }
    }

    fn check(&self, most: u64) -> Result<(), GpuError> {
        let count = self.bytes.len() as u64;
        let too_large = GpuError::TooLarge { what: self.name, count, unit: "bytes", most };
        if count > most { Err(too_large) } else { Ok(()) }
    }

    /// In a storage buffer; never empty, which no device likes.
    fn buffer(&self, device: &Device) -> Result<wgpu::Buffer, GpuError> {
        self.check(device.most_bytes())?;
        let buffer = device.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(self.name),
            size: self.bytes.len().max(64) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        device.queue.write_buffer(&buffer, 0, self.bytes);
        Ok(buffer)
    }

    /// In a texture, row after row.
    pub(crate) fn texture(&self, device: &Device) -> Result<wgpu::TextureView, GpuError> {
        let row = 16 * TEXTURE_WIDTH as usize;
        let most = u64::from(device.device.limits().max_texture_dimension_2d) * row as u64;
        self.check(most)?;
        let rows = self.bytes.len().div_ceil(row).max(1) as u32;
        let texture = device.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(self.name),
            size: wgpu::Extent3d { width: TEXTURE_WIDTH, height: rows, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: match self.is_float {
                true => wgpu::TextureFormat::Rgba32Float,
                false => wgpu::TextureFormat::Rgba32Uint,
            },
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let (whole, rest) = self.bytes.split_at(self.bytes.len() / row * row);
        write_rows(device, &texture, 0, whole);
        write_rows(device, &texture, (whole.len() / row) as u32, rest);
        Ok(texture.create_view(&wgpu::TextureViewDescriptor::default()))
    }
}

/// Writes whole rows of a texture, or the beginning of one.
fn write_rows(device: &Device, texture: &wgpu::Texture, first: u32, bytes: &[u8]) {
    if bytes.is_empty() {
        return;
    }
    let row = 16 * TEXTURE_WIDTH;
    let texels = (bytes.len() / 16) as u32;
    device.queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: 0,
            origin: wgpu::Origin3d { x: 0, y: first, z: 0 },
            aspect: wgpu::TextureAspect::All,
        },
        bytes,
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
        wgpu::Extent3d {
            width: texels.min(TEXTURE_WIDTH),
            height: texels.div_ceil(TEXTURE_WIDTH),
            depth_or_array_layers: 1,
        },
    );
}
