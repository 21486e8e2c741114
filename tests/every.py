"""Many cases in one test: `every` in place of parametrize, where cases differ in data only."""

import functools
import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from typing import Any

import pytest

SHOWN = 20
FAILURES = (Exception, pytest.fail.Exception)
SKIPS = pytest.skip.Exception


def every(names: str | Sequence[str], cases: Iterable[Any]) -> Callable[[Callable[..., None]], Any]:
    """Check all cases in one test, which names those that fail.

    Takes what `pytest.mark.parametrize` takes.  A case of its own costs some milliseconds in each
    worker, to collect, to set up and to report, whatever it checks.  Each has a folder and patches
    of its own here; other fixtures of a test are shared by its cases.  The test is skipped where
    all its cases are, or where there is none.
    """
    wanted = [name.strip() for name in names.split(",")] if isinstance(names, str) else list(names)
    rows = [_values(case, len(wanted)) for case in cases]

    def over(check: Callable[..., None]) -> Callable[..., None]:
        @functools.wraps(check)
        def test(**fixtures: Any) -> None:
            failed: list[tuple[str, BaseException]] = []
            skipped = ["there is no case"] if not rows else []
            for number, row in enumerate(rows):
                try:
                    with _own(fixtures, number) as own:
                        check(**dict(zip(wanted, row, strict=True)), **own)
                except SKIPS as skip:  # the other cases are checked all the same
                    skipped.append(str(skip))
                except FAILURES as error:
                    failed.append((", ".join(map(repr, row)), error))
            if failed:
                lines = [f"{row}: {str(error).strip() or type(error)}" for row, error in failed]
                listed = "\n".join(lines[:SHOWN])
                raise AssertionError(
                    f"{len(failed)} of {len(rows)} cases fail\n{listed}"
                ) from failed[0][1]
            if len(skipped) >= len(rows):
                pytest.skip(skipped[0])

        signature = inspect.signature(check)
        rest = [parameter for name, parameter in signature.parameters.items() if name not in wanted]
        assert len(rest) == len(signature.parameters) - len(wanted), f"no parameters {wanted}"
        test.__signature__ = signature.replace(parameters=rest)  # type: ignore[attr-defined]
        return test

    return over


@contextmanager
def _own(fixtures: Mapping[str, Any], number: int) -> Iterator[dict[str, Any]]:
    """Yield the fixtures of one case."""
    own = dict(fixtures)
    with ExitStack() as stack:
        if "tmp_path" in own:
            own["tmp_path"] /= f"case{number}"
            own["tmp_path"].mkdir()
        if "monkeypatch" in own:
            own["monkeypatch"] = stack.enter_context(own["monkeypatch"].context())
        if "capsys" in own:
            own["capsys"].readouterr()
        yield own


def _values(case: Any, count: int) -> tuple[Any, ...]:
    """Return a case's values; `pytest.param` has them inside, and a single one stands alone."""
    if isinstance(case, type(pytest.param())):
        assert not case.marks, "a marked case stays one of its own"
        return tuple(case.values)
    return tuple(case) if count > 1 else (case,)
