"""Scenes that take a second."""

import pytest

COARSE = {"numerics.spacing": 0.0146, "run.end": 0.06, "output.every": 0.02}


@pytest.fixture
def coarse():
    """Settings for a dam break of 200 particles."""
    return dict(COARSE)


@pytest.fixture
def tank():
    """Water at rest in a periodic box without walls, as a dict."""
    return {
        "title": "A periodic box",
        "dimension": 2,
        "run": {"end": 0.02},
        "numerics": {"spacing": 0.1, "periodic": {"x": [0, 1], "y": [0, 1]}},
        "phase": {
            "water": {
                "density": 1000,
                "velocity_scale": 1.0,
                "rheology": {"newtonian": {"viscosity": "1 Pa s"}},
            }
        },
        "body": {"all": {"phase": "water", "box": [[0, 0], [1, 1]]}},
        "output": {"every": 0.01, "fields": ["velocity", "pressure"]},
    }
