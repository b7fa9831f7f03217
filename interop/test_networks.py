"""Networks of curves: the edges of the part carry them, as another program reads both files."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from OCP.BRep import BRep_Builder
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.TopoDS import TopoDS, TopoDS_Compound

import joins
import occ
import ogee
from occ import Kind

SAMPLES = 40
"""Points of each curve."""

TOLERANCE = 1e-6
"""Millimetres; the hull is 8.5 m long."""


@dataclass
class Laid:
    """A network that was laid: the part, its curves by themselves, and the report."""

    part: Path
    model: occ.Model
    curves: occ.Model
    report: dict[str, Any]


@pytest.fixture(scope="module", params=[(), ("--no-pack",)], ids=["packed", "unpacked"])
def yacht(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Laid:
    folder = tmp_path_factory.mktemp("networks")
    part, curves = folder / "yacht.step", folder / "lines.step"
    report = ogee.network(ogee.ROOT / "models" / "yacht.json", part, "--save-curves", str(curves), *request.param)
    return Laid(part, occ.Model(part), occ.Model(curves), report)


def test_the_sheet_is_sound(yacht: Laid) -> None:
    assert ogee.passes_check(yacht.part)
    assert yacht.model.is_valid
    assert len(yacht.model.faces) == yacht.report["part"]["faces_written"]
    assert not yacht.model.edges.crowded
    found = joins.joins(yacht.model)
    assert found.gap <= TOLERANCE
    assert found.smooth_angle <= 1e-6


def test_edges_carry_the_curves(yacht: Laid) -> None:
    """Curves that meet inside the surface are cut there: 11 become 13."""
    curves = [TopoDS.Edge(edge) for edge in yacht.curves.parts(Kind.TopAbs_EDGE)]
    assert len(curves) == 13
    compound, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(compound)
    for edge in yacht.model.parts(Kind.TopAbs_EDGE):
        builder.Add(compound, edge)
    worst = 0.0
    for curve in curves:
        line = BRepAdaptor_Curve(curve)
        first, last = line.FirstParameter(), line.LastParameter()
        for k in range(SAMPLES + 1):
            point = line.Value(first + (last - first) * k / SAMPLES)
            vertex = BRepBuilderAPI_MakeVertex(point).Vertex()
            worst = max(worst, BRepExtrema_DistShapeShape(vertex, compound).Value())
    assert worst <= TOLERANCE
    assert yacht.report["max_edge_error"] <= 1e-10


def test_the_cage_says_what_it_holds(tmp_path: Path) -> None:
    """The cage that `ogee network` writes converts to the same part, with the curves on edges."""
    cage = tmp_path / "yacht.json"
    ogee.network(ogee.ROOT / "models" / "yacht.json", cage)
    held = json.loads(cage.read_text())
    assert len(held["meetings"]) == 6 and len(held["curves"]) == 13
    report = ogee.convert(cage, tmp_path / "yacht.step")
    direct = ogee.network(ogee.ROOT / "models" / "yacht.json", tmp_path / "direct.step")
    assert report["faces_written"] == direct["part"]["faces_written"]
