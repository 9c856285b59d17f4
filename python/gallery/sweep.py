# ---
# jupyter:
#   jupytext:
#     text_representation: {extension: .py, format_name: percent}
# ---
# %% [markdown]
# # A sweep of parameters, and a force of Python
# How far does the front of a dam break come in 0.15 s, for columns of several heights? Two runs go on at a time: a run
# leaves Python free, so that threads are enough.

# %%
import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import sph

out = Path(os.environ.get("GALLERY_OUT", "results/gallery"))
heights = [0.146, 0.219, 0.292]


def front(height):
    settings = {
        "numerics.spacing": 0.0146,
        "run.end": 0.15,
        "body.column.box": [[0, 0], [0.146, height]],
        "output.every": 0.15,
    }
    result = sph.run("dam-break-koshizuka", out / f"height-{height}", set=settings, threads=1)
    return result.series["front"][-1]


with ThreadPoolExecutor(2) as pool:
    fronts = list(pool.map(front, heights))
for height, x in zip(heights, fronts):
    print(f"H = {height:.3f} m: the front is at {x:.3f} m")

# %% [markdown]
# A force is a function of whole columns. This one is a wind that pushes what is above 0.2 m; its cost is told.


# %%
def wind(time, columns):
    push = np.zeros_like(columns["velocity"])
    push[columns["position"][:, 1] > 0.2, 0] = 5.0
    return push


settings = {"numerics.spacing": 0.0146, "run.end": 0.1}
calm = sph.Simulation("dam-break-koshizuka", set=settings, threads=1)
with sph.Simulation("dam-break-koshizuka", set=settings, threads=1, forces={"wind": wind}) as windy:
    for simulation in (calm, windy):
        simulation.run_until(0.1)
    calls, seconds = windy.python_cost["wind"]
    print(f"{calls} calls of the wind took {seconds:.3f} s")
    print(f"mean velocity {windy['velocity'][:, 0].mean():.3f} m/s, without wind {calm['velocity'][:, 0].mean():.3f} m/s")
