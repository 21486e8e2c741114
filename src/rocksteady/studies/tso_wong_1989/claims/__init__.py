"""Every statement of the paper that can be checked, each with the computation that checks it."""

from collections.abc import Callable

from rocksteady.studies.tso_wong_1989.claims import (
    equations,
    linearised,
    regions,
    responses,
    stability,
    time_histories,
    transitions,
    unchecked,
)
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Statement
from rocksteady.studies.tso_wong_1989.findings import Claim

STATEMENTS: tuple[Statement, ...] = (
    *equations.STATEMENTS,
    *linearised.STATEMENTS,
    *regions.STATEMENTS,
    *responses.STATEMENTS,
    *stability.STATEMENTS,
    *time_histories.STATEMENTS,
    *transitions.STATEMENTS,
    *unchecked.STATEMENTS,
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
