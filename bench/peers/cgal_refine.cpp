// Refinement of cages without tags by CGAL, for comparison: usage as `opensubdiv_refine`, with one peer, `cgal`.

#include "cage.h"
#include "measure.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <CGAL/version.h>

namespace {

typedef CGAL::Simple_cartesian<double>::Point_3 Point;
typedef CGAL::Surface_mesh<Point> Mesh;

Mesh connect(Cage const &cage) {
    Mesh mesh;
    mesh.reserve(Mesh::size_type(cage.vertexCount()), Mesh::size_type(2 * cage.faceCount()),
                 Mesh::size_type(cage.faceCount()));
    for (std::size_t v = 0; v < cage.points.size(); v += 3) {
        mesh.add_vertex(Point(cage.points[v], cage.points[v + 1], cage.points[v + 2]));
    }
    std::vector<Mesh::Vertex_index> face;
    int const *corner = cage.corners.data();
    for (int const size : cage.faceSizes) {
        face.clear();
        for (int k = 0; k < size; ++k) face.push_back(Mesh::Vertex_index(Mesh::size_type(*corner++)));
        if (mesh.add_face(face) == Mesh::null_face()) throw std::runtime_error("the cage was refused");
    }
    return mesh;
}

void refine(Cage const &cage, unsigned depth) {
    Buffer<double> points;
    Buffer<std::uint32_t> corners;
    Passes const result = passes([&] {
        Mesh mesh = connect(cage);
        CGAL::Subdivision_method_3::CatmullClark_subdivision(mesh, CGAL::parameters::number_of_iterations(depth));
        points.resize(3 * mesh.number_of_vertices());
        corners.resize(4 * mesh.number_of_faces());
        double *to = points.data();
        for (Mesh::Vertex_index const v : mesh.vertices()) {
            for (int c = 0; c < 3; ++c) *to++ = mesh.point(v)[c];
        }
        std::uint32_t *corner = corners.data();
        for (Mesh::Face_index const f : mesh.faces()) {
            for (Mesh::Vertex_index const v : mesh.vertices_around_face(mesh.halfedge(f))) *corner++ = v;
        }
    });
    printRefinement(result, points, corners);
}

}  // namespace

int main(int argc, char **argv) {
    std::vector<std::string> const arguments(argv + 1, argv + argc);
    try {
        if (!arguments.empty() && arguments[0] == "version") {
            std::cout << CGAL_VERSION_STR << '\n';
            return 0;
        }
        if (arguments.size() < 4 || arguments[0] != "refine" || arguments[1] != "cgal") {
            std::cerr << "usage: cgal_refine version | cgal_refine refine cgal LEVEL CAGE\n";
            return 2;
        }
        Cage const cage = readCage(arguments[3]);
        if (!cage.creaseSharpness.empty() || !cage.vertexSharpness.empty()) {
            throw std::runtime_error("sharp edges and vertices are not known here");
        }
        refine(cage, unsigned(std::stoi(arguments[2])));
    } catch (std::exception const &error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
