//! Whether the faces around a meeting of curves are what its rule asks for.

use std::collections::HashMap;

use super::{ControlMesh, Defect, Meeting};

/// A face at a meeting, seen from there: the next corner, the last, and how many corners there are.
#[derive(Clone, Copy)]
struct Around {
    face: u32,
    next: u32,
    last: u32,
    size: usize,
}

/// Meetings that are not inside, have other faces than quads, ports that are not every second neighbour, a parameter out of
/// range or sharp edges; and faces that two meetings share. All edges of the mesh are sound.
pub(super) fn check_meetings(mesh: &ControlMesh, defects: &mut Vec<Defect>) {
    let mut around: HashMap<u32, Vec<Around>> =
        mesh.meetings.iter().map(|meeting| (meeting.vertex, Vec::new())).collect();
    let mut owners: HashMap<u32, u32> = HashMap::new();
    for (face, corners) in (0..).zip(mesh.faces.iter()) {
        let size = corners.len();
        for (k, &vertex) in corners.iter().enumerate() {
            let Some(list) = around.get_mut(&vertex) else { continue };
            list.push(Around {
                face,
                next: corners[(k + 1) % size],
                last: corners[(k + size - 1) % size],
                size,
            });
            if let Some(other) = owners.insert(face, vertex) {
                let message =
                    format!("it shares face {face} with the meeting at vertex {other}; split the mesh first");
                defects.push(Defect::Meeting { vertex, message });
            }
        }
    }
    for meeting in &mesh.meetings {
        if let Some(message) = fault(mesh, meeting, &around[&meeting.vertex]) {
            defects.push(Defect::Meeting { vertex: meeting.vertex, message });
        }
    }
}

/// What is wrong with a meeting.
fn fault(mesh: &ControlMesh, meeting: &Meeting, around: &[Around]) -> Option<String> {
    let Meeting { vertex, ref ports, t } = *meeting;
    if !(t > 0.0 && t <= 0.5) {
        return Some(format!("its parameter is {t}, not above 0 and at most 1/2"));
    }
    if let Some(Around { face, size, .. }) = around.iter().find(|around| around.size != 4) {
        return Some(format!("face {face} there has {size} corners, not 4"));
    }
    let first = ports.first()?;
    let mut spokes = vec![*first];
    while spokes.len() <= around.len() {
        let last = spokes[spokes.len() - 1];
        let Some(next) = around.iter().find(|around| around.next == last) else { break };
        spokes.push(next.last);
    }
    let is_ring = spokes.len() == around.len() + 1 && spokes.pop() == Some(*first);
    if !is_ring {
        return Some("it is not inside the surface, or its first port is no neighbour".to_owned());
    }
    if ports.len() < 2 || !spokes.iter().step_by(2).eq(ports) || spokes.len() != 2 * ports.len() {
        let spokes = spokes.len();
        return Some(format!("its ports are not every second of its {spokes} neighbours, counter-clockwise"));
    }
    let is_sharp =
        mesh.creases.iter().any(|crease| crease.vertices.contains(&vertex) && crease.sharpness.value() > 0.0)
            || mesh.corners.iter().any(|corner| corner.vertex == vertex && corner.sharpness.value() > 0.0);
    is_sharp.then(|| "an edge there or the vertex itself is sharp".to_owned())
}
