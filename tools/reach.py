"""Which functions of the package each check calls, found by tracing it once.

What an earlier check has left in a cache or in a fixture counts as called by each check that reads
it. Calls in other processes and while modules are imported are not seen.
"""

import functools
import json
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import pytest


@dataclass
class Checks:
    """What checks take and call.

    Attributes
    ----------
    seconds
        Of the processor, for each check that passes, tracing included.
    callers
        For each function, as file and first line, the checks that call it.
    """

    seconds: dict[str, float] = field(default_factory=dict)
    callers: dict[str, list[str]] = field(default_factory=dict)

    def reaching(self, file: Path, line: int) -> list[str]:
        """Return the checks that call a function; of line 0, those that call any of its file."""
        if line:
            return self.callers.get(f"{file}:{line}", [])
        own = (found for place, found in self.callers.items() if place.startswith(f"{file}:"))
        return sorted({check for found in own for check in found})

    def write(self, file: Path) -> None:
        """Write the checks as JSON."""
        file.write_text(json.dumps(vars(self)), encoding="utf-8")

    @classmethod
    def read(cls, file: Path) -> "Checks":
        """Read checks that `write` has written."""
        return cls(**json.loads(file.read_text(encoding="utf-8")))


class Reach:
    """A trace of calls, split by check; a plugin of pytest that splits it by test.

    Parameters
    ----------
    tree
        Folder that holds `src` and `tests`.
    """

    def __init__(self, tree: Path) -> None:
        self._sources = f"{tree}/"
        self._now: set[CodeType] = set()
        self._called: dict[str, set[CodeType]] = {}
        self._fixtures: dict[str, set[CodeType]] = {}
        self._seconds: dict[str, float] = {}
        self._failed: set[str] = set()

    def see_memories(self) -> None:
        """Count what has filled a memory as called by each check that reads it.

        The memories are caches of `functools` in modules that are imported later.
        """
        functools.lru_cache = self._lru_cache
        functools.cache = self._lru_cache(maxsize=None)

    @contextmanager
    def check(self, name: str) -> Iterator[None]:
        """Trace a check; one that raises is left out."""
        began, called = time.process_time(), self._called.setdefault(name, set())
        before = sys.gettrace()
        sys.settrace(self._trace)
        threading.settrace(self._trace)
        try:
            with self._into(called):
                yield
        except Exception:  # noqa: BLE001 -- it fails without any change
            self._failed.add(name)
        finally:
            sys.settrace(before)
        self._seconds[name] = time.process_time() - began

    def checks(self) -> Checks:
        """Return what was found."""
        found = Checks({n: took for n, took in self._seconds.items() if n not in self._failed})
        places: dict[CodeType, str] = {}
        for name in found.seconds:
            for code in self._called[name]:
                if code not in places:
                    inside = code.co_filename.startswith(self._sources)
                    file = code.co_filename.removeprefix(self._sources)
                    places[code] = f"{file}:{code.co_firstlineno}" if inside else ""
            for place in {places[code] for code in self._called[name]} - {""}:
                found.callers.setdefault(place, []).append(name)
        return found

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Trace a test, and add what its fixtures have called before."""
        with self.check(item.nodeid):
            result = yield
        for name in getattr(item, "fixturenames", ()):
            self._called[item.nodeid] |= self._fixtures.get(name, set())
        return result

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: pytest.FixtureDef[Any]) -> Iterator[None]:
        """Collect what a fixture calls."""
        with self._into(self._fixtures.setdefault(fixturedef.argname, set())):
            return (yield)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Leave out a test that fails without any change."""
        if report.failed:
            self._failed.add(report.nodeid)

    def _trace(self, frame: FrameType, *_: Any) -> None:
        self._now.add(frame.f_code)

    @contextmanager
    def _into(self, called: set[CodeType]) -> Iterator[None]:
        """Collect what is called in a set of its own, and in the one around."""
        around, self._now = self._now, called
        try:
            yield
        finally:
            around |= called
            self._now = around

    def _lru_cache(self, maxsize: Any = 128, typed: bool = False) -> Any:
        """Stand in for `functools.lru_cache`, and count what filled a memory as called again."""
        if callable(maxsize):
            return self._lru_cache()(maxsize)

        def remembering(function: Callable[..., Any]) -> Callable[..., Any]:
            memory: Any = REMEMBER(maxsize, typed)(function)
            called: set[CodeType] = set()

            @functools.wraps(function)
            def read(*arguments: Any, **named: Any) -> Any:
                with self._into(called):
                    return memory(*arguments, **named)

            for name in ("cache_clear", "cache_info", "cache_parameters"):
                setattr(read, name, getattr(memory, name))
            return read

        return remembering


REMEMBER = functools.lru_cache


class Chosen:
    """A plugin of pytest that runs some tests, in the order given.

    Parameters
    ----------
    names
        Names of tests, as pytest shows them.
    """

    def __init__(self, names: list[str]) -> None:
        self.order = {name: number for number, name in enumerate(names)}

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Keep the chosen tests."""
        kept = [item for item in items if item.nodeid in self.order]
        items[:] = sorted(kept, key=lambda item: self.order[item.nodeid])
