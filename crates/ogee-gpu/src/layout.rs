//! What the processor and the shaders share: numbers and structs, written once, here.
//!
//! [`prelude`] says them again in WGSL, and every shader begins with it. Structs lie in memory as WGSL lays them out, so
//! vectors of three stand where a number can follow them; a test asks `naga` whether both agree on every field.

use bytemuck::{Pod, Zeroable};
use ogee_render::colour::{DIVERGING, RISING};
use ogee_render::shade::palette;

/// Width of the textures that hold data where there are no storage buffers, in texels of 16 bytes.
pub(crate) const TEXTURE_WIDTH: u32 = 1024;

/// Points of one bicubic patch.
pub(crate) const NET_POINTS: u32 = 16;

/// Into how many bindings control points may be spread.
pub(crate) const PARTS: usize = 4;

/// Steps below the last stored that are told from the corner itself; there a step is a hundredth of a pixel at most.
pub(crate) const STEPS_BEYOND: u32 = 8;

/// Newton steps towards the middle of the pixel, at most: one or two are enough unless they lead to another face.
pub(crate) const NEWTON_STEPS: u32 = 8;

/// Stands for what is across a side where there is nothing.
pub(crate) const BORDER: u32 = u32::MAX;

/// What a node is, in its top two bits.
pub(crate) mod node {
    pub(crate) const LEAF: u32 = 0;
    pub(crate) const SPLIT: u32 = 1;
    pub(crate) const TAIL: u32 = 2;
    /// Bits of the number below.
    pub(crate) const SHIFT: u32 = 30;
}

/// Bits of the last number of a pixel's parameters.
pub(crate) mod flag {
    /// There is a surface in the pixel.
    pub(crate) const COVERED: u32 = 1;
    /// What is stored is one minus the first parameter.
    pub(crate) const FAR_S: u32 = 2;
    /// What is stored is one minus the second.
    pub(crate) const FAR_T: u32 = 4;
}

/// The value of pixels that have none: where a map ends, and where no ray meets the light. No number has these bits.
pub(crate) const NO_VALUE: u32 = 0x7fc0_0000;

/// The value of pixels that show no surface.
pub(crate) const NO_SURFACE: u32 = 0xffff_ffff;

/// Numbers of styles, patterns and so on in shaders.
pub(crate) mod code {
    pub(crate) const SHADED: u32 = 0;
    pub(crate) const WIREFRAME: u32 = 1;
    pub(crate) const LIT: u32 = 2;
    pub(crate) const ISOPHOTE: u32 = 3;
    pub(crate) const ZEBRA: u32 = 4;
    pub(crate) const CURVATURE: u32 = 5;
    pub(crate) const ERROR: u32 = 6;
    pub(crate) const COMBS: u32 = 7;

    pub(crate) const SURFACE: u32 = 0;
    pub(crate) const POLYGON: u32 = 1;

    pub(crate) const REFLECTED: u32 = 0;
    pub(crate) const NORMAL: u32 = 1;

    pub(crate) const LINES: u32 = 0;
    pub(crate) const LATTICE: u32 = 1;
    pub(crate) const CIRCLES: u32 = 2;
    pub(crate) const IMAGE: u32 = 3;

    pub(crate) const GAUSS: u32 = 0;
    pub(crate) const MEAN: u32 = 1;
    pub(crate) const K1: u32 = 2;
    pub(crate) const K2: u32 = 3;
    pub(crate) const GREATEST: u32 = 4;
    pub(crate) const GAUSS_SIGN: u32 = 5;
}

/// Whole numbers that the prelude gives to shaders, by name.
const CONSTANTS: &[(&str, u32)] = &[
    ("TEXTURE_WIDTH", TEXTURE_WIDTH),
    ("NET_POINTS", NET_POINTS),
    ("STEPS_BEYOND", STEPS_BEYOND),
    ("BORDER", BORDER),
    ("LEAF", node::LEAF),
    ("SPLIT", node::SPLIT),
    ("TAIL", node::TAIL),
    ("NODE_SHIFT", node::SHIFT),
    ("COVERED", flag::COVERED),
    ("FAR_S", flag::FAR_S),
    ("FAR_T", flag::FAR_T),
    ("NO_VALUE", NO_VALUE),
    ("SHADED", code::SHADED),
    ("WIREFRAME", code::WIREFRAME),
    ("LIT", code::LIT),
    ("ISOPHOTE", code::ISOPHOTE),
    ("ZEBRA", code::ZEBRA),
    ("CURVATURE", code::CURVATURE),
    ("ERROR", code::ERROR),
    ("COMBS", code::COMBS),
    ("SURFACE", code::SURFACE),
    ("POLYGON", code::POLYGON),
    ("REFLECTED", code::REFLECTED),
    ("NORMAL", code::NORMAL),
    ("LINES", code::LINES),
    ("LATTICE", code::LATTICE),
    ("CIRCLES", code::CIRCLES),
    ("IMAGE", code::IMAGE),
    ("GAUSS", code::GAUSS),
    ("MEAN", code::MEAN),
    ("K1", code::K1),
    ("K2", code::K2),
    ("GREATEST", code::GREATEST),
    ("GAUSS_SIGN", code::GAUSS_SIGN),
];

