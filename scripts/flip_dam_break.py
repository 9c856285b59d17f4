#!/usr/bin/env python3
"""The dam break of Lobovsky et al. (2014) as an inviscid, incompressible flow in two dimensions, by another method.

    python3 scripts/flip_dam_break.py 0.005 series.txt      # needs numpy and scipy; 10 mm takes 6 s, 5 mm a minute
    python3 scripts/flip_dam_break.py 0.005 series.txt koshizuka     # the column of Koshizuka & Oka (1996), 10 s

Particles in cells (FLIP, Brackbill & Ruppel 1986; Zhu & Bridson 2005): particles carry the velocity, a staggered grid projects
it; the surface is a ghost-fluid p = 0 (Gibou et al. 2002), walls are free-slip. There is no density and no speed of sound, so
that nothing of SPH is in it. Columns: t, P1 (3 mm), P2 (15 mm), P3 (30 mm), P4 (80 mm), front, kinetic and potential
energy, volume of the cells with particles; SI units. docs/validation/impacts.md compares. The second form prints the share
of single particles: those with a third of the support of an SPH kernel (Wendland C2, h twice their distance) or less.
"""

import sys

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as linalg
from scipy.spatial import cKDTree

KOSHIZUKA = sys.argv[3:] == ["koshizuka"]
LENGTH, CEILING, COLUMN, DEPTH = (0.584, 0.7, 0.146, 0.292) if KOSHIZUKA else (1.61, 1.2, 0.6, 0.3)
GRAVITY, DENSITY, END = 9.81, 1000.0 if KOSHIZUKA else 997.0, 0.705 if KOSHIZUKA else 1.0
SENSORS = (0.003, 0.015, 0.030, 0.080)
AT_U, AT_V = np.array([0.0, 0.5]), np.array([0.5, 0.0])


def corners(points, offset, shape, dx):
    """The four nodes around every point, with their bilinear weights."""
    place = points / dx - offset
    low = np.clip(np.floor(place).astype(int), 0, np.array(shape) - 2)
    share = np.clip(place - low, 0, 1)
    for di in (0, 1):
        for dj in (0, 1):
            wx = share[:, 0] if di else 1 - share[:, 0]
            wy = share[:, 1] if dj else 1 - share[:, 1]
            yield low[:, 0] + di, low[:, 1] + dj, wx * wy


def to_grid(values, points, offset, shape, dx):
    """Means of the particles' values at the nodes, and where there are any."""
    size = shape[0] * shape[1]
    weight, total = np.zeros(size), np.zeros(size)
    for i, j, w in corners(points, offset, shape, dx):
        node = i * shape[1] + j
        weight += np.bincount(node, w, size)
        total += np.bincount(node, w * values, size)
    known = weight > 1e-9
    mean = np.zeros(size)
    mean[known] = total[known] / weight[known]
    return mean.reshape(shape), known.reshape(shape)


def at_points(grid, points, offset, dx):
    return sum(w * grid[i, j] for i, j, w in corners(points, offset, grid.shape, dx))


def shifted(a, axis, by):
    """As np.roll, with nothing coming in."""
    moved = np.roll(a, by, axis)
    edge = [slice(None)] * 2
    edge[axis] = 0 if by == 1 else -1
    moved[tuple(edge)] = 0
    return moved


def extrapolated(field, known, layers=4):
    field, known = field.copy(), known.copy()
    for _ in range(layers):
        total, count = np.zeros_like(field), np.zeros_like(field)
        for axis in (0, 1):
            for by in (1, -1):
                total += shifted(field * known, axis, by)
                count += shifted(known.astype(float), axis, by)
        new = ~known & (count > 0)
        field[new] = total[new] / count[new]
        known |= new
    return field


def level(cells, points, centres, dx):
    """Distance to the surface, below zero in cells with particles."""
    near = cells.copy()
    for axis in (0, 1):
        for by in (1, -1):
            near |= np.roll(cells, by, axis)
    phi = np.full(cells.shape, 0.5 * dx)
    phi[near] = cKDTree(points).query(centres[near])[0] - 0.5 * dx
    phi[cells] = np.minimum(phi[cells], -1e-3 * dx)
    phi[~cells] = np.maximum(phi[~cells], 1e-3 * dx)
    return phi


