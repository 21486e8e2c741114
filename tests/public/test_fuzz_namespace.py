"""Junk in every argument of the public namespace: refused in one line, or taken and computed."""

import copy
import inspect
import math
import os
import random
import resource
import shutil
import signal
import warnings
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction as PlainFraction
from itertools import filterfalse, islice
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
import xarray

import rocksteady as rs
from tests.outputs import unrendered
from tests.public import junk
from tests.public.calls import (
    REFUSED_LATER,
    Call,
    calls,
    close_pictures,
    is_recorded,
    public_callables,
    room,
)
from tests.public.things import things
from tests.show.assessment.pages import drawn_once

pytestmark = [
    pytest.mark.filterwarnings("ignore:Animation was deleted"),
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
]

LONGEST = 20.0
"""Seconds of the processor after which a call hangs: those of valid arguments take a tenth of one.
They do not depend on what else the machine does."""

HOLD_NAN = {
    "SteadyStates", "ResponseCurve", "RegionMap", "Boundaries", "Attractor", "Samples", "Fraction",
    "Passage", "Measures", "ResponseSpectrum", "Drop", "BranchPoint", "BasinAttractor",
    "Flights", "Impacts", "Stretch", "Orbit", "Erosion", "Basins", "OverturningWindows", "Peak",
    "OverturningWindow", "IntegratedRecord", "SteadyOrbit", "Trajectory", "AttractorSweep",
    "Neighbour", "Neighbours", "FragilityCurve", "Risk",
    "HazardBranchCheck", "BackAnalysis", "FateBasins", "NoiseFates", "Excursion",
    "RestingBranches", "RestingBranch", "RestingPoint", "RestingGap",
}  # fmt: skip
"""Results: NaN in one says that there is no such value, and their constructors let it pass."""


