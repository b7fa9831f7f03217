// A cage as OpenSubdiv's refiner, with adjacency: what refinement and both ways of evaluation start from.

#pragma once

#include "cage.h"

#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefiner.h>

#include <memory>

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

inline std::unique_ptr<Far::TopologyRefiner> connect(Cage const &cage) {
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = cage.vertexCount();
    descriptor.numFaces = cage.faceCount();
    descriptor.numVertsPerFace = cage.faceSizes.data();
    descriptor.vertIndicesPerFace = cage.corners.data();
    descriptor.numCreases = static_cast<int>(cage.creaseSharpness.size());
    descriptor.creaseVertexIndexPairs = cage.creaseVertices.data();
    descriptor.creaseWeights = cage.creaseSharpness.data();
    descriptor.numCorners = static_cast<int>(cage.vertexSharpness.size());
    descriptor.cornerVertexIndices = cage.sharpVertices.data();
    descriptor.cornerWeights = cage.vertexSharpness.data();

    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(cage.sharpCorners ? Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER
                                                          : Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    typedef Far::TopologyRefinerFactory<Far::TopologyDescriptor> Factory;
    std::unique_ptr<Far::TopologyRefiner> refiner(
        Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_CATMARK, options)));
    if (!refiner) throw std::runtime_error("the cage was refused");
    return refiner;
}
