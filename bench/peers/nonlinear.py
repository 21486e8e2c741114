"""B1 in the nonlinear model, with blocks of one slenderness: the package beside other solvers."""

import importlib
import math
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from importlib.metadata import version
from typing import Any

import numpy as np

from bench.peers.pendulum import exact_nonlinear_fate
from bench.peers.reference import Fate
from bench.peers.runs import Say, measured, noted, set_up
from bench.peers.truth import agreement
from bench.peers.work import (
    ALPHA,
    CYCLES,
    OVERTURNED,
    RESTITUTION,
    START_VELOCITY,
    TURN,
    Cells,
    Outcome,
    Peer,
    cells,
)
from rocksteady import Block, Execution, Harmonic, Nonlinear, State, map_fates, simulate

SOLVERS = {"taylor": "heyoka", "initial_value": "scipy", "runge_kutta": "numba"}
THINNED = 4  # all run every so many-th cell of either axis, or fewer
CHECKED, DIGITS = 8, 32  # every so many-th is marched in so many digits
DOUBTED, MORE_DIGITS = 24, 44  # and every so many-th in more
BLOCK = Block.from_p(alpha=ALPHA, p=1.0, restitution=RESTITUTION)
START = State(angle=0.0, velocity=START_VELOCITY)
FINEST = Nonlinear(tolerance=1e-11)


def run(own: Cells, model: Nonlinear) -> Outcome:
    """Map the cells in one thread."""
    axes = {
        "amplitude": np.unique(own.amplitude),
        "frequency_ratio": np.unique(own.frequency_ratio),
    }
    began = time.process_time()
    found = map_fates(
        BLOCK, axes=axes, start=START, cycles=CYCLES, model=model, run=Execution(executor="serial")
    )
    seconds = time.process_time() - began
    status = found["fate"].to_numpy().ravel()
    none = np.full(status.shape, -1)  # a map of fates counts no impacts
    return Outcome(status=status, impacts=none, last_phase=None, seconds=seconds)


def with_impacts(own: Cells, outcome: Outcome, model: Nonlinear) -> Outcome:
    """Return an outcome with the number of impacts and the phase [0, 2 pi) of the last of each."""
    counts, phases = outcome.impacts.copy(), np.full(len(own.index), math.nan)
    for i, (amplitude, ratio) in enumerate(
        zip(own.amplitude.tolist(), own.frequency_ratio.tolist(), strict=True)
    ):
        shaking = Harmonic(amplitude=amplitude, frequency_ratio=ratio)
        impacts = simulate(BLOCK, shaking, start=START, cycles=CYCLES, model=model).impacts
        counts[i] = len(impacts)
        if len(impacts):
            phases[i] = (math.pi * (impacts.half_cycles[-1] % 2) + impacts.phase[-1]) % TURN
    return replace(outcome, impacts=counts, last_phase=phases)


default = partial(run, model=Nonlinear())


def own_peers() -> list[Peer]:
    """Return the package with its default tolerance and with its finest."""
    return [
        Peer(
            name=name,
            version=version("rocksteady"),
            settings=f"map_fates in one thread, tolerance {model.tolerance:g}",
            thinned=THINNED,
            run=way,
        )
        for name, model, way in (
            ("rocksteady", Nonlinear(), default),
            ("rocksteady, finest", FINEST, partial(run, model=FINEST)),
        )
    ]


def exact_fates(own: Cells, digits: int) -> dict[int, Fate]:
    """Return the fates in many digits, by cell."""
    march = partial(exact_nonlinear_fate, digits=digits)
    with ProcessPoolExecutor() as pool:
        shaken = [ALPHA] * len(own.index), own.amplitude.tolist(), own.frequency_ratio.tolist()
        fates = pool.map(march, *shaken)
        return dict(zip(own.index.tolist(), fates, strict=True))


def compare(say: Say) -> dict[str, Any]:
    """Run all solvers and return what they took and what they got right."""
    say(f"nonlinear; checking some cells in {DIGITS} digits")
    truth = exact_fates(cells(CHECKED), DIGITS)
    again = exact_fates(cells(DOUBTED), MORE_DIGITS)
    rows: list[dict[str, Any]] = []
    for peer, model in zip(own_peers(), (Nonlinear(), FINEST), strict=True):
        say(f"  {peer.name}")
        own = cells(THINNED)
        row, outcome = measured(peer, own, default)
        rows.append(row | judged(own, with_impacts(own, outcome, model), truth))
    for module, name in SOLVERS.items():
        with noted(name, rows, say):
            solver = importlib.import_module(f"bench.peers.{module}")
            peers, setup = set_up(solver.nonlinear_peers)
            for peer in peers:
                say(f"  {peer.name}, {peer.settings}")
                own = cells(max(peer.thinned, THINNED))
                row, outcome = measured(peer, own, default)
                row["setup_s"] = setup
                rows.append(row | judged(own, outcome, truth))
    return {
        "rows": rows,
        "check": {
            "cells": len(truth),
            "digits": DIGITS,
            "again": len(again),
            "more_digits": MORE_DIGITS,
            "unchanged": sum(str(fate) == str(truth[cell]) for cell, fate in again.items()),
        },
    }


def judged(own: Cells, outcome: Outcome, truth: dict[int, Fate]) -> dict[str, Any]:
    """Return what a solver got right on the cells that are known in many digits."""
    at = np.flatnonzero(np.isin(own.index, list(truth)))
    assert outcome.last_phase is not None
    fates = [truth[cell] for cell in own.index[at].tolist()]
    return agreement(
        overturned=np.array([fate.status == OVERTURNED for fate in fates]),
        impacts=np.array([fate.impacts for fate in fates]),
        last_phase=np.array([fate.last_phase for fate in fates]),
        counted=np.array([not fate.rested for fate in fates]),
        status=outcome.status[at],
        found_impacts=outcome.impacts[at],
        found_phase=outcome.last_phase[at],
    )
