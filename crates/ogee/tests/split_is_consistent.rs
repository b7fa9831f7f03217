//! What the numbering promises: counts, twins, edges, rings, and where extraordinary vertices may be.

mod golden;

use golden::{cage, documents};
use ogee::{ControlMesh, EdgeId, FaceId, HalfedgeId, Level, Valence, VertexId, shapes};

fn cages() -> Vec<(String, ControlMesh)> {
    let golden =
        ["opensubdiv", "pccm"].into_iter().flat_map(documents).filter(|(_, document)| document.is_object());
    let mut cages: Vec<_> = golden
        .filter(|(_, document)| !document["cage"].is_null())
        .map(|(name, document)| (name, cage(&document["cage"], &document["options"])))
        .collect();
    cages.push(("torus".into(), shapes::torus(5, 4)));
    cages.push(("disk".into(), shapes::disk(9, 2)));
    cages
}

#[test]
fn split_is_consistent() {
    for (name, mesh) in cages() {
        let mut level = Level::new(&mesh).unwrap();
        for _ in 0..3 {
            let (parent, child) = (level.topology().clone(), level.refine().level);
            let t = child.topology();
            let (v, e, f, h) =
                (parent.vertex_count(), parent.edge_count(), parent.face_count(), parent.halfedge_count());
            assert_eq!(t.vertex_count(), v + e + f, "{name}");
            assert_eq!(t.edge_count(), 2 * e + h, "{name}");
            assert_eq!(t.face_count(), h, "{name}");
            let mut seen = vec![0; t.edge_count()];
            for h in (0..t.halfedge_count() as u32).map(HalfedgeId) {
                seen[t.edge(h).index()] += 1;
                if let Some(twin) = t.twin(h) {
                    assert_ne!(twin, h);
                    assert_eq!(t.twin(twin), Some(h), "{name}");
                    assert_eq!((t.origin(twin), t.target(twin)), (t.target(h), t.origin(h)), "{name}");
                    assert_eq!(t.edge(twin), t.edge(h), "{name}");
                }
            }
            let edges: Vec<_> = t.edge_halfedges().collect();
            for (e, &h) in edges.iter().enumerate() {
                assert_eq!(t.edge(h), EdgeId(e as u32));
                assert!(t.twin(h).is_none_or(|twin| h < twin), "{name}");
                assert_eq!(seen[e], 1 + i32::from(t.twin(h).is_some()), "{name}");
            }
            for v in (0..t.vertex_count() as u32).map(VertexId) {
                let ring: Vec<_> = t.ring(v).collect();
                assert!(ring.iter().all(|&h| t.origin(h) == v), "{name}");
                let open = ring.iter().any(|&h| t.twin(h).is_none());
                assert_eq!(t.is_boundary(v), open && t.twin(ring[0]).is_none(), "{name}");
            }
            level = child;
        }
    }
}

#[test]
fn only_corner_zero_is_extraordinary() {
    for (name, mesh) in cages() {
        let level = Level::new(&mesh).unwrap().refine().level.refine().level;
        let t = level.topology();
        let mut extraordinary = 0;
        for f in (0..t.face_count() as u32).map(FaceId) {
            for (corner, h) in t.halfedges(f).enumerate() {
                let valence = t.valence(t.origin(h));
                if corner > 0 {
                    assert!(valence.is_regular(), "{name}: face {f}, corner {corner}: {valence:?}");
                } else {
                    extraordinary += u32::from(!valence.is_regular());
                }
            }
        }
        if name == "cube" {
            assert_eq!(extraordinary, 24);
        }
    }
}

#[test]
fn euler_number_is_kept() {
    for (name, mesh) in cages() {
        let level = Level::new(&mesh).unwrap();
        let euler = |level: &Level| {
            let t = level.topology();
            t.vertex_count() as i64 - t.edge_count() as i64 + t.face_count() as i64
        };
        assert_eq!(euler(&level), euler(&level.refine().level), "{name}");
    }
    let torus = Level::new(&shapes::torus(6, 5)).unwrap();
    assert!((0..30).all(|v| torus.topology().valence(VertexId(v)) == Valence::Interior(4)));
}
