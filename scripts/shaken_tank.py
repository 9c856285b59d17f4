#!/usr/bin/env python3
"""The surface of water in a tank that is shaken along its length, by potential theory: linear and fully nonlinear.

    python3 scripts/shaken_tank.py 18 scenes/data/sloshing_tank_potential.csv      # needs numpy; a minute

Tank, depth, motion and gauge are those of the scene `sloshing-tank`. In the frame of the tank, whose acceleration is
a(t), with ψ(x, t) = φ(x, η, t) the potential at the surface and W = ∂φ/∂z there (Zakharov 1968):

    η_t = W (1 + η_x²) − ψ_x η_x
    ψ_t = −g η − a (x − l/2) − ½ ψ_x² + ½ W² (1 + η_x²)

φ is the sum of c cos(kx) cosh(k(z + h))/cosh(kh), k = nπ/l, n up to MODES, which slips along floor and walls. The c
are those that fit ψ at the surface by least squares; of the modes of η and ψ the upper third is damped, as products
fold short waves. Linear: W = Σ k tanh(kh) ψ_k at z = 0 and no squares, so that a mode is β'' + gk tanh(kh) β =
−(2/nπ) tanh(kh) [(−1)ⁿ − 1] a. Writes both levels at the gauge. Checks on stdout: two thirds of the modes, the mean
level, and the experiment (Faltinsen et al. 2000): mean difference, and rms over its range, with the mean and without.
"""

import csv
import math
import sys
from pathlib import Path

import numpy as np

EXPERIMENT = Path(__file__).resolve().parent.parent / "scenes" / "data" / "faltinsen2000_hw0p6_T1p3.csv"
GRAVITY = 9.81  # m/s²
LENGTH, DEPTH, GAUGE = 1.73, 0.6, 0.05  # m
AMPLITUDE, OMEGA = 0.032, 2 * math.pi / 1.3  # m, 1/s
END, STEP = 10.0, 0.005  # s


class Tank:
    """Modes of a rectangular tank and its surface, linear or not.

    `push` is the acceleration of the tank over time; `inflow` the speed that enters at the left wall over its
    height. That one has the potential u [(z + h)² − (x − l)²]/2l.
    """

    def __init__(self, length, depth, modes, linear=False, push=lambda t: 0.0, inflow=lambda t: 0.0):
        self.length, self.depth, self.linear = length, depth, linear
        self.push, self.inflow = push, inflow
        points = 4 * modes
        self.x = (np.arange(points) + 0.5) * length / points
        self.k = np.arange(modes + 1) * math.pi / length
        self.cos = np.cos(np.outer(self.x, self.k))
        self.sin = np.sin(np.outer(self.x, self.k))
        weight = np.full(modes + 1, 2.0 / points)
        weight[0] = 1.0 / points
        self.to_modes = (self.cos * weight).T
        # Of the highest mode e⁻¹ is left after a hundred steps.
        upper = np.clip((np.arange(modes + 1) / modes - 2 / 3) * 3, 0, 1)
        self.kept = np.ones(modes + 1) if linear else np.exp(-0.01 * upper**2)

    def entering(self, speed, eta):
        """The potential of the inflow at the surface."""
        return speed * ((eta + self.depth) ** 2 - (self.x - self.length) ** 2) / (2 * self.length)

    def vertical(self, rest, speed, eta):
        """W at the points, from the modes of the potential less that of the inflow at z = 0, and η at the points."""
        tanh = np.tanh(self.k * self.depth)
        if self.linear:
            return self.cos @ (self.k * tanh * rest) + speed * self.depth / self.length
        up = np.outer(eta, self.k)
        cosh = np.cosh(up) + tanh * np.sinh(up)
        sinh = np.sinh(up) + tanh * np.cosh(up)
        rest = self.cos @ rest + self.entering(speed, 0.0) - self.entering(speed, eta)
        fit = self.cos * cosh
        c = np.linalg.solve(fit.T @ fit, fit.T @ rest)
        return (self.cos * sinh) @ (self.k * c) + speed * (eta + self.depth) / self.length

    def rate(self, time, state):
        """Rates of the modes of η and of ψ less the potential of the inflow at z = 0."""
        level, rest = state
        speed, gain = self.inflow(time), (self.inflow(time + STEP) - self.inflow(time - STEP)) / (2 * STEP)
        eta = self.cos @ level
        vertical = self.vertical(rest, speed, eta)
        level_rate = vertical
        psi_rate = -GRAVITY * eta - self.push(time) * (self.x - self.length / 2) - self.entering(gain, 0.0)
        if not self.linear:
            eta_x, psi_x = (-self.sin @ (self.k * modes) for modes in (level, rest))
            psi_x = psi_x - speed * (self.x - self.length) / self.length
            steep = 1 + eta_x**2
            level_rate = vertical * steep - psi_x * eta_x
            psi_rate = psi_rate - psi_x**2 / 2 + vertical**2 * steep / 2
        return np.array([self.to_modes @ level_rate, self.to_modes @ psi_rate])

    def levels(self, places, end):
        """Times, and the elevations at places."""
        state, at = np.zeros((2, len(self.k))), np.cos(np.outer(places, self.k))
        levels = [at @ state[0]]
        for step in range(round(end / STEP)):
            t = step * STEP
            a = self.rate(t, state)
            b = self.rate(t + STEP / 2, state + STEP / 2 * a)
            c = self.rate(t + STEP / 2, state + STEP / 2 * b)
            d = self.rate(t + STEP, state + STEP * c)
            state = (state + STEP / 6 * (a + 2 * b + 2 * c + d)) * self.kept
            levels.append(at @ state[0])
        return np.arange(len(levels)) * STEP, np.array(levels).T, state[0][0]


