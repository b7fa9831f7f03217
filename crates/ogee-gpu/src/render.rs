//! `Renderer`: a surface on the device and a scene become a picture.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use ogee_render::{Picture, RenderError, Sampling, Scene, Stages, Style, View, comb};

use crate::device::Device;
use crate::grids::Grids;
use crate::layout::{NO_SURFACE, NO_VALUE, Shown};
use crate::pipeline::{layouts, pipeline, uniform};
use crate::read::Texels;
use crate::shaders::Entry;
use crate::targets::{Target, depth};
use crate::upload::{Data, GpuSurface, bind};
use crate::{GpuError, scene};

/// A pass over all pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pass {
    /// Which square and parameters each pixel shows.
    Parameter,
    /// The point of the surface there.
    Position,
    /// Its colour.
    Colour,
    /// Both at once, for the point that the middle of the pixel shows.
    Fused,
}

impl Pass {
    fn entry(self) -> Entry {
        match self {
            Pass::Parameter => Entry::Parameter,
            Pass::Position => Entry::Position,
            Pass::Colour => Entry::Colour,
            Pass::Fused => Entry::Fused,
        }
    }
}

/// Makes pictures on a device. Shaders are compiled when they are first needed, and kept.
#[derive(Debug)]
pub struct Renderer<'d> {
    pub(crate) device: &'d Device,
    /// Of the scene, the surface, and what passes hand on.
    pub(crate) layouts: [wgpu::BindGroupLayout; 3],
    pipelines: Mutex<HashMap<(Entry, Shown), wgpu::RenderPipeline>>,
    /// Bound where a pass has no use for a texture.
    pub(crate) blank: Blank,
}

#[derive(Debug)]
pub(crate) struct Blank {
    pub(crate) float: wgpu::TextureView,
    pub(crate) whole: wgpu::TextureView,
}

impl<'d> Renderer<'d> {
    /// A renderer on a device.
    ///
    /// # Errors
    /// If the device fails.
    pub fn new(device: &'d Device) -> Result<Renderer<'d>, GpuError> {
        let texel = [0.0; 4];
        let blank =
            |is_float| Data { name: "nothing", bytes: bytemuck::bytes_of(&texel), is_float }.texture(device);
        let blank = Blank { float: blank(true)?, whole: blank(false)? };
        let layouts = layouts(device);
        Ok(Renderer { device, layouts, pipelines: Default::default(), blank })
    }

    /// Makes a picture: the same as [`ogee_render::render`], in single precision.
    ///
    /// Pixels of [`Sampling::Parameters`] are made in the three passes of the paper, others in two. Of the seconds, `ids` is for the
    /// polygon, `position` for the passes, `colour` for what comes after.
    ///
    /// # Errors
    /// If it would show nothing, or nothing of what was asked for, or the device fails.
    pub fn render(&self, surface: &GpuSurface<'_>, scene: &Scene) -> Result<Picture, GpuError> {
        let start = Instant::now();
        let prepared = self.prepare(surface, scene)?;
        let ids = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let known = ogee_render::limit(&scene.style, std::iter::empty());
        let mut texels = prepared.draw(known)?;
        let unit = scene::unit(&scene.style, &surface.frame);
        let values = |texels: &Texels| -> Vec<f64> {
            texels
                .values()
                .filter(|&bits| bits != NO_SURFACE && bits != NO_VALUE)
                .map(|bits| unit * value(bits))
                .collect()
        };
        let mut limit = known;
        if matches!(scene.style, Style::Curvature { limit: None, .. }) {
            limit = ogee_render::limit(&scene.style, values(&texels).into_iter());
            texels = prepared.draw(limit)?;
        }
        let position = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let fragments = texels.values().filter(|&bits| bits != NO_SURFACE).count();
        if fragments == 0 {
            return Err(RenderError::EmptyView.into());
        }
        let is_lit =
            matches!(scene.style, Style::Reflection { .. } | Style::Highlight { .. } | Style::Error { .. });
        if is_lit && values(&texels).is_empty() {
            return Err(RenderError::LightMissed.into());
        }
        let mut colours: Vec<_> = texels.colours().collect();
        if let Style::Combs { share } = scene.style {
            let depth = |bits: u32| if bits == NO_SURFACE { f64::INFINITY } else { unit * value(bits) };
            let depths: Vec<f64> = texels.values().map(depth).collect();
            comb::draw(surface.view, &prepared.view, share, &depths, &mut colours);
        }
        let seconds = Stages { ids, position, colour: start.elapsed().as_secs_f64() };
        let level = prepared.cells.trailing_zeros();
        Ok(Picture { size: scene.size, colours, fragments, level, limit, seconds })
    }

    /// Everything that passes of a picture need.
    ///
    /// # Errors
    /// If the picture would show nothing, or is larger than the device takes.
    pub fn prepare<'a>(
        &'a self,
        surface: &'a GpuSurface<'a>,
        scene: &'a Scene,
    ) -> Result<Prepared<'a>, GpuError> {
        let view = ogee_render::check(surface.view, scene)?;
        let polygon = ogee_render::polygon(surface.view, scene, &view)?;
        let device = self.device;
        let grids = Grids::new(device, &polygon, &surface.frame)?;
        let target = || Target::new(device, scene.size);
        let (parameters, positions, colours) = (target()?, target()?, target()?);
        let texels = scene::light_texels(&scene.style);
        let light = if texels.is_empty() {
            self.blank.float.clone()
        } else {
            Data { name: "light", bytes: bytemuck::cast_slice(&texels), is_float: true }.texture(device)?
        };
        let blank = &self.blank;
        let [points, normals] = match &grids.textures {
            Some([points, normals]) => [points, normals],
            None => [&blank.float; 2],
        };
        let inputs = |parameters: &wgpu::TextureView, positions: &wgpu::TextureView| {
            let views = [points, normals, parameters, positions];
            bind(device, &self.layouts[2], views.into_iter().map(wgpu::BindingResource::TextureView))
        };
        let inputs = [
            inputs(&blank.whole, &blank.whole),
            inputs(&parameters.view, &blank.whole),
            inputs(&parameters.view, &positions.view),
        ];
        let depth = depth(device, scene.size);
        let uniform = uniform(device);
        let bindings = bind(
            device,
            &self.layouts[0],
            [uniform.as_entire_binding(), wgpu::BindingResource::TextureView(&light)].into_iter(),
        );
        device.check()?;
        Ok(Prepared {
            renderer: self,
            surface,
            scene,
            view,
            cells: polygon.cells,
            grids,
            uniform,
            bindings,
            inputs,
            targets: [parameters, positions, colours],
            depth,
        })
    }

    fn pipeline(&self, entry: Entry, shown: Shown) -> wgpu::RenderPipeline {
        // Passes that only look for points are the same for all styles.
        let shown = if entry.is_coloured() { shown } else { Shown::nothing(shown.parts) };
        let mut pipelines = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        let made = pipelines.entry((entry, shown));
        made.or_insert_with(|| pipeline(self.device, &self.layouts, entry, shown)).clone()
    }

    /// Draws grids, or one triangle over all.
    pub(crate) fn draw(
        &self,
        (entry, shown): (Entry, Shown),
        groups: [&wgpu::BindGroup; 3],
        targets: &[&Target],
        grids: Option<(&Grids, &wgpu::TextureView)>,
    ) {
        let mut encoder =
            self.device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let attachments: Vec<_> = targets.iter().map(|target| Some(target.attachment(entry))).collect();
        let depth = grids.map(|(_, depth)| wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(0.0),
                store: wgpu::StoreOp::Discard,
            }),
            stencil_ops: None,
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: &attachments,
            depth_stencil_attachment: depth,
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(&self.pipeline(entry, shown));
        for (number, group) in (0..).zip(groups) {
            pass.set_bind_group(number, group, &[]);
        }
        match grids {
            None => pass.draw(0..3, 0..1),
            Some((grids, _)) => {
                pass.set_index_buffer(grids.indices.slice(..), wgpu::IndexFormat::Uint32);
                for (corners, count) in &grids.buffers {
                    pass.set_vertex_buffer(0, corners.slice(..));
                    pass.draw_indexed(0..*count, 0, 0..1);
                }
            }
        }
        drop(pass);
        self.device.queue.submit([encoder.finish()]);
    }
}

