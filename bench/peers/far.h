// Evaluation with OpenSubdiv's Far: adaptive refinement, a patch table, a map to search it, Gregory end caps.

#pragma once

#include "refiner.h"

#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/ptexIndices.h>

class FarTable {
public:
    // A negative level leaves the default of the library's options for tables, 10.
    explicit FarTable(int level) : level(level) {}

    void prepare(Cage const &cage, Far::TopologyRefiner &refiner) {
        Far::PatchTableFactory::Options options;
        if (level >= 0) options.SetMaxIsolationLevel(unsigned(level));
        options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
        options.SetPatchPrecision<double>();
        options.generateVaryingTables = false;
        // Without these, infinitely sharp creases are approximated and corners that should be smooth are sharp.
        options.useInfSharpPatch = true;
        options.generateLegacySharpCornerPatches = false;
        // A second preparation starts afresh.
        refiner.Unrefine();
        refiner.RefineAdaptive(options.GetRefineAdaptiveOptions());
        table.reset(Far::PatchTableFactory::Create(refiner, options));
        map.reset(new Far::PatchMap(*table));
        firstPtex.resize(std::size_t(cage.faceCount()));
        Far::PtexIndices const ptex(refiner);
        for (int face = 0; face < cage.faceCount(); ++face) firstPtex[std::size_t(face)] = ptex.GetFaceId(face);
        refinePoints(cage, refiner);
    }

    void evaluate(Sample const &at, int order, double *out) const {
        int const face = firstPtex[std::size_t(at.face)] + (at.corner < 0 ? 0 : at.corner);
        Far::PatchTable::PatchHandle const *patch = map->FindPatch(face, at.u, at.v);
        if (!patch) throw std::runtime_error("a place has no patch");
        double weights[6][20];
        if (order == 1) {
            table->EvaluateBasis(*patch, at.u, at.v, weights[0], weights[1], weights[2]);
            combine<3>(weights, table->GetPatchVertices(*patch), out);
        } else {
            table->EvaluateBasis(*patch, at.u, at.v, weights[0], weights[1], weights[2], weights[3], weights[4],
                                 weights[5]);
            combine<6>(weights, table->GetPatchVertices(*patch), out);
        }
    }

private:
    struct Point {
        double xyz[3];

        void Clear() { xyz[0] = xyz[1] = xyz[2] = 0; }
        void AddWithWeight(Point const &other, double weight) {
            for (int i = 0; i < 3; ++i) xyz[i] += weight * other.xyz[i];
        }
    };

    // Points of all levels, then those that only the end caps have.
    void refinePoints(Cage const &cage, Far::TopologyRefiner const &refiner) {
        std::size_t const refined = std::size_t(refiner.GetNumVerticesTotal());
        points.resize(refined + std::size_t(table->GetNumLocalPoints()));
        for (std::size_t i = 0; i < cage.points.size(); ++i) points[i / 3].xyz[i % 3] = cage.points[i];
        Far::PrimvarRefinerReal<double> const primvars(refiner);
        Point *from = points.data();
        for (int i = 1; i < refiner.GetNumLevels(); ++i) {
            Point *to = from + refiner.GetLevel(i - 1).GetNumVertices();
            primvars.Interpolate(i, from, to);
            from = to;
        }
        if (table->GetNumLocalPoints() > 0) {
            table->GetLocalPointStencilTable<double>()->UpdateValues(points.data(), &points[refined]);
        }
    }

    template <int COUNT>
    void combine(double const (*weights)[20], Far::ConstIndexArray vertices, double *out) const {
        double sums[COUNT][3] = {};
        for (int i = 0; i < vertices.size(); ++i) {
            double const *point = points[std::size_t(vertices[i])].xyz;
            for (int k = 0; k < COUNT; ++k) {
                for (int axis = 0; axis < 3; ++axis) sums[k][axis] += weights[k][i] * point[axis];
            }
        }
        for (int k = 0; k < COUNT; ++k) {
            for (int axis = 0; axis < 3; ++axis) out[3 * k + axis] = sums[k][axis];
        }
    }

    int level;
    std::unique_ptr<Far::PatchTable> table;
    std::unique_ptr<Far::PatchMap> map;
    std::vector<int> firstPtex;
    std::vector<Point> points;
};
