"""The commands ``check``, ``explain``, ``run`` and ``study``."""

from __future__ import annotations

import json
import os
import sys
from typing import Iterable, Mapping, Optional, Union

from . import _sph
from ._arguments import Function, Scene, Set, joined, overrides, paths, registered, settings
from ._progress import Callback, watcher
from ._results import Record, Results, StudyResults

Path = Union[str, "os.PathLike[str]"]


class Check(Record):
    """What follows from a scene: sizes, speeds, dimensionless numbers, steps, time and memory."""


class Explanation(Record):
    """What a scene is made of: plugins, columns, stages, limits of the time step."""


def check(
    scene: Scene, *, set: Set = None, threads: Optional[int] = None, allow_path: Iterable[Path] = ()
) -> Check:
    """Reads, validates and assembles a scene without running it.

    Printed, the result is the text of ``sph check``; its attributes are those of ``--json``::

        sph.check("dam-break-koshizuka").particles

    Raises :class:`SceneError` with the line of every mistake.
    """
    text, told = _sph.check(scene, settings(set), paths(allow_path), threads)
    return Check(json.loads(told), text)


def explain(scene: Scene, *, set: Set = None, allow_path: Iterable[Path] = ()) -> Explanation:
    """Tells what a scene is made of, as ``sph explain`` does."""
    text, told = _sph.explain(scene, settings(set), paths(allow_path))
    return Explanation(json.loads(told), text)


def run(
    scene: Scene,
    out: Optional[Path] = None,
    *,
    set: Set = None,
    threads: Optional[int] = None,
    progress: Union[bool, Callback] = False,
    messages: bool = False,
    resume: bool = False,
    changed: bool = False,
    start: Optional[Path] = None,
    forces: Optional[Mapping[str, Function]] = None,
    probes: Optional[Mapping[str, Function]] = None,
    allow_path: Iterable[Path] = (),
) -> Results:
    """Runs a scene into a folder and gives its results.

    Parameters
    ----------
    scene
        A path, the name of a shipped scene, a TOML text of several lines, or a dict.
    out
        Folder of the results; ``results/NAME`` if left out.
    set
        Values put on top of the scene: ``{"numerics.spacing": "5 mm"}``.
    progress
        True for a bar (of tqdm where it is installed), or a function that is called about ten times a second
        with a :class:`Progress`; if it returns False the run writes a checkpoint and stops.
    messages
        Whether notes of the run go to stderr; they are in ``summary.warnings`` as well.
    resume, changed
        Go on from the checkpoint in the folder; with ``changed`` although the scene is another.
    start
        Begin with the particles of another run: its folder or checkpoint.
    forces
        Functions ``f(time, columns)`` by name that return accelerations in m/s², one row per particle. ``columns`` has
        numpy arrays by name: position and velocity, or those of an attribute ``f.columns``.
    probes
        Functions of the same form that return one number, a column of the series; their unit is ``f.unit``.

    What the functions cost is ``result.python_cost``: calls and seconds by name.

    Ctrl-C writes a checkpoint and raises KeyboardInterrupt.

    Raises :class:`SceneError`, :class:`UsageError`, or :class:`RunError` if a step failed.
    """
    forces, probes, functions = joined(forces, probes)
    arguments = {
        "set": [*settings(set), *overrides(forces, probes)],
        "allow_path": paths(allow_path),
        "out": None if out is None else os.fspath(out),
        "threads": threads,
        "resume": resume,
        "changed": changed,
        "start": None if start is None else os.fspath(start),
    }
    tell, close = watcher(progress)
    say = (lambda text: print(text, file=sys.stderr)) if messages else None
    with registered(functions) as costs:
        try:
            text, told, folder, _ = _sph.run(scene, arguments, tell, say)
        finally:
            close()
    return Results(folder, text=text, summary=json.loads(told), python_cost=costs)


def study(
    study: Path,
    out: Optional[Path] = None,
    *,
    set: Set = None,
    threads: Optional[int] = None,
    only: Iterable[str] = (),
    fresh: bool = False,
    progress: bool = False,
    allow_path: Iterable[Path] = (),
) -> StudyResults:
    """Runs a study: which error is reached in which time, over several variants of a scene.

    ``study`` is a path or the name of a shipped study. What is finished is kept: the same call goes on from there.
    With ``progress`` it tells on stderr where it is.
    """
    arguments = {
        "set": settings(set),
        "allow_path": paths(allow_path),
        "out": None if out is None else os.fspath(out),
        "threads": threads,
        "only": list(only),
        "fresh": fresh,
        "quiet": not progress,
    }
    text, told, going_on = _sph.study(os.fspath(study), arguments)
    return StudyResults(json.loads(told), text, going_on)
