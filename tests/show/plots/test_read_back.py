"""Numbers of every picture, read back from what is drawn and compared with the result."""

import contextlib
import dataclasses
import math
from collections.abc import Callable, Iterator
from datetime import UTC, datetime
from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

import rocksteady as rs
from tests.every import every
from tests.public.things import things
from tools.namespace import THINGS

G = 9.80665


@pytest.fixture(scope="module", name="t")
def _made() -> dict[str, Any]:
    return everything(things())


def everything(things: dict[str, Any]) -> dict[str, Any]:
    """Return one result of every class, and weak shaking, under which blocks stand."""
    made = dict(things)
    made["weak"] = rs.compute_rocking_spectrum(
        made["record"].scaled(0.5), alpha=[0.1, 0.3], periods_s=[1.0, 2.0, 4.0]
    )
    early, late = (
        dataclasses.replace(
            made["recording"],
            start_time=datetime(2020, 1, 1, 0, 0, 0, start, tzinfo=UTC),
            record=made["record"].scaled(factor),
        )
        for start, factor in ((0, 1.0), (250_000, 2.0))
    )
    made["two channels"] = rs.records.RecordSet(name="made", horizontal=(early, late))
    return made


def numbers(axes: Axes) -> Iterator[np.ndarray]:
    """Yield the numbers of one direction of each line, bar, band, set of marks and image."""
    for line in axes.get_lines():
        for data in (line.get_xdata(), line.get_ydata()):
            with contextlib.suppress(TypeError, ValueError):
                yield np.asarray(data, dtype=np.float64).ravel()
    for image in axes.get_images():
        yield _values(image)
    for group in axes.collections:
        yield from np.ma.getdata(np.ma.asarray(group.get_offsets(), dtype=np.float64)).T
        corners = [np.asarray(path.vertices) for path in group.get_paths()]
        yield from np.concatenate(corners or [np.zeros((0, 2))]).T
        yield _values(group)
    bars = [patch.get_extents().transformed(axes.transData.inverted()) for patch in axes.patches]
    yield np.array([end for bar in bars for end in (bar.x0, bar.x1)])
    yield np.array([end for bar in bars for end in (bar.y0, bar.y1)])


def _values(drawn: ScalarMappable) -> np.ndarray:
    """Return what an image or a set of marks is coloured by; nothing where that is one colour."""
    values = drawn.get_array()
    if values is None:
        return np.zeros(0)
    return np.asarray(np.ma.filled(values, np.nan), dtype=np.float64).ravel()


def assert_drawn(axes: Axes, expected: ArrayLike, words: str) -> None:
    """Refuse numbers that no single line, bar, band or image has all of."""
    values = np.asarray(expected, dtype=np.float64).ravel()
    values = np.unique(values[np.isfinite(values)])
    assert values.size, words
    for found in numbers(axes):
        drawn = np.sort(found[np.isfinite(found)])
        if not drawn.size:
            continue
        at = np.clip(np.searchsorted(drawn, values), 1, max(len(drawn) - 1, 1))
        near = np.minimum(
            np.abs(drawn[np.minimum(at, len(drawn) - 1)] - values), np.abs(drawn[at - 1] - values)
        )
        if (near <= 1e-9 + 1e-7 * np.abs(values)).all():
            return
    raise AssertionError(f"{words}: {values[:6]} are not drawn")


def wilson(share: np.ndarray, count: float, z: float = 1.6448536269514722) -> list[np.ndarray]:
    """Return both ends of the interval, as its defining quadratic has them."""
    a, b, c = 1.0 + z * z / count, -(2.0 * share + z * z / count), share**2
    root = np.sqrt(np.maximum(b * b - 4.0 * a * c, 0.0))
    return [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)]


def counted(t: dict[str, Any]) -> tuple[np.ndarray, int]:
    """Return the share of realisations of noise that overturn a block, and their number."""
    draws = t["noise fates"].fate.shape[2]
    return (t["noise fates"].fate == rs.Status.OVERTURNED).sum(axis=2) / draws, draws


