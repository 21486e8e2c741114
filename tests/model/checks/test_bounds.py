"""Rules in annotations: what they return, where they stand, and that defaults keep them."""

import ast
import dataclasses
import inspect
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.formulas import housner_restitution, impact_restitution
from rocksteady.model.blocks.caps import Cap
from rocksteady.model.blocks.sides import Side
from rocksteady.model.checks.bounds import (
    MASS,
    RESTITUTION,
    Bounds,
    Whole,
    length,
    restitution_of_wall,
)
from rocksteady.model.motions.synthetic import SyntheticMotion
from rocksteady.motions import (
    BandNoise,
    Floor,
    FourierSeries,
    Impulses,
    Segment,
    make_synthetic_suite,
)
from tests.trees import tree_of
from tools.namespace import THINGS

SOURCES = Path(rs.__file__).parent
CHECKED = {"checked", "checked_result"}


def test_a_rule_returns_plain_numbers_of_its_interval_alone() -> None:
    share = Bounds(0.0, 1.0, "[)", "give a share")
    given: object
    for given in (0, 0.0, 0.5, np.float32(0.5)):
        assert (type(share("part", given)), share("part", given)) == (float, given)
    for given in (1.0, -0.1, math.nan, math.inf, True, "0.5", None):
        with pytest.raises(
            rs.errors.InputError, match=r"part = .*it must lie in \[0, 1\); give a share"
        ):
            share("part", given)
    some = Whole(1, None, "give a number")
    assert type(some("count", np.int8(3))) is int
    for given in (0, 1.0, None):
        with pytest.raises(
            rs.errors.InputError, match="a whole number of 1 or above; give a number"
        ):
            some("count", given)
    with pytest.raises(rs.errors.InputError, match="a whole number from 0 to 2; give 1"):
        Whole(0, 2, "give 1")("count", 3)
    with pytest.raises(rs.errors.InputError, match=r"width = 0 .* \[1e-50, 1e\+50\]; give metres"):
        length("give metres")("width", 0)


def test_a_wall_may_keep_nothing_and_the_base_may_not() -> None:
    assert math.copysign(1.0, restitution_of_wall("restitution", -0.0)) == 1.0
    with pytest.raises(rs.errors.InputError, match="take sqrt"):
        RESTITUTION("restitution", 0.0)


def _ruled(arguments: ast.arguments) -> list[str]:
    every = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
    return [each.arg for each in every if "Annotated[" in ast.unparse(each.annotation or each)]


def test_rules_stand_only_where_they_are_enforced() -> None:
    loose = []
    for path in sorted(SOURCES.rglob("*.py")):
        if path.relative_to(SOURCES).parts[0] in ("cli", "kernels") or path.stem == "command":
            continue  # flags of typer, arrays of kernels
        holders: list[tuple[ast.AST, bool]] = [(tree_of(path), False)]
        for holder, inside in holders:
            for node in ast.iter_child_nodes(holder):
                if not isinstance(node, ast.ClassDef | ast.FunctionDef):
                    continue
                checked = bool(CHECKED & {ast.unparse(each) for each in node.decorator_list})
                private = node.name.startswith("_") and node.name not in ("__init__", "__call__")
                if isinstance(node, ast.ClassDef):
                    holders.append((node, checked))
                    texts = [
                        ast.unparse(each) for each in node.body if isinstance(each, ast.AnnAssign)
                    ]
                    found = any("Annotated[" in text for text in texts)
                else:
                    checked = checked or (inside and not private)
                    found = bool(_ruled(node.args))
                if found and not checked:
                    loose.append(f"{path.relative_to(SOURCES)}: {node.name}")
    assert loose == []


def test_defaults_are_what_their_rules_would_make_of_them() -> None:
    seen = 0
    for name, kind in THINGS.items():
        if not (inspect.isclass(kind) and dataclasses.is_dataclass(kind)):
            continue
        for field in dataclasses.fields(kind):
            rules = [rule for rule in getattr(field.type, "__metadata__", ()) if callable(rule)]
            if rules and field.default is not dataclasses.MISSING and field.default is not None:
                kept = rules[0](field.name, field.default)
                assert (type(kept), kept) == (type(field.default), field.default), (
                    name,
                    field.name,
                )
                seen += 1
    assert seen > 25


