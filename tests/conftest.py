"""How tests run: the seed of Hypothesis, garbage, Ctrl-C, and the line on what was skipped."""

import gc
import os
import signal
import sys
from collections import Counter
from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, settings

COMPILED = settings(
    # No deadline: the first call of a kernel compiles it, and a machine may have much else to do.
    deadline=None,
    # The same examples in each run, so that no run fails by chance.
    max_examples=25,
    derandomize=True,
    database=None,
    print_blob=True,
)
settings.register_profile("compiled", COMPILED)
# Without compilation each call is some hundred times slower, so that fewer have to do.
settings.register_profile(
    "plain", COMPILED, max_examples=12, suppress_health_check=[HealthCheck.too_slow]
)
# Other examples in each run, forty times as many: `pytest --hypothesis-profile=search`.
settings.register_profile("search", COMPILED, derandomize=False, max_examples=1000)
PLAIN = os.environ.get("ROCKSTEADY_KERNELS") == "python"
settings.load_profile("plain" if PLAIN else "compiled")
# Compiled kernels repeat the recorded calls in tests/installation/test_check.py.
collect_ignore = [] if PLAIN else ["kernels/test_recorded_calls.py"]


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with the tests of targets, whose fixture compiles for a minute in one process."""
    items.sort(key=lambda item: "built" not in getattr(item, "fixturenames", ()))


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Iterator[None]:
    """Collect without looking for garbage, and never look through what collecting has made.

    Python looks through all that lives each time: some hundred thousand objects of the tests.
    """
    gc.disable()
    yield
    gc.freeze()
    gc.enable()
    gc.set_threshold(20_000, 20, 20)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol() -> Iterator[None]:
    """Restore the settings of Matplotlib after each test."""
    drawing = sys.modules.get("matplotlib")
    before = {} if drawing is None else dict(drawing.rcParams)
    result = yield
    if drawing is not None:
        dict.update(drawing.rcParams, before)
    return result


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Write why tests of a whole run were skipped to build/not-run/tests, which `make` prints."""
    config, stats = terminalreporter.config, terminalreporter.stats
    if config.args_source is not pytest.Config.ArgsSource.TESTPATHS:
        return
    file = config.rootpath / "build" / "not-run" / "tests"
    file.unlink(missing_ok=True)
    why = Counter(skip.longrepr[2].removeprefix("Skipped: ") for skip in stats.get("skipped", []))
    if why:
        file.parent.mkdir(parents=True, exist_ok=True)
        line = ", ".join(f"{count} ({reason})" for reason, count in why.most_common())
        file.write_text(f"{line}; {len(stats['passed']):,} passed\n", encoding="utf-8")


# A script that has started the tests in its background has SIGINT ignored, in all that they start.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
