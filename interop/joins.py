"""What happens across the shared edges of a shape: gaps, and the angle between the normals of both sides."""

from __future__ import annotations

import math
from dataclasses import dataclass

from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Curve2d, BRepAdaptor_Surface
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopoDS import TopoDS, TopoDS_Edge, TopoDS_Face
from OCP.gp import gp_Pnt, gp_Vec

from occ import Model, SharedEdge

SAMPLES = 17
"""Points looked at along each edge, none of them an end."""

SHARP = 1.0
"""Degrees. Between a smooth edge and one that is meant to be sharp lies a wide empty range."""

SINGULAR = 1e-9
"""Sine of the angle between both tangents of a surface below which it has no usable normal."""


@dataclass
class Join:
    """The figures of one shared edge."""

    gap: float
    """Largest distance between the curve and either surface, and between the surfaces."""
    angle: float
    """Largest angle between the outward normals of both sides, in degrees."""

    @property
    def is_sharp(self) -> bool:
        return self.angle >= SHARP


@dataclass
class Joins:
    """The figures of all shared edges."""

    all: list[Join]

    @property
    def gap(self) -> float:
        return max((join.gap for join in self.all), default=0.0)

    @property
    def smooth_angle(self) -> float:
        return max((join.angle for join in self.all if not join.is_sharp), default=0.0)

    @property
    def sharp(self) -> int:
        return sum(join.is_sharp for join in self.all)


class _Side:
    """A face along one of its edges."""

    def __init__(self, edge: TopoDS_Edge, face: TopoDS_Face) -> None:
        self.surface = BRepAdaptor_Surface(face, False)
        self.curve = BRepAdaptor_Curve2d(edge, face)
        self.sign = -1.0 if face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED else 1.0

    def at(self, t: float) -> tuple[gp_Pnt, gp_Vec | None]:
        """Position and outward normal; no normal where the surface has none."""
        position, du, dv = gp_Pnt(), gp_Vec(), gp_Vec()
        where = self.curve.Value(t)
        self.surface.D1(where.X(), where.Y(), position, du, dv)
        normal = du.Crossed(dv)
        if normal.Magnitude() <= SINGULAR * du.Magnitude() * dv.Magnitude():
            return position, None
        return position, normal.Multiplied(self.sign)


def _join(shared: SharedEdge) -> Join:
    # Both orientations of an edge pick the two curves of a seam; elsewhere they make no difference.
    edge = shared.edge
    other = TopoDS.Edge(edge.Reversed()) if shared.left.IsSame(shared.right) else edge
    left, right = _Side(edge, shared.left), _Side(other, shared.right)
    curve = BRepAdaptor_Curve(edge)
    first, last = curve.FirstParameter(), curve.LastParameter()
    found = Join(0.0, 0.0)
    for sample in range(SAMPLES):
        t = first + (last - first) * (sample + 0.5) / SAMPLES
        on_edge = curve.Value(t)
        (here, n), (there, m) = left.at(t), right.at(t)
        found.gap = max(found.gap, here.Distance(there), here.Distance(on_edge), there.Distance(on_edge))
        if n is not None and m is not None:
            angle = math.degrees(math.atan2(n.Crossed(m).Magnitude(), n.Dot(m)))
            found.angle = max(found.angle, angle)
    return found


def joins(model: Model) -> Joins:
    """Measures every shared edge of a model."""
    return Joins([_join(shared) for shared in model.edges.shared])


def shortest_edge(model: Model) -> float:
    """Length of the chords between samples of the shortest edge."""
    lengths = []
    for shared in model.edges.shared:
        curve = BRepAdaptor_Curve(shared.edge)
        first, last = curve.FirstParameter(), curve.LastParameter()
        points = [curve.Value(first + (last - first) * k / SAMPLES) for k in range(SAMPLES + 1)]
        lengths.append(sum(a.Distance(b) for a, b in zip(points, points[1:])))
    return min(lengths, default=math.inf)
