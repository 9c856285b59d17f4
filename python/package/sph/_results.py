"""What runs leave behind."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path
from typing import Any, Iterator, Mapping, Optional, Sequence, Union

import numpy as np

from . import _sph
from ._errors import FileError


class Record(Mapping[str, Any]):
    """A table of JSON whose entries are attributes as well; printed, it is what the command line prints."""

    def __init__(self, table: Mapping[str, Any], text: str = "") -> None:
        self._table = table
        self._text = text

    def __getitem__(self, name: str) -> Any:
        return _record(self._table[name])

    def __iter__(self) -> Iterator[str]:
        return iter(self._table)

    def __len__(self) -> int:
        return len(self._table)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError:
            known = ", ".join(self._table)
            raise AttributeError(f"there is no `{name}` (there are: {known})") from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(k for k in self._table if k.isidentifier())]

    def __str__(self) -> str:
        return self._text or json.dumps(self._table, indent=2, ensure_ascii=False)

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {', '.join(self._table)}>"

    def to_dict(self) -> dict[str, Any]:
        """The table as plain dicts and lists."""
        return json.loads(json.dumps(self._table))


def _record(value: Any) -> Any:
    if isinstance(value, dict):
        return Record(value)
    if isinstance(value, list):
        return [_record(item) for item in value]
    return value


class Series(Mapping[str, np.ndarray]):
    """Columns of a table by name: ``series["time"]`` is a numpy array."""

    def __init__(self, path: Union[str, "os.PathLike[str]"]) -> None:
        self._take(_sph.read_table(os.fspath(path)))

    def _take(self, columns: Sequence[tuple[str, str, np.ndarray]]) -> None:
        self._columns = {name: values for name, _, values in columns}
        #: Unit of every column.
        self.units = {name: unit for name, unit, _ in columns}

    def __getitem__(self, name: str) -> np.ndarray:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        rows = len(next(iter(self._columns.values()), ()))
        return f"<{type(self).__name__} of {rows} rows: {', '.join(self._columns)}>"

    def to_pandas(self):
        """A pandas DataFrame; its ``attrs["units"]`` has the units."""
        import pandas

        frame = pandas.DataFrame(self._columns)
        frame.attrs["units"] = self.units
        return frame


class Curves(Series):
    """A curve of a probe at one output."""


class Measured(Series):
    """Columns that :meth:`Results.measure` finds: a row for every frame, or for every slice of every frame."""

    def __init__(self, columns: Sequence[tuple[str, str, np.ndarray]]) -> None:
        self._take(columns)


class Frame(Mapping[str, np.ndarray]):
    """Fields at one output time: ``frame["pressure"]``, one row per particle.

    Arrays have the axes that :class:`sph.Simulation` gives them: vectors have two components in a plane.
    """

    def __init__(self, read: Mapping[str, Any], walls: Optional[str], dimension: int) -> None:
        #: Simulated time, s.
        self.time: float = read["time"]
        #: Positions, m, one row of as many as there are dimensions per particle.
        self.points: np.ndarray = _unpadded(read["points"], dimension)
        self._data = {name: _unpadded(values, dimension) for name, (values, _) in read["point_data"].items()}
        #: Unit of every field.
        self.units = {name: unit for name, (_, unit) in read["point_data"].items()}
        #: Fields at the cells of a mesh, by name.
        self.cell_data = {name: _unpadded(values, dimension) for name, (values, _) in read["cell_data"].items()}
        #: Indices of the corners of every cell.
        self.cells: np.ndarray = read["cells"]
        self._walls = walls
        self._dimension = dimension

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._data[name]
        except KeyError:
            known = ", ".join(self._data)
            raise KeyError(f"no field `{name}` was written (there are: {known}; see output.fields)") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def __repr__(self) -> str:
        return f"<Frame at t = {self.time:.6g} s of {len(self.points)} points: {', '.join(self._data)}>"

    @property
    def walls(self) -> Optional["Frame"]:
        """The walls at the same time, if the scene has any."""
        return None if self._walls is None else Frame(_sph.read_vtu(self._walls), None, self._dimension)


def _unpadded(values: np.ndarray, dimension: int) -> np.ndarray:
    """Vectors without the third component that ParaView asks for, tensors as matrices."""
    width = values.shape[1] if values.ndim == 2 else 1
    if width == 3:
        return np.ascontiguousarray(values[:, :dimension])
    if width == dimension**2:
        return values.reshape(-1, dimension, dimension)
    return values


class Results:
    """The folder of a run, also of one that goes on or was made by the command line."""

    def __init__(
        self,
        folder: Union[str, "os.PathLike[str]"],
        *,
        text: str = "",
        summary: Optional[Mapping[str, Any]] = None,
        python_cost: Optional[Mapping[str, tuple[int, float]]] = None,
    ) -> None:
        #: The folder.
        self.folder = Path(folder)
        #: What the command line prints at the end of the run.
        self.text = text
        #: Calls and seconds of every function of Python, by name.
        self.python_cost = dict(python_cost or {})
        self._summary = summary
        self._dimension: Optional[int] = None
        if not self.folder.is_dir():
            raise FileError(f"there are no results in {self.folder}")

    def __repr__(self) -> str:
        return f"<Results in {self.folder}>"

    def __str__(self) -> str:
        return self.text or repr(self)

    @property
    def summary(self) -> Record:
        """``summary.json``: plugins, costs, drifts, errors against the references."""
        if self._summary is None:
            self._summary = json.loads(self._file("summary.json").read_text(encoding="utf-8"))
        return Record(self._summary, self.text)

    @property
    def status(self) -> str:
        """``"done"``, ``"failed"`` or ``"interrupted"``."""
        return self.summary["status"]

    @property
    def errors(self) -> dict[str, Optional[float]]:
        """The errors against the references of the scene."""
        return {name: error["value"] for name, error in self.summary["errors"].items()}

    @property
    def series(self) -> Series:
        """``series.csv``: balances and probes over time."""
        return Series(self._file("series.csv"))

    @property
    def dimension(self) -> int:
        """Dimensions of space."""
        if self._dimension is None:
            # A run that goes on has no summary. Its series has a column for each component of the momentum.
            columns = self.series if (self.folder / "series.csv").is_file() else {}
            self._dimension = 2 if "momentum.y" in columns and "momentum.z" not in columns else 3
        return self._dimension

    def curves(self, probe: str) -> list[Curves]:
        """The curves of a probe, one table per output."""
        folder = self.folder / "curves"
        name = re.compile(re.escape(probe) + r"_(\d{4,})\.csv")
        found = folder.iterdir() if folder.is_dir() else ()
        files = sorted((int(m[1]), p) for p in found if (m := name.fullmatch(p.name)))
        if not files:
            raise KeyError(f"no curves of `{probe}` were written")
        return [Curves(path) for _, path in files]

    @property
    def pictures(self) -> list[Path]:
        """The pictures, in the order of their names."""
        return sorted((self.folder / "pictures").glob("*.png"))

    @property
    def times(self) -> np.ndarray:
        """Times of the outputs of fields, s."""
        return np.array(sorted({time for time, _, _ in self._listed()}))

    def frame(self, which: int = -1) -> Frame:
        """The fields of an output, by its number; -1 is the last."""
        return self._frame(self.times[which])

    def frame_at(self, time: float) -> Frame:
        """The fields of the output that is nearest to a time, s."""
        times = self.times
        return self._frame(times[np.abs(times - time).argmin()])

    def frames(self) -> Iterator[Frame]:
        """The fields of all outputs, one after the other."""
        return (self._frame(time) for time in self.times)

    def tracks(self, identities: Sequence[int]) -> "dict[int, np.ndarray]":
        """Where particles have been: by identity, a row of time (s) and place (m) for every frame that has it."""
        wanted = {int(identity): [] for identity in identities}
        for frame in self.frames():
            rows = {int(name): row for row, name in enumerate(frame["identity"])}
            for identity, places in wanted.items():
                if identity in rows:
                    places.append([frame.time, *frame.points[rows[identity]]])
        width = 1 + self.dimension
        return {identity: np.array(places).reshape(-1, width) for identity, places in wanted.items()}

    def measure(
        self,
        field: str,
        *,
        reduce: Union[str, Sequence[str]] = "mean",
        quantile: Sequence[float] = (),
        weight: str = "one",
        phase: Optional[str] = None,
        above: Optional[Mapping[str, Any]] = None,
        below: Optional[Mapping[str, Any]] = None,
        fit: Optional[str] = None,
        along: Optional[str] = None,
        slice: Union[None, str, float] = None,
        gravity: Optional[Sequence[Any]] = None,
    ) -> Measured:
        """A field of all frames, reduced to numbers: ``sph measure`` with its options.

        ``above`` and ``below`` are bounds by the name of a field, numbers in SI units or texts: ``{"x": "20 cm"}``.
        """

        def bounds(given: Optional[Mapping[str, Any]]) -> list[str]:
            return [f"{name}={value}" for name, value in (given or {}).items()]

        arguments = {
            "results": os.fspath(self.folder),
            "field": field,
            "reduce": [reduce] if isinstance(reduce, str) else list(reduce),
            "quantile": [float(share) for share in quantile],
            "weight": weight,
            "phase": phase,
            "above": bounds(above),
            "below": bounds(below),
            "fit": fit,
            "along": along,
            "slice": None if slice is None else str(slice),
            "gravity": None if gravity is None else ",".join(map(str, gravity)),
        }
        return Measured(_sph.measure(json.dumps(arguments)))

    def _frame(self, time: float) -> Frame:
        here = {name: path for t, name, path in self._listed() if t == time}
        walls = here.pop("walls", None)
        (path,) = list(here.values())[:1] or [walls]
        return Frame(_sph.read_vtu(path), walls, self.dimension)

    def _listed(self) -> Sequence[tuple[float, str, str]]:
        return _sph.list_pvd(os.fspath(self._file("fields.pvd")))

    def _file(self, name: str) -> Path:
        path = self.folder / name
        if not path.is_file():
            raise FileError(f"there is no {name} in {self.folder}")
        return path


class StudyResults(Record):
    """``study.json``: variants with their errors, times and orders of convergence."""

    def __init__(self, table: Mapping[str, Any], text: str = "", going_on: Optional[str] = None) -> None:
        super().__init__(table, text)
        self._going_on = going_on

    @property
    def complete(self) -> bool:
        """Whether all variants are done."""
        return self._going_on is None

    def to_pandas(self):
        """A pandas DataFrame with a row for every variant: settings, errors, wall seconds, steps, particles."""
        import pandas

        rows = []
        for variant in self._table["variants"]:
            plain = {k: v for k, v in variant.items() if not isinstance(v, (dict, list))}
            for group in ("values", "errors", "wall_seconds"):
                nested = variant.get(group)
                if isinstance(nested, dict):
                    for key, value in nested.items():
                        plain[f"{group}.{key}"] = value["value"] if isinstance(value, dict) else value
            rows.append(plain)
        return pandas.DataFrame(rows)
