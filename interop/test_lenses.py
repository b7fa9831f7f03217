"""Cages with vertices of valence 2 and with poles: every construction is one solid."""

from __future__ import annotations

from collections import Counter

import pytest

import ogee
from conftest import Converted, Converter
from occ import Kind

URCHIN = ogee.ROOT / "models" / "urchin.obj"

METHODS = ("auto", "c2", "degree-raise", "identify", "remove", "merge")

TOLERANCE = 1e-6
"""Millimetres."""

ANGLE = 1e-6
"""Degrees."""


@pytest.fixture(scope="module", params=[(method, packing) for method in METHODS for packing in ("--pack", "--no-pack")],
                ids=lambda param: "".join(param))
def part(request: pytest.FixtureRequest, converted: Converter) -> Converted:
    method, packing = request.param
    return converted(URCHIN, "--lens", method, packing)


def test_forty_lenses_and_six_poles_are_seen_to(converted: Converter) -> None:
    lenses = converted(URCHIN, "--lens", "auto", "--pack").report["lenses"]
    assert Counter((lens["method"], lens["paired_with"] is None) for lens in lenses) == {
        ("polar", False): 32,
        ("polar", True): 6,
        ("merge", True): 8,
    }
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
    assert part.joins.gap <= TOLERANCE
    assert part.joins.smooth_angle <= ANGLE
