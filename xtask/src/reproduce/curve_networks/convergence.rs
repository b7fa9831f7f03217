//! How fast normals settle, against what the eigenvalues say.

use anyhow::{Context, Result};
use ogee::Vec3;
use ogee::curve_network::{Embedding, XMatrix, default_parameter, embed};

use super::maps::{even, star, uneven};
use super::settling::spreads;
use crate::bench::report::Table;

const LEVELS: [u32; 10] = [1, 2, 3, 4, 6, 8, 10, 12, 14, 16];

/// How far free spokes are lifted, of the length of a leg or so.
const LIFT: f64 = 0.05;

const UP: Vec3 = Vec3::new(0.0, 0.0, 1.0);

/// A meeting point of curves with tangents in a plane; its free spokes lifted off it, each by another length.
fn meeting(legs: &[Vec3], t: Option<f64>, lift: f64) -> Result<Embedding> {
    let (mesh, mut network) = star(legs, 0.2);
    network.options.parameter = t;
    let mut embedding = embed(&network, &mesh)?;
    let middle =
        embedding.x_configurations.iter().find(|x| x.center == 0).context("curves meet in the middle")?;
    for (j, &v) in middle.ring.iter().skip(1).step_by(2).enumerate() {
        embedding.mesh.points[v as usize].z += lift * (1.0 + (2.1 * j as f64).sin());
    }
    Ok(embedding)
}

/// Largest angle of normals and the plane of the tangents, by level, with the factor of one level.
pub(super) fn table() -> Result<Table> {
    let rate = |ports, t| 2.0 * XMatrix::new(ports, t).largest_free_eigenvalue();
    let star = default_parameter(3);
    let lifted = |ports, t| format!("{ports} curves, lifted, t = {t:.4} (2 lam = {:.4})", rate(ports, t));
    let cases = [
        ("4 curves, eigen ring, t found".to_owned(), meeting(&uneven(4), None, 0.0)?),
        (lifted(3, star), meeting(&uneven(3), Some(star), LIFT)?),
        (lifted(4, 0.25), meeting(&uneven(4), Some(0.25), LIFT)?),
        (lifted(4, 0.5), meeting(&even(4), Some(0.5), LIFT)?),
    ];
    let mut columns = vec!["level"];
    columns.extend(cases.iter().map(|(name, _)| name.as_str()));
    let mut table = Table::new(&columns);
    let settled: Vec<Vec<f64>> = cases
        .iter()
        .map(|(_, embedding)| spreads(&embedding.mesh, 0, &LEVELS, Some(UP)).context("normals exist"))
        .collect::<Result<_>>()?;
    for (i, level) in LEVELS.into_iter().enumerate() {
        let mut row = vec![level.to_string()];
        row.extend(settled.iter().map(|spreads| {
            let Some(before) = i.checked_sub(1) else { return figure(spreads[i]) };
            let levels = f64::from(level - LEVELS[before]);
            format!("{} ({:.3})", figure(spreads[i]), (spreads[i] / spreads[before]).powf(1.0 / levels))
        }));
        table.row(&row);
    }
    Ok(table)
}

/// Degrees, with three figures.
pub(super) fn figure(x: f64) -> String {
    if x >= 0.01 { format!("{x:.3}") } else { format!("{x:.2e}") }
}
