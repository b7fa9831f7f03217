"""Refinement of cages by Blender's subdivision modifier, for comparison. One line of JSON per run.

usage: blender_refine.py version
       blender_refine.py refine  PEER LEVEL CAGE
       blender_refine.py animate PEER LEVEL CAGE FRAMES

Vertices are those of the refined mesh, not of the limit surface. PEER is there because other programs have one.
Sharpness is the square of what Blender calls a crease, times ten.
"""

import json
import os
import statistics
import sys
import time

# One core, as for everybody: its threads ask how many there are when they start.
if os.environ.get("RAYON_NUM_THREADS") == "1":
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})

import bpy
import numpy


def status_bytes(key):
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) * 1024 for line in status if line.startswith(key))


class Peak:
    """Peak of resident memory over what is resident now."""

    def __init__(self):
        try:
            with open("/proc/self/clear_refs", "w") as file:
                file.write("5")
        except OSError:
            pass
        self.before = status_bytes("VmRSS:")

    def growth(self):
        return status_bytes("VmHWM:") - self.before


def read_cage(path):
    """Points, sizes and corners of faces, ends and sharpness of creases, sharp vertices and their sharpness."""
    with open(path, "rb") as file:
        vertices, faces, corners, creases, sharp, _ = (int(n) for n in numpy.fromfile(file, "<u4", 6))
        return (
            numpy.fromfile(file, "<f8", 3 * vertices).reshape(-1, 3),
            numpy.fromfile(file, "<i4", faces),
            numpy.fromfile(file, "<i4", corners),
            numpy.fromfile(file, "<u4", 2 * creases).reshape(-1, 2),
            numpy.fromfile(file, "<f4", creases),
            numpy.fromfile(file, "<u4", sharp),
            numpy.fromfile(file, "<f4", sharp),
        )


def make_object(cage, level):
    """The cage as an object of the scene, with the modifier."""
    points, sizes, corners, creases, crease_sharpness, sharp, vertex_sharpness = cage
    mesh = bpy.data.meshes.new("cage")
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.astype("f4").ravel())
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(len(sizes))
    mesh.polygons.foreach_set("loop_start", numpy.cumsum(sizes) - sizes)
    mesh.update(calc_edges=True)
    if len(creases):
        edges = numpy.empty(2 * len(mesh.edges), "i4")
        mesh.edges.foreach_get("vertices", edges)
        numbers = {tuple(sorted(edge)): k for k, edge in enumerate(edges.reshape(-1, 2).tolist())}
        values = numpy.zeros(len(mesh.edges), "f4")
        for ends, sharpness in zip(creases.tolist(), crease_sharpness):
            values[numbers[tuple(sorted(ends))]] = (sharpness / 10) ** 0.5
        mesh.attributes.new("crease_edge", "FLOAT", "EDGE").data.foreach_set("value", values)
    if len(sharp):
        values = numpy.zeros(len(points), "f4")
        values[sharp] = (vertex_sharpness / 10) ** 0.5
        mesh.attributes.new("crease_vert", "FLOAT", "POINT").data.foreach_set("value", values)
    cage = bpy.data.objects.new("cage", mesh)
    bpy.context.scene.collection.objects.link(cage)
    modifier = cage.modifiers.new("subdivision", "SUBSURF")
    modifier.levels = level
    modifier.use_limit_surface = False
    modifier.boundary_smooth = "PRESERVE_CORNERS"
    modifier.use_creases = True
    return cage


def evaluate(cage):
    """Refines; seconds and the mesh."""
    cage.data.update_tag()
    start = time.perf_counter()
    graph = bpy.context.evaluated_depsgraph_get()
    graph.update()
    mesh = cage.evaluated_get(graph).data
    # The mesh is made when it is first looked at.
    mesh.vertices[0].co
    return time.perf_counter() - start, mesh


def figures(mesh):
    """As `figures` of `measure.h`."""
    points = numpy.empty(3 * len(mesh.vertices), "f4")
    mesh.vertices.foreach_get("co", points)
    points = points.reshape(-1, 3).astype("f8")
    corners = numpy.empty(len(mesh.loops), "i4")
    mesh.loops.foreach_get("vertex_index", corners)
    a, b, c, d = (points[corners[k::4]] for k in range(4))
    normals = numpy.cross(c - a, d - b)
    area = numpy.linalg.norm(normals, axis=1).sum() / 2
    volume = (normals * (a + b + c + d)).sum() / 24
    x, y, z = points.T
    means = [term.mean() for term in (x, y, z, x * x, y * y, z * z, x * y, y * z, z * x)]
    return [float(figure) for figure in [*means, area, volume]]


def answer(mesh, **rest):
    counts = {"vertices": len(mesh.vertices), "faces": len(mesh.polygons)}
    print(json.dumps({**counts, "figures": figures(mesh), **rest}))


def animate(cage, points, frames):
    """The median time of so many poses, after one that brings memory."""
    times = []
    for frame in range(frames + 1):
        posed = points.copy()
        posed[:, 0] += frame / 16 * points[:, 1]
        cage.data.vertices.foreach_set("co", posed.astype("f4").ravel())
        seconds, mesh = evaluate(cage)
        times.append(seconds)
    return statistics.median(times[1:]), mesh


def main(arguments):
    if arguments == ["version"]:
        print(bpy.app.version_string)
        return
    task, _, level, path = arguments[:4]
    cage = read_cage(path)
    thing = make_object(cage, int(level))
    peak = Peak()
    first, mesh = evaluate(thing)
    growth = peak.growth()
    if task == "refine":
        # Connectivity is kept from now on, so a second time would be another task.
        answer(mesh, fresh_seconds=first, peak_bytes=growth)
    else:
        seconds, mesh = animate(thing, cage[0], int(arguments[4]))
        answer(mesh, set_up_seconds=first, set_up_bytes=growth, frame_seconds=seconds)


main(sys.argv[1:])
