#!/usr/bin/env python3
"""A wedge of water that lands with its edge on a flat rigid wall, without gravity: the flow that is similar to itself.

    python3 scripts/water_wedge.py 45 scenes/data/wedge_of_water.csv        # needs numpy and scipy; ten seconds

Lengths are in Ut, speeds in U, pressures in ρU² (U the speed before, t the time since the edge met the wall). The half
x > 0 is the upper half plane of ζ: 0 where the axis meets the wall, 1 at the tip of the jet, infinity far up. The wall
is 0 < ζ < 1, the surface ζ > 1. The surface keeps its arc length s from the tip (|u − r| = s), so that h = ∫√(dw'dz),
w' the complex velocity, maps the flow to a triangle with the angles π/2, π/4, π/4 (Wagner 1932):

    h'² = C²/[ζ (1 − ζ)^{3/2}]        w' = ∫ h'²/z' dζ
    ln z' = ln K − ½ ln ζ − (θ₁/π) ln(1 − ζ) − (1/π) ∫₁^∞ θ'(τ) ln[(τ − ζ)/τ] dτ
    −θ'(ζ) = |h'|²/(s s')             θ the direction of the surface, θ₁ at the tip (after Dobrovol'skaya 1969)

C, K and the contact angle π − θ₁ follow from the angle far up, from u = x at the tip and from w' = i far up. Checks on
stdout: the second resolution; the momentum ∮ (φ + y) n_y dl against ∫p dx; the edge to which the surface far up points,
which must be (0, −1).
"""

import sys

import numpy as np
from scipy.optimize import brentq

REACH = 70.0  # of x = ln(ζ − 1): beyond, all is a power of ζ to 1e-12


class Flow:
    """Kernels of the three parts of the boundary, for `count` points x on the surface."""

    def __init__(self, half_angle, count):
        self.far = np.pi / 2 - half_angle  # direction of the surface far up
        x = self.x = np.linspace(-REACH, REACH, count)
        self.dx = x[1] - x[0]
        self.log_zeta = np.logaddexp(0, x)
        # ln|τ − ζ| = (x + y)/2 + ln|2 sinh((x − y)/2)|; the trapezoidal rule has ln(dx/2π) where it is singular.
        apart = np.abs(x[:, None] - x[None, :])
        np.fill_diagonal(apart, 1.0)
        kernel = apart / 2 + np.log(-np.expm1(-apart))
        np.fill_diagonal(kernel, np.log(self.dx / (2 * np.pi)))
        share = self.dx / np.pi
        self.surface = (kernel + (x[:, None] + x[None, :]) / 2 - self.log_zeta) * share
        v = self.v = np.linspace(-75, 75, 1501)
        self.dv = v[1] - v[0]
        self.floor_zeta, self.floor_rest = -np.logaddexp(0, -v), -np.logaddexp(0, v)  # ln ζ, ln(1 − ζ)
        self.floor = (np.logaddexp(x, self.floor_rest[:, None]) - self.log_zeta) * share
        self.axis_rest = np.logaddexp(0, v)  # ζ = −e^v
        self.axis = (np.logaddexp(self.log_zeta, v[:, None]) - self.log_zeta) * share

    def cumulate(self, f):
        """∫ f dx from the first point, to third order."""
        part = np.empty(len(f) - 1, f.dtype)
        part[1:-1] = (13 * (f[1:-2] + f[2:-1]) - f[:-3] - f[3:]) / 24
        part[[0, -1]] = (f[0] + f[1]) / 2, (f[-2] + f[-1]) / 2
        return np.concatenate([[0], np.cumsum(part * self.dx)])

    def turn(self, contact, guess):
        """−dθ/dx for a contact angle, and how far u is from x at the tip."""
        tip, total = np.pi - contact, np.pi - contact - self.far
        g = guess * total / (guess.sum() * self.dx)
        for _ in range(600):
            log_slope = -self.log_zeta / 2 - tip / np.pi * self.x + self.surface @ g
            self.stretch = np.exp(log_slope + self.x)  # ds/dx over K
            self.s = self.stretch[0] * np.pi / contact + self.cumulate(self.stretch)
            new = np.exp(-self.log_zeta - self.x / 2 - log_slope) / self.s
            scale = total / (new.sum() * self.dx)
            change = np.abs(scale * new - g).max()
            g = 0.5 * (g + scale * new)
            if change < 1e-12:
                break
        slope = -self.floor_zeta / 2 - tip / np.pi * self.floor_rest + self.floor @ g
        jacobian = self.floor_zeta + self.floor_rest
        self.dz = np.exp(slope + jacobian)
        self.dw = np.exp(-self.floor_zeta - 1.5 * self.floor_rest - slope + jacobian)
        self.length = self.dz.sum() * self.dv + self.dz[-1] * np.pi / contact
        self.g, self.scale = g, scale
        return np.log(scale * self.dw.sum() * self.dv / self.length)

    def solve(self):
        """The contact angle, and with it all the rest."""
        guess, before = np.exp(-self.x**2 / 40), None
        for degrees in (0.5, 1, 2, 3, 4, 6, 8, 12):
            contact = np.radians(degrees)
            miss = self.turn(contact, guess)
            guess = self.g
            if before and before[1] * miss < 0:
                break
            before = (contact, miss)
        self.contact = brentq(lambda q: self.turn(q, guess), before[0], contact, xtol=1e-13)
        self.turn(self.contact, guess)
        slope = -self.v / 2 - (np.pi - self.contact) / np.pi * self.axis_rest + self.axis @ self.g
        speed = self.scale * np.exp(-1.5 * self.axis_rest - slope).sum() * self.dv  # over 1/K; it is 1 far up
        self.size = 1 / speed
        self.tip = self.size * self.length
        return self

    def on_the_floor(self):
        """x, p and φ along the floor: with S = φ − r²/2 it is p = ½ − S − ½(u − x)², and S = ½ at the tip."""
        middle = lambda f: self.size * (np.cumsum(f) - 0.5 * f) * self.dv
        x, u = middle(self.dz), self.scale * middle(self.dw)
        # Beyond the last point, which for a small contact angle is well before the tip, u − x is linear.
        rest = np.linspace(1, 0, 100)[1:]
        lag = np.append(u - x, (u[-1] - x[-1]) * rest)
        x = np.append(x, self.tip - (self.tip - x[-1]) * rest)
        parts = np.diff(x) * (lag[1:] + lag[:-1]) / 2
        s = 0.5 - np.append(np.cumsum(parts[::-1])[::-1], 0)
        return x, 0.5 - s - 0.5 * lag**2, s + x**2 / 2

    def free_surface(self):
        """z along the free surface from the tip on, its arc length, its direction."""
        turned = np.concatenate([[0], np.cumsum((self.g[1:] + self.g[:-1]) / 2) * self.dx])
        direction = np.exp(1j * (np.pi - self.contact - turned))
        s = self.size * self.s
        z = self.tip + s[0] * direction[0] + self.size * self.cumulate(self.stretch * direction)
        straight = np.linspace(0, s[0], 100)[:-1]
        z, s = np.append(self.tip + straight * direction[0], z), np.append(straight, s)
        return z, s, np.append(np.full(99, direction[0]), direction)