BLOCK = rs.Block.rectangle(width=0.4, height=1.2)
BODY: dict[str, Any] = {"alpha": 0.2, "radius": 1.0, "p": 2.0, "restitution": 0.9}
"""A side of a block."""
WAVE: dict[str, Any] = {"amplitude": 1.0, "frequency_ratio": 2.0}
SHAPED: dict[str, Any] = {
    "shape": "mavroeidis-papageorgiou",
    "amplitude": 1.0,
    "frequency_ratio": 2.0,
}
STRETCH: dict[str, Any] = {"duration": 1.0, "frequency": 1.0, "amplitude": 1.0}
NOISE: dict[str, Any] = {"rms": 0.1, "band": (1.0, 5.0), "duration": 20.0, "seed": 1}
GROUND: dict[str, Any] = {"rms": 0.1, "frequency_ratio": 6.0, "duration": 5.0, "seed": 1}
SAMPLES: dict[str, Any] = {"acceleration_m_s2": [0.0, 1.0, 0.0], "dt_s": 0.1}
SLOW = Floor(frequencies_hz=0.001, damping=0.9)
HALF_TURN = 0.5 * math.pi


RANGES: list[tuple[Callable[[Any], object], str, float, float, str]] = [
    (lambda x: rs.DimensionlessBlock(restitution=x), "restitution", 0.0, 1.0, "(]"),
    (
        lambda x: rs.DimensionlessBlock(restitution=x, one_sided=True),
        "restitution", 0.0, 1.0, "[]",
    ),
    (
        lambda x: rs.DimensionlessBlock(restitution=0.9, negative_restitution=x),
        "negative_restitution", 0.0, 1.0, "(]",
    ),
    (
        lambda x: rs.DimensionlessBlock(restitution=0.9, alpha_ratio=x),
        "alpha_ratio", 0.01, 100.0, "[]",
    ),
    (lambda x: rs.DimensionlessBlock(restitution=0.9, p_ratio=x), "p_ratio", 0.01, 100.0, "[]"),
    (lambda x: Side(**(BODY | {"alpha": x})), "alpha", 0.0, HALF_TURN, "()"),
    (lambda x: Side(**(BODY | {"radius": x})), "radius", 1e-50, 1e50, "[]"),
    (lambda x: Side(**(BODY | {"p": x})), "p", 1e-6, 1e6, "[]"),
    (lambda x: Side(**(BODY | {"restitution": x})), "restitution", 0.0, 1.0, "(]"),
    (
        lambda x: impact_restitution((0.2, 0.2), (1.0, 1.0), gyration=x),
        "gyration", 1e-50, 1e50, "[]",
    ),
    (
        lambda x: housner_restitution(0.2, gravity=x, radius=1e-50), "gravity", 1e-50, 1e50, "[]"
    ),
    (BLOCK.against_wall, "restitution", 0.0, 1.0, "[]"),
    (BLOCK.with_restitution, "restitution", 0.0, 1.0, "(]"),
    (
        lambda x: rs.Block.rectangle(width=x, height=1e-50, restitution=0.9),
        "width", 1e-50, 1e50, "[]",
    ),
    (lambda x: Cap(columns=4, cap_mass_ratio=x), "cap_mass_ratio", 0.0, 1000.0, "[]"),
    (lambda x: MASS("mass_kg", x), "mass_kg", 0.0, 1e9, "(]"),
    (lambda x: rs.Nonlinear(tolerance=x), "tolerance", 1e-13, 1e-3, "[]"),
    (lambda x: rs.Harmonic(**(WAVE | {"amplitude": x})), "amplitude", 0.0, 1e50, "[]"),
    (
        lambda x: rs.Harmonic(**(WAVE | {"frequency_ratio": x})),
        "frequency_ratio", 0.01, 1e4, "[]",
    ),
    (lambda x: rs.Harmonic(**WAVE, phase=x), "phase", -1e6, 1e6, "[]"),
    (lambda x: Segment(duration=x), "duration", 0.0, 1e6, "(]"),
    (lambda x: Segment(duration=1.0, constant=x), "constant", -1e50, 1e50, "[]"),
    (lambda x: Segment(duration=1.0, slope=x), "slope", -1e50, 1e50, "[]"),
    (lambda x: Segment(duration=1.0, jump=x), "jump", -1e50, 1e50, "[]"),
    (lambda x: Segment(**(STRETCH | {"amplitude": x})), "amplitude", -1e50, 1e50, "[]"),
    (lambda x: Segment(duration=1.0, frequency=x), "frequency", 0.0, 1e4, "[]"),
    (lambda x: Segment(**STRETCH, phase=x), "phase", -1e6, 1e6, "[]"),
    (
        lambda x: Segment(**STRETCH, harmonics=((1, x, 0.0), (2, 1.0, 0.0))),
        "size", -1e50, 1e50, "[]",
    ),
    (lambda x: Segment(**STRETCH, harmonics=((1, 1.0, x),)), "phase", -1e6, 1e6, "[]"),
    (
        lambda x: FourierSeries(amplitude=1.0, frequency_ratio=x, harmonics=((1, 1.0, 0.0),)),
        "frequency_ratio", 0.01, 1e4, "[]",
    ),
    (
        lambda x: FourierSeries(amplitude=1.0, frequency_ratio=x, harmonics=((4, 1.0, 0.0),)),
        "frequency_ratio", 0.01, 2500.0, "[]",
    ),
    (lambda x: rs.Pulse(**(SHAPED | {"amplitude": x})), "amplitude", 0.0, 1e50, "[]"),
    (
        lambda x: rs.Pulse(**(SHAPED | {"frequency_ratio": x})),
        "frequency_ratio", 0.01, 5000.0, "[]",
    ),
    (lambda x: rs.Pulse(**SHAPED, oscillations=x), "oscillations", 1.0, 50.0, "(]"),
    (lambda x: rs.Pulse(**SHAPED, phase=x), "phase", -1e6, 1e6, "[]"),
    (lambda x: rs.Pulse(**SHAPED, tolerance=x), "tolerance", 1e-8, 0.1, "[]"),
    (lambda x: Impulses(velocities=(x,)), "velocities", -1e50, 1e50, "[]"),
    (lambda x: Impulses(velocities=(1.0,), times=(x,)), "times", 0.0, 1e6, "[]"),
    (lambda x: rs.motions.delay(rs.Still(), x), "by", 0.0, 1e6, "[]"),
    (lambda x: rs.motions.cut(rs.Still(), x), "at", 0.0, 1e6, "[]"),
    (lambda x: rs.motions.scale(rs.Harmonic(**WAVE), x), "factor", -1e50, 1e50, "[]"),
    (lambda x: rs.Record(**SAMPLES).scaled(x), "factor", 1.0 / 1e50, 1e50, "[]"),
    (lambda x: rs.Record(**SAMPLES).scaled(-x), "factor", 1.0 / 1e50, 1e50, "[]"),
    (lambda x: rs.Record(**(SAMPLES | {"dt_s": x})), "dt_s", 1e-15, 1e50, "[]"),
    (lambda x: BandNoise(**(NOISE | {"rms": x})), "rms", 0.0, 1e50, "[]"),
    (
        lambda x: BandNoise(rms=0.1, band=(x, 2.0 * x), duration=10.0 / x, seed=1),
        "band", 0.01, 5000.0, "[]",
    ),
    (lambda x: SyntheticMotion(**(GROUND | {"rms": x})), "rms", 0.0, 1e50, "[]"),
    (
        lambda x: SyntheticMotion(**(GROUND | {"frequency_ratio": x})),
        "frequency_ratio", 0.01, 1e4, "[]",
    ),
    (lambda x: SyntheticMotion(**GROUND, filter_damping=x), "filter_damping", 0.01, 1.0, "[]"),
    (lambda x: SyntheticMotion(**GROUND, high_pass_ratio=x), "high_pass_ratio", 0.001, 1.0, "[)"),
    (lambda x: SyntheticMotion(**GROUND, rise=x, decay=0.0), "rise", 0.0, 1.0, "[]"),
    (lambda x: SyntheticMotion(**GROUND, rise=0.25, decay=x), "decay", 0.0, 0.75, "[]"),
    (lambda x: Floor(frequencies_hz=x), "frequencies_hz", 1e-3, 1e4, "[]"),
    (lambda x: Floor(frequencies_hz=1.0, damping=x), "damping", 0.0, 1.0, "()"),
    (
        lambda x: Floor(frequencies_hz=[1.0, 2.0], shapes=[-5.0, x]), "shapes", 5.0, 5.0, "[]"
    ),
    (lambda x: Floor(frequencies_hz=1.0, shapes=x), "shapes", 0.0, 2.5, "[]"),
    (
        lambda x: Floor(frequencies_hz=[1.0, 2.0], shapes=[x, 5.0]), "shapes", -5.0, -2.5, "[]"
    ),
    (
        lambda x: SLOW.motion(rs.Record(**(SAMPLES | {"dt_s": 100.0})), tolerance=x),
        "tolerance", 1e-9, 0.1, "[]",
    ),
    (lambda x: Floor(frequencies_hz=1.0).amplification(x), "frequency_hz", 1.0 / 1e50, 1e50, "[]"),
]  # fmt: skip
"""What takes a number, its argument, the ends of its range, and which of them belong to it."""


