"""Rules in annotations: what they return, where they stand, and that defaults keep them."""

import ast
import dataclasses
import inspect
import math
from pathlib import Path

import numpy as np
import pytest

import rocksteady as rs
from rocksteady.model.checks.bounds import (
    RESTITUTION,
    Bounds,
    Whole,
    length,
    restitution_of_wall,
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
        if path.relative_to(SOURCES).parts[0] in ("cli", "kernels"):
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
