"""Files of certificates checked, by the programs that check them alone."""

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from importlib.resources import files
from os import PathLike
from pathlib import Path

from rocksteady.certify import base_checker, fate_checker
from rocksteady.certify._balls import precision
from rocksteady.certify.certificate import FORMAT
from rocksteady.certify.region import Arithmetic, Leaves, region_from
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.results.answer import Answer
from rocksteady.results.description import Description, Fact
from rocksteady.results.result import Result

BASE = "base_checker"
PROGRAMS = {
    "orbit": (BASE, "checker"),
    "chaos": (BASE, "checker", "chaos_checker"),
    "point": (BASE, "checker", "point_checker"),
    "region": (BASE, "region_checker"),
    "fate": ("fate_checker",),
}
"""Modules of which the program that checks a kind alone is made."""
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
    arithmetic: Arithmetic = "arb",
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
        if kind == "region" and "tree" in values:
            region = region_from(values)
            refusal = "refused: it is no region"
            answer = refusal if region is None else region.check(leaves, arithmetic)
        elif kind == "fate":
            answer = fate_checker.check(
                text, getattr(fate_checker, arithmetic), list(accelerations_m_s2)
            )
        else:
            for name in PROGRAMS.get(kind, ()):
                import_module(f"rocksteady.certify.{name}")
            answer = base_checker.check(text, getattr(base_checker, arithmetic))
    verdict, _, reason = answer.partition(": ")
    return CheckedCertificate(kind=kind, verdict=verdict, reason=reason)


def program(kind: str) -> str:
    """Return the text of the program that checks certificates of a kind alone.

    Parameters
    ----------
    kind
        "orbit", "point", "fate", "region" or "chaos".
    """
    here = files("rocksteady.certify")
    first, *further = (here.joinpath(f"{x}.py").read_text(encoding="utf-8") for x in PROGRAMS[kind])
    body, start, end = first.partition('if __name__ == "__main__":')
    imports = re.compile(r"^from rocksteady[^\n(]*(\([^)]*\))?\n", re.MULTILINE)
    added = "".join(f"{imports.sub('', text)}\n\n" for text in further)
    return f"{body}{added}{start}{end}"
