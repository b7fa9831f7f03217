// Evaluation with OpenSubdiv's Bfr: one surface per face, made on demand or all beforehand.

#pragma once

#include "refiner.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

namespace Bfr = OpenSubdiv::Bfr;

typedef Bfr::RefinerSurfaceFactory<> BfrFactory;
typedef Bfr::Surface<double> BfrSurface;

// A negative level leaves the library's defaults: 2 at smooth features and 6 at sharp ones.
inline BfrFactory::Options bfrOptions(int level) {
    BfrFactory::Options options;
    if (level >= 0) options.SetApproxLevelSmooth(level).SetApproxLevelSharp(level);
    return options;
}

// Nine numbers, position and first derivatives, or eighteen with second derivatives.
inline void bfrEvaluate(BfrSurface const &surface, double const *patchPoints, Sample const &at, int order,
                        double *out) {
    double const own[2] = {at.u, at.v};
    double place[2] = {at.u, at.v};
    Bfr::Parameterization const parameters = surface.GetParameterization();
    bool const isSubFace = parameters.HasSubFaces();
    if (isSubFace) parameters.ConvertNormalizedSubFaceToCoord(at.corner, own, place);
    if (order == 1) {
        surface.Evaluate(place, patchPoints, 3, out, out + 3, out + 6);
    } else {
        surface.Evaluate(place, patchPoints, 3, out, out + 3, out + 6, out + 9, out + 12, out + 15);
    }
    // A sub-face is half as long in its face's parameters as in its own.
    if (isSubFace) {
        for (int i = 3; i < 9; ++i) out[i] /= 2;
        for (int i = 9; i < 9 * order; ++i) out[i] /= 4;
    }
}

// A surface is made when a sample lies on another face than the one before.
class BfrOnDemand {
public:
    explicit BfrOnDemand(int level) : level(level) {}

    void prepare(Cage const &cage, Far::TopologyRefiner &refiner) {
        points = cage.points.data();
        factory.reset(new BfrFactory(refiner, bfrOptions(level)));
        face = -1;
    }

    void evaluate(Sample const &at, int order, double *out) {
        if (at.face != face) {
            face = at.face;
            if (!factory->InitVertexSurface(face, &surface)) throw std::runtime_error("a face has no surface");
            patchPoints.resize(3 * std::size_t(surface.GetNumPatchPoints()));
            surface.PreparePatchPoints(points, 3, patchPoints.data(), 3);
        }
        bfrEvaluate(surface, patchPoints.data(), at, order, out);
    }

private:
    int level;
    double const *points = nullptr;
    std::unique_ptr<BfrFactory> factory;
    int face = -1;
    BfrSurface surface;
    std::vector<double> patchPoints;
};

// The surfaces of all faces and their patch points are kept.
class BfrPrepared {
public:
    explicit BfrPrepared(int level) : level(level) {}

    void prepare(Cage const &cage, Far::TopologyRefiner &refiner) {
        factory.reset(new BfrFactory(refiner, bfrOptions(level)));
        std::size_t const count = std::size_t(cage.faceCount());
        surfaces = std::vector<BfrSurface>(count);
        starts.assign(count + 1, 0);
        for (std::size_t face = 0; face < count; ++face) {
            if (!factory->InitVertexSurface(int(face), &surfaces[face])) {
                throw std::runtime_error("a face has no surface");
            }
            starts[face + 1] = starts[face] + 3 * std::size_t(surfaces[face].GetNumPatchPoints());
        }
        patchPoints.resize(starts[count]);
        for (std::size_t face = 0; face < count; ++face) {
            surfaces[face].PreparePatchPoints(cage.points.data(), 3, &patchPoints[starts[face]], 3);
        }
    }

    void evaluate(Sample const &at, int order, double *out) const {
        std::size_t const face = std::size_t(at.face);
        bfrEvaluate(surfaces[face], &patchPoints[starts[face]], at, order, out);
    }

private:
    int level;
    std::unique_ptr<BfrFactory> factory;
    std::vector<BfrSurface> surfaces;
    std::vector<std::size_t> starts;
    std::vector<double> patchPoints;
};
