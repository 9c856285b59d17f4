#!/usr/bin/env python3
"""The dam break of Kleefsman et al. (2005, SPHERIC test 2) on a box, inviscid and incompressible, in three dimensions.

    python3 scripts/flip_dam_break_box.py 0.02 series.txt end=2.5 surface=cells courant=0.4     # or `still`: water at rest
    python3 scripts/flip_dam_break_box.py compare series.txt        # of a series that is there

To 1.2 s 4 cm takes 5 s of a thread, 3 cm 15 to 25 s, 2 cm 2 min (numpy and scipy). Without options: end=1.2 courant=0.8.
Particles in cells as scripts/flip_dam_break.py (FLIP, Brackbill & Ruppel 1986; Zhu & Bridson 2005), eight to a cell, in one
half of the tank: y = 0.5 m is a mirror. No density, no speed of sound, no air; walls are free-slip. The box is cut from the
cells: only the open part of a face counts (Batty et al. 2007); slivers below 0.3 of a cell are closed. The surface is p = 0
where the level set of Zhu & Bridson is zero (ghost fluid, Gibou et al. 2002), or, with "surface=cells", at the faces of the
cells with particles as in two dimensions; that makes the water half a cell too large.

P1 and P3 are of the cells that touch the box's face (there dp/dn = 0) at the mirror, between their centres by z, and means
over a step. H2 and H4 are the water from the floor to the first two empty cells. Columns: t at the end of the step, P1, P3,
H2, H4, front, kinetic and potential energy (both halves), volume of the wet cells, particles in a cell inside the water (1
at the start); SI units. docs/validation/impacts.md compares.
"""

import pathlib
import sys

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as linalg
from scipy.spatial import cKDTree

TANK, COLUMN, STILL_DEPTH = np.array([3.22, 0.5, 1.0]), np.array([1.228, 0.5, 0.55]), 0.3
BOX = np.array([[2.3955, -1.0, -1.0], [2.5565, 0.2015, 0.161]])
GRAVITY, DENSITY, SLIVER = 9.81, 1000.0, 0.3
SENSORS, GAUGES = (0.021, 0.101), (2.26, 0.614)
RADIUS = 0.36  # of the level set, in cells: over a flat surface of shaken particles it is right within 0.15, 0.01 in the mean
EXPERIMENT = pathlib.Path(__file__).parent.parent / "scenes/data/spheric2_P1_P3_P5_P7_H2_H4.csv"


class Grid:
    """Lines, open parts of faces and cells, and faces in the box's skin at which the normal velocity is zero."""

    def __init__(self, dx, still):
        nx, ny = divisions(TANK[0], COLUMN[0], dx), divisions(TANK[1], BOX[1, 1], dx)
        depth = STILL_DEPTH if still else COLUMN[2]
        dz = depth / round(depth / dx)
        self.n = np.array([nx, ny, int(np.ceil(TANK[2] / dz - 1e-9))])
        self.d = np.array([TANK[0] / nx, TANK[1] / ny, dz])
        self.column = np.array([TANK[0], TANK[1], depth]) if still else COLUMN
        self.box = np.array([TANK, np.zeros(3)]) if still else self.snapped()
        lines = [np.arange(n + 1) * d for n, d in zip(self.n, self.d)]
        self.centres = [0.5 * (line[1:] + line[:-1]) for line in lines]
        low, high = self.box
        cover = [np.maximum(np.minimum(b, x[1:]) - np.maximum(a, x[:-1]), 0) / x[1] for x, a, b in zip(lines, low, high)]
        self.open = 1 - outer(cover)
        self.open[self.open < 1e-9] = 0
        self.area, self.blocked = [], []
        for axis in range(3):
            on = (lines[axis] > low[axis] - 1e-9) & (lines[axis] < high[axis] + 1e-9)
            area = 1 - outer([on if a == axis else cover[a] for a in range(3)])
            area[area < 1e-9] = 0
            places = [lines[a] if a == axis else self.centres[a] for a in range(3)]
            deep = np.stack(np.meshgrid(*(np.minimum(x - a, b - x) for x, a, b in zip(places, low, high)), indexing="ij"))
            skin = (area == 0) & (deep[axis] <= deep.min(0) + 1e-9)
            np.moveaxis(area, axis, 0)[[0, -1]] = 0
            np.moveaxis(skin, axis, 0)[[0, -1]] = True
            self.area, self.blocked = self.area + [area], self.blocked + [skin]

    def snapped(self):
        """The box, grown to the next line where less than SLIVER of a cell is left open."""
        low, high = BOX / self.d
        low = np.where(low - np.floor(low) < SLIVER, np.floor(low), low)
        return np.array([low, np.where(np.ceil(high) - high < SLIVER, np.ceil(high), high)]) * self.d

    def cell(self, points):
        return np.ravel_multi_index(np.clip((points / self.d).astype(int), 0, self.n - 1).T, self.n)

    def kept(self, x):
        """Points, brought back into the tank and out of the box by the shortest way."""
        x = np.clip(x, 1e-4 * self.d, (self.n - 1e-4) * self.d)
        inside = np.nonzero(((x > self.box[0]) & (x < self.box[1])).all(1))[0]
        side = np.concatenate([x[inside] - self.box[0], self.box[1] - x[inside]], 1).argmin(1)
        x[inside, side % 3] = (self.box + [[-1e-4], [1e-4]] * self.d).ravel()[side]
        return x


