#!/usr/bin/env python3
"""What potential theory says of a wave's way from the first gauge of `subaerial-landslide` to the others.

    python3 scripts/past_gauges.py RESULTS      # needs numpy; a folder of a run with gauges G1 to G4; a minute

A tank as deep as the water begins at G1. Water is let in there at a speed that is even over the depth, so that the
level there becomes that of the run: at first u = 2 √(g(h + η)) − 2 √(gh), a long wave of one direction, then u += ½
(η of the run − η) √(g/h), twelve times, of which the best counts. All that follows is free: fully nonlinear potential
flow (scripts/shaken_tank.py). Says when the crest passes each gauge and how high it is, in the run and by theory, and
the speed from G1 over √(g(h + A)), A the height at G1; the same for a solitary wave as high, whose speed is 1 by
definition, which checks the method; and the speed of linear theory for a wave whose crest is as long.
"""

import csv
import math
import sys
from pathlib import Path

import numpy as np
from shaken_tank import GRAVITY, STEP, Tank

DEPTH = 0.15  # m
GAUGES = {"G1": 0.70, "G2": 1.00, "G3": 1.30, "G4": 1.60}  # m
PLACES = [x - 0.70 for x in GAUGES.values()]
LENGTH, MODES = 2.6, 52  # m: long enough that nothing comes back
ROUNDS = 12
LONG = math.sqrt(GRAVITY * DEPTH)


def smoothed(values):
    """Without what is shorter than some 50 ms."""
    weights = np.hanning(11)
    return np.convolve(np.pad(values, 5, mode="edge"), weights / weights.sum(), mode="valid")


def followed(times, wanted):
    """Levels at the gauges of a wave whose level at the first is the wanted one."""
    speed, best = 2 * np.sqrt(GRAVITY * (DEPTH + wanted)) - 2 * LONG, (math.inf, None)
    # What follows the crest does not reach it.
    counted = times < times[int(np.argmax(wanted))] + 0.15
    for _ in range(ROUNDS):
        tank = Tank(LENGTH, DEPTH, MODES, inflow=lambda t, u=speed: float(np.interp(t, times, u)))
        now, levels, _ = tank.levels(PLACES, times[-1])
        off = wanted - np.interp(times, now, levels[0])
        error = abs(off[counted]).max() / wanted.max()
        best = min(best, (error, levels), key=lambda b: b[0])
        speed = speed + 0.5 * smoothed(off) * math.sqrt(GRAVITY / DEPTH)
    print(f"the level at G1 is that of the run to {best[0]:.1%} of the crest")
    return now, best[1]


def crest(times, level, after):
    """Time and height of the first crest after a time: the parabola through its ±30 ms."""
    rising = np.flatnonzero((times >= after) & (level > 0.6 * level[times >= after].max()))
    first = rising[0]
    top = first + int(np.argmax(level[first : first + round(0.15 / (times[1] - times[0]))]))
    near = np.abs(times - times[top]) <= 0.03
    a, b, c = np.polyfit(times[near] - times[top], level[near], 2)
    return times[top] - b / (2 * a), c - b * b / (4 * a)


def width(times, level):
    """How long the first crest is over half of its height, s."""
    when, height = crest(times, level, 0.0)
    at, over = int(np.argmin(np.abs(times - when))), level > height / 2
    return times[at + int(np.argmin(over[at:]))] - times[at - int(np.argmin(over[at::-1]))]


def passing(times, levels):
    """Times and heights of the crest at the gauges."""
    found, after = [], 0.0
    for level in levels:
        found.append(crest(times, level, after))
        after = found[-1][0]
    return found


def read(folder):
    """Even times, and levels over the still water at the gauges."""
    with open(Path(folder) / "series.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    ran = np.array([float(row["time[s]"]) for row in rows])
    times = np.arange(0.0, ran[-1], STEP)
    columns = [np.array([float(row[g + "[m]"]) for row in rows]) for g in GAUGES]
    return times, [np.interp(times, ran, c - c[ran < 0.1].mean()) for c in columns]


def say(name, found, norm):
    """A row: times, heights, speeds between gauges, and that from the first over a norm."""
    line, before = f"{name:24}", None
    for place, (when, height) in zip(PLACES, found):
        line += f" | {when:.3f} s, {1e3 * height:4.1f} mm"
        if before:
            line += f", {(place - before[0]) / (when - before[1]):.3f} m/s"
        before = place, when
    whole = (PLACES[-1] - PLACES[0]) / (found[-1][0] - found[0][0]) / norm
    last = (PLACES[-1] - PLACES[1]) / (found[-1][0] - found[1][0]) / math.sqrt(GRAVITY * (DEPTH + found[1][1]))
    print(f"{line} | {whole - 1:+.1%}, from G2, with the height there, {last - 1:+.1%}")


def main():
    times, run = read(sys.argv[1])
    found = passing(times, run)
    high = found[0][1]
    norm = math.sqrt(GRAVITY * (DEPTH + high))
    over = width(times, run[0])
    say("run", found, norm)
    now, levels = followed(times, smoothed(run[0]))
    say("theory", passing(now, levels), norm)
    rate = math.sqrt(0.75 * high / DEPTH**3) * norm
    now, levels = followed(times, high / np.cosh(rate * (times - times[-1] / 2 + 0.25)) ** 2)
    say("solitary wave, check", passing(now, levels), norm)
    # A sine is over half of its crest, from its mean, for a third of its period.
    k = math.pi / (1.5 * over * LONG)
    for _ in range(50):
        k = math.pi / (1.5 * over * math.sqrt(GRAVITY / k * math.tanh(k * DEPTH)))
    linear = math.sqrt(GRAVITY / k * math.tanh(k * DEPTH))
    print(f"over half of its crest at G1 for {over:.3f} s, a solitary wave as high for {1.763 / rate:.3f} s: a sine of")
    print(f"kh = {k * DEPTH:.2f} has {linear:.3f} m/s; √(g(h + A)) = {norm:.3f} m/s")


if __name__ == "__main__":
    main()
