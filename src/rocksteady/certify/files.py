"""Files of certificates checked, by the programs that check them alone."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from rocksteady.certify import checker, fate_checker
from rocksteady.certify._balls import precision
from rocksteady.certify.certificate import FORMAT
from rocksteady.certify.region import Leaves, ProvedRegion, region_from
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.results.answer import Answer
from rocksteady.results.description import Description, Fact
from rocksteady.results.result import Result

HOLDS, REFUSED, UNDECIDED = "holds", "refused", "undecided"


@checked
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class CheckedCertificate(Result):
    """What the check of a certificate's file found.

    Attributes
    ----------
    kind
        "orbit", "point", "fate", "region" or "chaos", as the file says.
    verdict
        "holds", "refused" or "undecided".
    reason
        Why it does not hold; empty where it does.
    """

    kind: str
    verdict: str
    reason: str

    @property
    def holds(self) -> bool:
        """Whether the certificate holds."""
        return self.verdict == HOLDS

    def describe(self) -> Description:
        """Return the verdict and the reason."""
        headline = f"the certificate {'holds' if self.holds else f'is {self.verdict}'}: {self.kind}"
        sentence = f"{headline}; {self.reason}" if self.reason else headline
        facts = [
            Fact("holds", self.holds, "holds"),
            Fact("kind", self.kind, "kind"),
            Fact("verdict", self.verdict, "verdict"),
            Fact("reason", self.reason, "reason" if self.reason else ""),
        ]
        return Description(headline, facts, answer=Answer(sentence[:1].upper() + sentence[1:]))


@checked
def check_certificate(
    file: str | PathLike[str],
    *,
    accelerations_m_s2: Sequence[float] = (),
    leaves: Leaves = 1000,
    arithmetic: str = "arb",
) -> CheckedCertificate:
    """Check the file of a certificate.

    Parameters
    ----------
    file
        The file.
    accelerations_m_s2
        Samples of the record of a fate [m/s^2].
    leaves
        Boxes of a region that are drawn and proved again; None for all.
    arithmetic
        "arb" of python-flint, or "iv" of mpmath.

    Raises
    ------
    InputError
        If the file cannot be read as a certificate, or there is no such arithmetic.

    Examples
    --------
    >>> import tempfile, pathlib
    >>> file = pathlib.Path(tempfile.mkdtemp()) / "chaos.json"
    >>> from rocksteady.certify.chaos import certify_chaos
    >>> _ = file.write_text(certify_chaos(0.6, 2, 0.8).to_json())
    >>> check_certificate(file).holds
    True
    """
    if arithmetic not in ("arb", "iv"):
        raise InputError("arithmetic", arithmetic, "there is no such one", "give arb or iv")
    try:
        text = Path(file).read_text(encoding="utf-8")
        values = json.loads(text)
        kind = str(values["kind"])
    except (OSError, ValueError, TypeError, LookupError, RecursionError):
        raise InputError(
            "certificate",
            file,
            "it cannot be read as the JSON of a certificate",
            "give a file that `rocksteady certify` has written with --out",
        ) from None
    if (form := values.get("format")) != FORMAT:
        raise InputError(
            "certificate",
            file,
            f"its form is {form}, and this version of rocksteady reads {FORMAT}",
            "check it with the version that wrote it",
        )
    with precision(64):
        if kind == "region":
            answer = _checked_region(region_from(values), leaves)
        elif kind == "fate":
            answer = fate_checker.check(
                text, getattr(fate_checker, arithmetic), list(accelerations_m_s2)
            )
        else:
            answer = checker.check(text, getattr(checker, arithmetic))
    verdict, _, reason = answer.partition(": ")
    return CheckedCertificate(kind=kind, verdict=verdict, reason=reason)


def _checked_region(region: ProvedRegion | None, leaves: int | None) -> str:
    """Return the verdict on a region."""
    if region is None:
        return "refused: it is no region"
    return HOLDS if region.check(leaves) else "refused: a box is not what its letter says"
