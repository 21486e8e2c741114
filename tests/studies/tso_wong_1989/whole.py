"""The whole study, computed once for all tests of a process; and evidence tampered with."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any
from unittest.mock import patch

from matplotlib.figure import Figure

from rocksteady.studies.tso_wong_1989 import _study as study_module
from rocksteady.studies.tso_wong_1989._study import Study, TimedPanel, reproduce
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Sample
from rocksteady.studies.tso_wong_1989.claims.findings import Claim, Finding
from rocksteady.studies.tso_wong_1989.claims.statements import STATEMENTS
from rocksteady.studies.tso_wong_1989.figures.fates import Fate
from rocksteady.studies.tso_wong_1989.figures.histories import History
from rocksteady.studies.tso_wong_1989.figures.regions import Plane
from rocksteady.studies.tso_wong_1989.figures.responses import Responses

UNSTABLE = ("8a", "8b", "8c", "9a", "9b", "9c", "11a", "12b", "12c", "12d", "13b", "13c", "13d")
STABLE = ("10", "11b", "12a", "13a")
HISTORIES = (
    *("8a", "8b", "8c", "9a", "9b", "9c", "10", "11a", "11b"),
    *("12a", "12b", "12c", "12d", "13a", "13b", "13c", "13d"),
)
PANELS = ("3a", "3b", "4a", "4b", "5a", "5b", "6a", "6b", "7a", "7b", *HISTORIES)
"""Every figure of the paper that is computed, as the reference results list them."""


@cache
def evidence() -> Evidence:
    return Evidence()


@cache
def finding(name: str) -> Finding:
    """The outcome of one statement on the true evidence."""
    return found(name, evidence())


def values(name: str) -> dict[str, Any]:
    """The numbers behind it."""
    return dict(finding(name).values)


def found(name: str, on: Evidence) -> Finding:
    """The outcome of one statement on any evidence."""
    (statement,) = (statement for statement in STATEMENTS if statement.id == name)
    return statement.check(on)


@cache
def study() -> Study:
    with patch.object(study_module, "Evidence", evidence):
        return reproduce()


@cache
def claims() -> dict[str, Claim]:
    return {claim.id: claim for claim in study().claims}


def undrawn(whole: Study) -> Study:
    """The same study with pictures that cost nothing."""
    panels = tuple(
        TimedPanel(panel=replace(timed.panel, draw=tiny), seconds=timed.seconds)
        for timed in whole.panels
    )
    return replace(whole, panels=panels)


def tiny() -> Figure:
    return Figure(figsize=(0.5, 0.5), dpi=40)


# --------------------------------------------------------------------- evidence that is not true


def sampled(**changes: Any) -> Evidence:
    """Evidence whose random points have other solutions (fields of `SteadyStates`)."""
    return with_sample(replace(evidence().sample, states=replace(states(), **changes)))


def with_sample(sample: Sample) -> Evidence:
    tampered = Evidence()
    tampered.__dict__["sample"] = sample
    return tampered


def states() -> Any:
    return evidence().sample.states


def with_planes(**planes: Any) -> Evidence:
    """Evidence with other planes: figure_3a=..."""
    return replace(evidence(), planes={**evidence().planes, **named(planes)})


def with_responses(**curves: list[Any]) -> Evidence:
    """Evidence in which figures of response curves hold others."""
    tampered: dict[str, Responses] = dict(evidence().responses)
    for name, others in named(curves).items():
        response = replace(tampered[name])
        response.__dict__["curves"] = others
        tampered[name] = response
    return replace(evidence(), responses=tampered)


def with_histories(**sources: str | History) -> Evidence:
    """Evidence in which figures hold the history of another figure: figure_8a="12d"."""
    true = evidence().histories
    others = {
        name: true[source] if isinstance(source, str) else source
        for name, source in named(sources).items()
    }
    return replace(evidence(), histories={**true, **others})


def named(values: Mapping[str, Any]) -> dict[str, Any]:
    return {name.removeprefix("figure_"): value for name, value in values.items()}


def plane(restitution: float, order: int) -> Plane:
    return Plane(id="other", restitution=restitution, order=order)


def higher(fate: Fate, highest: float) -> Fate:
    """A fate whose motion has another peak."""
    return replace(fate, highest=highest)
