//! `Grids`: the polygon on the device.

use ogee::Vec3;
use ogee_render::Polygon;

use crate::GpuError;
use crate::device::Device;
use crate::flat::narrow;
use crate::frame::Frame;
use crate::layout::Vertex;
use crate::upload::Data;

/// Corners that one buffer holds, if a grid has no more.
const CORNERS: usize = 1 << 20;

/// Grids of points on the surface, cut into buffers that every device takes.
#[derive(Debug)]
pub(crate) struct Grids {
    /// Corners of whole grids, and how many indices draw them.
    pub(crate) buffers: Vec<(wgpu::Buffer, u32)>,
    /// Triangles of the first buffer; those of the others begin alike.
    pub(crate) indices: wgpu::Buffer,
    /// Points and normals, where they are asked for: the polygon itself is shown then.
    pub(crate) textures: Option<[wgpu::TextureView; 2]>,
}

impl Grids {
    pub(crate) fn new(device: &Device, polygon: &Polygon, frame: &Frame) -> Result<Grids, GpuError> {
        let side = polygon.cells as usize + 1;
        let count = side * side;
        let together = (CORNERS / count).clamp(1, polygon.squares.len().max(1));
        let triangles = triangles(side as u32, together as u32);
        let indices =
            buffer(device, "triangles", wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&triangles))?;
        let points: Vec<[f32; 3]> = polygon.points.iter().map(|&point| narrow(frame.point(point))).collect();
        let mut buffers = Vec::new();
        for (squares, points) in polygon.squares.chunks(together).zip(points.chunks(together * count)) {
            let corners: Vec<Vertex> = points
                .chunks(count)
                .zip(squares)
                .flat_map(|(grid, &square)| grid.iter().map(move |&position| Vertex { position, square }))
                .collect();
            let corners =
                buffer(device, "corners", wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&corners))?;
            buffers.push((corners, (triangles.len() / together * squares.len()) as u32));
        }
        let textures = match polygon.normals.is_empty() {
            true => None,
            false => Some([
                texture(device, "points", points.into_iter())?,
                texture(device, "normals", polygon.normals.iter().map(|&normal: &Vec3| narrow(normal)))?,
            ]),
        };
        Ok(Grids { buffers, indices, textures })
    }
}

/// Two triangles for each cell of so many grids.
fn triangles(side: u32, grids: u32) -> Vec<u32> {
    let cell = |first: u32| {
        let [a, b, c, d] = [first, first + 1, first + side + 1, first + side];
        [a, b, c, a, c, d]
    };
    let corners = move |grid: u32| {
        (0..side - 1).flat_map(move |j| (0..side - 1).map(move |i| side * (side * grid + j) + i))
    };
    (0..grids).flat_map(corners).flat_map(cell).collect()
}

fn buffer(
    device: &Device,
    name: &'static str,
    usage: wgpu::BufferUsages,
    bytes: &[u8],
) -> Result<wgpu::Buffer, GpuError> {
    let (count, most) = (bytes.len() as u64, device.device.limits().max_buffer_size);
    if count > most {
        return Err(GpuError::TooLarge { what: name, count, unit: "bytes", most });
    }
    let buffer = device.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(name),
        size: count,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    device.queue.write_buffer(&buffer, 0, bytes);
    Ok(buffer)
}

fn texture(
    device: &Device,
    name: &'static str,
    points: impl Iterator<Item = [f32; 3]>,
) -> Result<wgpu::TextureView, GpuError> {
    let texels: Vec<[f32; 4]> = points.map(|[x, y, z]| [x, y, z, 0.0]).collect();
    Data { name, bytes: bytemuck::cast_slice(&texels), is_float: true }.texture(device)
}
