"""Scenes stepped in a loop."""

from __future__ import annotations

import os
from typing import Any, Iterable, Iterator, Mapping, NamedTuple, Optional, Union

import numpy as np

from . import _sph
from ._arguments import Function, Scene, Set, joined, overrides, paths, settings


class Column(NamedTuple):
    """A column of particles."""

    unit: str
    """SI unit; "1" for pure numbers."""
    state: bool
    """Whether it carries history; such columns may be set."""
    axes: tuple[int, ...]
    """Lengths of the axes after the first, which is that of the particles."""


class Simulation:
    """A scene in memory, one step at a time; it writes no file.

    Stepped to the output times of a run it has the bits of the run::

        sim = sph.Simulation("dam-break-koshizuka", set={"numerics.spacing": "5 mm"})
        sim.run_until(0.1)
        sim["velocity"][:, 0].max()

    ``sim[name]`` is a new array; ``sim[name] = array`` overwrites a column of state (``sim.columns`` tells which are).
    Particles are sorted now and then: rows of different steps are matched by ``sim["identity"]``.

    ``forces`` and ``probes`` are functions of Python as in :func:`sph.run`. ``start`` is a folder or checkpoint of another
    run of the same bodies.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        set: Set = None,
        threads: Optional[int] = None,
        start: Union[str, "os.PathLike[str]", None] = None,
        forces: Optional[Mapping[str, Function]] = None,
        probes: Optional[Mapping[str, Function]] = None,
        allow_path: Iterable[Union[str, "os.PathLike[str]"]] = (),
    ) -> None:
        forces, probes, functions = joined(forces, probes)
        self._given: list[str] = []
        try:
            for name, function in functions.items():
                _sph.register(name, function)
                self._given.append(name)
            wanted = [*settings(set), *overrides(forces, probes)]
            start = None if start is None else os.fspath(start)
            self._flow = _sph.Simulation(scene, wanted, paths(allow_path), threads, start)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Gives the names of the functions back; the simulation cannot be stepped with them any more."""
        while self._given:
            _sph.forget(self._given.pop())

    def __enter__(self) -> "Simulation":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if getattr(self, "_given", None):
            self.close()

    @property
    def title(self) -> str:
        """Title of the scene."""
        return self._flow.title

    @property
    def dimension(self) -> int:
        """Dimensions of space."""
        return self._flow.dimension

    @property
    def time(self) -> float:
        """Simulated time, s."""
        return self._flow.time

    @property
    def end(self) -> float:
        """Time at which the scene ends, s; steps may go beyond it."""
        return self._flow.end

    @property
    def dt(self) -> float:
        """The last step, s."""
        return self._flow.last_step[0]

    @property
    def limiter(self) -> str:
        """What limited the last step."""
        return self._flow.last_step[1]

    @property
    def steps(self) -> int:
        """Steps taken."""
        return self._flow.step_counts[0]

    @property
    def steps_rolled_back(self) -> int:
        """Steps that failed and were taken back."""
        return self._flow.step_counts[1]

    @property
    def python_cost(self) -> dict[str, tuple[int, float]]:
        """Calls and seconds of every function of Python, by name."""
        return {name: _sph.costs(name) for name in self._given}

    def step(self, steps: int = 1, *, until: Optional[float] = None) -> float:
        """Takes steps as long as the stability bounds allow, not beyond `until` (s); the time after them, s.

        A step that fails is taken back and tried with half of it, as in a run; what does not help raises
        :class:`sph.RunError`.
        """
        target = max(self.end, self.time + 1e9) if until is None else until
        for _ in range(steps):
            if self.time >= target:
                break
            self._flow.one_step(target)
        return self.time

    def run_until(self, time: float) -> int:
        """Steps until a time (s) is hit exactly; the number of steps."""
        before = self.steps
        self._flow.evaluate()
        while self.time < time:
            self._flow.one_step(time)
        return self.steps - before

    @property
    def columns(self) -> dict[str, Column]:
        """The columns of the particles, by name."""
        return {name: Column(unit, state, tuple(axes)) for name, unit, state, axes in self._flow.describe()}

    def __len__(self) -> int:
        return len(self._flow)

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._flow.get(name)
        except KeyError:
            known = ", ".join(self.columns)
            raise KeyError(f"the scene has no column `{name}` (there are: {known})") from None

    def __setitem__(self, name: str, values: Any) -> None:
        try:
            self._flow.set(name, values)
        except KeyError:
            known = ", ".join(self.columns)
            raise KeyError(f"the scene has no column `{name}` (there are: {known})") from None

    def __repr__(self) -> str:
        return f"<Simulation {self.title!r}: {len(self)} particles at t = {self.time:.6g} s>"

    def measure(self) -> dict[str, float]:
        """What the probes of the scene measure now."""
        return {name: value for name, (value, _) in self._flow.measure().items()}

    @property
    def wall_points(self) -> np.ndarray:
        """Points of the walls, m."""
        return self._flow.wall_points()