def pressure(cells, phi, divergence, dx, dt):
    """Solves div(grad p)/rho = div u/dt in the cells with p = 0 at the surface."""
    count = cells.sum()
    number = -np.ones(cells.shape, int)
    number[cells] = np.arange(count)
    i, j = np.nonzero(cells)
    diagonal, rows, columns = np.zeros(count), [], []
    for di, dj in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        a, b = i + di, j + dj
        inside = (a >= 0) & (a < cells.shape[0]) & (b >= 0) & (b < cells.shape[1])
        other = np.full(count, -1)
        other[inside] = number[a[inside], b[inside]]
        water, air = inside & (other >= 0), inside & (other < 0)
        diagonal[water] += 1
        rows.append(np.nonzero(water)[0])
        columns.append(other[water])
        here, there = phi[i[air], j[air]], phi[a[air], b[air]]
        diagonal[air] += 1 / np.maximum(0.5, here / (here - there))
    alone = diagonal == 0
    diagonal[alone] = 1
    off = -np.ones(sum(map(len, rows)))
    places = (np.concatenate(rows + [np.arange(count)]), np.concatenate(columns + [np.arange(count)]))
    matrix = sp.csc_matrix((np.concatenate([off, diagonal]), places))
    right = -divergence[i, j] * DENSITY * dx * dx / dt
    right[alone] = 0
    if count < 9000:
        solution = linalg.spsolve(matrix, right)
    else:
        solution = linalg.cg(matrix, right, rtol=1e-7, M=sp.diags(1 / diagonal), maxiter=4000)[0]
    whole = np.zeros(cells.shape)
    whole[cells] = solution
    return whole


def projected(u, axis, p, cells, phi, dx, dt):
    """u less the gradient of p, and which faces touch a cell with particles."""
    low = (slice(None, -1), slice(None)) if axis == 0 else (slice(None), slice(None, -1))
    high = (slice(1, None), slice(None)) if axis == 0 else (slice(None), slice(1, None))
    inner = (slice(1, -1), slice(None)) if axis == 0 else (slice(None), slice(1, -1))
    here, there = cells[low], cells[high]
    water = np.where(here, phi[low], phi[high])
    air = np.where(here, phi[high], phi[low])
    surface = here ^ there
    theta = np.where(surface, np.maximum(0.5, water / np.where(surface, water - air, 1)), 1)
    slope, known = np.zeros_like(u), np.zeros(u.shape, bool)
    slope[inner] = (p[high] - p[low]) / theta
    known[inner] = here | there
    ends = ((0, 0), (-1, -1))
    for face, cell in ends:
        at = (face, slice(None)) if axis == 0 else (slice(None), face)
        of = (cell, slice(None)) if axis == 0 else (slice(None), cell)
        known[at] = cells[of]
    return np.where(known, u - dt / (DENSITY * dx) * slope, 0), known


def single(x):
    """Share of the particles with a third of a support or less; side walls and floor are mirrors."""
    h = 2 * np.sqrt(COLUMN * DEPTH / len(x))
    right = [2 * LENGTH, 0] + x * [-1, 1]
    y = np.vstack([x, x[x[:, 0] < 2 * h] * [-1, 1], right[right[:, 0] < LENGTH + 2 * h]])
    y = np.vstack([y, y[y[:, 1] < 2 * h] * [1, -1]])
    lists = cKDTree(y).query_ball_point(x, 2 * h)
    q = [np.linalg.norm(y[near] - here, axis=1) / h for near, here in zip(lists, x)]
    support = np.array([((1 - 0.5 * d) ** 4 * (2 * d + 1)).sum() for d in q]) * 7 / (16 * np.pi)
    return (support < 1 / 3).mean()


