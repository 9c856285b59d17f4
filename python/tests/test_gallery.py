"""The scripts of the gallery run, and say what they promise."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

GALLERY = Path(__file__).parent.parent / "gallery"


def run(name, folder):
    environment = {**os.environ, "GALLERY_OUT": str(folder), "GALLERY_SPACING": "0.0146"}
    command = [sys.executable, str(GALLERY / name)]
    done = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=folder)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_every_script_is_run_here():
    assert sorted(p.name for p in GALLERY.glob("*.py")) == ["dam_break.py", "error_against_time.py", "sweep.py"]


def test_dam_break(tmp_path):
    told = run("dam_break.py", tmp_path)
    assert re.search(r"front-mps: \d+\.\d % \(rms-over-range", told), told
    fronts = [float(x) for x in re.findall(r"^ +\d\.\d +(\d\.\d\d)$", told, re.M)]
    assert len(fronts) == 7 and fronts == sorted(fronts) and fronts[-1] > 2.5
    if pytest.importorskip("matplotlib"):
        assert (tmp_path / "dam-break.png").stat().st_size > 10_000


def test_error_against_time(tmp_path):
    told = run("error_against_time.py", tmp_path)
    assert told.count("done") >= 6 and "order" in told, told
    assert "error-against-time.svg" in told


def test_sweep(tmp_path):
    told = run("sweep.py", tmp_path)
    fronts = [float(x) for x in re.findall(r"front is at (\d\.\d+) m", told)]
    assert len(fronts) == 3 and fronts == sorted(fronts)
    windy, calm = re.search(r"velocity (-?\d\.\d+) m/s, without wind (-?\d\.\d+) m/s", told).groups()
    assert float(windy) > float(calm)
