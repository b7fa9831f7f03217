"""Files that are damaged on purpose: a measurement that cannot fail measures nothing."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import joins
import occ
import ogee
from conftest import Converter
from part21 import Part21
from test_models import ANGLE, TOLERANCE

Damage = Callable[[Callable[[Part21], None]], Path]


@pytest.fixture
def damaged(converted: Converter, tmp_path: Path) -> Damage:
    """The mug, written again after some damage."""

    def damage(how: Callable[[Part21], None]) -> Path:
        text = Part21(converted("mug").part)
        how(text)
        return text.write(tmp_path / "damaged.step")

    return damage


def test_no_damage_is_no_damage(converted: Converter, damaged: Damage) -> None:
    assert damaged(lambda text: None).read_bytes() == converted("mug").part.read_bytes()


def test_a_moved_boundary_is_noticed(damaged: Damage) -> None:
    path = damaged(lambda text: text.move_a_boundary_pole(0.017))
    model = occ.Model(path)
    assert model.tolerance > 1000 * TOLERANCE
    assert joins.joins(model).gap > 1000 * TOLERANCE
    assert not ogee.passes_check(path)


def test_a_tilt_is_noticed(converted: Converter, damaged: Damage) -> None:
    # The text is in order, nothing gapes: only the angle and the volume can tell.
    path = damaged(lambda text: text.move_an_inner_pole(1e-3))
    model, whole = occ.Model(path), converted("mug")
    found = joins.joins(model)
    assert ogee.passes_check(path)
    assert found.gap <= TOLERANCE
    assert ANGLE < found.smooth_angle < joins.SHARP
    assert abs(occ.exact_volume(model.shape) / whole.volume - 1) > 1e-9


def test_a_missing_face_is_noticed(converted: Converter, damaged: Damage) -> None:
    path = damaged(Part21.drop_a_face)
    model, whole = occ.Model(path), converted("mug").model
    assert len(model.faces) == len(whole.faces) - 1
    assert model.edges.free
    assert not ogee.passes_check(path)
