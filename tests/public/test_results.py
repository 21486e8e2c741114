"""What every result has: rows of a data frame, whose columns are numeric, and its model."""

import copy
import dataclasses
import functools
import importlib
import inspect
import json
import pickle
import pkgutil
from collections.abc import Callable, Iterator
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes

import rocksteady as rs
from rocksteady.results import result as results
from rocksteady.results.result import Result
from rocksteady.sweep.cases.accessor import KINDS, kind_of
from tests.every import every
from tests.public.things import things
from tools.namespace import THINGS

NUMBERS: dict[str, tuple[Callable[[Any], Any], str]] = {
    "basins": (lambda found: found.label.ravel(), "label"),
    "boundaries": (lambda found: [found.kind.item()], "kind"),
    "cascade": (lambda found: found.values, "amplitude"),
    "course": (lambda found: found.velocity_m_s, "velocity_m_s"),
    "curve": (lambda found: found.peak, "peak"),
    "erosion": (lambda found: found.integrity_factor, "integrity_factor"),
    "fragility_curve": (lambda found: [row[2] / row[1] for row in found.stripes], "share"),
    "neighbours": (lambda found: [each.peak for each in found.cases], "peak"),
    "orbit": (lambda found: [state.speed for state in found.states], "speed_per_pivot_time"),
    "pushed": (lambda found: [found.friction_needed], "friction_needed"),
    "regions": (lambda found: found.heteroclinic, "heteroclinic"),
    "response": (lambda found: found.pseudo_velocity_m_s, "pseudo_velocity_m_s"),
    "quick": (lambda found: [found.median_pgv_m_s], "median_pgv_m_s"),
    "screens": (lambda found: [row.verdict for row in found.rows], "verdict"),
    "set": (lambda found: [found.horizontal[0].record.dt_s], "dt_s"),
    "steady": (lambda found: found.angle, "angle"),
    "trail": (lambda found: [each.peaks[1] for each in found.attractors], "lowest"),
    "windows": (lambda found: found.low[np.isfinite(found.low)], "low"),
}
"""By name of a thing: what one of its columns holds."""
HISTORY = ("acceleration", "velocity", "displacement")


@pytest.fixture(scope="module", name="made")
def _made() -> dict[str, Any]:
    return things()


@pytest.mark.slow
@every("name", NUMBERS)
def test_a_column_has_the_numbers_of_the_result(name: str, made: dict[str, Any]) -> None:
    numbers, column = NUMBERS[name]
    result = made[name]
    assert result.to_dataframe()[column].tolist() == pytest.approx(list(numbers(result)))


def test_every_result_has_rows_and_no_column_mixes_numbers_with_other_things(
    made: dict[str, Any],
) -> None:
    results = {name: each for name, each in made.items() if isinstance(each, Result)}
    assert set(NUMBERS) < set(results)
    for name, result in results.items():
        frame = result.to_dataframe()
        assert len(frame) > 0, name
        assert frame.columns.is_unique, name
        assert [str(column) for column in frame] == list(frame), name
        for column in (column for column in frame if frame[column].dtype.kind == "O"):
            kinds = {type(value) for value in frame[column].dropna()}
            assert kinds <= {str} or kinds == {bool}, (name, column, kinds)


def test_json_holds_the_values_of_every_result(made: dict[str, Any]) -> None:
    for name, result in made.items():
        if isinstance(result, Result):
            values = result.to_dict()
            assert json.loads(json.dumps(values, allow_nan=False)) == values, name


