//! What tests of pictures share: a device, if there is one, and cages.

#![allow(dead_code, unreachable_pub, reason = "each claim uses a part of it")]
#![allow(clippy::print_stdout, reason = "one should know what was not tested")]

use ogee::quality::LimitView;
use ogee::{ControlMesh, Level, LimitSurface, PatchTable};
use ogee_gpu::{Device, DeviceOptions, GpuError};

/// A device, or `None` with a word about it. Where `OGEE_REQUIRE_GPU` is 1 there has to be one.
pub fn device(options: &DeviceOptions) -> Option<Device> {
    match Device::new(options) {
        Ok(device) => Some(device),
        Err(GpuError::NoAdapter { .. }) if std::env::var("OGEE_REQUIRE_GPU").as_deref() != Ok("1") => {
            println!("skipped: no adapter");
            None
        }
        Err(error) => panic!("{error}"),
    }
}

/// Hands the limit surface of a cage on.
pub fn with_view<T>(mesh: &ControlMesh, then: impl FnOnce(&LimitView<'_>, &PatchTable) -> T) -> T {
    let level = Level::new(mesh).expect("the cage is a surface");
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    then(&LimitView::new(&level, &surface), &table)
}
