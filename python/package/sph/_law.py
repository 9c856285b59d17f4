"""Laws sheared alone, without particles."""

from __future__ import annotations

from typing import Any, Mapping, Optional

import numpy as np

from . import _sph
from ._arguments import toml


class Law:
    """A material law in a rheometer: a simple shear at one pressure.

    The name and the parameters are those of ``[phase.NAME.rheology.LAW]`` in a scene::

        mud = sph.Law("bingham", viscosity="1 Pa s", yield_stress="5 Pa",
                      regularisation={"papanastasiou": {"stress_growth": 20}})
        mud.stress([0.1, 1.0, 10.0])

    Raises :class:`sph.UsageError` for a law or a parameter that there is not.
    """

    def __init__(self, name: str, parameters: Optional[Mapping[str, Any]] = None, **more: Any) -> None:
        #: Name of the law.
        self.name = name
        self._text = "\n".join(f"{key} = {toml(value)}" for key, value in {**(parameters or {}), **more}.items())
        self.viscosity([1.0], 1.0)

    def viscosity(self, strain_rates: Any, pressure: float = 0.0) -> np.ndarray:
        """Effective viscosity η in Pa s at strain rates in 1/s and a pressure in Pa."""
        return _sph.viscosities(self.name, self._text, pressure, _row(strain_rates))

    def stress(self, strain_rates: Any, pressure: float = 0.0) -> np.ndarray:
        """Shear stress η γ̇ in Pa of steady flow; of an elastic law the viscous part alone."""
        rates = _row(strain_rates)
        return self.viscosity(rates, pressure) * rates

    def shear(self, strain_rate: float, strains: Any, pressure: float = 0.0) -> np.ndarray:
        """Shear stress in Pa of a shear at a constant rate from rest, at strains that rise from zero.

        From one strain to the next is one step of the law, of second order.
        """
        return _sph.shear_stresses(self.name, self._text, pressure, strain_rate, _row(strains))

    def __repr__(self) -> str:
        return f"<Law {self.name}: {self._text.replace(chr(10), ', ')}>"


def _row(values: Any) -> np.ndarray:
    return np.ascontiguousarray(np.atleast_1d(np.asarray(values, dtype=float)))
