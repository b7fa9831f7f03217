// Refinement and animation of cages by OpenSubdiv, for comparison. Each run does one task and prints one line of JSON.

#include "measure.h"
#include "refiner.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTable.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/osd/cpuEvaluator.h>
#include <opensubdiv/version.h>

namespace Osd = OpenSubdiv::Osd;

namespace {

char const *const USAGE =
    "usage: opensubdiv_refine version\n"
    "       opensubdiv_refine refine  float|double LEVEL CAGE\n"
    "       opensubdiv_refine animate stencils|stencils-4|stencils-double|primvar LEVEL CAGE FRAMES\n"
    "stencils: CpuEvaluator on three floats a point; stencils-4: on four, which it has a kernel for;\n"
    "stencils-double: UpdateValues on doubles; primvar: PrimvarRefiner on floats, level by level.\n";

template <typename T>
struct Point {
    T x, y, z;
    void Clear(void * = nullptr) { x = y = z = 0; }
    void AddWithWeight(Point const &other, T weight) {
        x += weight * other.x;
        y += weight * other.y;
        z += weight * other.z;
    }
};

std::unique_ptr<Far::TopologyRefiner> refined(Cage const &cage, int depth) {
    std::unique_ptr<Far::TopologyRefiner> refiner = connect(cage);
    refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(depth));
    return refiner;
}

// All levels' points from the cage's; those of the last go to `points`, three numbers each.
template <typename T>
void interpolate(Far::TopologyRefiner const &refiner, T const *cage, Buffer<Point<T>> (&inner)[2], Buffer<T> &points) {
    Far::PrimvarRefinerReal<T> const primvar(refiner);
    int const depth = refiner.GetMaxLevel();
    points.resize(3 * std::size_t(refiner.GetLevel(depth).GetNumVertices()));
    Point<T> const *from = reinterpret_cast<Point<T> const *>(cage);
    for (int level = 1; level <= depth; ++level) {
        Point<T> *to = reinterpret_cast<Point<T> *>(points.data());
        if (level < depth) {
            inner[level % 2].resize(std::size_t(refiner.GetLevel(level).GetNumVertices()));
            to = inner[level % 2].data();
        }
        primvar.Interpolate(level, from, to);
        from = to;
    }
}

void copyFaces(Far::TopologyRefiner const &refiner, Buffer<int> &corners) {
    Far::TopologyLevel const &last = refiner.GetLevel(refiner.GetMaxLevel());
    int const faces = last.GetNumFaces();
    corners.resize(4 * std::size_t(faces));
    for (int face = 0; face < faces; ++face) {
        Far::ConstIndexArray const vertices = last.GetFaceVertices(face);
        for (int k = 0; k < 4; ++k) corners[4 * std::size_t(face) + std::size_t(k)] = vertices[k];
    }
}

template <typename T>
void refine(Cage const &cage, int depth) {
    std::vector<T> const cagePoints(cage.points.begin(), cage.points.end());
    Buffer<T> points;
    Buffer<int> corners;
    Buffer<Point<T>> inner[2];
    Passes const result = passes([&] {
        std::unique_ptr<Far::TopologyRefiner> const refiner = refined(cage, depth);
        interpolate(*refiner, cagePoints.data(), inner, points);
        copyFaces(*refiner, corners);
    });
    printRefinement(result, points, corners);
}

// What a table holds, and what is needed to make it, is made by `setUp`; `apply` gives the points of a pose.
template <typename T, typename SetUp, typename Apply>
void animateWith(Cage const &cage, int depth, int frames, int stride, SetUp &&setUp, Apply &&apply) {
    Peak const peak;
    double const start = now();
    setUp();
    double const setUpSeconds = now() - start;
    double const setUpBytes = peak.growth();
    Buffer<T> out;
    double const seconds =
        animate<T>(cage.points, frames, stride, [&](std::vector<T> const &posed) { apply(posed, out); });
    std::size_t const vertices = out.size() / std::size_t(stride);
    Buffer<T> points;
    points.resize(3 * vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
        for (std::size_t c = 0; c < 3; ++c) points[3 * i + c] = out[std::size_t(stride) * i + c];
    }
    Buffer<int> corners;
    copyFaces(*refined(cage, depth), corners);
    std::size_t const faces = corners.size() / 4;
    std::cout << "{";
    printFigures(vertices, faces, figures(points, vertices, corners, faces));
    std::cout << ",\"set_up_seconds\":" << setUpSeconds << ",\"set_up_bytes\":" << setUpBytes
              << ",\"frame_seconds\":" << seconds << "}\n";
}

