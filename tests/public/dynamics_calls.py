"""One valid call of what concerns basins, edges, branches and curves of bifurcations."""

from typing import Any

import numpy as np

import rocksteady as rs
from tests.public.things import fields


def dynamics_calls(t: dict[str, Any]) -> dict[Any, dict[str, Any]]:
    """Return the arguments of each call by its function, from things of `tests.public.things`."""
    few = [-0.5, 0.0, 0.5]
    bare, shaking = t["bare"], t["shaking"]
    block = t["block"]
    waves = ((1, 1.0, 0.0), (2, 0.5, 0.0))
    series = rs.motions.FourierSeries(amplitude=2.0, frequency_ratio=4.0, harmonics=waves)
    bifurcation_curve = rs.branches.BifurcationCurve(
        type=rs.branches.PointType.FOLD,
        parameters=("frequency_ratio", "amplitude"),
        points=(t["fold"], t["fold"]),
    )
    near: dict[str, Any] = {
        "parameter": "amplitude",
        "within": (1.95, 2.05),
        "largest_step": 0.1,
    }
    return {
        rs.motions.FourierSeries: {
            "amplitude": 2.0,
            "frequency_ratio": 4.0,
            "harmonics": ((1, 1.0, 0.0), (2, 0.5, 0.0)),
        },
        rs.motions.FourierSeries.from_si: {
            "block": block,
            "acceleration_m_s2": 4.0,
            "frequency_hz": 2.0,
            "harmonics": ((1, 1.0, 0.0),),
        },
        rs.motions.FourierSeries.from_samples: {
            "samples": [0.0, 1.0, 0.5, -1.0, -0.5],
            "frequency_ratio": 2.0,
            "orders": 2,
        },
        series.misfit: {"samples": [0.0, 1.0, -1.0]},
        series.acceleration: {"phase": few},
        series.acceleration_m_s2: {"block": block},
        series.frequency_hz: {"block": block},
        series.segments: {},
        t["basins"].describe: {},
        t["basins"].fractions: {},
        t["basins"].fractions()[0].describe: {},
        t["basins"].attractors[0].describe: {},
        t["basins"].state: {"row": 0, "column": 1},
        t["basins"].to_dataframe: {},
        t["basins"].to_dataset: {},
        t["edge"].describe: {},
        t["edge"].to_dataframe: {},
        t["hilltop"].at: {"phase": [0.1, 0.2]},
        t["hilltop"].describe: {},
        t["hilltop"].direction: {"kind": "stable", "phase": 0.1},
        t["hilltop"].trajectory: {},
        t["manifold"].describe: {},
        t["manifold"].nearest: {"angle": 0.1, "velocity": 0.2},
        t["manifold"].to_dataframe: {},
        t["basins"].entropy: {"box": 1},
        t["basins"].uncertainty_exponent: {"sizes": [2, 3], "by": "boxes"},
        t["shares"].describe: {},
        t["shares"].case: {"index": 1},
        t["shares"].entropies: {"box": 1},
        t["shares"].entropies(1).describe: {},
        t["shares"].intervals: {},
        t["shares"].to_dataset: {},
        t["shares"].families[0].describe: {},
        t["entropy"].describe: {},
        t["exponent"].describe: {},
        t["exponent"].interval: {},
        t["boundary"].describe: {},
        rs.basins.MatchingOptions: {"distance": "nearest", "threshold": 0.1},
        rs.basins.SamplingOptions: {"angles": few, "velocities": few, "seed": 1},
        rs.basins.compute_basin_entropy: {"labels": np.zeros((4, 4), dtype=np.int64), "box": 2},
        rs.basins.compute_uncertainty_exponent: {
            "labels": np.eye(9, dtype=np.int64),
            "sizes": [1, 2],
        },
        rs.basins.check_boundary: {"labels": np.eye(18, dtype=np.int64), "ball": 2, "balls": 100},
        t["erosion"].describe: {},
        rs.basins.IntegrityDrop(
            measure="integrity_factor", level=0.5, low=0.1, high=0.2, above=0.6, below=0.4
        ).describe: {},
        t["erosion"].drop: {"tolerance": 0.5},
        t["erosion"].measure: {"name": "integrity_factor"},
        t["erosion"].to_dataset: {},
        rs.branches.find_branches: {"origins": [t["orbit"]], **near, "max_branches": 1},
        rs.branches.follow_bifurcation: {
            "origin": t["fold"],
            "parameters": ("frequency_ratio", "amplitude"),
            "within": ((3.9, 4.1), (1.9, 2.1)),
            "most_points": 3,
        },
        rs.branches.CurveOptions: {"orders": (1,), "max_impacts": 2},
        rs.branches.BifurcationCurve: {
            "type": rs.branches.PointType.FOLD,
            "parameters": ("frequency_ratio", "amplitude"),
            "points": (t["fold"], t["fold"]),
        },
        bifurcation_curve.describe: {},
        bifurcation_curve.rows: {},
        bifurcation_curve.to_dataframe: {},
        t["resting branch"].pieces: {},
        rs.branches.find_cascade: {
            "origin": t["doubling"],
            "parameter": "frequency_ratio",
            "within": (1.7, 2.0),
            "direction": -1,
            "doublings": 3,
        },
        rs.branches.CodimensionTwoPoint: {"point": t["fold"], "curves": (1, 2)},
        rs.branches.Region: {
            "place": (2.0, 3.0),
            "motions": ("symmetric",),
            "extent": (0, 1.0, 3.0),
        },
        rs.branches.BifurcationCurves: {
            "block": bare,
            "motion": shaking,
            "parameters": ("frequency_ratio", "amplitude"),
            "within": ((3.9, 4.1), (1.9, 2.1)),
            "search": rs.branches.CurveOptions(),
            "curves": (),
            "points": (),
            "regions": (),
            "complete": True,
        },
        rs.find_bifurcation_curves: {
            "block": bare,
            "motion": shaking,
            "parameters": ("frequency_ratio", "amplitude"),
            "within": ((3.9, 4.1), (0.1, 1.0)),
            "search": rs.branches.CurveOptions(lines=(1, 0), max_impacts=2, max_period=1),
        },
        rs.branches.find_resting_branches: {
            "block": bare,
            "motion": shaking,
            "parameter": "amplitude",
            "within": (1.0, 1.05),
            "resolution": 0.05,
        },
        rs.branches.follow_resting_branch: {
            "origin": t["resting point"],
            "parameter": "amplitude",
            "within": (1.0, 1.06),
            "resolution": 0.03,
        },
        t["resting branch"].at: {"value": 1.05},
        t["resting branch"].value: {"point": t["resting point"]},
        rs.branches.RestingGap: fields(t["resting"].gaps[0]),
        rs.branches.Excursion: fields(t["resting point"].excursions[0]),
        rs.branches.follow_branch: {"origin": t["orbit"], **near, "most_points": 5},
    }
