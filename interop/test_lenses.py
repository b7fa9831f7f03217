"""Cages with vertices of valence 2 and with poles: every construction is one solid."""

from __future__ import annotations

from collections import Counter

import pytest

import ogee
from conftest import Converted, Converter
from occ import Kind

URCHIN = ogee.ROOT / "models" / "urchin.obj"
WING = ogee.ROOT / "testdata" / "lens" / "wing.obj"

METHODS = ("auto", "polar", "c2", "degree-raise", "identify", "remove", "merge")

TOLERANCE = 1e-6
"""Millimetres."""

ANGLE = 1e-6
"""Degrees."""

NEAR_A_SINGULAR_CORNER = 1e-3
"""Degrees. The two patches that close rings have no derivative at the lens, and curves in their parameters, which
OpenCASCADE fits to 1e-7 mm, err there: 4e-4 on a part of 12 mm."""


@pytest.fixture(scope="module", params=[(method, packing) for method in METHODS for packing in ("--pack", "--no-pack")],
                ids=lambda param: "".join(param))
def part(request: pytest.FixtureRequest, converted: Converter) -> Converted:
    method, packing = request.param
    return converted(WING, "--lens", method, packing)


def test_forty_lenses_and_six_poles_are_seen_to(converted: Converter) -> None:
    lenses = converted(URCHIN, "--lens", "auto", "--pack").report["lenses"]
    assert Counter(lens["method"] for lens in lenses) == {"polar": 38, "merge": 8}
    assert sum(lens["method"] == "polar" and lens["paired_with"] is not None for lens in lenses) == 32
    assert all(lens["reason"] for lens in lenses)


def test_the_text_is_clean(part: Converted) -> None:
    assert ogee.passes_check(part.part)


def test_it_is_one_valid_solid(part: Converted) -> None:
    assert part.model.is_valid
    assert part.model.solids == 1
    assert not part.model.edges.free
    assert not part.model.edges.crowded
    assert len(part.model.faces) == part.report["faces_written"]
    assert part.volume == pytest.approx(part.reported_volume, rel=1e-9)


def test_poles_are_edges_without_length(converted: Converter) -> None:
    """Two halves at each of 22 poles: what the file leaves out, OpenCASCADE adds."""
    made = converted(URCHIN, "--lens", "auto", "--pack")
    assert made.model.count(Kind.TopAbs_EDGE) == made.report["edges"] + 44


def test_faces_meet_smoothly(part: Converted) -> None:
    assert part.report["sharp_edges"] == 0
    assert part.report["max_normal_angle_deg"] <= ANGLE
    assert part.joins.gap <= TOLERANCE
    is_closed_by_rings = any(lens["method"] in ("c2", "degree-raise") for lens in part.report["lenses"])
    assert part.joins.smooth_angle <= (NEAR_A_SINGULAR_CORNER if is_closed_by_rings else ANGLE)


def test_the_urchin_is_one_smooth_solid(converted: Converter) -> None:
    made = converted(URCHIN, "--lens", "auto", "--pack")
    assert made.model.is_valid and made.model.solids == 1 and not made.model.edges.free
    assert made.joins.gap <= TOLERANCE
    assert made.joins.smooth_angle <= ANGLE