def shares_of(t: dict[str, Any]) -> np.ndarray:
    """Return the share of overturned runs of a suite, over the period."""
    fell = t["suite"]["status"] == rs.Status.OVERTURNED
    over = [name for name in fell.dims if name != "period"]
    return np.asarray(fell.mean(over))


def fallen_by_level(fragility: rs.risk.Fragility) -> np.ndarray:
    """Return the share of runs of an ensemble that overturn, at each level."""
    fell = fragility.ensemble["status"] == rs.Status.OVERTURNED
    return np.asarray(fell.mean([name for name in fell.dims if name != "level"]))


def bands_of(fragility: rs.risk.Fragility) -> np.ndarray:
    """Return both ends of the interval of each share that falls."""
    return np.array([[row["low"], row["high"]] for row in fragility.states[-1].rows])


def residuals(t: dict[str, Any]) -> list[float]:
    """Return how many more tests of a record fell than the probabilities expect."""
    rows: dict[str, float] = {}
    for test, p in zip(t["observations"].tests, t["predictions"].p.tolist(), strict=True):
        rows[test.record.name] = rows.get(test.record.name, 0.0) + float(test.fell) - p
    return list(rows.values())


def mixed(share: float) -> float:
    """Return the entropy of two labels of which one has this share [nats]."""
    return -share * math.log(share) - (1.0 - share) * math.log(1.0 - share)


def entropies_of(t: dict[str, Any]) -> list[float]:
    """Return the entropy of the whole window, as one box, at each value."""
    windows = (np.unique(label, return_counts=True)[1] for label in t["shares"].label)
    return [float(-(n / n.sum() * np.log(n / n.sum())).sum()) for n in windows]


def line_of(t: dict[str, Any]) -> np.ndarray:
    """Return the least squares line through the logarithms of what is uncertain."""
    size, share = t["exponent"].size, t["exponent"].uncertain / t["exponent"].total
    return np.exp(np.polyval(np.polyfit(np.log(size), np.log(share), 1), np.log(size)))


def peak_of(t: dict[str, Any]) -> float:
    """Return the PGA of the record [g]."""
    return float(np.abs(t["record"].acceleration_m_s2).max()) / G


Case = Callable[[dict[str, Any]], tuple[dict[str, Any], list[ArrayLike]]]

