"""The notebooks of the gallery run, and say what they promise."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")
pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")
pytest.importorskip("matplotlib")

GALLERY = Path(__file__).parent.parent / "gallery"
NAMES = ["dam_break", "error_against_time", "law_in_shear", "pyvista_fields", "sweep"]


def executed(name, folder):
    """What a notebook prints, executed in a folder, and its pictures."""
    done = folder / f"{name}.ipynb"
    command = [sys.executable, str(GALLERY / "execute.py"), str(GALLERY / f"{name}.ipynb"), str(done)]
    ran = subprocess.run(command, capture_output=True, text=True, cwd=folder, timeout=600)
    assert ran.returncode == 0, ran.stderr
    notebook = nbformat.read(done, 4)
    outputs = [out for cell in notebook.cells if cell.cell_type == "code" for out in cell.outputs]
    printed = "".join(out.text for out in outputs if out.output_type == "stream" and out.name == "stdout")
    pictures = [out for out in outputs if "image/png" in out.get("data", {})]
    return printed, len(pictures)


def test_every_notebook_is_run_here_and_shipped_with_small_outputs():
    assert sorted(p.stem for p in GALLERY.glob("*.ipynb")) == NAMES
    for name in NAMES:
        path = GALLERY / f"{name}.ipynb"
        assert path.stat().st_size < 1_000_000, name
        nbformat.validate(nbformat.read(path, 4))
        # No folder of the machine on which it was executed.
        assert not re.search(r"/(home|root|work|tmp)/", path.read_text(encoding="utf-8")), name


def test_dam_break(tmp_path):
    told, pictures = executed("dam_break", tmp_path)
    assert re.search(r"front-mps +\d+\.\d %  \(rms-over-range", told), told
    fronts = [float(x) for x in re.findall(r"^ +\d\.\d +(\d\.\d\d) +\d\.\d\d$", told, re.M)]
    # It moves on, and no faster than the dry front of Ritter: x/L = 1 + 2 √(gH) t/L = 1 + 2 t*, with H = 2L.
    times = [0.5 * (k + 1) for k in range(6)]
    assert len(fronts) == 6 and fronts == sorted(fronts)
    assert all(1.0 < x < 1.0 + 2.0 * t for t, x in zip(times, fronts)), fronts
    assert told.count("particle ") == 3 and pictures == 1


def test_error_against_time(tmp_path):
    told, pictures = executed("error_against_time", tmp_path)
    assert told.count("done") >= 6 and "order" in told and pictures == 1, told


def test_law_in_shear(tmp_path):
    told, pictures = executed("law_in_shear", tmp_path)
    missing = {form: float(x) for form, x in re.findall(r"^([a-z-]+) +([+-]\d\.\d\de[+-]\d\d) Pa$", told, re.M)}
    # Formulas of the regularisations at 1/s with 5 Pa, 1 Pa s: τ_y e^(−mγ̇), none, and τ_y (1/√(1 + ε²) − 1) twice.
    assert missing["papanastasiou"] == pytest.approx(-5 * 2.718281828**-20, rel=0.01)
    assert missing["bi-viscosity"] == pytest.approx(0, abs=1e-12)
    assert missing["bercovier-engelman"] == pytest.approx(5 * (1.01**-0.5 - 1), rel=0.01)
    assert missing["ratio"] == pytest.approx(5 * (1.0025**-0.5 - 1), rel=0.01)
    slope, modulus = map(float, re.search(r"slope at the start (\S+) kPa, shear modulus (\S+) kPa", told).groups())
    assert slope == pytest.approx(modulus, rel=0.01) and pictures == 2


def test_sweep(tmp_path):
    told, pictures = executed("sweep", tmp_path)
    fronts = [float(x) for x in re.findall(r"front is at (\d\.\d+) m", told)]
    assert len(fronts) == 3 and fronts == sorted(fronts) and pictures == 1
    windy, calm = re.search(r"velocity (-?\d\.\d+) m/s, without wind (-?\d\.\d+) m/s", told).groups()
    assert float(windy) > float(calm)


def test_pyvista_fields(tmp_path):
    pytest.importorskip("pyvista")
    told, pictures = executed("pyvista_fields", tmp_path)
    low = re.search(r"surface_distance +\(\d+,\) from (\S+) to", told).group(1)
    # A particle at the surface is half a spacing within it.
    assert float(low) == pytest.approx(0.5 * 0.0073, rel=1e-3)
    assert pictures == 3
