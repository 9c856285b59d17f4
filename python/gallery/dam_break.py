# ---
# jupyter:
#   jupytext:
#     text_representation: {extension: .py, format_name: percent}
# ---
# %% [markdown]
# # A dam break beside its experiment
# The column of water of Koshizuka & Oka (1996) collapses. We run the shipped scene with larger particles, so that
# it takes seconds, and look at the front beside the experiment, which is a file of the scene.

# %%
import os
from pathlib import Path

import numpy as np

import sph

out = Path(os.environ.get("GALLERY_OUT", "results/gallery"))
spacing = float(os.environ.get("GALLERY_SPACING", "0.0073"))
settings = {"numerics.spacing": spacing, "run.end": 0.3, "output.every": 0.05}
checked = sph.check("dam-break-koshizuka", set=settings)
print(f"{checked.particles} particles, {checked.estimate.steps:.0f} steps")

# %%
result = sph.run("dam-break-koshizuka", out / "dam-break", set=settings, progress=True)
for name, error in result.summary.errors.items():
    print(f"{name}: {100 * error.value:.1f} % ({error.norm}, {error.samples} samples)")

# %% [markdown]
# The series has the position of the front. In times of √(L/2g) and widths L of the column:

# %%
series = result.series
width, scale = 0.146, 0.086264
print("   t*    x*")
for t in np.arange(0.0, 3.5, 0.5):
    front = np.interp(t * scale, series["time"], series["front"]) / width
    print(f"{t:5.1f} {front:5.2f}")

# %% [markdown]
# Fields are arrays with a row per particle; the last output:

# %%
frame = result.frame(-1)
speed = np.linalg.norm(frame["velocity"], axis=1)
print(f"t = {frame.time:.2f} s: the fastest particle has {speed.max():.2f} m/s at {frame.points[speed.argmax(), :2]} m")

# %%
try:
    import matplotlib

    matplotlib.use(os.environ.get("MPLBACKEND", "Agg"))
    import matplotlib.pyplot as plt
except ImportError:
    print("matplotlib is not installed: no picture")
else:
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
    left.plot(series["time"] / scale, series["front"] / width)
    left.set(xlabel="t √(2g/L)", ylabel="x/L", title="front")
    dots = right.scatter(*frame.points[:, :2].T, c=frame["pressure"], s=4)
    right.set(aspect="equal", title=f"pressure at {frame.time:.2f} s")
    figure.colorbar(dots, label=f"Pa")
    figure.savefig(out / "dam-break.png", dpi=120)
