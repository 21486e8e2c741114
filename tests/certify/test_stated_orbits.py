"""Orbits that floating point states at random places and in the manual, held against proofs."""

import gc
import re
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pytest
from matplotlib import pyplot as plt

import rocksteady as rs
from rocksteady.certify.orbit import certify_orbit
from rocksteady.dynamics.orbits.orbit import Orbit
from rocksteady.errors import ModelError

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
        if not certificate.proved:
            if certificate.verdict != "refuted" or orbit.admissible:
                differing.append(f"{certificate.claim}: {certificate.reason}")
        elif not orbit.admissible:
            differing.append(f"{certificate.claim}: stated to pass through the floor")
        elif (certificate.content["claim"]["stability"] == "stable") != orbit.stable:
            differing.append(f"{certificate.claim}: stated the other way")
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
