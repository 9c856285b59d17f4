"""Scenes stepped in a loop, and functions of Python in them."""

import gc

import numpy as np
import pytest

import sph


def by_identity(simulation, name):
    return simulation[name][np.argsort(simulation["identity"])]


def test_stepped_to_the_outputs_a_scene_has_the_bits_of_its_run(coarse, tmp_path):
    coarse["output.fields"] = ["velocity", "pressure", "velocity_gradient"]
    result = sph.run("dam-break-koshizuka", tmp_path, set=coarse, threads=1)
    simulation = sph.Simulation("dam-break-koshizuka", set=coarse, threads=1)
    for time in result.times:
        simulation.run_until(time)
    assert simulation.time == 0.06
    assert simulation.steps == result.summary.steps
    frame = result.frame(-1)
    order = np.argsort(frame["identity"])
    assert np.array_equal(by_identity(simulation, "position"), frame.points[order])
    for name in ["velocity", "velocity_gradient"]:
        assert np.array_equal(by_identity(simulation, name), frame[name][order]), name
        assert frame[name].shape[1:] == simulation.columns[name].axes
    assert frame.walls.points.shape[1] == 2


def test_columns_are_told_and_state_can_be_set(coarse):
    simulation = sph.Simulation("dam-break-koshizuka", set=coarse, threads=1)
    simulation.step(3)
    columns = simulation.columns
    assert columns["velocity"] == ("m/s", True, (2,))
    assert not columns["pressure"].state
    assert simulation["velocity"].shape == (len(simulation), 2)
    assert simulation["identity"].dtype == np.uint32
    simulation["velocity"] = [0.0, 1.0]
    assert (simulation["velocity"] == [0.0, 1.0]).all()
    with pytest.raises(sph.RunError, match="not state"):
        simulation["pressure"] = 0.0
    with pytest.raises(ValueError, match="expected an array of shape"):
        simulation["velocity"] = np.zeros((3, 2))
    with pytest.raises(KeyError, match="there are: position"):
        simulation["velocty"]
    with pytest.raises(sph.RunError, match="not finite"):
        simulation["velocity"] = np.nan
    assert set(simulation.measure()) == {"front"}


def test_momentum_given_between_steps_is_kept(tank):
    simulation = sph.Simulation(tank, threads=1)
    simulation.step()
    simulation["velocity"] = [0.25, -0.5]
    before = simulation["position"]
    time = simulation.time
    simulation.run_until(0.02)
    assert np.allclose(simulation["velocity"], [0.25, -0.5], atol=1e-12)
    way = (simulation["position"] - before)[np.argsort(simulation["identity"])] % 1.0
    assert np.allclose(way, [0.25 * (0.02 - time), 1.0 - 0.5 * (0.02 - time)], atol=1e-12)


def test_a_uniform_force_gives_the_momentum_of_newton(tank, tmp_path):
    def push(time, columns):
        assert columns["position"].shape == (100, 2)
        return np.broadcast_to([2.0, 0.0], (100, 2))

    result = sph.run(tank, tmp_path, threads=1, forces={"push": push})
    momentum = result.series["momentum.x"]
    assert momentum[-1] == pytest.approx(1000 * 2.0 * 0.02, rel=1e-9)
    calls, seconds = result.python_cost["push"]
    assert calls > 1 and seconds > 0
    assert "python force: push" in result.summary.wall_seconds_by_stage


def test_a_force_by_columns_of_its_own_and_a_probe(tank, tmp_path):
    def spin(time, columns):
        x = columns["position"] - 0.5
        return np.stack([-x[:, 1], x[:, 0]], axis=1) + 0 * columns["pressure"][:, None]

    spin.columns = ["position", "pressure"]

    def fastest(time, columns):
        return np.abs(columns["velocity"]).max()

    fastest.unit = "m/s"
    probes = {"fastest": fastest}
    result = sph.run(tank, tmp_path, threads=1, forces={"spin": spin}, probes=probes)
    assert result.series.units["fastest"] == "m/s"
    assert result.series["fastest"][0] == 0
    assert 0.4 * 0.02 < result.series["fastest"][-1] < 0.8 * 0.02


def test_what_a_function_raises_is_the_cause(tank, tmp_path):
    def broken(time, columns):
        raise ZeroDivisionError("no wind today")

    with pytest.raises(sph.RunError, match="no wind today") as caught:
        sph.run(tank, tmp_path, set={"run.retries": 0}, threads=1, forces={"wind": broken})
    assert isinstance(caught.value.__cause__, ZeroDivisionError)
    with pytest.raises(sph.RunError, match="expected an array of shape"):
        sph.run(tank, tmp_path, threads=1, forces={"wind": lambda t, c: np.zeros(3)})
    with pytest.raises(sph.SceneError, match="no function `gone`"):
        sph.check(tank, set={"body-force.python": {"functions": ["gone"]}})


def test_forces_act_in_a_loop_and_their_names_are_free_afterwards(tank):
    for _ in range(2):
        with sph.Simulation(tank, threads=1, forces={"push": lambda t, c: [1.0, 0.0]}) as simulation:
            simulation.run_until(0.01)
            assert np.allclose(simulation["velocity"], [0.01, 0.0], rtol=1e-9)
            assert simulation.python_cost["push"][0] > 0
    sph.Simulation(tank, threads=1, forces={"push": lambda t, c: [1.0, 0.0]})
    gc.collect()
    sph.Simulation(tank, threads=1, forces={"push": lambda t, c: [1.0, 0.0]}).close()


def test_a_function_cannot_look_at_the_simulation_that_calls_it(tank):
    holder = {}

    def curious(time, columns):
        holder["simulation"].time
        return [0.0, 0.0]

    with sph.Simulation(tank, threads=1, forces={"curious": curious}) as simulation:
        holder["simulation"] = simulation
        with pytest.raises(sph.RunError, match="being stepped"):
            simulation.step()


def test_a_simulation_starts_where_a_run_ended(coarse, tmp_path):
    result = sph.run("dam-break-koshizuka", tmp_path, set=coarse, threads=1)
    simulation = sph.Simulation("dam-break-koshizuka", set=coarse, threads=1, start=tmp_path)
    assert simulation.time == 0.06
    frame = result.frame(-1)
    order = np.argsort(frame["identity"])
    assert np.array_equal(by_identity(simulation, "position"), frame.points[order])
