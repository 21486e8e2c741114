"""The map of the page, its boundaries included, is to the last bit that of the package."""

from typing import Any

import numpy as np
import pytest

from rocksteady import (
    Block,
    DimensionlessBlock,
    Linear,
    Nonlinear,
    Rest,
    State,
    Steady,
    map_attractors,
)
from rocksteady.dynamics.orbits.attractor import KINDS
from rocksteady.formulas import steady_states
from rocksteady.orbits import compute_region_map
from rocksteady.outcomes import AttractorKind
from tests.explorer.in_node import InNode

NOT_COMPUTED = -128
BLOCK = Block.rectangle(width=0.6, height=2.0, restitution=0.9)
MAP = """
const { axisValues, mapTile } = await import(parts('physics/tiles.mjs'));
const numbers = (values) => [...values].map((x) => Number.isNaN(x) ? null : x);
answer(asked.map(({ given, start, window: [w0, w1, a0, a1], counts, log, nested, cycles }) => {
  const ratios = axisValues(kernels, { from: w0, to: w1, count: counts[0], log });
  const amplitudes = axisValues(kernels, { from: a0, to: a1, count: counts[1], log });
  const tile = mapTile(kernels, { given, start, ratios, amplitudes, nested, cycles });
  const columns = Object.entries(tile).map(([name, values]) => [name, numbers(values)]);
  return { ratios: [...ratios], amplitudes: [...amplitudes], ...Object.fromEntries(columns) };
}));
"""
BOUNDARIES = """
const { regionAt, regionBoundaries } = await import(parts('physics/boundaries.mjs'));
const found = regionBoundaries(kernels, asked.ratios, asked.restitution, asked.order);
const plain = Object.fromEntries(Object.entries(found).map(([name, of]) => [name, [...of]]));
const regions = asked.amplitudes.map((a) => asked.ratios.map(
  (_, i) => regionAt(a, found.existence[i], found.sign[i], found.kind[i]),
));
answer({ ...plain, regions });
"""
STARTS: dict[str, tuple[dict[str, Any], Any]] = {
    "rest": ({"kind": "rest"}, Rest()),
    "steady": ({"kind": "steady"}, Steady()),
    "state": (
        {"kind": "state", "angle": -0.35, "velocity": 0.25},
        State(angle=-0.35, velocity=0.25),
    ),
}
RESULTS = ("kind", "period", "impacts", "highest", "lowest")


def tile(start: str, *, seed: int, nonlinear: bool = False, size: int = 10) -> dict[str, Any]:
    """Return what is asked of a tile somewhere in the plane."""
    draw = np.random.default_rng(seed)
    w, a = draw.uniform(0.4, 5.0), draw.uniform(0.01, 1.5)
    given = {
        "amplitude": 0.0,
        "frequencyRatio": 0.0,
        "restitution": draw.uniform(0.5, 0.98),
        "nonlinear": nonlinear,
        "alpha": BLOCK.alpha,
    }
    return {
        "given": given,
        "start": STARTS[start][0],
        "window": [w, w * draw.uniform(1.5, 4.0), a, a + draw.uniform(1.0, 5.0)],
        "counts": [size, size - 1],
        "log": seed % 2 == 1,
        "cycles": 2000,
    }


def assert_equal(asked: dict[str, Any], found: dict[str, Any], start: Any, **more: Any) -> set[int]:
    """Assert that a tile has the cells of the package's map; return their kinds."""
    restitution, nonlinear = asked["given"]["restitution"], asked["given"]["nonlinear"]
    expected = map_attractors(
        BLOCK.with_restitution(restitution)
        if nonlinear
        else DimensionlessBlock(restitution=restitution),
        axes={"amplitude": found["amplitudes"], "frequency_ratio": found["ratios"], **more},
        start=start,
        max_cycles=asked["cycles"],
        model=Nonlinear() if nonlinear else Linear(),
    )
    for name in RESULTS:
        cells = np.array(found[name], dtype=float)
        np.testing.assert_array_equal(cells, expected[name].values.ravel().astype(float), name)
    return set(found["kind"])


@pytest.mark.slow
@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize(("nonlinear", "size"), [(False, 16), (True, 5)])
def test_tiles_are_those_of_map_attractors(
    start: str, nonlinear: bool, size: int, in_node: InNode
) -> None:
    asked = [tile(start, seed=seed, nonlinear=nonlinear, size=size) for seed in range(4)]
    kinds: set[int] = set()
    for one, found in zip(asked, in_node(MAP, asked), strict=True):
        kinds |= assert_equal(one, found, STARTS[start][1])
    assert len(kinds) >= 2, "the windows show something"