def shaken(modes, linear):
    """The level at the gauge of the scene."""
    tank = Tank(LENGTH, DEPTH, modes, linear, push=lambda t: -AMPLITUDE * OMEGA**2 * math.cos(OMEGA * t))
    times, levels, mean = tank.levels([GAUGE], END)
    print(f"mean level at the end {1e3 * mean:+.2f} mm")
    return times, levels[0]


def experiment():
    """Times and levels of the experiment."""
    with open(EXPERIMENT, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return np.array(rows[1:], dtype=float).T


def compare(what, off, extent):
    """Says how large differences are beside a range."""
    rms = math.sqrt((off**2).mean()) / extent
    print(f"{what:40} mean {1e3 * off.mean():+5.1f} mm, rms {rms:.3f}, without the mean {off.std() / extent:.3f}")


def main():
    modes, (times, measured) = int(sys.argv[1]), experiment()
    extent = measured.max() - measured.min()
    now, linear = shaken(modes, True)
    _, full = shaken(modes, False)
    _, coarse = shaken(2 * modes // 3, False)
    for name, level in (("linear", linear), ("nonlinear", full)):
        print(f"{name}: from {1e3 * level.min():.1f} to {1e3 * level.max():.1f} mm")
        compare(f"{name} - experiment", np.interp(times, now, level) - measured, extent)
    print(f"experiment: from {1e3 * measured.min():.1f} to {1e3 * measured.max():.1f} mm")
    compare("nonlinear - linear", full - linear, extent)
    compare("two thirds of the modes - all", coarse - full, extent)
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(
            "# Level 5 cm from the left wall of a tank of 1.73 m, 0.6 m of water, x = 32 mm cos(2 pi t/1.3 s)\n"
            f"# Source: potential theory, {modes} modes (scripts/shaken_tank.py)\n"
            "# Units: s, m (over the level at rest)\n"
            "t_s,eta_m,eta_linear_m\n"
        )
        for row in list(zip(now, full, linear))[::4]:
            file.write("{:.2f},{:.5f},{:.5f}\n".format(*row))


if __name__ == "__main__":
    main()
