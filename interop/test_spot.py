"""Spot: a cage drawn by hand, whose extraordinary vertices touch."""

from __future__ import annotations

import pytest

import ogee
from conftest import Converted
from downstream import OFFSET, cut_in_two, offset_inwards


def test_spot_is_one_smooth_solid(spot: Converted) -> None:
    model = spot.model
    assert ogee.passes_check(spot.part)
    assert model.solids == spot.report["solids"] == 1
    assert not model.edges.free
    assert model.is_valid
    assert model.tolerance <= 1e-7
    assert spot.joins.gap <= 1e-12 * model.size
    assert spot.joins.sharp == 0
    assert spot.joins.smooth_angle <= 1e-6
    assert spot.volume == pytest.approx(spot.reported_volume, rel=1e-9)


def test_spot_can_be_cut(spot: Converted) -> None:
    left, right = cut_in_two(spot.model.shape)
    assert left.is_valid and right.is_valid
    assert left.volume + right.volume == pytest.approx(spot.volume, rel=1e-7)


def test_spot_can_be_offset(spot: Converted) -> None:
    offset = offset_inwards(spot.model.shape, OFFSET * spot.model.size)
    assert offset is not None and offset.is_valid
    shrunk = spot.volume - OFFSET * spot.model.size * spot.report["area"]
    assert offset.volume == pytest.approx(shrunk, rel=0.01)
