"""Cages in which curves meet: patches of two degrees in one part."""

from __future__ import annotations

import pytest

import ogee
from conftest import Converted, Converter
from occ import Kind

CAGES = sorted((ogee.ROOT / "testdata" / "meetings").glob("*.json"))

TOLERANCE = 1e-6
"""Millimetres."""

ANGLE = 1e-6
"""Degrees."""


@pytest.fixture(scope="module", params=[(cage, options) for cage in CAGES for options in ((), ("--no-pack",))],
                ids=lambda param: "-".join((param[0].stem, *param[1])))
def part(request: pytest.FixtureRequest, converted: Converter) -> Converted:
    cage, options = request.param
    return converted(cage, *options)


def test_there_are_cages() -> None:
    assert [cage.stem for cage in CAGES] == ["closed", "open"]


def test_the_text_is_clean(part: Converted) -> None:
    assert ogee.passes_check(part.part)


def test_the_checker_is_content(part: Converted) -> None:
    assert part.model.is_valid
    assert len(part.model.faces) == part.report["faces_written"]
    assert part.model.count(Kind.TopAbs_EDGE) == part.report["edges"]
    assert not part.model.edges.crowded


def test_closed_cages_become_solids(part: Converted) -> None:
    closed = part.cage.stem == "closed"
    assert part.report["closed"] == closed
    assert part.model.solids == int(closed)
    assert (not part.model.edges.free) == closed
    if closed:
        assert part.volume == pytest.approx(part.reported_volume, rel=1e-9)


def test_faces_meet_smoothly(part: Converted) -> None:
    assert part.report["sharp_edges"] == 0
    assert part.joins.gap <= TOLERANCE
    assert part.joins.smooth_angle <= ANGLE