def main(dx, out):
    nx = round(LENGTH / dx)
    dx = LENGTH / nx
    ny = round(CEILING / dx)
    # Four particles to a cell, shaken by a fifth of their distance.
    a = (np.arange(int(COLUMN / dx * 2)) + 0.5) * dx / 2
    b = (np.arange(round(DEPTH / dx * 2)) + 0.5) * dx / 2
    x = np.stack(np.meshgrid(a, b, indexing="ij"), -1).reshape(-1, 2)
    x += np.random.default_rng(1).uniform(-0.2, 0.2, x.shape) * dx / 2
    x = np.clip(x, 1e-6, None) * [COLUMN / (len(a) * dx / 2), DEPTH / (len(b) * dx / 2)]
    v = np.zeros_like(x)
    mass = DENSITY * COLUMN * DEPTH / len(x)
    xc, yc = (np.arange(nx) + 0.5) * dx, (np.arange(ny) + 0.5) * dx
    centres = np.stack(np.meshgrid(xc, yc, indexing="ij"), -1)
    shapes = ((nx + 1, ny), (nx, ny + 1))
    t, rows = 0.0, []
    while t < END:
        fastest = max(np.abs(v).max(), 1e-3)
        dt = min(0.8 * dx / fastest, 0.25 * np.sqrt(dx / GRAVITY), END - t + 1e-12)
        old = []
        for axis, offset in ((0, AT_U), (1, AT_V)):
            old.append(extrapolated(*to_grid(v[:, axis], x, offset, shapes[axis], dx)))
        u, w = old[0].copy(), old[1] - GRAVITY * dt
        u[0] = u[-1] = 0
        w[:, 0] = w[:, -1] = 0
        cells = np.zeros((nx, ny), bool)
        cell = np.clip((x / dx).astype(int), 0, [nx - 1, ny - 1])
        cells[cell[:, 0], cell[:, 1]] = True
        phi = level(cells, x, centres, dx)
        p = pressure(cells, phi, (u[1:] - u[:-1] + w[:, 1:] - w[:, :-1]) / dx, dx, dt)
        new = []
        for axis, field in ((0, u), (1, w)):
            field = extrapolated(*projected(field, axis, p, cells, phi, dx, dt))
            edge = field if axis == 0 else field.T
            edge[0] = edge[-1] = 0
            new.append(field)
        grids = list(zip(old, new, (AT_U, AT_V)))
        moved = np.stack([at_points(n, x, o, dx) for _, n, o in grids], 1)
        v = v + moved - np.stack([at_points(f, x, o, dx) for f, _, o in grids], 1)
        middle = np.clip(x + 0.5 * dt * moved, 1e-6, [LENGTH - 1e-6, CEILING - 1e-6])
        x = x + dt * np.stack([at_points(n, middle, o, dx) for _, n, o in grids], 1)
        x = np.clip(x, 1e-4 * dx, [LENGTH - 1e-4 * dx, CEILING - 1e-4 * dx])
        t += dt
        if KOSHIZUKA and int(10 * t) > int(10 * (t - dt)):
            print(f"t = {t:.3f} s: {100 * single(x):.1f} % of {len(x)} particles are single")
        sensors = [np.interp(z, yc, p[-1]) for z in SENSORS]
        energies = [0.5 * mass * (v**2).sum(), mass * GRAVITY * x[:, 1].sum()]
        rows.append([t, *sensors, x[:, 0].max(), *energies, cells.sum() * dx * dx])
    np.savetxt(out, rows)
    if KOSHIZUKA:
        return
    rows, time, scale = np.array(rows), np.sqrt(DEPTH / GRAVITY), DENSITY * GRAVITY * DEPTH
    for name, column in (("P2", 2), ("P4", 4)):
        means = []
        for low in (2.6, 3, 3.5, 4, 4.5, 5):
            m = (rows[:, 0] / time >= low) & (rows[:, 0] / time < low + 0.5)
            means.append(np.trapezoid(rows[m, column], rows[m, 0]) / np.ptp(rows[m, 0]) / scale)
        print(name, "over rho g H from t* = 2.6, 3, 3.5, 4, 4.5, 5:", *(f"{m:.2f}" for m in means))


if __name__ == "__main__":
    main(float(sys.argv[1]), sys.argv[2])