def outer(parts):
    return np.einsum("i,j,k->ijk", *(np.asarray(p, float) for p in parts))


def divisions(length, inner, dx):
    """A number of cells near length/dx that has a line close to `inner`."""
    near = range(int(np.ceil(0.95 * length / dx)), int(1.05 * length / dx) + 1)
    return min(near, key=lambda n: abs(inner * n / length - round(inner * n / length)))


def stencil(points, axis, grid):
    """Matrix of the trilinear weights of the faces of an axis at points."""
    shape = np.array(grid.area[axis].shape)
    place = points / grid.d - np.where(np.arange(3) == axis, 0, 0.5)
    low = np.clip(np.floor(place).astype(np.int32), 0, shape - 2)
    share = np.clip(place - low, 0, 1)
    columns, weights = np.empty((len(points), 8), np.int32), np.empty((len(points), 8))
    for c, (i, j, k) in enumerate(np.ndindex(2, 2, 2)):
        columns[:, c] = ((low[:, 0] + i) * shape[1] + low[:, 1] + j) * shape[2] + low[:, 2] + k
        weights[:, c] = np.abs(share - [1 - i, 1 - j, 1 - k]).prod(1)
    starts = np.arange(0, columns.size + 1, 8, dtype=np.int32)
    return sp.csr_matrix((weights.ravel(), columns.ravel(), starts), shape=(len(points), shape.prod()))


def to_grid(values, matrix, shape):
    """Means of the particles' values at the faces, and where there are any."""
    total, weight = (matrix.T @ np.stack([values, np.ones_like(values)], 1)).T
    return np.where(weight > 1e-9, total / np.maximum(weight, 1e-9), 0).reshape(shape), (weight > 1e-9).reshape(shape)


def ends(axis):
    """Slices of the lower and the upper of two neighbours, and of the faces between them."""
    return [tuple(cut if a == axis else slice(None) for a in range(3)) for cut in (slice(-1), slice(1, None), slice(1, -1))]


def neighbours(a):
    """Sums over the six neighbours."""
    total = np.zeros(a.shape)
    for axis in range(3):
        low, high, _ = ends(axis)
        total[low] += a[high]
        total[high] += a[low]
    return total


def grown(cells):
    return cells | (neighbours(cells) > 0)


def extrapolated(field, known, layers):
    field, known = np.where(known, field, 0), known.copy()
    for _ in range(layers):
        count = neighbours(known)
        new = ~known & (count > 0)
        field[new] = neighbours(field)[new] / count[new]
        known |= new
    return field, known


def level(x, where, occupied, grid):
    """Distance to the surface near it, below zero in the water (Zhu & Bridson)."""
    fluid = grid.open > 0
    near = fluid & np.where(occupied, neighbours(fluid & ~occupied) > 0, neighbours(occupied) > 0)
    near, close = fluid & grown(near), grown(grown(grown(near)))
    d = grid.d.mean()
    points = x[close.ravel()[where]] / d
    centres = np.stack([grid.centres[a][i] for a, i in enumerate(np.nonzero(near))], 1) / d
    far, who = cKDTree(points).query(centres, 32, distance_upper_bound=1.0)
    weights = np.maximum(1 - far**2, 0) ** 3
    weight = weights.sum(1)
    mean = (weights[:, :, None] * points[np.minimum(who, len(points) - 1)]).sum(1) / np.maximum(weight, 1e-12)[:, None]
    phi = np.where(occupied, -d, d)
    phi[near] = np.where(weight > 1e-6, np.linalg.norm(centres - mean, axis=1) - RADIUS, 1) * d
    return phi