CASES: dict[str, Case] = {
    "plot_back_analysis": lambda t: (
        {"analysis": t["back analysis"]},
        [t["back analysis"].first_values, t["back analysis"].medians[:1]],
    ),
    "plot_base": lambda t: (
        {"motion": t["run"]},
        [t["run"].base_acceleration(t["run"].times()) * t["run"].block.alpha],
    ),
    "plot_assessment": lambda t: (
        {"assessment": t["assessed runs"]},
        [
            [t["assessed runs"].judged.shaking.level],
            [1.1 * t["assessed runs"].judged.shaking.level],
            [t["assessed runs"].target.share],
            fallen_by_level(t["assessed runs"].fragility),
            bands_of(t["assessed runs"].fragility),
        ],
    ),
    "plot_basin_entropies": lambda t: (
        {"entropies": t["shares"].entropies(3)},
        [t["shares"].values, entropies_of(t)],
    ),
    "plot_uncertainty": lambda t: (
        {"exponent": t["exponent"]},
        [t["exponent"].size, t["exponent"].uncertain / t["exponent"].total, line_of(t)],
    ),
    "plot_rows": lambda t: (
        {"result": t["branch test"]},
        [[float(1.0 - survival) for survival in t["branch test"].survival]],
    ),
    "plot_rows entropy": lambda t: ({"result": t["entropy"]}, [[mixed(0.25)]]),
    "plot_rows share": lambda t: (
        {"result": t["basins"].fractions()[0]},
        [
            [float((t["basins"].label == 0).mean())],
            wilson(np.array([(t["basins"].label == 0).mean()]), t["basins"].label.size),
        ],
    ),
    "plot_channels": lambda t: (
        {"channels": t["two channels"]},
        [
            np.asarray(t["record"].acceleration_m_s2) / G,
            2.0 * np.asarray(t["record"].acceleration_m_s2) / G - 2.2 * 2.0 * peak_of(t),
            0.25 + 0.05 * np.arange(60),
        ],
    ),
    "plot_survey": lambda t: (
        {"survey": t["survey"]},
        [
            [math.atan(0.11 / 0.5)],
            [math.atan(0.2 / 0.5)],
            [math.hypot(0.055, 0.25)],
            [math.hypot(0.1, 0.25)],
        ],
    ),
    "plot_survey tests": lambda t: (
        {"survey": t["observations"]},
        [[0.5 * peak_of(t)], [1.5 * peak_of(t)]],
    ),
    "plot_integrated_record m": lambda t: (
        {"course": rs.compute_measures(t["record"])},
        [np.asarray(t["record"].acceleration_m_s2) / G],
    ),
    "plot_facade_capacity m": lambda t: (
        {"check": t["mechanism"]},
        [[0.0, 1e3 * t["facade"].mechanism.d0_m], [t["facade"].mechanism.a0_g, 0.0]],
    ),
    "plot_steady_regions b": lambda t: (
        {"curves": rs.orbits.compute_region_boundaries([3.0, 4.0], 0.8)},
        [t["regions"].existence, t["regions"].kind, t["regions"].sign],
    ),
    "plot_basin_shares": lambda t: (
        {"shares": t["shares"]},
        [
            t["shares"].values,
            np.cumsum(
                [
                    100.0 * (t["shares"].label == label).mean(axis=(1, 2))
                    for label in range(t["shares"].label.max() + 1)
                ],
                axis=0,
            )[-1],
        ],
    ),
    "plot_basins": lambda t: ({"basins": t["basins"]}, [t["basins"].label]),
    "plot_bifurcation_curves": lambda t: (
        {"curves": t["curves"]},
        [*t["curves"].curves[0].values.T],
    ),
    "plot_bifurcations": lambda t: (
        {"diagram": t["branch"]},
        [t["branch"].values, [point.peaks[0] for point in t["branch"].points]],
    ),
    "plot_facade_capacity": lambda t: (
        {"check": t["facade check"]},
        [[0.0, 1e3 * t["facade"].mechanism.d0_m], [t["facade"].mechanism.a0_g, 0.0]],
    ),
    "plot_cascade": lambda t: (
        {"cascade": t["cascade"]},
        [np.abs(np.diff(t["cascade"].values)), np.arange(len(t["cascade"].values) - 1)],
    ),
    "plot_edge_state": lambda t: (
        {"edge": t["edge"]},
        [t["edge"].angle, t["edge"].velocity, [t["edge"].start.velocity]],
    ),
    "plot_erosion": lambda t: (
        {"erosion": t["erosion"]},
        [t["erosion"].amplitude, t["erosion"].radius / t["erosion"].still_radius],
    ),
    "plot_facade_runs": lambda t: (
        {"runs": t["facade runs"]},
        [t["facade runs"].share[:, 0][~t["facade runs"].beyond_d0[:, 0]]],
    ),
    "plot_fatal_kicks": lambda t: (
        {"kicks": t["kicks"]},
        [
            t["kicks"].first[::2] * t["block"].alpha * G / t["block"].p,
            t["kicks"].time_pt / t["block"].p,
        ],
    ),
    "plot_fate_basins": lambda t: ({"fates": t["fates"]}, [t["fates"].still_safe]),
    "plot_fragility": lambda t: (
        {"fragility": t["fragility"]},
        [t["levels"].levels, fallen_by_level(t["fragility"]), bands_of(t["fragility"])],
    ),
    "plot_fragility curve": lambda t: (
        {"fragility": t["fragility_curve"]},
        [[1 / 15, 9 / 15, 14 / 15], [0.2, 0.4, 0.8]],
    ),
    "plot_free_rocking": lambda _: (
        {"restitutions": [0.8], "impacts": 3},
        [rs.formulas.free_rocking_peaks(0.9, 0.8, 3)],
    ),
    "plot_husid": lambda t: (
        {"course": t["course"]},
        [t["course"].arias_m_s / t["course"].arias_m_s[-1], t["course"].t_s],
    ),
    "plot_test_ladders": lambda t: (
        {"calibration": t["calibration"]},
        [[test.gain] for test in t["observations"].tests],
    ),
    "plot_learning": lambda t: (
        {"calibration": t["calibration"]},
        [[row["tests"] for row in t["validation"].learning]],
    ),
    "plot_manifolds": lambda t: (
        {"manifolds": t["manifold"]},
        [part for each in t["manifold"].branches for part in (each.first, each.second)],
    ),
    "plot_outcomes": lambda t: ({"dataset": t["map"], "by": "peak"}, [t["map"].highest.values]),
    "plot_multipliers": lambda t: (
        {"orbits": [t["orbit"]]},
        [np.asarray(t["orbit"].multipliers).real, np.asarray(t["orbit"].multipliers).imag],
    ),
    "plot_noise_fates": lambda t: (
        {"fates": t["noise fates"]},
        [
            100.0 * counted(t)[0][0],
            100.0 * np.array(wilson(counted(t)[0][0, 1:], counted(t)[1])),
            t["noise fates"].level * t["noise"].rms * t["block"].uplift_acceleration,
        ],
    ),
    "plot_steady_orbit": lambda t: (
        {"orbit": t["steady"]},
        [t["steady"].angle, t["steady"].tau / (2.0 * math.pi)],
    ),
    "plot_share_that_falls": lambda t: (
        {"summary": t["summary"]},
        [100.0 * shares_of(t), t["summary"].period.values],
    ),
    "plot_overturning": lambda t: (
        {"windows": t["windows"]},
        [t["windows"].low, t["windows"].high],
    ),
    "plot_overturning_scales": lambda t: (
        {"scales": t["scales"]},
        [t["scales"].low, t["scales"].high],
    ),
    "plot_phase_portrait": lambda t: (
        {"trajectory": t["run"]},
        [
            t["run"].phase_path()[0] * math.degrees(t["run"].block.alpha),
            t["run"].phase_path()[1] * math.degrees(t["run"].block.alpha) * t["run"].block.p,
        ],
    ),
    "plot_posterior": lambda t: (
        {"calibration": t["calibration"]},
        [
            [row["outline"]]
            for row in t["calibration"].parameters
            if (row["object"], row["parameter"]) == ("vase", "alpha_rad")
        ],
    ),
    "plot_predictions": lambda t: (
        {"predictions": t["predictions"]},
        [[p] for p in t["predictions"].p.tolist()],
    ),
    "plot_steady_regions": lambda t: (
        {"curves": t["regions"]},
        [t["regions"].existence, t["regions"].kind, t["regions"].sign],
    ),
    "plot_reliability": lambda t: (
        {"calibration": t["calibration"]},
        [
            [row["predicted"] for row in t["validation"].reliability],
            [row["observed"] for row in t["validation"].reliability],
        ],
    ),
    "plot_proved_region": lambda t: (
        {"region": t["proved region"]},
        [t["proved region"].grid(500, 500)],
    ),
    "plot_residuals": lambda t: ({"calibration": t["calibration"]}, [residuals(t)]),
    "plot_response": lambda t: (
        {"curves": t["curve"]},
        [t["curve"].frequency_ratio, t["curve"].peak],
    ),
    "plot_response_spectra": lambda t: (
        {"spectra": [t["response"]]},
        [
            t["response"].periods_s,
            (2.0 * math.pi / t["response"].periods_s) ** 2
            * np.abs(t["response"].displacement_m)
            / G,
        ],
    ),
    "plot_restitution": lambda t: (
        {"fit": t["restitution_fit"], "panel": "impacts"},
        [[each.restitution for each in t["restitution_fit"].impacts]],
    ),
    "plot_risk": lambda t: ({"risk": t["risk"]}, [t["hazard"].levels, t["hazard"].rates]),
    "plot_rocking_spectrum": lambda t: (
        {"dataset": t["weak"]},
        [
            t["weak"].period.values,
            np.where(t["weak"].status == 2, np.nan, t["weak"].peak_angle).ravel(),
        ],
    ),
    "plot_safe_basin": lambda t: ({"erosion": t["erosion"], "index": 0}, [t["erosion"].safe[0]]),
    "plot_poincare_section": lambda t: (
        {"motions": [t["orbit"]]},
        [[value] for each in t["orbit"].states for value in (each.speed, each.phase)],
    ),
    "plot_spectrum_map": lambda t: (
        {"dataset": t["weak"]},
        [np.where(t["weak"].status == 2, np.nan, t["weak"].peak_angle)],
    ),
    "plot_floor_spectra": lambda t: (
        {"floors": [t["record"]], "building_period_s": 0.5, "height_ratio": 1.0},
        [
            rs.measures.compute_response_spectrum(
                t["record"], np.geomspace(0.05, 4.0, 60)
            ).acceleration_m_s2
            / t["record"].peak_acceleration_m_s2,
            rs.codes.floor_accelerations(
                np.geomspace(0.05, 4.0, 60), pga_g=1.0, building_period_s=0.5, height_ratio=1.0
            )["EN 1998-1"],
        ],
    ),
    "plot_objects": lambda t: (
        {"table": t["objects"]},
        [
            [row["share"] for row in t["objects"].rows],
            *([row["low"], row["high"]] for row in t["objects"].rows),
        ],
    ),
    "plot_placed_spectra": lambda t: (
        {"shaking": t["placed"], "block": t["block"]},
        [
            t["placed"].placing.spectrum.accelerations_g(np.geomspace(0.05, 4.0, 160)),
            t["placed"].placing.mean_g(np.geomspace(0.05, 4.0, 160)),
            np.array([0.3, 1.1]) * 2.0 * math.pi / t["block"].p,
        ],
    ),
    "plot_plan": lambda t: ({"table": t["on floors"]}, [[0.0], [0.0, 0.5]]),
    "plot_suite_spectrum": lambda t: (
        {"summary": t["summary"]},
        [t["summary"].period.values, t["summary"].peak_angle.sel(quantile=0.5).values.ravel()],
    ),
    "plot_tornado": lambda _: (
        {"rows": [("one", 0.1, 0.4), ("two", 0.25, 0.28)], "base": 0.26},
        [[0.1, 0.4, 0.25, 0.28, 0.26]],
    ),
    "plot_trajectory": lambda t: (
        {"trajectory": t["run"]},
        [t["run"](t["run"].times()).angle * math.degrees(t["run"].block.alpha)],
    ),
    "plot_integrated_record": lambda t: (
        {"course": t["course"]},
        [np.asarray(t["record"].acceleration_m_s2) / G, t["course"].t_s],
    ),
    "plot_integrated_record v": lambda t: (
        {"course": t["course"], "quantity": "velocity"},
        [t["course"].velocity_m_s],
    ),
    "plot_integrated_record d": lambda t: (
        {"course": t["course"], "quantity": "displacement"},
        [t["course"].displacement_m],
    ),
}
"""Arguments and expected numbers of each picture, by the function that draws it."""


@every("name", CASES)
def test_a_picture_holds_the_numbers_of_its_result(name: str, t: dict[str, Any]) -> None:
    given, expected = CASES[name](t)
    draw = THINGS[name.split(maxsplit=1)[0]]
    axes = draw(**given, ax=Figure(figsize=(8.0, 5.0)).add_subplot())
    for place, values in enumerate(expected):
        assert_drawn(axes, values, f"{name}, {place}")


FIRST_ASKED = ("screens", "hazard_curve", "neighbours", "steady_states", "attractor_kinds")
"""Pictures that `test_first_asked` reads back."""


def test_every_picture_of_numbers_is_read_back() -> None:
    """A section of a facade and the block itself show shapes, which tests of their own measure."""
    shapes = {"plot_facade_section", "plot_block"}
    shapes |= {f"plot_{name}" for name in FIRST_ASKED}
    drawn = {name for name in THINGS if name.startswith("plot_")}
    assert {name.split(maxsplit=1)[0] for name in CASES} == drawn - shapes