template <typename T>
std::unique_ptr<Far::StencilTableReal<T> const> stencils(Cage const &cage, int depth) {
    std::unique_ptr<Far::TopologyRefiner> const refiner = refined(cage, depth);
    typedef Far::StencilTableFactoryReal<T> Factory;
    typename Factory::Options options;
    options.generateIntermediateLevels = false;
    options.generateOffsets = true;
    return std::unique_ptr<Far::StencilTableReal<T> const>(Factory::Create(*refiner, options));
}

void animate(std::string const &peer, Cage const &cage, int depth, int frames) {
    if (peer == "primvar") {
        std::unique_ptr<Far::TopologyRefiner> refiner;
        Buffer<Point<float>> inner[2];
        return animateWith<float>(
            cage, depth, frames, 3, [&] { refiner = refined(cage, depth); },
            [&](std::vector<float> const &posed, Buffer<float> &out) {
                interpolate(*refiner, posed.data(), inner, out);
            });
    }
    if (peer == "stencils-double") {
        std::unique_ptr<Far::StencilTableReal<double> const> table;
        return animateWith<double>(
            cage, depth, frames, 3, [&] { table = stencils<double>(cage, depth); },
            [&](std::vector<double> const &posed, Buffer<double> &out) {
                out.resize(3 * std::size_t(table->GetNumStencils()));
                Point<double> *to = reinterpret_cast<Point<double> *>(out.data());
                table->UpdateValues(reinterpret_cast<Point<double> const *>(posed.data()), to);
            });
    }
    int const stride = peer == "stencils-4" ? 4 : 3;
    if (stride == 3 && peer != "stencils") throw std::runtime_error("no such peer: " + peer);
    std::unique_ptr<Far::StencilTableReal<float> const> table;
    Osd::BufferDescriptor const layout(0, stride, stride);
    animateWith<float>(
        cage, depth, frames, stride, [&] { table = stencils<float>(cage, depth); },
        [&](std::vector<float> const &posed, Buffer<float> &out) {
            int const count = table->GetNumStencils();
            out.resize(std::size_t(stride) * std::size_t(count));
            Osd::CpuEvaluator::EvalStencils(posed.data(), layout, out.data(), layout, table->GetSizes().data(),
                                            table->GetOffsets().data(), table->GetControlIndices().data(),
                                            table->GetWeights().data(), 0, count);
        });
}

}  // namespace

int main(int argc, char **argv) {
    std::vector<std::string> const arguments(argv + 1, argv + argc);
    try {
        std::string const task = arguments.empty() ? "" : arguments[0];
        if (task == "version") {
            std::cout << OPENSUBDIV_VERSION_NUMBER / 10000 << '.' << OPENSUBDIV_VERSION_NUMBER / 100 % 100 << '.'
                      << OPENSUBDIV_VERSION_NUMBER % 100 << '\n';
            return 0;
        }
        if (task != "refine" && task != "animate") {
            std::cerr << USAGE;
            return 2;
        }
        std::string const peer = arguments.at(1);
        int const depth = std::stoi(arguments.at(2));
        Cage const cage = readCage(arguments.at(3));
        if (task == "animate") {
            animate(peer, cage, depth, std::stoi(arguments.at(4)));
        } else if (peer == "float") {
            refine<float>(cage, depth);
        } else if (peer == "double") {
            refine<double>(cage, depth);
        } else {
            throw std::runtime_error("no such peer: " + peer);
        }
    } catch (std::exception const &error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
