"""Statements that this package cannot check, each with the reason."""

from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence, Statements
from rocksteady.studies.tso_wong_1989.findings import Finding

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
    "slender",
    "For slender blocks the critical angle is small, and sine and cosine may be linearised.",
    page=91,
)
def slender(_: Evidence) -> Finding:
    """Bound the terms that are left out; the motions cannot be compared yet."""
    # For 0 <= x <= alpha: x - sin x <= x^3/6 and 1 - cos x <= x^2/2.
    bounds = ", ".join(
        f"{alpha**2 / 6.0:.1%} and {alpha**2 / 2.0:.1%} at α = {alpha:g} rad"
        for alpha in (0.1, 0.2, 0.3)
    )
    return Finding(
        holds=None,
        detail="The paper states no error. Between rest and balance the terms left out are at most "
        f"α²/6 of the restoring moment and α²/2 of the excitation: {bounds}. What they do to the "
        "motion needs the full equations (1), (2), which this version of the package does not "
        "march.",
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
