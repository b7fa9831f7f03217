"""What people do with a solid after import: cut it in two, offset it inwards."""

from __future__ import annotations

from dataclasses import dataclass

from OCP.BRepAlgoAPI import BRepAlgoAPI_Common, BRepAlgoAPI_Cut
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepOffsetAPI import BRepOffsetAPI_MakeOffsetShape
from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
from OCP.TopoDS import TopoDS_Shape
from OCP.gp import gp_Pnt

from occ import adaptive_volume, bounding_box

MIDDLE = 0.5137
"""Where along the longest side to cut: near the middle, and on no plane of symmetry nor row of the cage."""

OFFSET = 0.002
"""Depth of the offset, to the diagonal."""


@dataclass
class Outcome:
    """A shape that an operation made."""

    volume: float
    is_valid: bool


def outcome(shape: TopoDS_Shape) -> Outcome:
    return Outcome(adaptive_volume(shape), BRepCheck_Analyzer(shape).IsValid())


def cut_in_two(shape: TopoDS_Shape) -> tuple[Outcome, Outcome]:
    """What is left of a plane across the longest side of a shape, and what is right of it."""
    low, high = bounding_box(shape)
    sides = [b - a for a, b in zip(low, high)]
    longest = sides.index(max(sides))
    margin = max(sides)
    start, end = [a - margin for a in low], [b + margin for b in high]
    start[longest] = low[longest] + MIDDLE * sides[longest]
    right_half = BRepPrimAPI_MakeBox(gp_Pnt(*start), gp_Pnt(*end)).Shape()
    left = BRepAlgoAPI_Cut(shape, right_half).Shape()
    right = BRepAlgoAPI_Common(shape, right_half).Shape()
    return outcome(left), outcome(right)


def offset_inwards(shape: TopoDS_Shape, depth: float) -> Outcome | None:
    """The shape with all faces moved into it, sharp edges kept sharp; `None` where OpenCASCADE fails."""
    maker = BRepOffsetAPI_MakeOffsetShape()
    maker.PerformByJoin(shape, -depth, 1e-4)
    made = maker.Shape() if maker.IsDone() else None
    return None if made is None or made.IsNull() else outcome(made)
