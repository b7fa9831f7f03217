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
    let Some(&first) = ports.first() else { return Some("it has no ports".to_owned()) };
    let mut spokes = vec![first];
    while spokes.len() <= around.len() {
        let last = spokes[spokes.len() - 1];
        let Some(next) = around.iter().find(|around| around.next == last) else { break };
        spokes.push(next.last);
    }
    let is_ring = spokes.len() == around.len() + 1 && spokes.pop() == Some(first);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Corner, Crease, FaceList, Sharpness, check, shapes};

    fn messages(mesh: &ControlMesh) -> Vec<String> {
        check(mesh).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn what_is_wrong_is_said() {
        // A meeting of three in the middle of a disk; its neighbours in order, and a vertex of the rim.
        let disk = shapes::disk(6, 2);
        let spokes: Vec<u32> = disk.faces.iter().filter(|face| face[0] == 0).map(|face| face[1]).collect();
        let ports = vec![spokes[0], spokes[2], spokes[4]];
        let with = |meetings: Vec<Meeting>| ControlMesh { meetings, ..disk.clone() };
        let good = Meeting { vertex: 0, ports: ports.clone(), t: 0.3 };
        assert_eq!(messages(&with(vec![good.clone()])), [""; 0]);
        let rim = disk.faces.face(3)[2];
        let rotated = vec![ports[2], ports[0], ports[1]];
        assert_eq!(messages(&with(vec![Meeting { ports: rotated, ..good.clone() }])), [""; 0]);
        let bad = [
            (Meeting { vertex: 99, ..good.clone() }, "names vertex 99, but there are only"),
            (Meeting { vertex: rim, ..good.clone() }, "not inside the surface"),
            (Meeting { t: 0.0, ..good.clone() }, "its parameter is 0,"),
            (Meeting { t: f64::NAN, ..good.clone() }, "its parameter is NaN,"),
            (Meeting { t: 0.51, ..good.clone() }, "its parameter is 0.51,"),
            (Meeting { ports: vec![], ..good.clone() }, "no ports"),
            (Meeting { ports: vec![rim, 1, 2], ..good.clone() }, "its first port is no neighbour"),
            (Meeting { ports: vec![ports[0], ports[2], ports[1]], ..good.clone() }, "every second of its 6"),
            (Meeting { ports: ports[..2].to_vec(), ..good.clone() }, "every second of its 6"),
            (Meeting { ports: spokes.clone(), ..good.clone() }, "every second of its 6"),
        ];
        for (meeting, wanted) in bad {
            let found = messages(&with(vec![meeting]));
            assert!(found.len() == 1 && found[0].contains(wanted), "{wanted}: {found:?}");
        }
        let sharp = Sharpness::Infinite;
        let creased = ControlMesh {
            creases: vec![Crease { vertices: [0, spokes[1]], sharpness: sharp }],
            ..with(vec![good.clone()])
        };
        let cornered =
            ControlMesh { corners: vec![Corner { vertex: 0, sharpness: sharp }], ..with(vec![good.clone()]) };
        for mesh in [creased, cornered] {
            assert!(messages(&mesh)[0].contains("is sharp"));
        }
    }

    #[test]
    fn neighbours_and_polygons_are_refused() {
        let mut grid = shapes::grid(5, 4);
        let meeting = |vertex: u32| Meeting { vertex, ports: vec![vertex + 1, vertex - 1], t: 0.5 };
        grid.meetings = vec![meeting(8), meeting(16)];
        assert_eq!(messages(&grid), [""; 0]);
        grid.meetings = vec![meeting(8), meeting(15)];
        assert!(messages(&grid)[0].contains("shares face"), "{:?}", messages(&grid));
        grid.meetings.pop();
        let mut faces = FaceList::new();
        for (f, face) in grid.faces.iter().enumerate() {
            if f == 1 {
                faces.push(&face[..3]);
                faces.push(&[face[0], face[2], face[3]]);
            } else {
                faces.push(face);
            }
        }
        grid.faces = faces;
        assert!(messages(&grid)[0].contains("corners, not 4"), "{:?}", messages(&grid));
    }
}
