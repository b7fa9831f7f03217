"""Damage to the text of a STEP file, to see whether anybody notices."""

from __future__ import annotations

import re
from pathlib import Path

ENTITY = re.compile(r"#(\d+)=(.*?);\s*\n", re.S)
"""One entity, from its number to the semicolon at the end of its line."""


class Part21:
    """A STEP file as numbered entities."""

    def __init__(self, path: Path) -> None:
        text = path.read_text()
        begin, end = text.index("DATA;\n") + len("DATA;\n"), text.rindex("ENDSEC;")
        self.head, self.tail = text[:begin], text[end:]
        self.entities = {int(number): body for number, body in ENTITY.findall(text[begin:end])}

    def write(self, path: Path) -> Path:
        lines = [f"#{number}={body};\n" for number, body in self.entities.items()]
        path.write_text(self.head + "".join(lines) + self.tail)
        return path

    def first(self, kind: str) -> int:
        """The number of the first entity of a kind."""
        return next(number for number, body in self.entities.items() if body.startswith(f"{kind}("))

    def move_a_boundary_pole(self, distance: float) -> None:
        """Moves a pole in the middle of the first row of the first surface; its edge stays where it was."""
        self._move_a_pole(0, distance)

    def move_an_inner_pole(self, distance: float) -> None:
        """Moves a pole of the row after that: no gap opens, but the surface tilts along its boundary."""
        self._move_a_pole(1, distance)

    def _move_a_pole(self, row: int, distance: float) -> None:
        surface = self.first("B_SPLINE_SURFACE_WITH_KNOTS")
        body = self.entities[surface]
        start, end = body.index("(("), body.index("))") + 2
        rows = [row.split(",") for row in body[start + 2 : end - 2].split("),(")]
        middle = len(rows[row]) // 2
        position = _coordinates(self.entities[int(rows[row][middle][1:])])
        moved = max(self.entities) + 1
        coordinates = ",".join(_real(c + distance / 3**0.5) for c in position)
        self.entities[moved] = f"CARTESIAN_POINT('',({coordinates}))"
        rows[row][middle] = f"#{moved}"
        poles = "),(".join(",".join(row) for row in rows)
        self.entities[surface] = f"{body[:start]}(({poles})){body[end:]}"

    def drop_a_face(self) -> None:
        """Takes one face out of the first shell."""
        shell = self.first("CLOSED_SHELL")
        self.entities[shell] = re.sub(r"\(#\d+,", "(", self.entities[shell], count=1)


def _coordinates(point: str) -> list[float]:
    return [float(c) for c in point[point.rindex("(") + 1 : point.index(")")].split(",")]


def _real(value: float) -> str:
    """A real as STEP spells it: with a point, and a capital E."""
    mantissa, _, exponent = repr(value).upper().partition("E")
    mantissa = mantissa if "." in mantissa else mantissa + "."
    return f"{mantissa}E{exponent}" if exponent else mantissa
