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
    use super::*;
    use crate::layout::{Face, Field, Pattern, Picture, PlaneLight, Shared, Square, Tail, View};

    fn parsed(entry: Entry, storage: Storage) -> naga::Module {
        let text = entry.text(storage, 1 << 20);
        naga::front::wgsl::parse_str(&text).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&text)))
    }

    #[test]
    fn every_shader_is_valid() {
        for entry in Entry::ALL {
            for storage in [Storage::Buffers, Storage::Textures] {
                let module = parsed(entry, storage);
                let flags = naga::valid::ValidationFlags::all();
                let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
                if let Err(error) = validator.validate(&module) {
                    panic!("{entry:?} {storage:?}: {}", error.emit_to_string(&entry.text(storage, 1 << 20)));
                }
            }
        }
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
