//! Masks where curves of a network meet.

use std::f64::consts::TAU;

/// The tangent of the curve that arrives along one of the quad's edges, and where the free spoke along the other leads in
/// the end: of the eigenvectors to 1/2 of `docs/methods/curve_network.md`.
pub(super) fn tangents(ports: usize, port_first: bool, t: f64) -> [Vec<f64>; 2] {
    let count = 1 + 4 * ports;
    let ring = |k: usize| 1 + k % (4 * ports);
    // Neighbours of the vertex are numbered from the quad's first edge; ports are every second one.
    let first = usize::from(!port_first);
    let tangent = |port: usize, share: f64, out: &mut Vec<f64>| {
        let at = 2 * (2 * port + first);
        out[0] -= share;
        for (k, weight) in [(at, 4.0 / 6.0), (at + 1, 1.0 / 6.0), (at + 4 * ports - 1, 1.0 / 6.0)] {
            out[ring(k)] += share * weight;
        }
    };
    let mut own = vec![0.0; count];
    tangent(0, 1.0, &mut own);
    // The free spoke after port 0, or the one before it.
    let mut free = vec![0.0; count];
    for port in 0..ports {
        let step = if port_first { port } else { ports - port };
        let share: f64 = (0..ports)
            .map(|w| {
                let angle = TAU * w as f64 / ports as f64;
                let sums = (angle * step as f64).cos() + (angle * (1.0 - step as f64)).cos();
                let under = 1.0 - t + t * angle.cos();
                // Two ports at t = 1/2: what has no place in the tangents is an eigenvector of its own, below.
                if under.abs() < 1e-9 { 0.0 } else { sums / (2.0 * under) }
            })
            .sum();
        tangent(port, share / ports as f64, &mut free);
    }
    if ports == 2 && (t - 0.5).abs() < 1e-9 {
        let spoke = 2 * usize::from(port_first);
        for (k, weight) in [(0, 4.0), (1, 1.0), (7, 1.0), (3, -1.0), (4, -4.0), (5, -1.0)] {
            free[ring(spoke + k)] += weight / 12.0;
        }
    }
    if port_first { [own, free] } else { [free, own] }
}