/// What is shown: known when a shader is compiled, so that it has no more in it than it needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Shown {
    pub(crate) style: u32,
    pub(crate) pattern: u32,
    /// Which ray meets the light plane.
    pub(crate) ray: u32,
    /// Whether points are of the surface or of the polygon.
    pub(crate) points: u32,
    /// Over how many bindings control points are spread. Some devices take every branch, and one is the rule.
    pub(crate) parts: u32,
}

impl Shown {
    /// Nothing but points.
    pub(crate) fn nothing(parts: u32) -> Shown {
        Shown {
            style: code::SHADED,
            pattern: code::LINES,
            ray: code::REFLECTED,
            points: code::SURFACE,
            parts,
        }
    }

    /// Names and values of the shader's constants.
    pub(crate) fn constants(self) -> [(&'static str, f64); 5] {
        let Shown { style, pattern, ray, points, parts } = self;
        [("STYLE", style), ("PATTERN", pattern), ("RAY", ray), ("POINTS", points), ("PARTS", parts)]
            .map(|(name, value)| (name, f64::from(value)))
    }

    /// Their declarations.
    fn declaration() -> String {
        Shown::nothing(1).constants().map(|(name, _)| format!("override {name}: u32;\n")).concat()
    }
}

/// A field of a struct: its name, its type in WGSL, where it begins and its size, in bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Field {
    pub(crate) name: &'static str,
    pub(crate) wgsl: &'static str,
    pub(crate) offset: usize,
    pub(crate) size: usize,
}

/// A type that WGSL has too.
pub(crate) trait Wgsl {
    const NAME: &'static str;
}

macro_rules! wgsl {
    ($($rust:ty => $name:literal),* $(,)?) => {
        $(impl Wgsl for $rust {
            const NAME: &'static str = $name;
        })*
    };
}

wgsl! {
    f32 => "f32",
    u32 => "u32",
    [f32; 2] => "vec2<f32>",
    [f32; 3] => "vec3<f32>",
    [f32; 4] => "vec4<f32>",
    [u32; 2] => "vec2<u32>",
    [u32; 4] => "vec4<u32>",
}

/// A struct that shaders have too.
pub(crate) trait Shared: Pod + Wgsl {
    fn fields() -> Vec<Field>;

    /// Its declaration in WGSL.
    fn declaration() -> String {
        let fields = Self::fields();
        let lines: String =
            fields.iter().map(|field| format!("    {}: {},\n", field.name, field.wgsl)).collect();
        format!("struct {} {{\n{lines}}}\n", Self::NAME)
    }
}