def surface_shares(wet, phi, axis):
    """The wet ones of the cells on both sides of the faces, and the distances over which their pressures differ, in cells."""
    low, high, _ = ends(axis)
    here, there = wet[low], wet[high]
    mixed = here ^ there
    if phi is None:
        return here, there, np.where(mixed, 0.5, 1)
    water = np.where(here, phi[low], phi[high]) / np.where(mixed, -np.abs(phi[low] - phi[high]), 1)
    return here, there, np.where(mixed, np.clip(water, 0.1, 1), 1)


def pressure(wet, phi, velocity, grid, dt, guess):
    """Solves div(A grad p)/rho = div(A u)/dt in the wet cells, A the open parts of the faces."""
    count, number, every = wet.sum(), np.full(wet.shape, -1), np.arange(wet.sum())
    number[wet] = every
    diagonal, right, entries = np.zeros(count), np.zeros(wet.shape), []
    for axis in range(3):
        low, high, inner = ends(axis)
        flux = velocity[axis] * grid.area[axis]
        right -= (flux[high] - flux[low]) * DENSITY / (dt * grid.d[axis])
        here, there, share = surface_shares(wet, phi, axis)
        weight = grid.area[axis][inner] / (grid.d[axis] ** 2 * share)
        both = here & there & (weight > 0)
        for a, b, own in ((low, high, here), (high, low, there)):
            diagonal += np.bincount(number[a][own], weight[own], count)
            entries.append((-weight[both], number[a][both], number[b][both]))
    alone = diagonal <= 0
    root = 1 / np.sqrt(np.where(alone, 1, diagonal))
    values, rows, columns = (np.concatenate(e) for e in zip(*entries, (np.where(alone, 1, diagonal), every, every)))
    scaled = sp.csr_matrix((values * root[rows] * root[columns], (rows, columns)), shape=(count, count))
    found, failed = linalg.cg(scaled, np.where(alone, 0, right[wet]) * root, x0=guess[wet] / root, rtol=1e-7, maxiter=5000)
    assert not failed, "the pressure has not converged"
    p = np.zeros(wet.shape)
    p[wet] = found * root
    return p


def projected(field, ballistic, axis, p, wet, phi, grid, dt):
    """Velocities less the gradient of p, carried on to where the particles need them."""
    low, high, inner = ends(axis)
    here, there, share = surface_shares(wet, phi, axis)
    blocked, new, known = grid.blocked[axis], field.copy(), np.zeros(field.shape, bool)
    new[inner] -= dt / (DENSITY * grid.d[axis]) * (p[high] - p[low]) / share
    known[inner] = here | there
    new[blocked] = 0
    known = (known & (grid.area[axis] > 0)) | (blocked & (neighbours(known) > 0))
    new, known = extrapolated(new, known, 2)
    new, known = extrapolated(np.where(known, new, field), known | ballistic, 2)
    new[blocked] = 0
    return new


def start(grid):
    """Eight particles to a cell, shaken by a fifth of their distance."""
    many = np.round(grid.column / grid.d * 2).astype(int)
    axes = [(np.arange(m) + 0.5) * c / m for m, c in zip(many, grid.column)]
    x = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    return x + np.random.default_rng(1).uniform(-0.2, 0.2, x.shape) * grid.column / many


def height(here, grid, full):
    """Water over the floor in a column of cells, up to two empty ones."""
    top = np.argmax((here == 0) & (np.append(here[1:], 0) == 0))
    return grid.d[2] * (top - 1 + min(1, here[top - 1] / full) if top else 0)


