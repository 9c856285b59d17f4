"""Scenes checked, explained, run and read."""

import subprocess
import sys

import numpy as np
import pytest

import sph


def test_check_tells_what_the_command_line_tells():
    checked = sph.check("dam-break-koshizuka", threads=1)
    assert checked.particles == 72 * 145
    assert checked.dimension == 2
    command = [sys.executable, "-m", "sph", "check", "dam-break-koshizuka", "--threads", "1"]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stdout

    def without_wall_time(text):
        # Each check measures its own.
        return [line for line in text.strip().splitlines() if not line.startswith("  wall time")]

    assert without_wall_time(told) == without_wall_time(str(checked))


def test_explain_lists_columns_and_plugins(coarse):
    explained = sph.explain("dam-break-koshizuka", set=coarse)
    assert "pressure" in [field.name for field in explained.fields]
    assert ("kernel", "wendland-c2") in [(p.kind, p.name) for p in explained.plugins]


def test_a_mistake_has_its_line_and_the_text_of_the_command_line(tmp_path):
    scene = tmp_path / "bad.toml"
    text = 'title = "x"\ndimension = 2\n[run]\nend = 1\n[numerics]\nspcing = 0.1\n'
    scene.write_text(text)
    with pytest.raises(sph.SceneError) as caught:
        sph.check(scene)
    wrong = {d["path"]: d for d in caught.value.diagnostics}
    assert wrong["numerics.spcing"]["line"] == 6
    assert "did you mean `spacing`?" in str(caught.value)
    command = [sys.executable, "-m", "sph", "check", str(scene)]
    told = subprocess.run(command, capture_output=True, text=True)
    assert told.returncode == 2
    assert told.stderr.strip() == str(caught.value)
    with pytest.raises(sph.SceneError) as of_text:
        sph.check(text)
    assert "numerics.spcing" in str(of_text.value)


def test_a_scene_that_is_not_there_is_a_usage_error():
    with pytest.raises(sph.UsageError, match="dam-break-koshizuka"):
        sph.run("dam-brek-koshizuka")


def test_a_run_from_a_dict_is_that_of_its_text(tank, tmp_path):
    tank["body"]["all"]["velocity"] = np.array([1.0, 0.0])
    text = """
title = "A periodic box"
dimension = 2
run.end = 0.02
numerics = { spacing = 0.1, periodic = { x = [0, 1], y = [0, 1] } }
[phase.water]
density = 1000
velocity_scale = 1.0
rheology.newtonian.viscosity = "1 Pa s"
[body.all]
phase = "water"
box = [[0, 0], [1, 1]]
velocity = [1.0, 0.0]
[output]
every = 0.01
fields = ["velocity", "pressure"]
"""
    of_dict = sph.run(tank, tmp_path / "dict", threads=1)
    of_text = sph.run(text, tmp_path / "text", threads=1)
    assert of_dict.status == of_text.status == "done"
    for name in of_dict.series:
        assert np.array_equal(of_dict.series[name], of_text.series[name]), name
    frames = zip(of_dict.frames(), of_text.frames())
    assert all(np.array_equal(a.points, b.points) for a, b in frames)
    assert np.allclose(of_dict.frame(-1)["velocity"], [1, 0], atol=1e-12)


def test_results_are_arrays_with_units(coarse, tmp_path):
    result = sph.run("dam-break-koshizuka", tmp_path, set=coarse, threads=1)
    assert np.allclose(result.times, [0, 0.02, 0.04, 0.06])
    assert result.summary.steps > 10
    assert abs(result.summary.drift.mass) < 1e-12
    assert set(result.errors) >= {"front-mps", "front-experiment"}
    series = result.series
    assert series.units["front"] == "m"
    assert series["front"][0] < series["front"][-1]
    frame = result.frame_at(0.041)
    assert frame.time == pytest.approx(0.04)
    assert len(frame.points) == result.summary.particles
    assert frame.walls is not None and frame.walls.cells.shape[1] == 2
    again = sph.Results(tmp_path)
    assert again.summary.steps == result.summary.steps
    assert len(again.pictures) >= 4
    assert "written to" in str(result)


def test_tables_go_to_pandas(coarse, tmp_path):
    pandas = pytest.importorskip("pandas")
    result = sph.run("dam-break-koshizuka", tmp_path, set=coarse, threads=1)
    frame = result.series.to_pandas()
    assert isinstance(frame, pandas.DataFrame)
    assert frame.attrs["units"]["front"] == "m"


def test_progress_is_told_and_can_stop_a_run_which_goes_on_to_the_same_bits(coarse, tmp_path):
    told = []

    def stop(progress):
        told.append(progress)
        return progress.step < 5

    whole = sph.run("dam-break-koshizuka", tmp_path / "whole", set=coarse, threads=1)
    longer = {**coarse, "numerics.spacing": 0.002}
    first = sph.run("dam-break-koshizuka", tmp_path / "parts", set=longer, threads=1, progress=stop)
    assert first.status == "interrupted"
    assert told and told[0].end == 0.06 and told[-1].particles == 72 * 145
    assert whole.status == "done"
    short = {**coarse, "run.max_steps": 7}
    parts = tmp_path / "resumed"
    stopped = sph.run("dam-break-koshizuka", parts, set=short, threads=1)
    assert stopped.summary.steps == 7
    on = sph.run("dam-break-koshizuka", parts, set=coarse, threads=1, resume=True, changed=True)
    assert np.array_equal(on.frame(-1).points, whole.frame(-1).points)


