"""What people do with a part after import."""

from __future__ import annotations

import pytest

from conftest import Converter
from downstream import OFFSET, cut_in_two, offset_inwards


@pytest.mark.parametrize("name", ["box", "bracket", "hand", "knot", "mug"])
def test_a_cut_through_the_middle(converted: Converter, name: str) -> None:
    part = converted(name)
    left, right = cut_in_two(part.model.shape)
    assert left.is_valid and right.is_valid
    assert 0.2 < left.volume / part.volume < 0.8
    assert left.volume + right.volume == pytest.approx(part.volume, rel=1e-7)


FAILS = pytest.mark.xfail(strict=True, reason="the offset of OpenCASCADE comes back empty")


@pytest.mark.parametrize("name", ["box", pytest.param("bracket", marks=FAILS), "hand", "knot", "mug"])
def test_an_offset_inwards(converted: Converter, name: str) -> None:
    part = converted(name)
    depth = OFFSET * part.model.size
    offset = offset_inwards(part.model.shape, depth)
    assert offset is not None and offset.is_valid
    # The first two terms of the volume of a parallel body.
    assert offset.volume == pytest.approx(part.volume - depth * part.report["area"], rel=0.01)
