"""From the arguments of Python to those of the command line."""

from __future__ import annotations

import contextlib
import json
import math
import os
from typing import Any, Callable, Iterable, Iterator, Mapping, Optional, Sequence, Union

from . import _sph

Scene = Union[str, "os.PathLike[str]", Mapping[str, Any]]
Set = Union[Mapping[str, Any], Iterable[str], None]
Function = Callable[[float, "dict[str, Any]"], Any]


def toml(value: Any) -> str:
    """A value as it stands in a scene."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        if not math.isfinite(value):
            raise ValueError(f"a scene holds no {value}")
        return repr(value)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{json.dumps(str(k))} = {toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, os.PathLike):
        return json.dumps(os.fspath(value))
    if isinstance(value, Sequence):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    raise TypeError(f"a scene holds numbers, texts, lists and dicts, not {type(value).__name__}")


def settings(set: Set) -> list[str]:
    """``{"numerics.spacing": 0.01}`` or ``["numerics.spacing=0.01"]`` as ``--set`` takes it."""
    if set is None:
        return []
    if isinstance(set, str):
        return [set]
    if isinstance(set, Mapping):
        return [f"{path}={toml(value)}" for path, value in set.items()]
    return [str(text) for text in set]


def paths(folders: Iterable[Union[str, "os.PathLike[str]"]]) -> list[str]:
    """Folders as texts."""
    return [os.fspath(folder) for folder in folders]


def columns_of(function: Function) -> Optional[list[str]]:
    """Columns that a function asks for by an attribute ``columns``."""
    wanted = getattr(function, "columns", None)
    return None if wanted is None else [str(name) for name in wanted]


def overrides(forces: Mapping[str, Function], probes: Mapping[str, Function]) -> list[str]:
    """What makes a scene name the functions."""
    found = []
    if forces:
        table: dict[str, Any] = {"functions": list(forces)}
        asked = [columns_of(f) for f in forces.values()]
        if any(a is not None for a in asked):
            default = ["position", "velocity"]
            every = [name for a in asked for name in (default if a is None else a)]
            table["columns"] = list(dict.fromkeys(every))
        found.append(f"body-force.python={toml(table)}")
    for name, probe in probes.items():
        table = {"kind": "python", "function": name, "unit": getattr(probe, "unit", "1")}
        columns = columns_of(probe)
        if columns is not None:
            table["columns"] = columns
        found.append(f"probe.{name}={toml(table)}")
    return found


@contextlib.contextmanager
def registered(functions: Mapping[str, Function]) -> Iterator[dict[str, tuple[int, float]]]:
    """Gives functions their names for a while; in the end the dict has calls and seconds of each."""
    costs: dict[str, tuple[int, float]] = {}
    given = []
    try:
        for name, function in functions.items():
            _sph.register(name, function)
            given.append(name)
        yield costs
    finally:
        for name in given:
            costs[name] = _sph.costs(name)
            _sph.forget(name)


def joined(forces: Optional[Mapping[str, Function]], probes: Optional[Mapping[str, Function]]):
    """Both mappings, and the union of them."""
    forces, probes = dict(forces or {}), dict(probes or {})
    both = forces.keys() & probes.keys()
    if both:
        raise ValueError(f"a force and a probe are both called {sorted(both)}")
    return forces, probes, {**forces, **probes}
