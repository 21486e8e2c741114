"""Basins of the page against `compute_basins`, cell by cell."""

import functools
from typing import Any

import numpy as np
import pytest

from rocksteady import Block, DimensionlessBlock, Harmonic, Linear, Nonlinear, compute_basins
from rocksteady.dynamics.basins.window import CELLS, HALF_WIDTHS, centred
from rocksteady.dynamics.orbits.attractor import KINDS
from tests.cli.program import rocksteady
from tests.every import every
from tests.explorer.in_node import InNode

BASINS = """
const { emptyCells, labelStates, settleStates } = await import(parts('physics/basins.mjs'));
answer(asked.map(({ given, angles, velocities, cycles, order }) => {
  const cells = emptyCells(angles.length * velocities.length), columns = angles.length;
  for (const places of order) {
    const part = settleStates(kernels, {
      given, cycles, angles: places.map((place) => angles[place % columns]),
      velocities: places.map((place) => velocities[Math.floor(place / columns)]),
    });
    places.forEach((place, k) => {
      for (const name of Object.keys(cells)) cells[name][place] = part[name][k];
    });
  }
  const { label, attractors } = labelStates(kernels, given, cells);
  return {
    label: [...label], attractors, kinds: [...cells.kind],
  };
}));
"""
WHOLE = """
const { START_WINDOW } = await import(parts('kernels/window.mjs'));
const { cellMiddles, settleStates } = await import(parts('physics/basins.mjs'));
const { ATTRACTOR_KINDS } = await import(parts('physics/attractor.mjs'));
const { angle, velocity, columns, rows } = START_WINDOW;
const [across, up] = [cellMiddles(-angle, angle, columns), cellMiddles(-velocity, velocity, rows)];
const places = Array.from({ length: columns * rows }, (_, place) => place);
const { kind } = settleStates(kernels, { given: asked,
  angles: places.map((k) => across[k % columns]),
  velocities: places.map((k) => up[Math.floor(k / columns)]) });
const falls = kind.filter((code) => ATTRACTOR_KINDS[code] === 'overturned').length;
answer({ across: [...across], up: [...up], share: falls / kind.length });
"""
CASES = (  # amplitude, frequency ratio, restitution, alpha of the nonlinear model, half width
    (2.0, 1.9, 0.8, None, 1.2),
    (2.0, 6.0, 0.8, None, 0.6),
    (0.8, 2.0, 0.8, None, 0.9),
    (3.0, 6.5, 0.93, None, 0.9),
    (2.2, 2.3, 0.92, 0.25, 0.7),
    (0.8, 2.0, 0.85, 0.15, 0.8),
)


def asked_of(case: tuple[Any, ...], cells: int) -> dict[str, Any]:
    """Return the basins to compute: a square window, in parts of any order and size."""
    amplitude, ratio, restitution, alpha, width = case
    step = 2.0 * width / cells
    angles = (np.arange(cells) - 0.5 * (cells - 1)) * step
    order = np.random.default_rng(8).permutation(cells * cells)
    return {
        "given": {
            "amplitude": amplitude,
            "frequencyRatio": ratio,
            "restitution": restitution,
            "nonlinear": alpha is not None,
            "alpha": alpha or 0.0,
        },
        "angles": angles.tolist(),
        "velocities": (1.1 * angles).tolist(),
        "cycles": 200,
        "order": [part.tolist() for part in np.array_split(order, 5)],
    }


def test_cells_labels_attractors_and_shares_are_those_of_the_package(in_node: InNode) -> None:
    asked = [asked_of(case, 18 if case[3] else 28) for case in CASES]
    names = set()
    for case, each, found in zip(CASES, asked, in_node(BASINS, asked), strict=True):
        amplitude, ratio, restitution, alpha, _ = case
        block = DimensionlessBlock(restitution=restitution)
        basins = compute_basins(
            Block.from_p(alpha=alpha, p=3.0, restitution=restitution) if alpha else block,
            Harmonic(amplitude=amplitude, frequency_ratio=ratio),
            angles=each["angles"],
            velocities=each["velocities"],
            max_cycles=200,
            model=Nonlinear() if alpha else Linear(),
        )
        assert found["label"] == basins.label.ravel().tolist()
        assert [KINDS[code] for code in found["kinds"]] == [
            basins.attractors[label].kind for label in basins.label.ravel()
        ]
        for attractor, own, fraction in zip(
            basins.attractors, found["attractors"], basins.fractions(), strict=True
        ):
            assert (own["kind"], own["name"]) == (attractor.kind, attractor.name)
            assert own["states"] == fraction.states
            assert own["states"] / basins.label.size == fraction.share
            if attractor.orbit is None:
                assert own["orbit"] is None
                continue
            orbit = attractor.orbit
            assert own["orbit"]["period"] == orbit.period
            # The package follows full equations in lanes, and the page one by one: where Newton's
            # method begins differs, and the last digits do.
            near = functools.partial(pytest.approx, rel=1e-11 if alpha else 0.0, abs=0.0)
            assert (own["orbit"]["highest"], own["orbit"]["lowest"]) == near(
                (orbit.highest, orbit.lowest)
            )
            assert own["orbit"]["states"] == [
                near({"side": state.side, "phase": state.phase, "speed": state.speed})
                for state in orbit.states
            ]
        names |= {attractor.name for attractor in basins.attractors}
    assert names >= {"overturned", "rest", "symmetric-1", "symmetric-3", "unsymmetric-1a"}, names


def test_states_that_are_not_computed_have_no_label(in_node: InNode) -> None:
    asked = asked_of(CASES[0], 16)
    computed = asked["order"][0]
    (found,) = in_node(BASINS, [{**asked, "order": [computed]}])
    assert {place for place, label in enumerate(found["label"]) if label >= 0} == set(computed)
    assert sum(attractor["states"] for attractor in found["attractors"]) == len(computed)


@every(
    "flags,alpha",
    [
        ("-A 0.5 -W 2 -r 0.8", None),
        ("-A 2 -W 6 -r 0.8", None),
        ("-A 0.3 -W 3.7 -r 0.95", None),
        ("-A 1.7 -W 2.9 -r 0.85 --alpha-rad 0.3 --radius-m 1", 0.3),
    ],
)
def test_the_share_of_the_page_is_that_of_the_terminal(
    flags: str, alpha: float | None, in_node: InNode
) -> None:
    """The page's kernels, in node, and `rocksteady basins` with its defaults."""
    _, amplitude, _, ratio, _, restitution, *_ = flags.split()
    given = {
        "amplitude": float(amplitude),
        "frequencyRatio": float(ratio),
        "restitution": float(restitution),
        "nonlinear": alpha is not None,
        "alpha": alpha or 0.0,
    }
    page = in_node(WHOLE, given)
    axes = [centred(reach, count) for reach, count in zip(HALF_WIDTHS, CELLS, strict=True)]
    assert [page["across"], page["up"]] == [axis.tolist() for axis in axes]
    fractions = rocksteady(f"basins {flags} --json").json["fractions"]
    (share,) = [part["share"] for part in fractions if part["kind"] == "overturned"]
    assert page["share"] == share
