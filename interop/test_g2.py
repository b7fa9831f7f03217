"""`convert --method g2`: OpenCASCADE finds solids whose curvature has no jumps, and can work with them."""

from __future__ import annotations

from pathlib import Path

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.TopoDS import TopoDS_Face

import ogee
from conftest import MODELS, SPOT, Converted, Converter
from curvature import curvature
from downstream import cut_in_two, offset_inwards

CAGES: list[Path] = [*(ogee.ROOT / "models" / f"{name}.obj" for name in MODELS), ogee.ROOT / "models" / "yacht.json", SPOT]

G2 = ("--method", "g2")

TOLERANCE = 1e-6
"""Millimetres."""

ANGLE = 1e-6
"""Degrees."""

JUMP = 1e-8
"""Difference of normal curvatures, to the largest one."""

OFFSET = 0.005
"""Depth of the offset, to the diagonal."""

SPOT_ANGLE, SPOT_JUMP = 5e-11, 5e-9
"""What is promised of Spot: degrees, and the difference of normal curvatures times the diagonal."""

CAP_KNOTS = ([0.0, 0.5, 1.0], [8, 5, 8])
"""In both directions, each with how often it stands there."""


def cage(name: Path) -> Path:
    if not name.is_file():
        pytest.skip(f"no {name.stem}")
    return name


@pytest.fixture(scope="module", params=CAGES, ids=lambda path: path.stem)
def part(request: pytest.FixtureRequest, converted: Converter) -> Converted:
    return converted(cage(request.param), *G2)


@pytest.fixture(scope="module")
def spot_of_caps(converted: Converter) -> Converted:
    return converted(cage(SPOT), *G2)


def has_only_caps(part: Converted) -> bool:
    """Whether no irregular vertex had to be left to PCCM."""
    has_none_left = all(note["code"] != "no_cap" for note in part.report["notes"])
    return has_none_left and part.report["caps"] == len(part.report["nodes"])


def degree(face: TopoDS_Face) -> tuple[int, int]:
    surface = BRepAdaptor_Surface(face, False)
    return surface.UDegree(), surface.VDegree()


def test_it_is_the_solid_that_pccm_makes(part: Converted, converted: Converter) -> None:
    model, smooth = part.model, converted(part.cage)
    assert ogee.passes_check(part.part)
    assert model.is_valid
    assert (model.solids, model.shells) == (part.report["solids"], part.report["shells"])
    assert (model.solids, model.shells) == (smooth.model.solids, smooth.model.shells)
    assert not model.edges.crowded
    assert bool(model.edges.free) != part.report["closed"]
    assert part.report["closed"] == smooth.report["closed"]
    assert len(model.faces) == part.report["faces_written"]


def test_faces_meet_smoothly(part: Converted) -> None:
    assert part.model.tolerance <= TOLERANCE
    assert part.joins.gap <= TOLERANCE
    assert part.joins.smooth_angle <= ANGLE
    assert part.joins.sharp == part.report["sharp_edges"]


def test_curvature_does_not_jump(part: Converted) -> None:
    measured = curvature(part.model)
    assert (measured.samples > 0) == (part.report["smooth_edges"] > 0)
    if has_only_caps(part):
        assert measured.relative_jump <= JUMP


def test_caps_are_of_degree_seven(part: Converted) -> None:
    sectors = sum(node["faces"] for node in part.report["nodes"] if node["kind"] != "pccm")
    caps = [face for face in part.model.faces if degree(face) == (7, 7)]
    assert len(caps) == sectors
    for face in caps:
        surface = BRepAdaptor_Surface(face, False).BSpline()
        for knots, times in ((surface.UKnots(), surface.UMultiplicities()), (surface.VKnots(), surface.VMultiplicities())):
            assert (list(knots), list(times)) == CAP_KNOTS


def test_caps_meet_bicubics_in_cubics(part: Converted) -> None:
    for shared in part.model.edges.shared:
        if {degree(shared.left), degree(shared.right)} == {(7, 7), (3, 3)}:
            assert BRepAdaptor_Curve(shared.edge).Degree() <= 3


def test_curvature_of_pccm_jumps(part: Converted, converted: Converter) -> None:
    if part.report["caps"] > 0:
        assert curvature(converted(part.cage).model).relative_jump > 1e-3


def test_spot_is_as_smooth_as_the_construction_says(spot_of_caps: Converted) -> None:
    model, measured = spot_of_caps.model, curvature(spot_of_caps.model)
    assert has_only_caps(spot_of_caps)
    assert model.solids == 1 and not model.edges.free
    assert spot_of_caps.volume == pytest.approx(spot_of_caps.reported_volume, rel=1e-9)
    assert spot_of_caps.joins.sharp == 0
    assert spot_of_caps.joins.smooth_angle <= SPOT_ANGLE
    assert measured.jump * model.size <= SPOT_JUMP


def test_spot_can_be_cut(spot_of_caps: Converted) -> None:
    left, right = cut_in_two(spot_of_caps.model.shape)
    assert left.is_valid and right.is_valid
    assert left.volume + right.volume == pytest.approx(spot_of_caps.volume, rel=1e-6)


def test_spot_can_be_offset(spot_of_caps: Converted) -> None:
    depth = OFFSET * spot_of_caps.model.size
    offset = offset_inwards(spot_of_caps.model.shape, depth)
    assert offset is not None and offset.is_valid
    assert offset.volume == pytest.approx(spot_of_caps.volume - depth * spot_of_caps.report["area"], rel=0.02)


@pytest.mark.parametrize("name", ["hand", "mug", "vase"])
def test_one_face_per_quad_makes_the_same_solid(converted: Converter, name: str) -> None:
    packed, loose = converted(name, *G2), converted(name, *G2, "--no-pack")
    assert len(loose.model.faces) == loose.report["patches"] > len(packed.model.faces)
    assert loose.model.is_valid
    assert curvature(loose.model).relative_jump <= JUMP
    assert packed.volume == pytest.approx(packed.reported_volume, rel=1e-9)
    assert loose.volume == pytest.approx(packed.volume, rel=1e-9)