def test_a_bar_of_tqdm_is_shown(coarse, tmp_path, capsys):
    pytest.importorskip("tqdm")
    sph.run("dam-break-koshizuka", tmp_path, set=coarse, threads=1, progress=True)
    assert "%" in capsys.readouterr().err


def test_a_scene_of_grains_runs(tmp_path):
    text = """
title = "A ball on the floor"
[run]
end = "0.05 s"
[grains]
count = 1
radius = ["10 cm", "10 cm"]
density = "2.6 g/cm^3"
gravity = [0, 0, "-9.81 m/s^2"]
[grains.contact.linear-elastic]
modulus = "1 MPa"
stiffness_ratio = 0.5
friction = 0.5
[start.cloud]
[box]
low = [0, 0, 0]
high = [0.3, 0.3, 0.3]
"""
    result = sph.run(text, tmp_path)
    assert result.summary.grains == 1
    with pytest.raises(sph.UsageError, match="grains"):
        sph.Simulation(text)


def test_a_study_gives_its_orders(tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE)
    (tmp_path / "study.toml").write_text(STUDY)
    results = sph.study(tmp_path / "study.toml", tmp_path / "out", threads=1)
    assert results.complete
    assert len(results.variants) == 2
    assert "order" in str(results)


SCENE = """
title = "Decaying vortices"
dimension = 2
run.end = 0.05
numerics = { spacing = 0.1, periodic = { x = [0, 1], y = [0, 1] } }
[phase.water]
density = 1
velocity_scale = 1
rheology.newtonian.viscosity = 0.01
[body.all]
phase = "water"
box = [[0, 0], [1, 1]]
initial.taylor-green = { speed = 1, length = 1, density = 1, kinematic_viscosity = 0.01 }
[reference.velocity]
field = "velocity"
solution = "taylor-green"
norm = "l1"
parameters = { speed = 1, length = 1, density = 1, kinematic_viscosity = 0.01 }
"""
STUDY = """
title = "Two spacings"
scene = "scene.toml"
error = "velocity"
[[vary]]
name = "spacing"
key = "numerics.spacing"
values = [0.1, 0.05]
"""


def test_a_law_is_sheared_alone_and_its_mistakes_are_told():
    mud = sph.Law("newtonian", viscosity="2 Pa s")
    assert mud.stress([0.5, 3.0]).tolist() == [1.0, 6.0]
    with pytest.raises(sph.UsageError, match="did you mean `newtonian`"):
        sph.Law("newtonien", viscosity=1.0)
    with pytest.raises(sph.UsageError, match="viscosity"):
        sph.Law("newtonian", viscosity="1 m/s")


def test_a_measurement_has_the_numbers_of_the_command_line(coarse, tmp_path):
    result = sph.run("dam-break-koshizuka", tmp_path, set=coarse, threads=1)
    found = result.measure("speed", reduce=["max", "mean"], quantile=[0.5], above={"x": "20 mm"}, fit="y")
    words = "speed --reduce max,mean --quantile 0.5 --above x=20mm --fit y".split()
    command = [sys.executable, "-m", "sph", "measure", str(tmp_path), *words]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    head, *rows = (line.split(",") for line in told.splitlines())
    assert list(found) == ["time", "max", "mean", "q0.5", "slope", "rms_about", "at_zero"]
    assert head[:2] == ["time [s]", "max [m/s]"]
    assert len(rows) == len(result.times) and found["time"].tolist() == result.times.tolist()
    assert found.units["max"] == "m/s" and found.units["slope"] == "m/s per m"
    for frame, highest in zip(result.frames(), found["max"]):
        speed = np.linalg.norm(frame["velocity"][frame.points[:, 0] > 0.02], axis=1)
        assert highest == pytest.approx(speed.max())
    profile = result.measure("velocity.x", along="y", slice="50 mm")
    assert set(profile) == {"time", "y", "mean"} and len(profile["y"]) > 2 * len(rows)
    with pytest.raises(sph.UsageError, match="expected one of"):
        result.measure("y", reduce="most")
    with pytest.raises(sph.UsageError, match="exclude each other"):
        result.measure("y", fit="x", along="x")


def test_tracks_are_the_rows_of_an_identity(coarse, tmp_path):
    result = sph.run("dam-break-koshizuka", tmp_path / "a", set=coarse)
    (track,) = result.tracks([17]).values()
    assert track[:, 0].tolist() == result.times.tolist()
    for frame, (_, *place) in zip(result.frames(), track):
        (row,) = np.flatnonzero(frame["identity"] == 17)
        assert frame.points[row].tolist() == place
