"""Evidence shared by the checks: results of the figures, and random parameter points."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rocksteady.arrays import Floats
from rocksteady.formulas import steady_states
from rocksteady.kernels.elementary.arrays import tanh
from rocksteady.orbits import SteadyStates
from rocksteady.studies.tso_wong_1989.claims.findings import Finding
from rocksteady.studies.tso_wong_1989.figures.histories import History, histories
from rocksteady.studies.tso_wong_1989.figures.regions import Plane, planes
from rocksteady.studies.tso_wong_1989.figures.responses import Responses, responses

POINTS = 100_000
"""Random points of the parameter space."""
SEED = 1989


@dataclass(frozen=True, kw_only=True)
class Sample:
    """Random points with both their solutions and the paper's auxiliary quantities.

    Attributes
    ----------
    states
        Solutions, shape (2, points).
    tanh, damping, beta
        h = tanh(n pi / 2 Omega), D = (1 - delta)/(1 + delta), beta = A/(1 + Omega^2).
    p, q
        P = D h Omega and Q = D h^2/beta (eq 20).
    """

    states: SteadyStates
    tanh: Floats
    damping: Floats
    beta: Floats
    p: Floats
    q: Floats

    @property
    def root(self) -> Floats:
        """The radical of eqs 21 and 22; nan where it is not real."""
        with np.errstate(invalid="ignore"):
            root: Floats = np.sqrt(1.0 + np.square(self.p) - np.square(self.q))
        return root

    @property
    def exists(self) -> NDArray[np.bool_]:
        """Where there are solutions."""
        exists: NDArray[np.bool_] = self.states.region != 4
        return exists


def drawn_between(draw: np.random.Generator, low: float, high: float, points: int) -> Floats:
    """Return numbers drawn evenly; a generator's own ``uniform`` may round them otherwise."""
    return low + (high - low) * draw.random(points)


def random_sample(points: int = POINTS) -> Sample:
    """Return points drawn evenly over A to 8, Omega .2 to 16, restitution .05 to .99, n = 1, 3, 5.

    The ends cover the paper's axes and go beyond them; the seed is fixed.
    """
    draw = np.random.default_rng(SEED)
    amplitude = drawn_between(draw, 0.01, 8.0, points)
    ratio = drawn_between(draw, 0.2, 16.0, points)
    restitution = drawn_between(draw, 0.05, 0.99, points)
    order = draw.choice([1, 3, 5], points)
    states = steady_states(amplitude, ratio, restitution, order=order)
    h = tanh(0.5 * math.pi * order / ratio)
    damping = (1.0 - restitution) / (1.0 + restitution)
    beta = amplitude / (1.0 + ratio * ratio)
    return Sample(
        states=states,
        tanh=h,
        damping=damping,
        beta=beta,
        p=damping * h * ratio,
        q=damping * np.square(h) / beta,
    )


@dataclass(frozen=True, kw_only=True)
class Evidence:
    """Results on which the checks draw; each is computed at its first use."""

    planes: dict[str, Plane] = field(default_factory=planes)
    responses: dict[str, Responses] = field(default_factory=responses)
    histories: dict[str, History] = field(default_factory=histories)

    @cached_property
    def sample(self) -> Sample:
        """Random points."""
        return random_sample()


Check = Callable[[Evidence], Finding]


@dataclass(frozen=True, kw_only=True)
class Statement:
    """A statement of the paper and how it is checked; the fields are those of `Claim`."""

    id: str
    text: str
    page: int
    figures: tuple[str, ...]
    see: tuple[str, ...]
    check: Check


class Statements(list[Statement]):
    """The statements of one module, in the paper's order."""

    def add(
        self,
        name: str,
        text: str,
        *,
        page: int,
        figures: tuple[str, ...] = (),
        see: tuple[str, ...] = (),
    ) -> Callable[[Check], Check]:
        """Return a decorator that adds a check under its statement."""

        def register(check: Check) -> Check:
            self.append(
                Statement(id=name, text=text, page=page, figures=figures, see=see, check=check)
            )
            return check

        return register