def main(dx, out, still, end, courant, surface):
    grid = Grid(dx, still)
    print("cells", grid.n, "of", grid.d, "m; box", *(f"{b:.4f}" for b in grid.box[:, 0]), *(f"{b:.4f}" for b in grid.box[1, 1:]))
    x = start(grid)
    v, p = np.zeros_like(x), np.zeros(grid.n)
    mass, full = 2 * DENSITY * grid.column.prod() / len(x), len(x) * (grid.d / grid.column).prod()
    t, rows, front = 0.0, [], int(grid.box[0, 0] / grid.d[0] - 1e-6)
    while t < end - 1e-9:
        dt = min(courant * (grid.d / np.maximum(np.abs(v).max(0), 1e-3)).min(), 0.25 * np.sqrt(dx / GRAVITY), end - t + 1e-12)
        if len(rows) % 20 == 0:
            order = np.argsort(grid.cell(x), kind="stable")
            x, v = x[order], v[order]
        at = [stencil(x, axis, grid) for axis in range(3)]
        before = [to_grid(v[:, a], at[a], grid.area[a].shape) for a in range(3)]
        u = [np.where(grid.blocked[a], 0, before[a][0] - (GRAVITY * dt if a == 2 else 0)) for a in range(3)]
        where, fluid = grid.cell(x), grid.open > 0
        count = np.bincount(where, minlength=grid.n.prod()).reshape(grid.n)
        occupied = (count > 0) & fluid
        phi = None if surface == "cells" else level(x, where, occupied, grid)
        wet = fluid & (occupied | (neighbours(fluid & ~occupied) == 0) if phi is None else phi < 0)
        p = pressure(wet, phi, u, grid, dt, p)
        new = [projected(u[a], before[a][1], a, p, wet, phi, grid, dt) for a in range(3)]
        moved = np.stack([at[a] @ new[a].ravel() for a in range(3)], 1)
        v += moved - np.stack([at[a] @ before[a][0].ravel() for a in range(3)], 1)
        middle = grid.kept(x + 0.5 * dt * moved)
        x = grid.kept(x + dt * np.stack([stencil(middle, a, grid) @ new[a].ravel() for a in range(3)], 1))
        t += dt
        inner = occupied & (neighbours(occupied) == 6) & (grid.open == 1)
        energies = [0.5 * mass * (v**2).sum(), mass * GRAVITY * x[:, 2].sum(), 2 * (grid.open * wet).sum() * grid.d.prod()]
        sensors = [np.interp(z, grid.centres[2], p[front, 0]) for z in SENSORS]
        levels = [height(count[int(place / grid.d[0]), 0], grid, full) for place in GAUGES]
        rows.append([t, *sensors, *levels, x[:, 0].max(), *energies, count[inner].mean() / full])
    np.savetxt(out, rows)
    if still:
        deep = grid.centres[2] < STILL_DEPTH
        error = p[:, :, deep] - DENSITY * GRAVITY * (STILL_DEPTH - grid.centres[2][deep])
        print("largest error of the pressure, in Pa, and speed:", np.abs(error).max(), np.abs(v).max())
    else:
        compare(out)


def integral(rows, column):
    """Of values that are means over steps, from zero."""
    times, total = np.append(0, rows[:, 0]), np.append(0, np.cumsum(rows[:, column] * np.diff(rows[:, 0], prepend=0)))
    return lambda a, b: np.interp(b, times, total) - np.interp(a, times, total)


def compare(out):
    """Impulses, peaks and errors as those of the scene: rms over range of the measured; pressures as means of 10 ms."""
    here, measured = np.loadtxt(out), np.loadtxt(EXPERIMENT, delimiter=",", skiprows=6)
    for who, table in (("here", here), ("measured", measured)):
        begun = table[np.argmax(table[:, 1] > 1000) - 1, 0]
        rows = table[table[:, 0] < 1.2]
        for name, column in (("P1", 1), ("P3", 2)):
            total = integral(table, column)
            mean = total(rows[:, 0] - 0.005, rows[:, 0] + 0.005) / 0.01
            print(f"{name} {who}, kPa s: from 0.4 s to 0.5, 0.6, 0.8 s", *(f"{total(0.4, t) / 1e3:.3f}" for t in (0.5, 0.6, 0.8)),
                  f"in 0.1, 0.2 s from {begun:.4f} s", *(f"{total(begun, begun + t) / 1e3:.3f}" for t in (0.1, 0.2)),
                  *(f"largest {p.max():.0f} Pa at {rows[p.argmax(), 0]:.4f} s" for p in (rows[:, column], mean)))
    for end in sorted({1.2, round(here[-1, 0], 2)}):
        at = measured[measured[:, 0] <= end]
        values = [integral(here, c)(at[:, 0] - 0.005, at[:, 0] + 0.005) / 0.01 for c in (1, 2)]
        values += [np.interp(at[:, 0], here[:, 0], here[:, c]) for c in (3, 4)]
        errors = [np.sqrt(((a - b) ** 2).mean()) / np.ptp(b) for a, b in zip(values, at[:, [1, 2, 5, 6]].T)]
        print(f"errors of P1, P3, H2, H4 to {end:.2f} s:", *(f"{e:.4f}" for e in errors))
    for t, *_, kinetic, potential, volume, inside in here[np.searchsorted(here[:, 0], np.arange(0, here[-1, 0], 0.2))]:
        print(f"{t:.3f} s: energy {(kinetic + potential) / here[0, 6:8].sum():.4f}, volume {volume:.4f} m3, inside {inside:.3f}")


if __name__ == "__main__":
    given = dict(o.split("=") for o in sys.argv[3:] if "=" in o)
    end, courant, surface = float(given.get("end", 1.2)), float(given.get("courant", 0.8)), given.get("surface", "level")
    if sys.argv[1] == "compare":
        compare(sys.argv[2])
    else:
        main(float(sys.argv[1]), sys.argv[2], "still" in sys.argv, end, courant, surface)
