"""Converted parts, each made, read and measured once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import pytest

import joins
import occ
import ogee

MODELS = sorted(path.stem for path in (ogee.ROOT / "models").glob("*.obj"))
SPOT = ogee.ROOT.parent / "shared" / "models" / "spot" / "spot_control_mesh.obj"

MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}
UNIT_NAMES = {"mm": "millimetre", "cm": "centimetre", "m": "metre", "in": "INCH"}


@dataclass
class Converted:
    """A converted cage: what we say of it, and what OpenCASCADE makes of it."""

    cage: Path
    part: Path
    report: dict[str, Any]

    @cached_property
    def model(self) -> occ.Model:
        return occ.Model(self.part)

    @cached_property
    def joins(self) -> joins.Joins:
        return joins.joins(self.model)

    @cached_property
    def volume(self) -> float:
        """By OpenCASCADE, in cubic millimetres."""
        return occ.exact_volume(self.model.shape)

    @property
    def reported_volume(self) -> float:
        """By us, in cubic millimetres."""
        return self.report["volume"] * MILLIMETRES[self.report["unit"]] ** 3


Converter = Callable[..., Converted]


@pytest.fixture(scope="session")
def converted(tmp_path_factory: pytest.TempPathFactory) -> Converter:
    """Converts a cage with given options, once for the whole run."""
    folder = tmp_path_factory.mktemp("parts")
    known: dict[tuple[str, ...], Converted] = {}

    def convert(cage: str | Path, *options: str) -> Converted:
        path = cage if isinstance(cage, Path) else ogee.ROOT / "models" / f"{cage}.obj"
        key = (path.stem, *options)
        if key not in known:
            part = folder / ("_".join(key).replace("-", "") + ".step")
            known[key] = Converted(path, part, ogee.convert(path, part, *options))
        return known[key]

    return convert


@pytest.fixture(scope="session")
def spot(converted: Converter) -> Converted:
    """Spot, a cage that stands beside the project and not in it."""
    if not SPOT.is_file():
        pytest.skip("no Spot")
    return converted(SPOT)