macro_rules! shared {
    ($($(#[$doc:meta])* struct $name:ident { $($(#[$field_doc:meta])* $field:ident: $type:ty,)* })*) => {
        $(
            $(#[$doc])*
            #[repr(C)]
            #[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
            pub(crate) struct $name { $($(#[$field_doc])* pub(crate) $field: $type,)* }

            impl Wgsl for $name {
                const NAME: &'static str = stringify!($name);
            }

            impl Shared for $name {
                fn fields() -> Vec<Field> {
                    vec![$(Field {
                        name: stringify!($field),
                        wgsl: <$type as Wgsl>::NAME,
                        offset: std::mem::offset_of!($name, $field),
                        size: size_of::<$type>(),
                    },)*]
                }
            }
        )*
    };
}

shared! {
    /// A parametric face.
    struct Face {
        /// What the points of its leaves are relative to.
        origin: [f32; 3],
        /// Its node.
        root: u32,
    }

    /// A chain of patches around an irregular corner.
    struct Tail {
        /// Where the surface is at the corner; what the points of the chain are relative to.
        limit: [f32; 3],
        /// Its first net. Step `n`, tile `k` is net `first + 3 (n - 1) + k`.
        first: u32,
        /// Unit normal at the corner.
        normal: [f32; 3],
        /// How many steps are stored.
        steps: u32,
        /// By how much a step further down shrinks the surface.
        eigenvalue: f32,
        /// Which corner of the piece is irregular.
        corner: u32,
        unused: [u32; 2],
    }

    /// A square of parameters: `ogee::quality::Square`.
    struct Square {
        corner: [f32; 2],
        size: [f32; 2],
        /// Its parametric face.
        face: u32,
        /// A bit for each side that is an edge.
        sides: u32,
        unused: [u32; 2],
        /// For each side four times the square across it and the side of that, or [`BORDER`].
        across: [u32; 4],
    }

    /// A camera in pixels: `ogee_render::View`.
    struct View {
        eye: [f32; 3],
        scale: f32,
        right: [f32; 3],
        is_parallel: u32,
        up: [f32; 3],
        /// The least depth in the picture.
        near: f32,
        forward: [f32; 3],
        /// The greatest.
        far: f32,
        size: [f32; 2],
        /// Pixels of a line that is one wide.
        line_width: f32,
        unused: f32,
    }

    /// A plane of light: `ogee::quality::PlaneLight`.
    struct PlaneLight {
        centre: [f32; 3],
        half_a: f32,
        axis_a: [f32; 3],
        half_b: f32,
        axis_b: [f32; 3],
        unused: f32,
    }

    /// What is on a light plane: `ogee_render::Pattern`.
    struct Pattern {
        /// Width and height of an image.
        size: [u32; 2],
        period: f32,
        width: f32,
        phase: f32,
        radius: f32,
        half: f32,
        unused: f32,
    }

    /// Everything that decides on a picture, except the surface.
    struct Picture {
        view: View,
        light: PlaneLight,
        pattern: Pattern,
        /// Towards the light of isophotes; the axis of zebra stripes.
        direction: [f32; 3],
        /// Degrees of a pair of isophotes; pairs of zebra stripes.
        step: f32,
        quantity: u32,
        /// Where colours of a map end.
        limit: f32,
        /// Newton steps towards the middle of the pixel, at most.
        newton: u32,
        /// Cells along a side of the polygon's grids.
        cells: u32,
    }

    /// A corner of the polygon.
    struct Vertex {
        position: [f32; 3],
        /// The number of its square.
        square: u32,
    }
}

/// What begins every shader: constants and structs. `part` is how many points a binding holds: a power of two.
pub(crate) fn prelude(part: u32) -> String {
    let mut text: String =
        CONSTANTS.iter().map(|(name, value)| format!("const {name} = {value}u;\n")).collect();
    text += &format!("const PART_SHIFT = {}u;\n", part.trailing_zeros());
    for declaration in [
        Face::declaration(),
        Tail::declaration(),
        Square::declaration(),
        View::declaration(),
        PlaneLight::declaration(),
        Pattern::declaration(),
        Picture::declaration(),
    ] {
        text += &declaration;
    }
    text + &Shown::declaration() + &colours() + &unpack::<Face>() + &unpack::<Tail>() + &unpack::<Square>()
}

/// The palette and the scales of maps.
fn colours() -> String {
    let vector = |[r, g, b]: [f32; 3]| format!("vec3<f32>({r:?}, {g:?}, {b:?})");
    let single = [
        ("BODY", palette::BODY),
        ("INSIDE", palette::INSIDE),
        ("PAINT", palette::PAINT),
        ("PAINT_INSIDE", palette::PAINT_INSIDE),
        ("LIGHT", palette::LIGHT),
        ("EDGE", palette::EDGE),
        ("DARK", palette::DARK),
        ("NOTHING", palette::NOTHING),
    ];
    let scales = [("DIVERGING", DIVERGING), ("RISING", RISING)];
    let single = single.map(|(name, colour)| format!("const {name} = {};\n", vector(colour)));
    let scales = scales.map(|(name, scale)| {
        format!("const {name} = array<vec3<f32>, 5>({});\n", scale.map(vector).join(", "))
    });
    single.concat() + &scales.concat()
}

/// A function that makes a struct from words of sixteen bytes, which is how buffers and textures hold it.
fn unpack<T: Shared>() -> String {
    let words: Vec<String> = (0..size_of::<T>() / 16).map(|word| format!("w{word}: vec4<u32>")).collect();
    let parts: Vec<String> = T::fields()
        .iter()
        .map(|field| {
            let (word, first) = (field.offset / 16, field.offset % 16 / 4);
            let part = format!("w{word}.{}", &"xyzw"[first..first + field.size / 4]);
            if field.wgsl.contains("f32") { format!("bitcast<{}>({part})", field.wgsl) } else { part }
        })
        .collect();
    let name = T::NAME;
    format!(
        "fn unpack_{}({}) -> {name} {{\n    return {name}({});\n}}\n",
        name.to_lowercase(),
        words.join(", "),
        parts.join(", ")
    )
}
