"""Statements that this package cannot check, each with its reason."""

from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Statements
from rocksteady.studies.tso_wong_1989.claims.findings import Finding

STATEMENTS = Statements()


@STATEMENTS.add(
    "experiment",
    "Many of the predictions are confirmed by experiments (in the companion paper, Part 2).",
    page=90,
)
def experiment(_: Evidence) -> Finding:
    """Give no verdict: experiments are not computations."""
    return Finding(
        holds=None,
        detail="Measurements on real blocks; nothing to compute here. Part 2 appeared beside this "
        "paper (Earthquake Engineering and Structural Dynamics 18).",
    )


@STATEMENTS.add(
    "no-sliding",
    "The contact is rough enough that the block does not slide.",
    page=90,
)
def no_sliding(_: Evidence) -> Finding:
    """Give no verdict: the model has no friction force."""
    return Finding(
        holds=None,
        detail="An assumption, which this package shares: its equations hold no friction force to "
        "compare a coefficient with.",
    )


@STATEMENTS.add(
    "earlier-work",
    "Ogawa found when steady harmonic motions are possible; Spanos and Koh found subharmonic and "
    "unsymmetric ones.",
    page=89,
)
def earlier_work(_: Evidence) -> Finding:
    """Give no verdict: this is about other papers."""
    return Finding(
        holds=None,
        detail="A statement on what other papers contain, and not on the block. The motions "
        "themselves are found again here (Figs 3 to 13).",
    )