def test_a_table_of_any_result_that_is_cut_keeps_its_worst_rows(made: dict[str, Any]) -> None:
    ranked, counted = set(), set()
    for name, result in made.items():
        known = isinstance(result, xr.Dataset) and kind_of(result)
        content = result.rocksteady.describe() if known else None
        if isinstance(result, Result):
            content = result.describe()
        for whole in content.tables if content else ():
            if len(whole.rows) < 2:
                continue
            table = dataclasses.replace(whole, most=len(whole.rows) // 2, alarm="")
            left = len(whole.rows) - table.most
            assert f"{left:,} more row" in table.remark, name
            if table.severity is None:
                assert table.shown == list(table.rows[: table.most]), name
            else:
                ranked.add(name)
                expected = sorted(map(table.severity, table.rows), reverse=True)[: table.most]
                assert list(map(table.severity, table.shown)) == expected, name
            if table.kind is not None:
                counted.add(name)
                kinds = table.remark.partition(": ")[2].split(", ")
                assert sum(int(each.split()[0].replace(",", "")) for each in kinds) == left, name
    assert {"facade runs", "spectrum", "windows"} <= ranked, ranked
    assert {"facade runs", "spectrum"} <= counted, counted


def test_a_result_without_a_table_is_one_row_of_its_plain_facts(made: dict[str, Any]) -> None:
    record = made["record"]
    found = rs.compute_measures(record)
    values = {key: [value] for key, value in found.to_dict().items()}
    assert found.to_dataframe().to_dict("list") == values
    assert values["pga_m_s2"] == [pytest.approx(np.abs(record.acceleration_m_s2).max())]


def test_no_rows_keep_their_columns(made: dict[str, Any]) -> None:
    frame = rs.find_overturning_windows(
        made["bare"], "half-sine", [8.0], within=(0.1, 0.2)
    ).to_dataframe()
    assert len(frame) == 0
    assert {"frequency_ratio", "low", "high"} <= set(frame)


def test_a_gridded_result_is_a_row_a_cell(made: dict[str, Any]) -> None:
    found = made["map"]
    frame = found.rocksteady.to_dataframe()
    assert len(frame) == found.kind.size
    assert frame.set_index(["amplitude", "frequency_ratio"]).highest.loc[
        (2.0, 3.0)
    ] == pytest.approx(found.highest.sel(amplitude=2.0, frequency_ratio=3.0).item())


def test_a_result_whose_json_names_the_model_has_it(made: dict[str, Any]) -> None:
    results: dict[str, Any] = {n: each for n, each in made.items() if isinstance(each, Result)}
    named = {name: each.to_dict().get("model") for name, each in results.items()}
    models = {name: results[name].model.name for name, model in named.items() if model}
    assert models == {name: model for name, model in named.items() if model}
    assert {"boundaries", "branch", "cascade", "curve", "diagram", "neighbours"} <= set(models)


def test_all_neighbours_are_listed(made: dict[str, Any]) -> None:
    text = made["neighbours"].summary(more=True)
    assert "more rows" not in text
    assert text.count("at-rest") + text.count("overturned") == 26 + 1


MOTIONS = {
    each
    for each in (getattr(rs, name) for name in rs.__all__)
    if isinstance(each, type) and (hasattr(each, "segments") or each in (rs.Record, rs.BaseMotion))
    if each is not rs.histories.Trajectory
}
"""Classes of base motions."""


WITHOUT = {
    "Certificate": "a claim and its verdict, in words",
    "CheckedCertificate": "a verdict, in words",
    "FormulaAssessment": "one number",
    "Posterior": "plots.posterior draws it beside the prior, from the calibration",
    "Prior": "defaults of many objects, in unlike units",
    "Scores": "of some scores large values are good, of others small ones",
    "StoredPosterior": "as Posterior",
    "Validation": "plots.reliability draws it, from the calibration",
}
"""Results that have no picture, and why."""


def classes(kind: Any = Result) -> Iterator[type[Result]]:
    """Yield every class of results that can be made, and no base of several."""
    for each in kind.__subclasses__():
        private = each.__module__.rpartition(".")[2].startswith("_")
        base = each.__subclasses__() and each.__name__ not in THINGS
        if not base and not private and each.__module__[:11] == "rocksteady.":
            yield each
        yield from classes(each)


def test_every_class_of_results_and_motions_has_the_four(made: dict[str, Any]) -> None:
    for module in pkgutil.walk_packages(rs.__path__, "rocksteady."):
        if "__main__" not in module.name:
            importlib.import_module(module.name)
    found = set(classes())
    assert len(found) > 90
    assert {type(each) for each in made.values() if isinstance(each, Result)} <= found
    for kind in found:
        for name in ("summary", "_repr_html_"):
            assert callable(getattr(kind, name)), kind
        assert hasattr(kind, "to_dataframe") or hasattr(kind, "to_dataset"), kind
    own = {kind.__name__ for kind in found if kind.plot is not Result.plot}
    drawn = {kind.__name__ for kind in found} & (own | set(results._plots))
    assert {kind.__name__ for kind in found} - drawn == set(WITHOUT)
    assert not drawn & set(WITHOUT)


def test_every_result_and_every_motion_describes_itself(made: dict[str, Any]) -> None:
    described = {type(each): each for each in made.values() if isinstance(each, Result)}
    assert set(described) >= MOTIONS
    for kind, thing in described.items():
        assert thing.summary(), kind
        page = thing._repr_html_()
        assert page.startswith("<div"), kind
        assert page.endswith("</div>"), kind
        assert kind.__name__ in results._plots or kind not in MOTIONS, kind


@every("kind", sorted(each.__name__ for each in MOTIONS))
def test_the_rows_of_a_motion_are_integrals_of_each_other(kind: str, made: dict[str, Any]) -> None:
    motion = next(each for each in made.values() if type(each).__name__ == kind)
    frame = motion.to_dataframe()
    suffixes = ("_m_s2", "_m_s", "_m") if "t_s" in frame else ("", "", "")
    names = (f"{n}{s}" for n, s in zip(HISTORY, suffixes, strict=True))
    acceleration, velocity, displacement = (frame[name].to_numpy() for name in names)
    steps = np.diff(frame.iloc[:, 0])
    if kind == "Impulses":
        jumps = np.diff(velocity)
        assert jumps[np.abs(jumps) > 1e-12] == pytest.approx(motion.velocities)
    else:
        trapezia = velocity[0] + np.cumsum(steps * (acceleration[1:] + acceleration[:-1]) / 2.0)
        assert velocity[1:] == pytest.approx(trapezia, abs=2e-3 * np.abs(velocity).max() + 1e-15)
    trapezia = displacement[0] + np.cumsum(steps * (velocity[1:] + velocity[:-1]) / 2.0)
    margin = 5e-3 * np.abs(displacement).max() + 1e-15
    assert displacement[1:] == pytest.approx(trapezia, abs=margin)


@pytest.fixture(scope="module", name="drawable")
def _drawable(made: dict[str, Any]) -> dict[str, Any]:
    """One result of each kind of which there is a picture."""
    drawable: dict[str, Any] = {
        type(each).__name__: each for each in made.values() if isinstance(each, Result)
    }
    grids = [each for each in made.values() if isinstance(each, xr.Dataset)]
    drawable |= {kind_of(each): each for each in grids if kind_of(each)}
    drawable["rocking spectrum"] = made["spectrum"]  # of one record, as a picture is
    block, motion = (
        rs.DimensionlessBlock(restitution=0.87),
        rs.Harmonic(amplitude=3.0, frequency_ratio=4.2),
    )
    drawable["fate map"] = rs.map_fates(
        block, motion, axes={"phase": [0.0, 3.0], "velocity": [0.0, 0.5]}, cycles=5
    )
    search = rs.branches.CurveOptions(orders=(3,), lines=(1, 1), max_impacts=2, max_period=3)
    curves = rs.find_bifurcation_curves(
        block, motion, within=((4.4, 5.4), (2.5, 4.0)), search=search
    )
    drawable["BifurcationCurve"] = curves.curves[0]
    drawable["RegionBoundaries"] = rs.orbits.compute_region_boundaries([3.0, 4.0], 0.8)
    drawable["BasinEntropies"] = made["shares"].entropies(3)
    few = rs.basins.SamplingOptions(angles=[0.0, 0.3, 0.6], velocities=[0.0, 0.4], max_cycles=100)
    shares = rs.basins.compute_basin_shares(block, motion, "amplitude", [1.0, 1.1], sampling=few)
    drawable["BasinFamily"] = next(each for each in shares.families if any(each.orbits))
    drawable["BasinAttractor"] = drawable["BasinFamily"].typical
    drawable["Measures"] = rs.compute_measures(made["record"])
    drawable["BasinShare"] = made["basins"].fractions()[0]
    drawable["FateShare"] = made["fates"].fractions()[0]
    drawable["IntegrityDrop"] = rs.basins.IntegrityDrop(
        measure="integrity_factor", level=0.5, low=0.4, high=0.5, above=0.6, below=0.3
    )
    return drawable


SHAPES = {"Block", "DescribedObject", "DimensionlessBlock", "ObjectFacts", "ObjectPrior"}
"""Pictures of a shape, without axes."""


@pytest.mark.slow
@every("kind", sorted(results._plots))
def test_every_result_of_which_there_is_a_picture_draws_it_without_an_argument(
    kind: str, drawable: dict[str, Any]
) -> None:
    thing = drawable[kind]
    axes = thing.rocksteady.plot() if kind in KINDS else thing.plot()
    try:
        assert isinstance(axes, Axes)
        assert axes.has_data()
        assert axes.get_xlabel() or kind in SHAPES
        axes.figure.canvas.draw()
    finally:
        plt.close("all")


def test_one_response_curve_is_drawn_as_a_list_of_one_is(made: dict[str, Any]) -> None:
    drawn = [rs.plots.response(each) for each in (made["curve"], [made["curve"]])]
    try:
        one, other = ([np.asarray(line.get_ydata()) for line in axes.lines] for axes in drawn)
        assert len(one) == len(other) > 1
        for here, there in zip(one, other, strict=True):
            np.testing.assert_array_equal(here, there)
    finally:
        plt.close("all")


def held(thing: Any, seen: dict[int, Any]) -> Iterator[Any]:
    """Yield a thing and all frozen things of the package that it holds."""
    if id(thing) in seen:
        return
    seen[id(thing)] = thing
    if isinstance(thing, list | tuple):
        for item in thing[:200]:
            yield from held(item, seen)
    elif isinstance(thing, dict):
        yield from held(list(thing.values()), seen)
    elif dataclasses.is_dataclass(thing) and not isinstance(thing, type):
        yield thing
        yield from held([getattr(thing, field.name) for field in dataclasses.fields(thing)], seen)


def writable(thing: Any) -> list[str]:
    """Return the fields whose arrays can be written to, of those that are results."""
    found = []
    for field in dataclasses.fields(thing):
        value = getattr(thing, field.name)
        arrays = value if isinstance(value, tuple) else (value,)
        if any(isinstance(each, np.ndarray) and each.flags.writeable for each in arrays):
            found.append(f"{type(thing).__name__}.{field.name}")
    return found


def writable_when_computed(thing: Any) -> list[str]:
    """Return the properties whose arrays can be written to and come again when next read."""
    names = []
    for name in dir(type(thing)):
        if name[0] == "_" or not isinstance(
            inspect.getattr_static(type(thing), name), property | functools.cached_property
        ):
            continue
        try:
            values = [getattr(thing, name) for _ in range(2)]
        except Exception:  # noqa: BLE001 - of some results only
            continue
        first, second = (each if isinstance(each, tuple | list) else (each,) for each in values)
        if any(
            isinstance(array, np.ndarray)
            and array.flags.writeable
            and np.shares_memory(array, again)
            for array, again in zip(first, second, strict=True)
        ):
            names.append(f"{type(thing).__name__}.{name}")
    return names


COPIES: tuple[Callable[[Any], Any], ...] = (
    lambda each: pickle.loads(pickle.dumps(each)),
    copy.copy,
    copy.deepcopy,
)


def test_no_array_of_a_result_or_of_its_copy_can_be_written_to(made: dict[str, Any]) -> None:
    seen: dict[int, Any] = {}
    results = [each for each in held(dict(made), seen) if isinstance(each, Result)]
    assert len(results) > 60
    wrong = {name for each in results for name in writable(each)}
    assert wrong == set()
    wrong = {name for each in results for make in COPIES for name in writable(make(each))}
    assert wrong == set()


def test_no_array_that_a_property_has_computed_can_be_written_to(made: dict[str, Any]) -> None:
    seen: dict[int, Any] = {}
    results = {type(each): each for each in held(dict(made), seen) if isinstance(each, Result)}
    wrong = {name for each in results.values() for name in writable_when_computed(each)}
    assert wrong == set()
    copies = [pickle.loads(pickle.dumps(each)) for each in results.values()]
    assert {name for each in copies for name in writable_when_computed(each)} == set()


@pytest.mark.slow
def test_what_compares_by_value_is_equal_to_its_copies(made: dict[str, Any]) -> None:
    seen: dict[int, Any] = {}
    record = made["record"]
    rows = [[0.0, 0.3], [0.1, 0.8], [1.0, 0.3], [4.0, 0.02]]
    block = rs.Block.rectangle(width=0.4, height=1.8)
    demands = [
        rs.Demand(pga_g=0.3, spectrum=spectrum, spectrum_damping=damping)
        for spectrum, damping in (
            (rows, 0.05),
            (np.array(rows), 0.05),
            (record, None),
            (rs.measures.compute_response_spectrum(record, [0.1, 1.0]), None),
        )
    ]
    floor = rs.codes.SpectrumTable(
        periods_s=[0.0, 0.4, 4.0], values_g=[0.3, 1.2, 0.1], damping=0.05
    )
    more = [*demands, *(rs.screen_block(block, each, friction=0.3) for each in demands)]
    more += [rs.codes.FacadeDemand(slv=floor), made["record demand"]]
    more += [rs.codes.FacadeDemand(slv=made["record demand"])]
    compared = [
        each for each in held([*made.values(), *more], seen) if "__eq__" in vars(type(each))
    ]
    assert len({type(each) for each in compared}) > 20
    copies = [(each, make(each)) for each in compared for make in COPIES]
    assert {type(each).__name__ for each, other in copies if other != each} == set()
    assert {type(each).__name__ for each, other in copies if hash(other) != hash(each)} == set()
    assert demands[0] != demands[2]
    assert demands[0] != rs.Demand(pga_g=0.3)