fn value(bits: u32) -> f64 {
    f64::from(f32::from_bits(bits))
}

/// A scene on the device: its passes can be run one by one.
#[derive(Debug)]
pub struct Prepared<'a> {
    renderer: &'a Renderer<'a>,
    surface: &'a GpuSurface<'a>,
    scene: &'a Scene,
    view: View,
    cells: u32,
    grids: Grids,
    uniform: wgpu::Buffer,
    bindings: wgpu::BindGroup,
    /// With nothing yet, with parameters, with positions as well.
    inputs: [wgpu::BindGroup; 3],
    /// Parameters, positions, colours.
    targets: [Target; 3],
    depth: wgpu::TextureView,
}

impl Prepared<'_> {
    /// Runs a pass; what it reads has to be there. [`Device::finish`] waits for it.
    pub fn run(&self, pass: Pass) {
        let (inputs, target) = match pass {
            Pass::Parameter => (&self.inputs[0], &self.targets[0]),
            Pass::Position => (&self.inputs[1], &self.targets[1]),
            Pass::Colour => (&self.inputs[2], &self.targets[2]),
            Pass::Fused => (&self.inputs[1], &self.targets[2]),
        };
        let entry = pass.entry();
        let groups = [&self.bindings, &self.surface.bindings, inputs];
        let grids = entry.is_raster().then_some((&self.grids, &self.depth));
        self.renderer.draw((entry, scene::shown(self.scene, self.surface.parts)), groups, &[target], grids);
    }

    /// Tells shaders where the colours of a map end; all passes want it once.
    pub fn set_limit(&self, limit: Option<f64>) {
        let picture = scene::picture(self.scene, &self.view, &self.surface.frame, self.cells, limit);
        self.renderer.device.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&picture));
    }

    /// All passes.
    fn draw(&self, limit: Option<f64>) -> Result<Texels, GpuError> {
        self.set_limit(limit);
        // A shader that does little for triangles, one that does much for pixels: small triangles are drawn in whole blocks.
        self.run(Pass::Parameter);
        if matches!(self.scene.sampling, Sampling::Parameters(_)) && !scene::is_error(self.scene) {
            self.run(Pass::Position);
            self.run(Pass::Colour);
        } else {
            self.run(Pass::Fused);
        }
        self.targets[2].read(self.renderer.device)
    }
}
