"""One valid call of every public function and method on shaking tests and priors."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

import rocksteady as rs
from tests.public.things import fields


def observation_calls(t: dict[str, Any]) -> dict[Any, dict[str, Any]]:
    """Return the arguments of each call by its function, from things of `tests.public.things`."""
    one, spread = t["object prior"], t["spread"]
    calibration = t["calibration"]
    found = t["back analysis"]
    stored = rs.calibration.read_posterior(t["calibrated"])
    row = [0.11, 0.8, 1.0, 0.05]
    Path("tests.csv").write_text("test,record,object,outcome\n1,made,vase,fell\n", encoding="utf-8")
    Path("cemetery.csv").write_text(
        "name,width_m,height_m,outcome\nvase,0.1,0.5,fell\n", encoding="utf-8"
    )
    Path("prior.toml").write_text("[noise]\noutliers = 0.02\n", encoding="utf-8")
    first = float(found.first_values[1])
    inside = {"first": first, "second": first * float(found.ratios[1])}
    return {
        rs.calibration.PriorRange: fields(spread),
        rs.calibration.PriorRange.exactly: {"value": 0.3},
        rs.calibration.PriorRange.between: {"low": 0.3, "high": 0.4},
        rs.calibration.PriorRange.in_logarithm: {"low": 0.3, "high": 0.4},
        rs.calibration.PriorRange.around: {"mean": 0.3, "sd": 0.1},
        rs.calibration.PriorRange.parse: {"text": "0.3:0.4"},
        spread.within: {"name": "width", "low": 0.0, "high": 1.0},
        spread.quantile: {"uniforms": [0.2, 0.7]},
        rs.calibration.ShakingTest: {
            "name": "1",
            "record": t["record"],
            "object": "vase",
            "fell": True,
        },
        rs.calibration.ObjectPrior: {"name": "vase", "width_m": "0.10:0.12", "height_m": 0.5},
        one.describe: {},
        one.draw: {"uniforms": [[0.5] * 4]},
        one.scatter_of: {"values": [row]},
        one.sides: {"values": [row]},
        one.block: {"row": row},
        one.blocks: {"values": [row]},
        one.with_defaults: {"others": {"base": spread}},
        rs.calibration.OutcomeErrors: fields(t["prior"].noise),
        rs.calibration.Prior: {"defaults": {"base": 0.9}},
        t["prior"].describe: {},
        t["prior"].object_prior: {"given": one},
        rs.calibration.Observations: fields(t["observations"]),
        t["observations"].describe: {},
        t["observations"].of: {"name": "vase"},
        t["observations"].subset: {"indices": [0]},
        rs.read_tests: {"path": "tests.csv"},
        rs.calibration.read_prior: {"path": "prior.toml"},
        rs.export.write_tests: {"folder": "kept", "observations": t["observations"], "force": True},
        rs.calibration.Scatter: {"deviation": 0.05, "draws": 2},
        rs.calibration.compute_test_fates: {
            "blocks": t["block"],
            "tests": t["observations"],
            "gains": [0.8, 1.2],
        },
        rs.calibration.make_synthetic_tests: {
            "truth": t["block"],
            "motions": [t["record"]],
            "gains": [0.5],
        },
        rs.calibrate: {"tests": t["observations"], "most_runs": 100, "model": rs.Linear()},
        rs.calibration.Calibration: fields(calibration),
        rs.calibration.Validation: fields(t["validation"]),
        rs.calibration.Predictions: fields(t["predictions"]),
        rs.calibration.Posterior: fields(t["posterior"]),
        rs.calibration.Scores: fields(t["scores"]),
        rs.calibration.BackAnalysis: fields(found),
        rs.calibration.read_posterior: {"folder": t["calibrated"]},
        rs.calibration.StoredPosterior: fields(stored),
        stored.describe: {},
        stored.predict: {"tests": t["observations"]},
        calibration.predict: {"tests": t["observations"]},
        calibration.validate: {"folds": "test"},
        calibration.describe: {},
        t["validation"].describe: {},
        t["predictions"].describe: {},
        t["posterior"].describe: {},
        t["posterior"].of: {"name": "alpha_rad"},
        t["posterior"].interval: {"name": "alpha_rad"},
        t["posterior"].deviation: {"name": "sigma_ln"},
        t["posterior"].median_values: {},
        replace(
            t["posterior"], sessions={"day": np.zeros((len(t["posterior"].weights), 2))}
        ).session_gain: {"name": "day"},
        t["scores"].describe: {},
        t["scores"].values: {},
        rs.plots.test_ladders: {"calibration": calibration},
        rs.plots.posterior: {"calibration": calibration},
        rs.plots.reliability: {"calibration": calibration},
        rs.plots.learning: {"calibration": calibration},
        rs.plots.residuals: {"calibration": calibration},
        rs.plots.predictions: {"predictions": t["predictions"]},
        rs.export.write_calibration: {"calibration": calibration, "folder": "fit", "force": True},
        rs.calibration.Survey: fields(t["survey"]),
        t["survey"].describe: {},
        rs.calibration.ScanOptions: {"limits": (0.05, 2.0), "levels": 10, "draws": 4, "seed": 1},
        rs.calibration.ScanOptions().draws_of: {"objects": 20},
        rs.read_survey: {"path": "cemetery.csv"},
        rs.back_analyse: {
            "survey": t["survey"],
            "motions": [t["record"]],
            "scan": rs.calibration.ScanOptions(levels=4, draws=2, temper=0.5, trials=0),
        },
        found.describe: {},
        found.contains: inside,
        found.density_at: inside,
        found.rows: {},
        found.record_rows: {},
        found.grid_rows: {},
        rs.plots.back_analysis: {"analysis": found},
    }
