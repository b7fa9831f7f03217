"""The `ogee` command as a script would call it."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
COMMAND = os.environ.get("OGEE", str(ROOT / "target" / "release" / "ogee"))
"""The binary under test."""


def convert(cage: Path, part: Path, *options: str) -> dict[str, Any]:
    """Converts a cage and returns the report."""
    return _report("convert", str(cage), "-o", str(part), *options)


def network(cage: Path, out: Path, *options: str) -> dict[str, Any]:
    """Lays the network of curves in a cage's file and returns the report."""
    return _report("network", str(cage), "-o", str(out), *options)


def passes_check(part: Path) -> bool:
    """Whether our own lint of the text finds nothing."""
    done = _run("check", str(part), "--json")
    assert done.returncode in (0, 1), f"{' '.join(done.args)}: exit {done.returncode}\n{done.stderr}"
    return done.returncode == 0


def _report(*arguments: str) -> dict[str, Any]:
    done = _run(*arguments, "--json")
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(done.args)}: exit {done.returncode}\n{done.stderr}{done.stdout}")
    report = json.loads(done.stdout)
    assert report["schema"] == 1
    return report


def _run(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([COMMAND, *arguments], capture_output=True, text=True, stdin=subprocess.DEVNULL)
