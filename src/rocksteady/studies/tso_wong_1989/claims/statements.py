"""All checkable statements of the paper, each with its computation."""

from collections.abc import Callable

from rocksteady.studies.tso_wong_1989.claims import (
    _equations,
    _linearised,
    _regions,
    _responses,
    _stability,
    _time_histories,
    _transitions,
    _unchecked,
)
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Statement
from rocksteady.studies.tso_wong_1989.claims.findings import Claim

STATEMENTS: tuple[Statement, ...] = (
    *_equations.STATEMENTS,
    *_linearised.STATEMENTS,
    *_regions.STATEMENTS,
    *_responses.STATEMENTS,
    *_stability.STATEMENTS,
    *_time_histories.STATEMENTS,
    *_transitions.STATEMENTS,
    *_unchecked.STATEMENTS,
)
"""In the order of the paper's argument."""


def check(evidence: Evidence, *, done: Callable[[str], None] = lambda _: None) -> tuple[Claim, ...]:
    """Check every statement.

    Parameters
    ----------
    evidence
        Results on which the checks draw.
    done
        Called with the name of each statement when it has been checked.

    Returns
    -------
    tuple of Claim
        In the order of `STATEMENTS`.
    """
    claims = []
    for statement in STATEMENTS:
        claims.append(
            Claim(
                id=statement.id,
                statement=statement.text,
                page=statement.page,
                figures=statement.figures,
                see=statement.see,
                finding=statement.check(evidence),
            )
        )
        done(statement.id)
    return tuple(claims)
