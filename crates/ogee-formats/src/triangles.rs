//! Polygons cut into triangles, for formats that have nothing else.

use ogee::Vec3;

use crate::mesh::Faces;

/// How many triangles the faces give; those of fewer than three corners give none.
pub(crate) fn count(faces: Faces<'_>) -> usize {
    faces.iter().map(|face| face.len().saturating_sub(2)).sum()
}

/// The triangles of a mesh, face by face: quads cut along their shorter diagonal, polygons as fans about their
/// first corner. The vertices of every face are there.
pub(crate) fn of_faces<'a>(points: &'a [Vec3], faces: Faces<'a>) -> impl Iterator<Item = [u32; 3]> + 'a {
    faces.iter().flat_map(move |face| {
        let apex = match *face {
            [a, b, c, d] => usize::from(is_longer(points, [a, c], [b, d])),
            _ => 0,
        };
        let corner = move |k: usize| face[(apex + k) % face.len()];
        (2..face.len()).map(move |k| [corner(0), corner(k - 1), corner(k)])
    })
}

/// The area of a triangle times twice its unit normal.
pub(crate) fn normal(points: &[Vec3], [a, b, c]: [u32; 3]) -> Vec3 {
    let a = points[a as usize];
    (points[b as usize] - a).cross(points[c as usize] - a)
}

fn is_longer(points: &[Vec3], first: [u32; 2], second: [u32; 2]) -> bool {
    let length = |[a, b]: [u32; 2]| points[a as usize].distance(points[b as usize]);
    length(first) > length(second)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ogee::FaceList;

    #[test]
    fn quads_are_cut_along_the_shorter_diagonal() {
        let kite =
            |x: f64| [[0.0, -1.0, 0.0], [x, 0.0, 0.0], [0.0, 1.0, 0.0], [-x, 0.0, 0.0]].map(Vec3::from);
        let quad = [[0, 1, 2, 3]];
        let cut = |x: f64| of_faces(&kite(x), Faces::Quads(&quad)).collect::<Vec<_>>();
        assert_eq!(cut(3.0), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(cut(0.5), [[1, 2, 3], [1, 3, 0]]);
    }

    #[test]
    fn polygons_are_fans() {
        let points = [Vec3::ZERO; 5];
        let mut faces = FaceList::new();
        faces.push(&[4, 3, 2, 1, 0]);
        faces.push(&[0, 1]);
        let faces = Faces::Polygons(&faces);
        let triangles: Vec<_> = of_faces(&points, faces).collect();
        assert_eq!(triangles, [[4, 3, 2], [4, 2, 1], [4, 1, 0]]);
        assert_eq!(count(faces), 3);
    }
}