def momentum(flow, reach):
    """2 ∮ (φ + y) n_y dl over wall and surface up to s = reach: the force on the half wall less what is beyond."""
    z, s, _ = flow.free_surface()
    near = s < reach
    z, s = z[near], s[near]
    x, _, on_floor = flow.on_the_floor()
    return -np.trapezoid(abs(z + 1j) ** 2 - s**2, z.real) - 2 * np.trapezoid(on_floor, x)


def main():
    half_angle = np.radians(float(sys.argv[1]))
    for count in (1000, 2000):
        flow = Flow(half_angle, count).solve()
        x, p, _ = flow.on_the_floor()
        force = np.trapezoid(p, x)
        z, s, direction = flow.free_surface()
        k = np.searchsorted(s, 30)
        edge = z[k] - s[k] * direction[k]
        law = momentum(flow, 10)
        print(f"{count} points: contact {np.degrees(flow.contact):.4f}°, tip {flow.tip:.5f}, p {p[0]:.5f}")
        print(f"  at most {p.max():.5f} at {x[p.argmax()]:.4f}, edge {edge:.4f}")
        print(f"  half of the force: ∫p dx {force:.5f}, by momentum {law:.5f}")
    if len(sys.argv) > 2:
        write(sys.argv[2], flow, x, p, force)


def write(path, flow, x, p, force):
    """The table: one over the place on the wall, which is a time, the pressure there; and what grows with time."""
    with open(path, "w", encoding="utf-8") as out:
        out.write(f"""# A wedge of water, half angle {sys.argv[1]} degrees, lands with its edge on a flat rigid wall
# No gravity: the flow is similar to itself
# Source: computed for this project by scripts/water_wedge.py: Wagner's triangle, integral equation for the surface
# tau = U t/x at a place x of the wall, p over rho U^2; front = tip of the jet over x
# force = that on the whole wall over rho U^2 x
# Contact angle {np.degrees(flow.contact):.3f} degrees, tip at {flow.tip:.4f} U t
# p {p[0]:.4f} in the middle, at most {p.max():.4f} rho U^2 at {x[p.argmax()]:.3f} U t
tau,p,front,force
""")
        for tau in np.round(np.concatenate([np.arange(0.2, 1.0, 0.01), np.arange(1.0, 5.001, 0.05)]), 4):
            value = np.interp(1 / tau, x, p, right=0)
            out.write(f"{tau:g},{value:.5f},{flow.tip * tau:.5f},{2 * force * tau:.5f}\n")


if __name__ == "__main__":
    main()
