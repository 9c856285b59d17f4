"""Progress in terminals and notebooks."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import Callable, Optional, Union


@dataclass(frozen=True)
class Progress:
    """Where a run is."""

    time: float
    """Simulated time, s."""
    end: float
    """Simulated time at the end, s."""
    step: int
    """Steps taken."""
    dt: float
    """The last step, s."""
    limiter: str
    """What limited it."""
    particles: int
    """Free particles, or grains."""

    @property
    def share(self) -> float:
        """Share of the simulated time that is over."""
        return self.time / self.end if self.end > 0 else 1.0


Callback = Callable[[Progress], Optional[bool]]


class Bar:
    """A bar of tqdm where it is installed, else a line now and then."""

    def __init__(self) -> None:
        self._bar = None
        self._told = -1
        try:
            from tqdm.auto import tqdm
        except ImportError:
            return
        form = "{percentage:3.0f} % |{bar}| t = {n:.4g} of {total:.4g} s [{elapsed}<{remaining}{postfix}]"
        self._bar = tqdm(total=0.0, bar_format=form)

    def __call__(self, progress: Progress) -> None:
        if self._bar is not None:
            self._bar.total = progress.end
            self._bar.n = progress.time
            self._bar.set_postfix_str(f"Δt {progress.dt:.1e} s ({progress.limiter})")
            return
        tenth = int(10 * progress.share)
        if tenth > self._told:
            self._told = tenth
            print(f"{10 * tenth:3d} %  step {progress.step}", file=sys.stderr)

    def close(self) -> None:
        """Leaves the bar where it is."""
        if self._bar is not None:
            self._bar.close()


def watcher(progress: Union[bool, Callback]):
    """What the extension calls, and what is to be closed in the end."""
    if progress is False or progress is None:
        return None, lambda: None
    told = Bar() if progress is True else progress
    close = told.close if isinstance(told, Bar) else lambda: None
    return (lambda *now: told(Progress(*now))), close
