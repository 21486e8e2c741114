"""The statements as a whole: which there are, what they point to, and that none is hard-coded."""

import ast
import json
import math
import pkgutil
import re
from collections import Counter
from importlib import import_module
from pathlib import Path

import pytest

from rocksteady.studies.tso_wong_1989 import claims as package
from rocksteady.studies.tso_wong_1989.claims import _unchecked as unchecked
from rocksteady.studies.tso_wong_1989.claims.findings import Verdict
from rocksteady.studies.tso_wong_1989.claims.statements import STATEMENTS, check
from tests.every import every
from tests.studies.tso_wong_1989.claims import (
    test_equations,
    test_linearised,
    test_regions,
    test_responses,
    test_stability,
    test_time_histories,
    test_transitions,
)
from tests.studies.tso_wong_1989.whole import PANELS, claims, evidence, study

pytestmark = pytest.mark.usefixtures("computed")

MODULES = {
    name: import_module(f"{package.__name__}.{name}")
    for name in sorted(module.name for module in pkgutil.iter_modules(package.__path__))
}
TESTED = {
    "_equations": test_equations,
    "_linearised": test_linearised,
    "_regions": test_regions,
    "_responses": test_responses,
    "_stability": test_stability,
    "_time_histories": test_time_histories,
    "_transitions": test_transitions,
}


def test_there_are_at_least_thirty_that_the_computation_decides() -> None:
    verdicts = Counter(claim.verdict for claim in claims().values())
    assert verdicts[Verdict.REPRODUCED] + verdicts[Verdict.CORRECTED] >= 30
    assert len(claims()) == len(STATEMENTS) == len(study().claims)


def test_the_nine_known_corrections_come_out_of_the_computation() -> None:
    known = [f"E{number}" for number in range(1, 10)]
    assert [claims()[name].verdict for name in known] == [Verdict.CORRECTED] * 9
    assert all(claims()[name].finding.values for name in known), "with the numbers behind them"


def test_every_statement_is_a_sentence_with_a_page_and_an_outcome() -> None:
    for claim in claims().values():
        assert claim.statement.endswith("."), claim.id
        assert claim.statement[0].isupper() or claim.statement.startswith("p "), claim.id
        assert claim.finding.detail.endswith((".", ".)")), claim.id
        assert len(claim.finding.detail) > 40, claim.id
        for text in (claim.statement, claim.finding.detail):
            assert "nan" not in text.split(), claim.id
            assert "  " not in text, claim.id
        assert not re.search(r"\bNone\b|\[\]|\{", claim.finding.detail), claim.id
        assert 89 <= claim.page <= 106, claim.id


def test_names_are_unique_and_fit_for_links() -> None:
    names = [statement.id for statement in STATEMENTS]
    assert len(set(names)) == len(names)
    assert len({statement.text for statement in STATEMENTS}) == len(names)
    for name in names:
        assert name.replace("-", "").replace(".", "").isalnum(), name
        assert name.isascii(), name


def test_every_panel_has_a_statement_and_every_statement_names_panels_that_exist() -> None:
    pointed: set[str] = set()
    for claim in claims().values():
        named = (*claim.figures, *claim.see)
        assert len(set(named)) == len(named), claim.id
        assert set(named) <= set(PANELS), claim.id
        pointed |= set(named)
    assert pointed == set(PANELS)


def test_every_time_history_of_the_paper_has_a_statement_of_its_own() -> None:
    own = {claim.figures[0]: claim for claim in claims().values() if len(claim.figures) == 1}
    assert set(own) >= {name for name in PANELS if not name.startswith(tuple("34567"))}


def test_statements_that_cannot_be_checked_say_why_and_are_few() -> None:
    open_ones = [c for c in claims().values() if c.verdict is Verdict.NOT_CHECKABLE]
    assert {claim.id for claim in open_ones} == {s.id for s in unchecked.STATEMENTS}
    assert len(open_ones) <= 6


def test_the_outcomes_are_what_json_can_hold() -> None:
    from rocksteady.show.export.files import json_text

    for claim in claims().values():
        text = json_text("any", {"values": claim.finding.values})
        assert json.loads(text)["schema"] == "any"
        numbers = [n for n in flat(json.loads(text)) if not isinstance(n, str)]
        assert None not in numbers, f"{claim.id} holds a number that is not finite"


def flat(value: object) -> list[object]:
    if isinstance(value, dict):
        return [item for part in value.values() for item in flat(part)]
    if isinstance(value, list):
        return [item for part in value for item in flat(part)]
    return [value]


# -------------------------------------------------------------------------- nothing is hard-coded


def verdicts_given(source: str) -> list[ast.expr]:
    """The `holds` of every `Finding(...)` in a source."""
    calls = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Call)]
    findings = [c for c in calls if isinstance(c.func, ast.Name) and c.func.id == "Finding"]
    holds = [keyword.value for c in findings for keyword in c.keywords if keyword.arg == "holds"]
    assert len(holds) == len(findings), "a Finding without a holds by name"
    return holds


@every("name", MODULES)
def test_no_verdict_is_written_down(name: str) -> None:
    file = MODULES[name].__file__
    assert file is not None
    for holds in verdicts_given(Path(file).read_text(encoding="utf-8")):
        names = [node for node in ast.walk(holds) if isinstance(node, ast.Name)]
        constant = isinstance(holds, ast.Constant)
        assert constant == (name == "_unchecked"), ast.unparse(holds)
        if constant:
            assert isinstance(holds, ast.Constant)
            assert holds.value is None
        else:
            assert names, f"{ast.unparse(holds)} looks at nothing that was computed"


@every("name", TESTED)
def test_every_statement_has_evidence_on_which_its_verdict_is_the_other(name: str) -> None:
    statements = [statement.id for statement in MODULES[name].STATEMENTS]
    assert set(TESTED[name].FALSE) == set(statements)


def test_checks_are_done_in_order_and_said_once_each() -> None:
    said: list[str] = []
    found = check(evidence(), done=said.append)
    assert said == [statement.id for statement in STATEMENTS]
    assert [claim.id for claim in found] == said
    for claim in found:  # a second time the same
        assert claim.finding.detail == claims()[claim.id].finding.detail
        assert claim.verdict is claims()[claim.id].verdict


def test_numbers_of_the_values_are_finite() -> None:
    for claim in claims().values():
        for value in flat_numbers(claim.finding.values):
            assert math.isfinite(value), claim.id


def flat_numbers(value: object) -> list[float]:
    if isinstance(value, dict):
        return [item for part in value.values() for item in flat_numbers(part)]
    if isinstance(value, list | tuple):
        return [item for part in value for item in flat_numbers(part)]
    return [float(value)] if isinstance(value, int | float) else []
