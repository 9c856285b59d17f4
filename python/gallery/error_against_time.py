# ---
# jupyter:
#   jupytext:
#     text_representation: {extension: .py, format_name: percent}
# ---
# %% [markdown]
# # Which error in which time
# A study runs variants of a scene and keeps what is done. Here it is the decay of vortices with two kernels and three
# spacings; the error is that of the velocity against the exact solution.

# %%
import os
from pathlib import Path

import sph

out = Path(os.environ.get("GALLERY_OUT", "results/gallery"))
out.mkdir(parents=True, exist_ok=True)
study = out / "kernels.toml"
study.write_text(
    """
title = "Vortices with two kernels"
scene = "taylor-green-2d"
error = "velocity-l1"
set = { run.end = 0.1 }

[[vary]]
name = "kernel"
entries = [
    { name = "wendland-c2", set = { kernel.wendland-c2 = {} } },
    { name = "quintic-spline", set = { kernel.quintic-spline = {} } },
]

[[vary]]
name = "spacing"
key = "numerics.spacing"
values = [0.0625, 0.05, 0.04]
"""
)
results = sph.study(study, out / "kernels", threads=2)
print(results)

# %% [markdown]
# The same as a table. `report.html` in the folder of the study has the plots.

# %%
for variant in results.variants:
    print(variant.name, variant.status, variant.errors)
print([path.name for path in (out / "kernels").glob("*.svg")])
