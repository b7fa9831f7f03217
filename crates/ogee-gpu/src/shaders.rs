//! Shaders, assembled by joining files: what the processor shares with them, a way to load, libraries, an entry.

use crate::device::Storage;
use crate::layout::prelude;

/// What a shader is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Entry {
    /// Which square and parameters each pixel shows.
    Parameter,
    /// The point of the surface there.
    Position,
    /// Its colour.
    Colour,
    /// Both at once, for the middle of the pixel.
    Fused,
    /// Points at listed places.
    Evaluate,
}

/// Libraries, each after what it uses.
const LIBRARIES: &[&str] = &[
    include_str!("shaders/bicubic.wgsl"),
    include_str!("shaders/tree.wgsl"),
    include_str!("shaders/place.wgsl"),
    include_str!("shaders/curvature.wgsl"),
    include_str!("shaders/point.wgsl"),
    include_str!("shaders/camera.wgsl"),
    include_str!("shaders/newton.wgsl"),
    include_str!("shaders/reflection.wgsl"),
    include_str!("shaders/pattern.wgsl"),
    include_str!("shaders/image.wgsl"),
    include_str!("shaders/colour.wgsl"),
    include_str!("shaders/shade.wgsl"),
    include_str!("shaders/style.wgsl"),
];

impl Entry {
    /// Every one.
    #[cfg(test)]
    pub(crate) const ALL: [Entry; 5] =
        [Entry::Parameter, Entry::Position, Entry::Colour, Entry::Fused, Entry::Evaluate];

    /// True if it draws the polygon, false if one triangle over all pixels.
    pub(crate) fn is_raster(self) -> bool {
        self == Entry::Parameter
    }

    /// True if it writes colours.
    pub(crate) fn is_coloured(self) -> bool {
        matches!(self, Entry::Colour | Entry::Fused)
    }

    /// Into how many textures it writes.
    pub(crate) fn targets(self) -> usize {
        if self == Entry::Evaluate { 2 } else { 1 }
    }

    /// The shader's text; `part` is how many points a binding holds.
    pub(crate) fn text(self, storage: Storage, part: u32) -> String {
        let load = match storage {
            Storage::Buffers => include_str!("shaders/load_storage.wgsl"),
            Storage::Textures => include_str!("shaders/load_texture.wgsl"),
        };
        let vertex = match self.is_raster() {
            true => include_str!("shaders/raster.wgsl"),
            false => include_str!("shaders/screen.wgsl"),
        };
        let fragment = match self {
            Entry::Parameter => include_str!("shaders/parameter.wgsl"),
            Entry::Position => include_str!("shaders/position.wgsl"),
            Entry::Colour => include_str!("shaders/colour_pass.wgsl"),
            Entry::Fused => include_str!("shaders/fused.wgsl"),
            Entry::Evaluate => include_str!("shaders/evaluate.wgsl"),
        };
        let prelude = prelude(part);
        let first = [&prelude, include_str!("shaders/picture.wgsl"), load];
        [&first[..], LIBRARIES, &[vertex, fragment]].concat().join("\n")
    }
}

#[cfg(test)]
mod tests {
    use naga::back::glsl;
    use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};

    use super::*;
    use crate::layout::{Face, Field, Pattern, Picture, PlaneLight, Shared, Shown, Square, Tail, View};

    fn parsed(entry: Entry, storage: Storage) -> naga::Module {
        let text = entry.text(storage, 1 << 20);
        naga::front::wgsl::parse_str(&text).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&text)))
    }

    fn validated(entry: Entry, storage: Storage) -> (naga::Module, naga::valid::ModuleInfo) {
        let module = parsed(entry, storage);
        let flags = naga::valid::ValidationFlags::all();
        let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
        match validator.validate(&module) {
            Ok(info) => (module, info),
            Err(error) => {
                panic!("{entry:?} {storage:?}: {}", error.emit_to_string(&entry.text(storage, 1 << 20)))
            }
        }
    }

    #[test]
    fn every_shader_is_valid() {
        for entry in Entry::ALL {
            for storage in [Storage::Buffers, Storage::Textures] {
                validated(entry, storage);
            }
        }
    }

    /// One stage of a shader as WebGL2 wants it, or why it cannot be had.
    fn webgl2(entry: Entry, storage: Storage, stage: naga::ShaderStage) -> Result<String, String> {
        let (module, info) = validated(entry, storage);
        let name = if stage == naga::ShaderStage::Vertex { "vertex" } else { "fragment" };
        let constants = Shown::nothing(1).constants().map(|(name, value)| (name.to_owned(), value));
        let (module, info) = naga::back::pipeline_constants::process_overrides(
            &module,
            &info,
            Some((stage, name)),
            &constants.into_iter().collect(),
        )
        .map_err(|error| error.to_string())?;
        let version = glsl::Version::Embedded { version: 300, is_webgl: true };
        let options = glsl::Options { version, ..glsl::Options::default() };
        let pipeline =
            glsl::PipelineOptions { shader_stage: stage, entry_point: name.to_owned(), multiview: None };
        // What `wgpu` asks for there.
        let unchecked = BoundsCheckPolicy::Unchecked;
        let policies = BoundsCheckPolicies {
            index: unchecked,
            buffer: unchecked,
            image_load: unchecked,
            binding_array: unchecked,
        };
        let mut text = String::new();
        glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, policies)
            .and_then(|mut writer| writer.write())
            .map_err(|error| error.to_string())?;
        Ok(text)
    }

    #[test]
    fn every_shader_that_reads_textures_is_one_of_webgl2() {
        for entry in Entry::ALL {
            for stage in [naga::ShaderStage::Vertex, naga::ShaderStage::Fragment] {
                match webgl2(entry, Storage::Textures, stage) {
                    Ok(text) => assert!(text.starts_with("#version 300 es"), "{text}"),
                    Err(error) => panic!("{entry:?} {stage:?}: {error}"),
                }
            }
        }
        assert!(webgl2(Entry::Fused, Storage::Buffers, naga::ShaderStage::Fragment).is_err());
    }

    /// The struct as `naga` lays it out.
    fn laid_out(module: &naga::Module, name: &str) -> (Vec<(String, usize, usize)>, usize) {
        let mut layouter = naga::proc::Layouter::default();
        layouter.update(module.to_ctx()).unwrap();
        for (_, kind) in module.types.iter() {
            let naga::TypeInner::Struct { members, span } = &kind.inner else { continue };
            if kind.name.as_deref() == Some(name) {
                let fields = members.iter().map(|member| {
                    let name = member.name.clone().unwrap();
                    (name, member.offset as usize, layouter[member.ty].size as usize)
                });
                return (fields.collect(), *span as usize);
            }
        }
        panic!("there is no {name}");
    }

    fn compare<T: Shared>(module: &naga::Module) {
        let (found, size) = laid_out(module, T::NAME);
        let wanted: Vec<(String, usize, usize)> = T::fields()
            .into_iter()
            .map(|Field { name, offset, size, .. }| (name.to_string(), offset, size))
            .collect();
        assert_eq!((found, size), (wanted, size_of::<T>()), "{}", T::NAME);
    }

    #[test]
    fn structs_lie_in_shaders_as_they_lie_here() {
        for entry in Entry::ALL {
            for storage in [Storage::Buffers, Storage::Textures] {
                let module = parsed(entry, storage);
                compare::<Face>(&module);
                compare::<Tail>(&module);
                compare::<Square>(&module);
                compare::<View>(&module);
                compare::<PlaneLight>(&module);
                compare::<Pattern>(&module);
                compare::<Picture>(&module);
            }
        }
    }
}
