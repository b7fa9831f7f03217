"""What the curvature does across the shared edges of a shape, measured on OpenCASCADE's own evaluation of both surfaces."""

from __future__ import annotations

import math
from dataclasses import dataclass

from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Curve2d, BRepAdaptor_Surface
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopoDS import TopoDS, TopoDS_Edge, TopoDS_Face
from OCP.gp import gp_Pnt, gp_Vec

from joins import SHARP, SINGULAR
from occ import Model, SharedEdge

SAMPLES = 4
"""Points looked at along each edge, none of them an end, closer together near the ends: there are the irregular vertices."""


@dataclass
class Curvature:
    """The figures of all smooth edges of a shape. Lengths are in millimetres."""

    jump: float
    """Largest difference of the normal curvatures of both sides, perpendicular to an edge."""
    largest: float
    """Largest normal curvature perpendicular to an edge."""
    samples: int
    """Points at which both sides have one."""

    @property
    def relative_jump(self) -> float:
        return self.jump / self.largest if self.largest > 0.0 else 0.0


class _Side:
    """A face along one of its edges."""

    def __init__(self, edge: TopoDS_Edge, face: TopoDS_Face) -> None:
        self.surface = BRepAdaptor_Surface(face, False)
        self.curve = BRepAdaptor_Curve2d(edge, face)
        self.sign = -1.0 if face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED else 1.0

    def at(self, t: float) -> _Jet | None:
        """Where the surface has a normal, its derivatives."""
        du, dv, duu, dvv, duv = (gp_Vec() for _ in range(5))
        where = self.curve.Value(t)
        self.surface.D2(where.X(), where.Y(), gp_Pnt(), du, dv, duu, dvv, duv)
        normal = du.Crossed(dv)
        if normal.Magnitude() <= SINGULAR * du.Magnitude() * dv.Magnitude():
            return None
        return _Jet(du, dv, duu, duv, dvv, normal.Normalized().Multiplied(self.sign))


@dataclass
class _Jet:
    """First and second derivatives of a surface, and its outward normal."""

    du: gp_Vec
    dv: gp_Vec
    duu: gp_Vec
    duv: gp_Vec
    dvv: gp_Vec
    normal: gp_Vec

    def curvature(self, direction: gp_Vec) -> float:
        """Normal curvature in a direction of unit length: the second fundamental form."""
        e, f, g = self.du.Dot(self.du), self.du.Dot(self.dv), self.dv.Dot(self.dv)
        x, y = direction.Dot(self.du), direction.Dot(self.dv)
        determinant = e * g - f * f
        a, b = (x * g - y * f) / determinant, (y * e - x * f) / determinant
        bend = self.normal.Dot
        return a * a * bend(self.duu) + 2 * a * b * bend(self.duv) + b * b * bend(self.dvv)


def _along(shared: SharedEdge) -> list[tuple[float, float]]:
    """Normal curvatures of both sides across an edge, at each sample; none at all where it is sharp."""
    # Both orientations of an edge pick the two curves of a seam; elsewhere they make no difference.
    edge = shared.edge
    other = TopoDS.Edge(edge.Reversed()) if shared.left.IsSame(shared.right) else edge
    left, right = _Side(edge, shared.left), _Side(other, shared.right)
    curve = BRepAdaptor_Curve(edge)
    first, last = curve.FirstParameter(), curve.LastParameter()
    found = []
    for sample in range(SAMPLES):
        t = first + (last - first) * (1 - math.cos(math.pi * (sample + 0.5) / SAMPLES)) / 2
        here, there = left.at(t), right.at(t)
        tangent = curve.DN(t, 1)
        if here is None or there is None or tangent.Magnitude() == 0.0:
            continue
        if here.normal.Angle(there.normal) >= math.radians(SHARP):
            return []
        across = here.normal.Crossed(tangent).Normalized()
        found.append((here.curvature(across), there.curvature(across)))
    return found


def curvature(model: Model) -> Curvature:
    """Measures every smooth shared edge of a model."""
    pairs = [pair for shared in model.edges.shared for pair in _along(shared)]
    jump = max((abs(a - b) for a, b in pairs), default=0.0)
    largest = max((abs(k) for pair in pairs for k in pair), default=0.0)
    return Curvature(jump, largest, len(pairs))
