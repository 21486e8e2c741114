"""Which functions a check calls: its own, and what filled a cache that it reads."""

import functools
import sys
from pathlib import Path

import pytest

from tools.reach import Checks, Reach

HERE = Path(__file__).resolve()


def counted(value: int) -> int:
    return value + 1


def other(value: int) -> int:
    return counted(value) + 1


def line_of(function: object) -> str:
    return f"{HERE.name}:{function.__code__.co_firstlineno}"  # type: ignore[attr-defined]


def test_a_check_calls_what_filled_the_cache_that_it_reads(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    for name in ("cache", "lru_cache"):
        monkeypatch.setattr(functools, name, getattr(functools, name))  # is what it was, after it
    before = sys.gettrace()
    reach = Reach(HERE.parent)
    reach.see_memories()
    kept = functools.cache(other)
    few = functools.lru_cache(maxsize=1)(counted)
    with reach.check("fills it"):
        assert (kept(1), few(1)) == (3, 2)
    with reach.check("reads it"):
        assert kept(1) == 3
    with reach.check("calls one"):
        counted(1)
    with reach.check("calls nothing"):
        pass
    with reach.check("fails"):
        counted("")  # type: ignore[arg-type]
    assert (kept.cache_info().hits, few.cache_info().hits) == (1, 0)
    assert sys.gettrace() is before
    found = reach.checks()
    assert set(found.seconds) == {"fills it", "reads it", "calls one", "calls nothing"}
    assert found.callers[line_of(other)] == ["fills it", "reads it"]
    assert found.callers[line_of(counted)] == ["fills it", "reads it", "calls one"]
    found.write(tmp_path / "found.json")
    assert Checks.read(tmp_path / "found.json") == found
    assert found.reaching(Path(HERE.name), 0) == ["calls one", "fills it", "reads it"]
    assert found.reaching(Path(HERE.name), 1) == []
