"""What may go wrong."""

from __future__ import annotations

import json
from typing import Any


class Error(Exception):
    """Anything that keeps a command from its end; its text is that of the command line."""

    def __init__(self, text: str, told: str = "null") -> None:
        super().__init__(text)
        #: What ``sph … --json`` prints: diagnostics, or the summary of a run that failed.
        self.told: Any = json.loads(told)


class UsageError(Error, ValueError):
    """A scene that is not there, a folder that cannot be used, an option that cannot be."""


class SceneError(Error, ValueError):
    """A scene with mistakes: all of them, with their places."""

    @property
    def diagnostics(self) -> list[dict[str, Any]]:
        """For every mistake ``file``, ``line``, ``column``, ``path`` and ``message``."""
        return self.told

    @property
    def line(self) -> int:
        """Line of the first mistake, from 1."""
        return self.diagnostics[0]["line"]


class RunError(Error, RuntimeError):
    """A step that failed. If a function of Python raised, that is the ``__cause__``."""

    @property
    def summary(self) -> dict[str, Any] | None:
        """``summary.json`` of the run, if it left one."""
        return self.told if isinstance(self.told, dict) else None


class FileError(Error, OSError):
    """A file that cannot be read."""
