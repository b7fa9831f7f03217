//! Pipelines: a shader with all that it is bound to.

use crate::device::Device;
use crate::layout::{Picture, Shown, Vertex};
use crate::shaders::Entry;
use crate::targets::{DEPTH, TARGET};
use crate::upload::{self, texture_type};

/// What is bound to every shader: the scene, the surface, and what passes hand on.
pub(crate) fn layouts(device: &Device) -> [wgpu::BindGroupLayout; 3] {
    [scene_layout(device), upload::layout(device), input_layout(device)]
}

/// Room for what shaders are told of a scene.
pub(crate) fn uniform(device: &Device) -> wgpu::Buffer {
    device.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("picture"),
        size: size_of::<Picture>() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn entry_of(
    binding: u32,
    visibility: wgpu::ShaderStages,
    ty: wgpu::BindingType,
) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

fn scene_layout(device: &Device) -> wgpu::BindGroupLayout {
    let uniform = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    device.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("scene"),
        entries: &[
            entry_of(0, wgpu::ShaderStages::VERTEX_FRAGMENT, uniform),
            entry_of(1, wgpu::ShaderStages::FRAGMENT, texture_type(true)),
        ],
    })
}

fn input_layout(device: &Device) -> wgpu::BindGroupLayout {
    let entries = [true, true, false, false];
    let entries: Vec<_> = (0..)
        .zip(entries)
        .map(|(binding, is_float)| entry_of(binding, wgpu::ShaderStages::FRAGMENT, texture_type(is_float)))
        .collect();
    device.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("inputs"),
        entries: &entries,
    })
}

/// A shader for what is shown.
pub(crate) fn pipeline(
    device: &Device,
    layouts: &[wgpu::BindGroupLayout; 3],
    entry: Entry,
    shown: Shown,
) -> wgpu::RenderPipeline {
    let Device { device, storage, part, .. } = device;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("ogee"),
        source: wgpu::ShaderSource::Wgsl(entry.text(*storage, *part).into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &layouts.each_ref().map(Some),
        immediate_size: 0,
    });
    let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint32];
    let corners = wgpu::VertexBufferLayout {
        array_stride: size_of::<Vertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &attributes,
    };
    let buffers = [Some(corners)];
    let targets = vec![Some(wgpu::ColorTargetState::from(TARGET)); entry.targets()];
    let is_raster = entry.is_raster();
    let constants = shown.constants();
    let compilation_options =
        wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("ogee"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: compilation_options.clone(),
            buffers: if is_raster { &buffers } else { &[] },
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: is_raster.then(|| wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options,
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}
