"""Files of certificates checked, by the programs that check them alone."""

import inspect
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

from rocksteady.certify.proofs import (
    base_checker,
    chaos_checker,
    checker,
    fate_checker,
    point_checker,
    region_checker,
)
from rocksteady.certify.proofs._balls import precision
from rocksteady.certify.proofs.certificate import FORMAT, NAMES, place
from rocksteady.certify.proofs.region import WORDS, Arithmetic, Leaves, region_from
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.results.numbers import plural
from rocksteady.results.result import Result
from rocksteady.small_files import content_of

PROGRAMS = {
    "orbit": (base_checker, checker),
    "chaos": (base_checker, checker, chaos_checker),
    "point": (base_checker, checker, point_checker),
    "region": (base_checker, region_checker),
    "fate": (base_checker, fate_checker),
}
"""Modules of which the program that checks a kind alone is made."""
HINT = "give a file that `rocksteady certify` has written with --out"
HOLDS, SAMPLED, REFUSED, UNDECIDED = "holds", "sampled", "refused", "undecided"


@checked
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class CheckedCertificate(Result):
    """What the check of a certificate's file found.

    Attributes
    ----------
    kind
        "orbit", "point", "fate", "region" or "chaos", as the file says.
    verdict
        "holds"; "sampled" where boxes of a region that were drawn hold; "refused" or "undecided".
    reason
        Why it does not hold; empty where it does.
    claim
        What is proved, by the numbers that were read; empty where it does not hold.
    coverage
        How many boxes of a region were checked; empty of other kinds.
    """

    kind: str
    verdict: str
    reason: str
    claim: str = ""
    coverage: str = ""

    @property
    def holds(self) -> bool:
        """Whether all of the certificate holds."""
        return self.verdict == HOLDS


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
        Boxes of a region that are proved again, half of them the largest and half drawn by area;
        None for all.
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
    >>> from rocksteady.certify.proofs.chaos import certify_chaos
    >>> _ = file.write_text(certify_chaos(0.6, 2, 0.8).to_json())
    >>> check_certificate(file).holds
    True
    """
    content = content_of(Path(file), "certificate", HINT)
    try:
        text = content.decode()
        values = json.loads(text)
        kind = values["kind"] if values["kind"] in PROGRAMS else "unknown"
    except (ValueError, TypeError, LookupError, RecursionError):
        raise InputError(
            "certificate",
            file,
            "it cannot be read as the JSON of a certificate",
            HINT,
        ) from None
    if (form := values.get("format")) != FORMAT:
        raise InputError(
            "certificate",
            file,
            f"its form is {form!r:.60}, and this version of rocksteady reads {FORMAT}",
            "check it with the version that wrote it",
        )
    with precision(64):
        region = region_from(text)
        if region is not None:
            answer = region.check(leaves, arithmetic)
        else:
            proof = getattr(base_checker, arithmetic)
            answer = base_checker.check(text, proof, list(accelerations_m_s2))
    verdict, _, reason = answer.partition(": ")
    if verdict not in (HOLDS, SAMPLED):
        return CheckedCertificate(kind=kind, verdict=verdict, reason=reason)
    claim = _claim(values) if region is None else region.describe().headline
    if verdict == SAMPLED:
        claim = claim.replace("proved", "claimed", 1)
    return CheckedCertificate(kind=kind, verdict=verdict, reason="", claim=claim, coverage=reason)


def _claim(values: dict[str, Any]) -> str:
    """Return what a certificate claims, from what its check has read."""
    claim, model, kind = values["claim"], values["model"], values["kind"]
    if kind == "chaos":
        return f"entropy of {claim['entropy_per_period']} per period or more: {place(model)}"
    if kind == "fate":
        what = f"{values['pulse']} pulse" if "pulse" in values else "record"
        ends = [f" at A = {end}" for end in values.get("between", ())] or [""]
        fates = [f"{each}{end}" for each, end in zip(claim["outcomes"], ends, strict=True)]
        return f"the block {' and '.join(fates)}: {what}, {place(model)}"
    if kind == "region":
        box = [values["amplitude"], values["frequency_ratio"]]
        for k, half in enumerate(values["path"]):
            low, high = box[k % 2]
            middle = (low + high) / 2
            box[k % 2] = [middle, high] if half == "1" else [low, middle]
        texts = {name: tuple(map(str, pair)) for name, pair in zip(NAMES, box, strict=False)}
        return f"{WORDS[claim['letter']]} on all of {place(texts | model)}"
    flights = len(values["half_periods"])
    impacts = plural(flights * (1 + flights % 2), "impact")
    if kind == "orbit":
        return f"one {claim['stability']} motion that closes after {impacts}: {place(model)}"
    name = {1: "symmetry breaking", 0: "period doubling"}[flights % 2]
    what = "fold" if claim["sign"] == 1 else f"{claim['criticality']} {name}"
    side = "larger" if claim["opens"] > 0 else "smaller"
    at = f"A = {values['amplitude']} within {values['radii'][-1]}"
    return f"one {what} after {impacts}, open to {side} A, at {at}: {place(model)}"


def program(kind: str) -> str:
    """Return the text of the program that checks certificates of a kind alone.

    Parameters
    ----------
    kind
        "orbit", "point", "fate", "region" or "chaos".
    """
    first, *further = map(inspect.getsource, PROGRAMS[kind])
    body, start, end = first.partition('if __name__ == "__main__":')
    imports = re.compile(r"^from rocksteady[^\n(]*(\([^)]*\))?\n", re.MULTILINE)
    added = "".join(f"{imports.sub('', text)}\n\n" for text in further)
    return f"{body}{added}{start}{end}"