def test_a_state_after_an_impact_starts_with_its_phase(in_node: InNode) -> None:
    asked = tile("rest", seed=11)
    asked["start"] = {"kind": "impact", "side": -1, "phase": 4.2, "speed": 0.3}
    [found] = in_node(MAP, [asked])
    assert_equal(asked, found, State(angle=0.0, velocity=-0.3), phase=4.2)


def test_a_nested_tile_leaves_out_the_cells_of_a_coarser_one(in_node: InNode) -> None:
    asked = tile("state", seed=3)
    whole, rest = in_node(MAP, [asked, {**asked, "nested": True}])
    coarse = np.zeros((len(whole["amplitudes"]), len(whole["ratios"])), dtype=bool)
    coarse[::2, ::2] = True
    for name in RESULTS:
        full, finer = (np.array(one[name], float).reshape(coarse.shape) for one in (whole, rest))
        np.testing.assert_array_equal(finer[~coarse], full[~coarse], name)
    assert (np.array(rest["kind"]).reshape(coarse.shape)[coarse] == NOT_COMPUTED).all()


@pytest.mark.parametrize(
    ("restitution", "amplitude"), [(1.0, 0.0), (1.0, 0.9), (0.8, 0.0), (0.8, 30.0)]
)
def test_ends_of_the_parameters(restitution: float, amplitude: float, in_node: InNode) -> None:
    asked = {**tile("state", seed=4, size=6), "counts": [6, 1], "cycles": 100}
    asked["given"]["restitution"] = restitution
    asked["window"][2:] = [amplitude, amplitude]
    [found] = in_node(MAP, [asked])
    assert found["amplitudes"] == [amplitude]
    assert_equal(asked, found, STARTS["state"][1])


def test_without_loss_motions_are_followed_for_200_periods(in_node: InNode) -> None:
    asked = {**tile("rest", seed=2, size=5), "window": [4.0, 9.0, 0.8, 1.6], "log": False}
    asked["given"]["restitution"] = 1.0
    [found] = in_node(MAP, [{name: asked[name] for name in asked if name != "cycles"}])
    kinds = assert_equal({**asked, "cycles": 200}, found, Rest())
    assert KINDS.index(AttractorKind.UNDECIDED) in kinds


def test_logarithmic_axes_have_equal_steps_of_the_logarithm(in_node: InNode) -> None:
    asked = {**tile("rest", seed=1, size=6), "window": [0.5, 32.0, 0.01, 1.0]}
    [found] = in_node(MAP, [asked])
    np.testing.assert_allclose(found["ratios"], 2.0 ** (np.arange(6) - 0.5), rtol=1e-14)
    np.testing.assert_allclose(found["amplitudes"], 10.0 ** (0.4 * np.arange(5) - 1.8), rtol=1e-14)


@pytest.mark.parametrize(("restitution", "order"), [(0.5, 1), (0.925, 1), (0.8, 3), (1.0, 1)])
def test_boundaries_are_those_of_the_package(
    restitution: float, order: int, in_node: InNode
) -> None:
    ratios = [0.01, *np.linspace(0.1, 14.0, 60).tolist(), 9999.0]
    amplitudes = [0.0, 0.3, 0.9, 2.0, 5.0, 40.0]
    found = in_node(
        BOUNDARIES,
        {"ratios": ratios, "restitution": restitution, "order": order, "amplitudes": amplitudes},
    )
    curves = compute_region_map(ratios, restitution, order=order)
    names = {"symmetryBreaking": "symmetry_breaking", "frequencyRatio": "frequency_ratio"}
    for name in ("frequencyRatio", "existence", "sign", "kind", "symmetryBreaking", "heteroclinic"):
        expected = getattr(curves, names.get(name, name))
        number = np.isfinite(expected)  # JSON has no other numbers
        values = np.array(found[name], dtype=float)
        np.testing.assert_array_equal(values[number], expected[number], name)
        assert number.sum() > 50
    states = steady_states(np.array(amplitudes)[:, None], ratios, restitution, order=order)
    np.testing.assert_array_equal(found["regions"], states.region)
