//! The shipped cages: each is a short program, so that its dimensions have names and its file can be made
//! again. All lengths are millimetres, z is up.

mod ball;
mod bauble;
mod bottle;
mod bracket;
mod brick;
mod builder;
mod car;
mod chair;
mod hand;
mod hull;
mod knob;
mod knot;
mod mug;
mod profile;
mod stars;
mod sweep;
#[cfg(test)]
mod tests;
mod urchin;
mod vase;
mod write;
mod yacht;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use ogee::ControlMesh;
use ogee::curve_network::CurveNetwork;

/// A cage that is shipped, and what is promised about it.
struct Model {
    /// The name of the file, without extension.
    name: &'static str,
    /// What it is and what it exercises; opens the file.
    about: &'static [&'static str],
    form: Form,
    mesh: ControlMesh,
}

/// A cage that is shipped with the curves that its surface is to contain.
struct NetworkModel {
    /// The name of the file, without extension.
    name: &'static str,
    form: Form,
    mesh: ControlMesh,
    network: CurveNetwork,
}

/// What kind of surface a model is.
enum Form {
    /// Closed, so many connected pieces, so many handles in all.
    Closed { pieces: usize, genus: usize },
    /// With a boundary.
    Open,
}

/// All models, in the order of their names.
fn all() -> Vec<Model> {
    vec![
        ball::model(),
        bauble::model(),
        bottle::model(),
        brick::model(),
        bracket::model(),
        car::model(),
        chair::model(),
        hand::model(),
        hull::model(),
        knob::model(),
        knot::model(),
        mug::model(),
        stars::model(),
        urchin::model(),
        vase::model(),
    ]
}

/// All models with curves, in the order of their names.
fn networks() -> Vec<NetworkModel> {
    vec![yacht::model()]
}

/// Where the shipped cages live.
pub(crate) fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../models")
}

/// Writes every model and says what was written, one line each.
pub(crate) fn write_all(folder: &Path) -> Result<Vec<String>> {
    std::fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    let mut lines = Vec::new();
    for model in all() {
        let path = folder.join(model.name).with_extension("obj");
        std::fs::write(&path, write::to_obj(&model)?)
            .with_context(|| format!("cannot write {}", path.display()))?;
        lines.push(format!("{}: {}", model.name, write::counts(&model.mesh, &model.form)));
    }
    for model in networks() {
        let path = folder.join(model.name).with_extension("json");
        std::fs::write(&path, write::to_json(&model)?)
            .with_context(|| format!("cannot write {}", path.display()))?;
        let counts = write::counts(&model.mesh, &model.form);
        lines.push(format!("{}: {counts}, {} curves", model.name, model.network.curves.len()));
    }
    Ok(lines)
}
