"""Every shipped cage, converted and read by OpenCASCADE: is it the solid that we say it is?"""

from __future__ import annotations

import pytest

import ogee
from conftest import MILLIMETRES, MODELS, UNIT_NAMES, Converted, Converter
from occ import Kind

OPEN_EDGES = {"hull": 8}
"""Edges on the boundary of the open cages; all others are closed."""

TOLERANCE = 1e-6
"""Millimetres."""

ANGLE = 1e-6
"""Degrees."""


@pytest.fixture(scope="module", params=MODELS)
def part(request: pytest.FixtureRequest, converted: Converter) -> Converted:
    return converted(request.param)


def is_open(part: Converted) -> bool:
    return part.cage.stem in OPEN_EDGES


def test_there_are_models() -> None:
    assert len(MODELS) >= 14
    assert set(OPEN_EDGES) < set(MODELS)


def test_the_text_is_clean(part: Converted) -> None:
    assert ogee.passes_check(part.part)


def sides_at_poles(part: Converted) -> int:
    """Two halves of a cap at each pole have a side that is one point: an edge that the file leaves out, and OpenCASCADE adds."""
    paired = [lens["paired_with"] is not None for lens in part.report["lenses"] if lens["method"] == "polar"]
    return 2 * paired.count(False) + paired.count(True)


def test_counts_are_those_reported(part: Converted) -> None:
    model, report = part.model, part.report
    assert model.solids == report["solids"]
    assert model.shells == report["shells"]
    assert len(model.faces) == report["faces_written"]
    assert model.count(Kind.TopAbs_EDGE) == report["edges"] + sides_at_poles(part)
    assert model.count(Kind.TopAbs_VERTEX) == report["vertices"]


def test_closed_cages_become_solids(part: Converted) -> None:
    edges = part.model.edges
    assert len(edges.free) == OPEN_EDGES.get(part.cage.stem, 0)
    assert not edges.crowded
    assert len(edges.degenerate) == sides_at_poles(part)
    assert part.report["closed"] != is_open(part)
    assert (part.model.solids == 0) if is_open(part) else (part.model.solids >= 1)


def test_the_checker_is_content(part: Converted) -> None:
    assert part.model.is_valid


def test_faces_meet(part: Converted) -> None:
    assert part.model.tolerance <= TOLERANCE
    assert part.joins.gap <= TOLERANCE


def test_smooth_edges_are_smooth(part: Converted) -> None:
    assert part.joins.smooth_angle <= ANGLE
    assert part.report["max_normal_angle_deg"] <= ANGLE


def test_sharp_edges_are_sharp(part: Converted) -> None:
    report = part.report
    assert part.joins.sharp == report["sharp_edges"]
    assert len(part.joins.all) == report["sharp_edges"] + report["smooth_edges"]


def test_the_volume_is_ours(part: Converted) -> None:
    if is_open(part):
        assert part.report["volume"] is None
    else:
        assert part.volume == pytest.approx(part.reported_volume, rel=1e-9)


def test_names_of_faces_survive(part: Converted) -> None:
    names = part.model.face_names
    assert all(name.startswith("f") and name[1:].replace(".", "", 1).isdigit() for name in names)
    assert len(set(names)) == len(names)
    assert all(int(name[1:].split(".")[0]) < part.report["cage_faces"] for name in names)


def test_the_unit_is_the_millimetre(part: Converted) -> None:
    assert part.report["unit"] == "mm"
    assert part.model.units == [UNIT_NAMES["mm"]]


@pytest.mark.parametrize("unit", ["cm", "m", "in"])
def test_the_unit_is_the_one_asked_for(converted: Converter, unit: str) -> None:
    millimetres, other = converted("mug"), converted("mug", "--unit", unit)
    assert other.report["unit"] == unit
    assert other.model.units == [UNIT_NAMES[unit]]
    assert other.report["volume"] == pytest.approx(millimetres.report["volume"], rel=1e-12)
    assert other.volume == pytest.approx(millimetres.volume * MILLIMETRES[unit] ** 3, rel=1e-9)


@pytest.mark.parametrize("protocol", ["214", "242"])
def test_both_protocols_load(converted: Converter, protocol: str) -> None:
    part = converted("bracket", "--ap", protocol)
    assert {"214": "AUTOMOTIVE_DESIGN", "242": "AP242_MANAGED"}[protocol] in part.part.read_text()[:1000]
    assert part.model.solids == 1
    assert not part.model.edges.free
    assert part.model.is_valid
    assert part.volume == pytest.approx(part.reported_volume, rel=1e-9)


def test_one_face_per_quad_makes_the_same_solid(converted: Converter) -> None:
    packed, loose = converted("mug"), converted("mug", "--no-pack")
    assert len(loose.model.faces) == loose.report["faces_written"] == loose.report["patches"]
    assert len(loose.model.faces) > len(packed.model.faces)
    assert loose.joins.smooth_angle <= ANGLE
    assert loose.volume == pytest.approx(packed.volume, rel=1e-9)
