"""Orbits that floating point states at random places and in the manual, held against proofs."""

import gc
import re
from collections import Counter
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import arb
from matplotlib import pyplot as plt

import rocksteady as rs
from rocksteady.certify.proofs._balls import precision
from rocksteady.certify.proofs.certificate import harmonic_numbers
from rocksteady.certify.proofs.orbit import Proposal, certify_orbit, prove_orbit
from rocksteady.certify.proofs.region import NONE, Box, verdict_of
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.errors import ModelError
from rocksteady.orbits import SteadyStates
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence
from rocksteady.studies.tso_wong_1989.claims.statements import check

DOCS = Path(__file__).parents[2] / "docs"
CELLS = re.compile(r"^```(?:python|\{code-cell\}.*)\n((?:.*\n)*?)^```", re.MULTILINE)
OPTIONS = re.compile(r"\A---\n(?:.*\n)*?---\n|^[:%].*$", re.MULTILINE)
SEARCHES = re.compile(r"\b(find_(?!overturning|fatal|facade)\w+|follow_branch)\(")


def disagreements(count: int, seed: int) -> tuple[Counter[str], list[str]]:
    """Verdicts on the orbits at random amplitudes, ratios and restitutions, and what differs."""
    random, found = np.random.default_rng(seed), list[Orbit]()
    for _ in range(count):
        amplitude, ratio = random.uniform(0.3, 6.0), random.uniform(1.0, 8.0)
        block = rs.DimensionlessBlock(restitution=random.uniform(0.5, 0.95))
        motion = rs.Harmonic(amplitude=amplitude, frequency_ratio=ratio)
        found += rs.find_orbits(block, motion, max_period=3, seeds=2)
    return proofs(found)


def proofs(orbits: Iterable[Orbit]) -> tuple[Counter[str], list[str]]:
    """Verdicts on the orbits, and what differs from what they state."""
    verdicts, differing = Counter[str](), []
    for orbit in orbits:
        if orbit.rest_phases:
            continue
        try:
            certificate = certify_orbit(orbit)
        except ModelError as error:
            verdicts[error.name] += 1
            continue
        verdicts[certificate.verdict] += 1
        stability = certificate.content["claim"]["stability"] if certificate.proved else ""
        if wrong := difference(certificate.verdict, stability, orbit.admissible, orbit.stable):
            differing.append(f"{certificate.claim}: {wrong} {certificate.reason}")
    return verdicts, differing


def difference(verdict: str, stability: str, admissible: bool, stable: bool) -> str:
    """What a proof says against what is stated; empty for nothing."""
    if verdict != ("proved" if admissible else "refuted"):
        return f"stated {admissible=}, {verdict}"
    return (
        f"stated {stable=}, {stability}" if stability and stable != (stability == "stable") else ""
    )


def solutions(states: SteadyStates, random: np.random.Generator) -> tuple[Counter[str], list[str]]:
    """Verdicts on both branches at up to 100 points of a grid, and what differs."""
    verdicts, differing = Counter[str](), []
    inputs = (states.amplitude, states.frequency_ratio, states.restitution, states.order)
    flat = [each.ravel() for each in np.broadcast_arrays(states.region, *inputs)]
    phases, traces = states.phase.reshape(2, -1), states.trace.reshape(2, -1)
    for k in random.choice(flat[0].size, min(100, flat[0].size), replace=False).tolist():
        region, a, w, r, n = (each[k].item() for each in flat)
        if region == 4:
            with precision(128):
                letter = verdict_of(Box(a, a, w, w), arb(r), n)
            verdicts["no solution"] += 1
            differing += [] if letter == NONE else [f"no solution at {a}, {w}, {r}, {n}"]
            continue
        for branch in (0, 1):
            numbers = harmonic_numbers(a, w, r)
            proof = prove_orbit(Proposal(numbers, (n,), (phases[branch, k].item(),)), 512)
            verdicts[proof.verdict] += 1
            allowed, margin = proof.verdict == "proved", 1 + r * r - abs(traces[branch, k].item())
            if states.admissible is not None:
                allowed = bool(states.admissible.reshape(2, -1)[branch, k])
            at_border = abs(margin) < 1e-12  # in doubles it has no stability
            verdicts["at a bifurcation"] += at_border
            stability = "" if at_border else proof.stability
            if wrong := difference(proof.verdict, stability, allowed, margin > 0 and r < 1):
                differing.append(f"branch {branch + 1} at {a}, {w}, {r}, {n}: {wrong}")
    return verdicts, differing


def test_orbits_of_a_few_random_states_are_proved_as_they_are_stated() -> None:
    verdicts, differing = disagreements(10, 1)
    assert verdicts["proved"] >= 10
    assert differing == []


@pytest.mark.slow
def test_orbits_of_a_thousand_random_states_are_proved_as_they_are_stated() -> None:
    verdicts, differing = disagreements(1000, 3)
    assert verdicts["proved"] >= 2000
    assert differing == []


@pytest.mark.slow
def test_every_orbit_of_the_manual_is_proved_as_it_is_stated(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    pages, found = [], dict[int, Orbit]()
    for page in sorted(DOCS.rglob("*.md")):
        cells = CELLS.findall(page.read_text(encoding="utf-8"))
        if not SEARCHES.search("".join(cells)):
            continue
        pages.append(page.name)
        names: dict[str, object] = {}
        for cell in cells:
            exec(OPTIONS.sub("", cell), names)
        plt.close("all")
        # Also those inside diagrams, attractors and lists.
        found |= {id(each): each for each in gc.get_objects() if isinstance(each, Orbit)}
    assert len(pages) >= 12
    verdicts, differing = proofs(found.values())
    assert verdicts["proved"] >= 70
    assert set(verdicts) <= {"proved", "refuted", "model"}
    assert differing == []


@pytest.mark.slow
def test_every_motion_behind_the_papers_statements_is_proved_as_it_is_stated(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    motions = list[Any]()
    for kind in (SteadyStates, Orbit):
        monkeypatch.setattr(kind, "__init__", recorder(kind.__init__, motions))
    evidence, random = Evidence(), np.random.default_rng(1989)
    for panels in (evidence.planes, evidence.responses, evidence.histories):
        for each in panels.values():
            each.panel()
    check(evidence)
    verdicts, differing = proofs(each for each in motions if isinstance(each, Orbit))
    for each in motions:
        if isinstance(each, SteadyStates):
            further, wrong = solutions(each, random)
            verdicts, differing = verdicts + further, differing + wrong
    assert verdicts["proved"] >= 10_000
    assert verdicts["undecided"] == 0
    assert verdicts["at a bifurcation"] == 2  # of the statement on symmetry breaking
    assert differing == []


def recorder(begin: Callable[..., None], motions: list[Any]) -> Callable[..., None]:
    """What begins a result, and keeps it."""

    def kept(self: object, *given: object, **named: object) -> None:
        begin(self, *given, **named)
        motions.append(self)

    return kept
