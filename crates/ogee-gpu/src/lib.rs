//! Pictures of exact surfaces on a graphics processor.
//!
//! The pictures are those of [`ogee_render`], with every point evaluated by a shader: the trees of all faces are sent to the
//! device as they are, chains around irregular corners expanded into bicubic nets, and each pixel goes down its own tree. The
//! method is that of Yasui and Kanai; `docs/methods/exact_evaluation.md` has how it is laid out.
//!
//! ```no_run
//! use ogee::quality::LimitView;
//! use ogee::{Level, LimitSurface, PatchTable, shapes};
//! use ogee_gpu::{Device, DeviceOptions, GpuSurface, Renderer};
//! use ogee_render::Scene;
//!
//! let mesh = shapes::cube();
//! let level = Level::new(&mesh)?;
//! let table = PatchTable::new(&level);
//! let surface = LimitSurface::new(&table, &mesh.points);
//! let view = LimitView::new(&level, &surface);
//!
//! let device = Device::new(&DeviceOptions::default())?;
//! let renderer = Renderer::new(&device)?;
//! let on_device = GpuSurface::new(&device, &view)?;
//! let picture = renderer.render(&on_device, &Scene::of(&view, [640, 480]))?;
//! picture.image().write_png(std::fs::File::create("cube.png")?)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | file | holds |
//! | --- | --- |
//! | `device` | [`Device`]: which adapter, its limits, waiting and failing |
//! | `layout` | what the processor and the shaders share, and the prelude that says it in WGSL |
//! | `shaders` | joining files of WGSL to shaders |
//! | `frame` | the model around the origin and of size one |
//! | `flat`, `upload` | trees as arrays; [`GpuSurface`] |
//! | `scene`, `grids` | [`ogee_render::Scene`] and [`ogee_render::Polygon`] as shaders read them |
//! | `render`, `evaluate` | [`Renderer`]: pictures and passes; points at listed places |
//! | `pipeline`, `targets`, `read` | shaders bound to data, what they write, and back |

mod device;
mod error;
mod evaluate;
mod flat;
mod frame;
mod grids;
mod layout;
mod pipeline;
mod read;
mod render;
mod scene;
mod shaders;
mod targets;
mod upload;

pub use device::{Device, DeviceOptions, Storage};
pub use error::GpuError;
pub use render::{Pass, Prepared, Renderer};
pub use upload::GpuSurface;
