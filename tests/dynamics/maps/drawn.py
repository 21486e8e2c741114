"""Random maps, their blocks and motions made by hand, and the comparison of a cell with a call."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rocksteady import Block, DimensionlessBlock, Harmonic, Rest, State, Steady, find_attractor
from rocksteady.dynamics.batch.attractors import KIND_FLAGS
from rocksteady.errors import ModelError
from rocksteady.formulas import housner_restitution

RANGES = {
    "amplitude": (0.4, 5.0),
    "frequency_ratio": (0.7, 7.0),
    "phase": (-9.0, 9.0),
    "acceleration_m_s2": (1.0, 12.0),
    "frequency_hz": (0.3, 4.0),
    "restitution": (0.3, 0.98),
    "negative_restitution": (0.3, 0.98),
    "alpha_ratio": (0.6, 1.6),
    "p_ratio": (0.8, 1.25),
    "width": (0.2, 0.7),
    "height": (0.9, 3.0),
    "alpha": (0.1, 0.5),
    "radius": (0.4, 2.0),
    "p": (1.5, 5.0),
    "angle": (-0.6, 0.6),
    "velocity": (-0.5, 0.5),
    "kick": (1e-6, 0.1),
}
"""From where the values of each axis are drawn."""


@dataclass(frozen=True)
class Case:
    """A map, and what its cells are, by the constructors of block, shaking and start."""

    block: Block | DimensionlessBlock
    shaking: Harmonic | None
    start: Rest | State | Steady
    housner: bool
    axes: dict[str, list[float]]
    fixed: dict[str, float]

    def at(
        self, moved: Mapping[str, float]
    ) -> tuple[Block | DimensionlessBlock, Harmonic, Rest | State | Steady]:
        cell = {**self.fixed, **moved}
        block = self._block(cell)
        return block, self._shaking(block, cell), self._start(cell)

    @property
    def named(self) -> dict[str, Any]:
        """The axes of the public functions."""
        return {**self.axes, **self.fixed} | ({"restitution": "housner"} if self.housner else {})

    def _block(self, cell: Mapping[str, float]) -> Block | DimensionlessBlock:
        base = self.block
        if isinstance(base, DimensionlessBlock):
            unlike = ("negative_restitution", "alpha_ratio", "p_ratio")
            ratios: dict[str, Any] = {name: cell[name] for name in unlike if name in cell}
            return DimensionlessBlock(
                restitution=cell.get("restitution", base.restitution), **ratios
            )
        kept = base.restitution
        if self.housner:
            kept = housner_restitution(
                base.alpha, p=base.p, radius=base.radius, gravity=base.gravity
            )
        rest: Any = {"restitution": cell.get("restitution", kept), "gravity": base.gravity}
        sizes = {"width", "height", "alpha", "radius", "p"} & set(cell)
        if self.housner and sizes:
            rest["restitution"] = "housner"
        if sizes & {"width", "height"}:
            width, height = cell.get("width", base.width), cell.get("height", base.height)
            return Block.rectangle(width=width, height=height, **rest)
        if "p" in sizes:
            return Block.from_p(alpha=cell.get("alpha", base.alpha), p=cell["p"], **rest)
        if sizes:
            alpha, radius = cell.get("alpha", base.alpha), cell.get("radius", base.radius)
            return Block.from_radius(alpha=alpha, radius=radius, **rest)
        side = replace(base.positive, restitution=rest["restitution"])
        return Block(positive=side, negative=side, gravity=base.gravity)

    def _shaking(self, block: Block | DimensionlessBlock, cell: Mapping[str, float]) -> Harmonic:
        shaken = self.shaking or Harmonic(amplitude=0.0, frequency_ratio=1.0)  # replaced below
        a, w = shaken.amplitude, shaken.frequency_ratio
        if isinstance(block, Block):
            moved = Harmonic.from_si(
                block,
                acceleration_m_s2=cell.get("acceleration_m_s2", 1.0),
                frequency_hz=cell.get("frequency_hz", 1.0),
            )
            a = moved.amplitude if "acceleration_m_s2" in cell else a
            w = moved.frequency_ratio if "frequency_hz" in cell else w
        return Harmonic(
            amplitude=cell.get("amplitude", a),
            frequency_ratio=cell.get("frequency_ratio", w),
            phase=cell.get("phase", shaken.phase),
        )

    def _start(self, cell: Mapping[str, float]) -> Rest | State | Steady:
        if isinstance(self.start, Steady):
            return replace(self.start, kick=cell.get("kick", self.start.kick))
        if isinstance(self.start, State):
            angle, velocity = self.start.angle, self.start.velocity
        elif {"angle", "velocity"} & set(cell):
            angle, velocity = 0.0, 0.0
        else:
            return Rest()
        return State(angle=cell.get("angle", angle), velocity=cell.get("velocity", velocity))


def drawn_case(number: int) -> Case:
    """Return a random map of axes, one to four, and fixed parameters that go together."""
    rng = np.random.default_rng(number)
    block: Block | DimensionlessBlock = DimensionlessBlock(restitution=0.8)
    if rng.random() < 0.75:
        block = Block.rectangle(
            width=rng.uniform(0.3, 0.5), height=rng.uniform(1.0, 2.0), restitution=0.85, gravity=9.8
        )
    start = (
        Rest(),
        State(angle=rng.uniform(-0.4, 0.4), velocity=rng.uniform(-0.3, 0.3)),
        Steady(
            branch=int(rng.integers(1, 3)),
            order=int(rng.choice([1, 3])),
            kick=1e-3,
            side=int(rng.choice([-1, 1])),
        ),
    )[rng.integers(3)]
    housner = isinstance(block, Block) and bool(rng.random() < 0.4)
    names = _drawn_names(rng, block, start, housner=housner)
    shaken = {"amplitude", "acceleration_m_s2"} & set(names) and {
        "frequency_ratio",
        "frequency_hz",
    } & set(names)
    shaking = Harmonic(
        amplitude=rng.uniform(1.2, 4.0),
        frequency_ratio=rng.uniform(1.0, 5.0),
        phase=rng.uniform(-4.0, 4.0),
    )
    count = min(len(names), int(rng.integers(1, 5)))
    points = (0, 9, 4, 3, 2)[count]
    return Case(
        block=block,
        shaking=None if shaken and rng.random() < 0.7 else shaking,
        start=start,
        housner=housner,
        axes={name: rng.uniform(*RANGES[name], points).tolist() for name in names[:count]},
        fixed={name: rng.uniform(*RANGES[name]) for name in names[count:]},
    )


def _drawn_names(
    rng: np.random.Generator,
    block: Block | DimensionlessBlock,
    start: Rest | State | Steady,
    *,
    housner: bool,
) -> list[str]:
    """Return names of parameters: at most one of each way in which a thing can be said."""
    groups = [["amplitude"], ["frequency_ratio"], ["restitution"]]
    if isinstance(block, Block):
        groups[0].append("acceleration_m_s2")
        groups[1].append("frequency_hz")
        pairs = (["width", "height"], ["alpha", "radius"], ["alpha", "p"])
        groups += [[name] for name in pairs[rng.integers(3)]]
    if housner:
        groups.remove(["restitution"])
    if isinstance(start, Steady):
        groups.append(["kick"])
    else:
        if isinstance(block, DimensionlessBlock):
            groups += [["negative_restitution"], ["alpha_ratio"], ["p_ratio"]]
        groups += [["phase"], ["angle"], ["velocity"]]
    count = min(int(rng.integers(1, 8)), len(groups))
    chosen = rng.choice(len(groups), size=count, replace=False)
    return [str(rng.choice(groups[place])) for place in chosen]


def same_as_alone(
    cell: Any,
    block: Block | DimensionlessBlock,
    shaking: Harmonic,
    *,
    start: Any,
    cycles: int,
) -> None:
    """Assert that a cell of a map is what `find_attractor` finds, but for rounding on the way."""
    kind = KIND_FLAGS[int(cell.kind)]
    try:
        alone = find_attractor(block, shaking, start=start, max_cycles=cycles)
    except ModelError:
        assert kind == "no-start"
        assert math.isnan(cell.highest)
        return
    if alone.growth > 1e10:  # a rounding chooses where it goes
        return
    assert kind == alone.kind.value
    assert int(cell.period) == (alone.period or 0)
    orbit = alone.orbit
    impacts = 0 if orbit is None else (-1 if orbit.impacts is None else orbit.impacts)
    assert int(cell.impacts) == impacts
    peaks = (math.nan, math.nan) if alone.peaks is None else alone.peaks
    np.testing.assert_allclose([cell.highest, cell.lowest], peaks, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(float(cell.lyapunov), alone.lyapunov, rtol=0.0, atol=1e-8)
    assert int(cell.after) == alone.after
