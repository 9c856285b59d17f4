"""Smoothed particle hydrodynamics, and grains one by one, from scene files.

A scene is a path, the name of a shipped scene (``"dam-break-koshizuka"``), a TOML text, or a dict::

    import sph

    result = sph.run("dam-break-koshizuka", set={"run.end": 0.3}, out="results/dam")
    print(result.summary.errors["front-mps"].value)
    result.series["front"]              # a column of series.csv as a numpy array
    result.frame(-1)["pressure"]        # a field at the last output

    sim = sph.Simulation("dam-break-koshizuka")
    while sim.time < 0.1:
        sim.step()
    sim["velocity"] *= 0.5              # columns of state may be changed between steps

All quantities are in SI units. Mistakes are exceptions with the text of the command line:
:class:`SceneError` knows the line of the scene.
"""

from ._commands import Check, Explanation, check, explain, run, study
from ._errors import Error, FileError, RunError, SceneError, UsageError
from ._law import Law
from ._results import Curves, Frame, Measured, Record, Results, Series, StudyResults
from ._simulation import Simulation
from ._sph import __version__

__all__ = [
    "Check",
    "Curves",
    "Error",
    "Explanation",
    "FileError",
    "Frame",
    "Law",
    "Measured",
    "Record",
    "Results",
    "RunError",
    "SceneError",
    "Series",
    "Simulation",
    "StudyResults",
    "UsageError",
    "__version__",
    "check",
    "explain",
    "run",
    "study",
]