def takes(make: Callable[[Any], object], name: str, value: object) -> bool:
    """Return whether a value is taken, or refused for another argument than its own."""
    try:
        make(value)
    except rs.errors.InputError as error:
        return not str(error).startswith((f"{name} = ", "harmonics = "))
    return True


def test_ranges_end_where_they_say_to_the_last_digit() -> None:
    wrong = []
    for make, name, low, high, ends in RANGES:
        rows = [
            (low, ends[0] == "["),
            (math.nextafter(low, -math.inf), False),
            (high, ends[1] == "]"),
            (math.nextafter(high, math.inf), False),
        ]
        if low < high:
            rows += [(math.nextafter(low, math.inf), True), (math.nextafter(high, -math.inf), True)]
        for value, belongs in rows:
            if takes(make, name, value) is not belongs:
                wrong.append((name, value, belongs))
    assert not wrong, wrong


COUNTS: list[tuple[Callable[[Any], object], str, int, int | None]] = [
    (lambda n: Cap(columns=n, cap_mass_ratio=1.0), "columns", 2, 1000),
    (
        lambda n: rs.Block.frame(columns=n, cap_mass_ratio=1.0, width=0.4, height=2.0),
        "columns", 1, 1000,
    ),
    (lambda n: BandNoise(**(NOISE | {"seed": n})), "seed", 0, 2**64 - 1),
    (lambda n: BandNoise(**NOISE, number=n), "number", 0, 2**32 - 1),
    (lambda n: SyntheticMotion(**(GROUND | {"seed": n})), "seed", 0, None),
    (lambda n: make_synthetic_suite(1, seed=n), "seed", 0, None),
    (lambda n: Segment(**STRETCH, harmonics=((n, 1.0, 0.0),)), "order", 1, 64),
    (
        lambda n: FourierSeries.from_samples(
            np.eye(1, 200)[0], frequency_ratio=1.0, orders=n
        ),
        "orders", 1, 64,
    ),
    (lambda n: Floor(frequencies_hz=[1.0] * n, shapes=[0.02] * n), "frequencies_hz", 1, 50),
]  # fmt: skip


def test_counts_end_where_they_say_and_are_whole() -> None:
    wrong = []
    for make, name, low, high in COUNTS:
        rows: list[tuple[object, bool]] = [(low, True), (low + 1, True), (low - 1, False)]
        if high is not None:
            rows += [(high, True), (high + 1, False)]
        if name != "frequencies_hz":
            rows += [(True, False), (float(low + 1), False), (None, name == "orders")]
        for value, belongs in rows:
            if takes(make, name, value) is not belongs:
                wrong.append((name, value, belongs))
    with pytest.raises(rs.errors.InputError, match=r"^count = 1001"):
        make_synthetic_suite(1001)
    with pytest.raises(rs.errors.InputError, match=r"^count = 0"):
        make_synthetic_suite(0)
    assert not wrong, wrong