@pytest.fixture(scope="module", autouse=True)
def _room(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Work in a folder of its own with the files of things, without a screen."""
    before = Path.cwd()
    folder = tmp_path_factory.mktemp("fuzz")
    shutil.copytree(room(), folder, dirs_exist_ok=True)  # made before, perhaps, and elsewhere
    os.chdir(folder)
    mpl.use("Agg")
    yield
    os.chdir(before)


@pytest.fixture(autouse=True)
def _memory() -> Iterator[None]:
    """Allow 16 GB of addresses, so that an exploding size is a `MemoryError` and not a swap."""
    before = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (before_or(before[1], 16 << 30), before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_AS, before)


def before_or(hard: int, wanted: int) -> int:
    """Return a limit that the hard one allows."""
    return wanted if hard == resource.RLIM_INFINITY else min(hard, wanted)


def drawn(chance: random.Random, valid: Any) -> Any:
    """Return a value that is junk, more often than not; `valid` is one that is none."""
    kind = chance.random()
    if kind < 0.7:
        return chance.choice(junk.SCALARS if kind < 0.4 else junk.MADE)()
    if kind < 0.85:
        return chance.choice(list(things().values()))
    if kind < 0.95:
        return type(valid) if kind < 0.9 else [valid]
    return [valid, chance.choice(junk.SCALARS)()]


class Hanging(BaseException):
    """A call has run for too long; no `except Exception` hides it."""


@contextmanager
def no_hanging() -> Iterator[None]:
    """Raise `Hanging` in a call that goes on and on."""

    def hangs(*_: object) -> None:
        raise Hanging

    before = signal.signal(signal.SIGPROF, hangs)
    signal.setitimer(signal.ITIMER_PROF, LONGEST)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


def foreign(call: Call, changed: dict[str, Any], *, valid: bool = False) -> str | None:
    """Return what is wrong with how a call ends; None if nothing is.

    A refusal is wrong where all that is given is `valid`.
    """
    try:
        with warnings.catch_warnings(), no_hanging():
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", message="Animation was deleted")
            warnings.filterwarnings("ignore", message=".*sizes are in metres")  # our own
            found = call(**changed)
            if isinstance(found, Iterator):
                found = list(islice(found, 50))
    except rs.RocksteadyError as error:
        long = "\n" in str(error) or len(str(error)) > 2000
        if long:
            return f"a message of more than a line: {str(error)[:300]!r}"
        return f"refused: {error}" if valid else None
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt):
            raise
        if any(note.startswith("in cell") for note in getattr(error, "__notes__", ())):
            return None  # the caller's own case function fails
        return f"{type(error).__name__} at {place_of(error)}: {str(error)[:150]}"
    return nan_let_in(call, changed, found)


def refused(call: Call) -> str | None:
    """Return the error of a call; None of one that succeeds."""
    try:
        call()
    except rs.RocksteadyError as error:
        return str(error)
    return None


def place_of(error: BaseException) -> str:
    """Return the file and the line of the package where an error was raised."""
    trace, place = error.__traceback__, ""
    while trace is not None:
        file = trace.tb_frame.f_code.co_filename
        if "rocksteady" in file and "arguments.py" not in file:
            place = f"{Path(file).name}:{trace.tb_lineno}"
        trace = trace.tb_next
    return place


def nan_let_in(call: Call, changed: dict[str, Any], found: Any) -> str | None:
    """Return whether NaN went in and came out of what holds none."""
    if call.function.__qualname__.split(".")[0] not in HOLD_NAN and changed:
        given = any(has_nan(value) for value in changed.values())
        if found is not None and given and has_nan(found):
            return "NaN let in"
    return None


def has_nan(value: Any, depth: int = 3) -> bool:
    """Return whether a number, or an array or a list of them, holds NaN."""
    if isinstance(value, float | np.floating):
        return math.isnan(value)
    if isinstance(value, np.ndarray) and value.dtype.kind == "f" and value.size < 10**6:
        return bool(np.isnan(value).any())
    deeper = isinstance(value, list | tuple) and depth > 0
    return deeper and any(has_nan(item, depth - 1) for item in value[:10])


def fuzz(seed: int, count: int) -> Counter[str]:
    """Return the findings of so many calls with junk in one or two arguments."""
    chance = random.Random(seed)
    table = calls()
    labels = sorted(label for label, call in table.items() if call.parameters)
    findings: Counter[str] = Counter()
    verbose = os.environ.get("FUZZ_LOG")
    for number in range(count):
        label = labels[number % len(labels)]
        call = table[label]
        names = chance.sample(
            call.parameters, min(len(call.parameters), 1 if chance.random() < 0.7 else 2)
        )
        changed = {name: drawn(chance, call.arguments.get(name)) for name in names}
        for name in names:
            parameter = inspect.signature(call.function).parameters[name]
            if parameter.kind is inspect.Parameter.VAR_POSITIONAL:
                changed[name] = [*call.arguments[name], changed[name]]
        if verbose:
            with open(verbose, "w", encoding="utf-8") as file:  # noqa: PTH123
                print(number, label, {k: safe(v) for k, v in changed.items()}, file=file)
        wrong = foreign(call, changed)
        if wrong is not None:
            shown = {name: safe(value) for name, value in changed.items()}
            findings[f"{label}: {wrong} <- {shown}"] += 1
        close_pictures()
    return findings


def safe(value: Any) -> str:
    """Return the repr of anything, short."""
    try:
        return repr(value)[:80]
    except Exception:  # noqa: BLE001
        return f"<{type(value).__name__}>"


def test_every_public_callable_has_a_valid_call() -> None:
    handing_on = ("Assessment", "Bifurcation", "BranchPoint", "RestingPoint", "StateFragility")
    apart = {"Store.opened", *(f"{name}.plot" for name in handing_on)}
    assert {label.split(" of ")[0] for label in calls()} == public_callables() - apart


def test_every_valid_call_that_is_not_recorded_succeeds() -> None:
    wrong = {}
    with unrendered(), drawn_once():  # pages have tests of their own
        for label in filterfalse(is_recorded, calls()):
            wrong[label] = foreign(calls()[label], {}, valid=True)
            close_pictures()
    assert {label: what for label, what in wrong.items() if what} == {}


def relatives(value: Any) -> list[Any]:
    """Return the same numbers in other types."""
    if type(value) is int and abs(value) < 128:
        return [np.int8(value), np.array(value, dtype=np.int16)]
    if type(value) is float and math.isfinite(value):
        return [np.longdouble(value), PlainFraction(value), np.array(value)]
    if isinstance(value, list) and value and all(type(item) is float for item in value):
        return [[PlainFraction(item) for item in value], np.array(value, dtype=np.longdouble)]
    return []


@pytest.mark.slow
def test_valid_numbers_of_every_type_are_taken() -> None:
    wrong: dict[str, object] = {}
    for label, call in calls().items():
        for name, value in call.arguments.items():
            others = relatives(value)
            for other in others[len(wrong) % 2 :: 2] or others:
                changed = {name: other}
                wrong[f"{label}: {changed}"] = foreign(
                    call, changed, valid=label not in REFUSED_LATER
                )
                close_pictures()
    assert {label: what for label, what in wrong.items() if what} == {}


def test_results_are_compared_by_identity_and_can_be_kept_in_sets() -> None:
    for name, thing in things().items():
        if isinstance(thing, xarray.Dataset):
            continue
        other = copy.deepcopy(thing)
        assert (thing == other) in (True, False), name
        assert {thing: name}[thing] == name
    run = things()["run"]
    for part in (run, run.impacts, run.flights, run([0.1, 0.2])):
        assert part != copy.deepcopy(part)
        assert {part: 1}[part] == 1


@pytest.mark.parametrize(
    ("label", "changed", "line"),
    [
        (
            "plot_poincare_section of a trajectory",
            {"since": "a"},
            "since = 'a' is not valid: it must be a",
        ),
        ("plot_poincare_section of a trajectory", {"since": [1, 2]}, "since = [1, 2] is not valid"),
        ("plot_poincare_section of a trajectory", {"since": 10**400}, "it must be a finite number"),
        (
            "plot_poincare_section of a trajectory",
            {"since": junk.Vast()},
            "it must be a finite number",
        ),
        ("plot_poincare_section of a trajectory", {"since": math.nan}, "since = nan is not valid"),
        ("Trajectory.base_acceleration", {"pt": 1e308}, "it must lie in [0, 1e+50]"),
        ("Trajectory.base_displacement", {"pt": [0.0, 1e308]}, "it must lie in [0, 1e+50]"),
        ("Trajectory.at_time", {"t_s": 1e308}, "pt = inf is not valid: the trajectory reaches"),
        ("Trajectory.at_time", {"t_s": -1e308}, "pt = -inf is not valid: the trajectory reaches"),
        ("compute_average_acceleration", {"period_s": 1e308}, "period_s = 1e+308 is not valid"),
        ("animate", {"speed": 5e-324}, "speed = 5e-324 is not valid"),
        ("plot_response", {"curves": ()}, "curves = () is not valid: there must be one or more"),
        ("Output", {"units": 3.0}, "units = 3.0 is not valid: it must be a text"),
        ("Axis", {"units": [1.0]}, "units = [1.0] is not valid: it must be a text"),
        ("DimensionlessBlock", {"restitution": junk.Quantity(0.8, "m")}, "it carries a unit"),
        ("DimensionlessBlock", {"restitution": np.ma.masked}, "1 of its 1 elements are masked"),
        ("MatchingOptions", {"threshold": np.array([1.0, 2.0])}, "threshold = array([1., 2.])"),
        ("HilltopSaddle.direction", {"phase": (1.0,)}, "it must be a finite number"),
        ("HilltopSaddle.direction", {"kind": "stabel"}, "it must be 'unstable' or 'stable'"),
        ("RestitutionFit.peaks_of", {"ratios": 0.5}, "ratios = 0.5 is not valid"),
        ("RestitutionFit.peaks_of", {"ratios": (0.9,)}, "there are two impacts"),
        ("ElasticSpectrum", {"tc_star_s": None}, "tc_star_s = None is not valid"),
        ("StoredPosterior.predict", {"tests": range(10**12)}, "tests = range("),
        ("Calibration.predict", {"tests": range(10**12)}, "tests = range("),
        ("HilltopSaddle.at", {"phase": math.inf}, "phase = inf is not valid: it must"),
        ("HilltopSaddle.at", {"phase": [0.0, math.nan]}, "phase = nan is not valid: it must"),
        ("Manifold.nearest", {"angle": -1e300}, "angle = -1e+300 is not valid: it must lie in"),
        ("read_prior", {"path": "\n"}, "\\n"),
        ("simulate", {"block": junk.deep()}, "it must be a Block or a DimensionlessBlock"),
        ("simulate", {"motion": junk.Unshowable()}, "motion = <Unshowable> is not valid"),
    ],
)
def test_the_line_names_what_is_wrong(label: str, changed: dict[str, Any], line: str) -> None:
    call = calls()[label]
    assert foreign(call, changed) is None
    told = refused(call._replace(arguments={**call.arguments, **changed}))
    assert told is not None
    assert line in told


def test_a_curve_through_no_bifurcation_is_refused() -> None:
    with pytest.raises(
        rs.errors.InputError, match="curves = 'end-of-range' is not valid: a curve is"
    ):
        rs.plots.bifurcation_curves([[things()["branch"].points[0]]])


def test_names_of_ten_thousand_characters_make_a_short_line() -> None:
    name = "a" * 10_000
    for make in (
        lambda: rs.sweeps.Axis(name=name, values=[1.0]),
        lambda: rs.sweeps.Output(name=name),
        lambda: rs.map_attractors(things()["bare"], axes={name: [1.0]}),
    ):
        with pytest.raises(rs.errors.InputError) as refusal:
            make()
        assert len(str(refusal.value)) < 500


@pytest.mark.parametrize("seed", [17])
def test_two_thousand_calls_with_junk(seed: int) -> None:
    findings = fuzz(seed, 2_000)
    assert not findings, "\n".join(findings)


@pytest.mark.slow
def test_five_thousand_calls_with_junk() -> None:
    findings = fuzz(1, 5_000)
    assert not findings, "\n".join(findings)
