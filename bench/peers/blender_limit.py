"""Limit positions and normals by Blender's subdivision modifier, for comparison. One line of JSON per run.

usage: blender_limit.py version
       blender_limit.py faces    PEER LEVEL CAGE ORDER SIDE
       blender_limit.py vertices PEER LEVEL CAGE ORDER SIDE OUTPUT

Blender has no evaluation at a parameter: the modifier tessellates, here into SIDE x SIDE quads a face, and puts the
vertices on the limit surface. LEVEL is its quality, -1 for the default. OUTPUT takes positions and normals of the
vertices, six 64-bit numbers each. PEER and ORDER are there because other programs have them.
"""

import json
import os
import sys
import time

# One core, as for everybody: its threads ask how many there are when they start.
if os.environ.get("RAYON_NUM_THREADS") == "1":
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})

import bpy
import numpy


def read_cage(path):
    """Points, and the corners of each face."""
    with open(path, "rb") as file:
        header = numpy.fromfile(file, "<u4", 6)
        if header[3] or header[4]:
            sys.exit("sharp edges and vertices are not handed on")
        points = numpy.fromfile(file, "<f8", 3 * header[0]).reshape(-1, 3)
        sizes = numpy.fromfile(file, "<i4", header[1])
        corners = numpy.fromfile(file, "<i4", header[2])
    return points, numpy.split(corners, numpy.cumsum(sizes)[:-1])


def make_object(points, faces, quality, side):
    """The cage as an object of the scene, with the modifier."""
    mesh = bpy.data.meshes.new("cage")
    mesh.from_pydata(points.tolist(), [], [face.tolist() for face in faces])
    cage = bpy.data.objects.new("cage", mesh)
    bpy.context.scene.collection.objects.link(cage)
    modifier = cage.modifiers.new("subdivision", "SUBSURF")
    modifier.levels = side.bit_length() - 1
    modifier.use_limit_surface = True
    modifier.boundary_smooth = "PRESERVE_CORNERS"
    if quality >= 0:
        modifier.quality = quality
    return cage


def evaluate(cage):
    """Tessellates once more, with normals; seconds and the mesh."""
    cage.data.update_tag()
    start = time.perf_counter()
    graph = bpy.context.evaluated_depsgraph_get()
    graph.update()
    mesh = cage.evaluated_get(graph).data
    # Normals are computed when they are first asked for.
    len(mesh.vertex_normals) and mesh.vertex_normals[0]
    return time.perf_counter() - start, mesh


def vectors(collection, name):
    """A property of all members, as rows of three."""
    values = numpy.empty(3 * len(collection), "f4")
    collection.foreach_get(name, values)
    return values.reshape(-1, 3).astype("f8")


def main(arguments):
    if arguments == ["version"]:
        print(bpy.app.version_string)
        return
    task, _, level, path, _, side = arguments[:6]
    points, faces = read_cage(path)
    cage = make_object(points, faces, int(level), int(side))
    first, _ = evaluate(cage)
    # Connectivity is kept from the first time, as it is when a cage is animated.
    seconds, mesh = evaluate(cage)
    if task == "vertices":
        rows = [vectors(mesh.vertices, "co"), vectors(mesh.vertex_normals, "vector")]
        numpy.hstack(rows).astype("<f8").tofile(arguments[6])
    count = len(mesh.vertices)
    print(json.dumps({"points": count, "seconds": seconds, "prepare_seconds": first, "checksum": ""}))


main(sys.argv[1:])
