//! Points of the surface at listed places, evaluated by shaders.

use ogee::{Location, Vec3};

use crate::layout::{Shown, TEXTURE_WIDTH, flag};
use crate::pipeline::uniform;
use crate::shaders::Entry;
use crate::targets::Target;
use crate::upload::{Data, bind};
use crate::{GpuError, GpuSurface, Renderer};

impl Renderer<'_> {
    /// Positions and normals of the surface at listed places, in single precision.
    ///
    /// # Errors
    /// If there are more than the device takes, or it fails.
    pub fn evaluate(
        &self,
        surface: &GpuSurface<'_>,
        places: &[Location],
    ) -> Result<Vec<(Vec3, Vec3)>, GpuError> {
        let device = self.device;
        let packed: Vec<[u32; 4]> = places.iter().map(|&place| pack(place)).collect();
        let list = Data { name: "places", bytes: bytemuck::cast_slice(&packed), is_float: false };
        let size = [TEXTURE_WIDTH, (places.len() as u32).div_ceil(TEXTURE_WIDTH).max(1)];
        let list = list.texture(device)?;
        let blank = &self.blank;
        let uniform = uniform(device);
        let scene = bind(
            device,
            &self.layouts[0],
            [uniform.as_entire_binding(), wgpu::BindingResource::TextureView(&blank.float)].into_iter(),
        );
        let inputs = [&blank.float, &blank.float, &list, &blank.whole];
        let inputs =
            bind(device, &self.layouts[2], inputs.into_iter().map(wgpu::BindingResource::TextureView));
        let targets = [Target::new(device, size)?, Target::new(device, size)?];
        let shader = (Entry::Evaluate, Shown::nothing(surface.parts));
        self.draw(shader, [&scene, &surface.bindings, &inputs], &[&targets[0], &targets[1]], None);
        let [positions, normals] = targets.each_ref().map(|target| target.read(device));
        let (positions, normals) = (positions?, normals?);
        let points = positions.colours().zip(normals.colours()).take(places.len());
        Ok(points
            .map(|(position, normal)| (surface.frame.point_back(position), Vec3::from(normal.map(f64::from))))
            .collect())
    }
}

/// A place as shaders read it: of each parameter and its rest the smaller, rounded once.
fn pack(place: Location) -> [u32; 4] {
    let [(u, is_far_u), (v, is_far_v)] = place.parameters().map(|x| (x.min(1.0 - x) as f32, x > 0.5));
    let flags =
        flag::COVERED | if is_far_u { flag::FAR_S } else { 0 } | if is_far_v { flag::FAR_T } else { 0 };
    [u.to_bits(), v.to_bits(), place.parametric_face() as u32, flags]
}
