"""The study's report: discrepancies first, then every figure, then every statement."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

from rocksteady.show.export.files import FORMATS
from rocksteady.show.report import render
from rocksteady.studies.tso_wong_1989.claims.findings import Claim, Verdict, corrected
from rocksteady.studies.tso_wong_1989.figures.panel import Panel

WORDS = {
    Verdict.REPRODUCED: ("reproduced", "agrees"),
    Verdict.CORRECTED: ("corrected", "differs"),
    Verdict.NOT_CHECKABLE: ("not checkable", "open"),
}
"""Each verdict's word and its class in the page's style."""


@dataclass(frozen=True, kw_only=True)
class ReportedPanel:
    """A panel with its picture and the time that it took.

    Attributes
    ----------
    panel
        The panel.
    picture
        Data URI of its picture, from `rocksteady.show.report`.
    seconds
        Time to compute and to draw it [s].
    """

    panel: Panel
    picture: str
    seconds: float


@dataclass(frozen=True, kw_only=True)
class _Entry:
    """What the page shows of a panel: its verdict, the statements that it shows, and others."""

    panel: Panel
    picture: str
    seconds: float
    verdict: Verdict
    claims: tuple[Claim, ...]
    see: tuple[Claim, ...]

    @property
    def files(self) -> list[str]:
        """The files beside the report that hold the panel's data and its picture."""
        stem = f"figure-{self.panel.id}"
        more = [f"{stem}-{name}.csv" for name in self.panel.more_tables]
        return [f"{stem}.csv", *more, *(f"{stem}.{kind}" for kind in FORMATS)]


def report_html(
    *,
    claims: Sequence[Claim],
    sections: Sequence[ReportedPanel],
    seconds: float,
    version: str,
    environment: str,
) -> str:
    """Return the report as the text of one HTML file.

    Parameters
    ----------
    claims
        The statements, in the order in which they are to be listed.
    sections
        The panels in the paper's order, all or some of them.
    seconds
        Run time of the whole study [s].
    version
        The package's version.
    environment
        What it ran on, in one line.

    Returns
    -------
    str
        The same for the same values. Beside the file it expects ``figure-<id>.csv``, ``.png``,
        ``.svg`` and ``.pdf`` of each panel, and ``figure-<id>-<name>.csv`` of each further table:
        it links to them.
    """
    entries = [_entry(section, claims) for section in sections]
    groups = groupby(entries, key=lambda entry: figure_number(entry.panel.id))
    return render(
        __package__,
        "report.html.j2",
        claims=claims,
        corrected=corrected(claims),
        counts=Counter(claim.verdict for claim in claims),
        environment=environment,
        groups=[(number, list(members)) for number, members in groups],
        panels={entry.panel.id for entry in entries},
        panel_counts=Counter(entry.verdict for entry in entries),
        seconds=seconds,
        Verdict=Verdict,
        version=version,
        words=WORDS,
    )


def panel_verdict(claims: Sequence[Claim]) -> Verdict:
    """Return the verdict on a panel from those on the statements that it shows.

    Corrected if one of them is; not checkable if there are some and none can be checked.
    """
    verdicts = {claim.verdict for claim in claims}
    if Verdict.CORRECTED in verdicts:
        return Verdict.CORRECTED
    if verdicts == {Verdict.NOT_CHECKABLE}:
        return Verdict.NOT_CHECKABLE
    return Verdict.REPRODUCED


def figure_number(panel: str) -> str:
    """Return the number of the paper's figure to which a panel belongs.

    Examples
    --------
    >>> figure_number("12b"), figure_number("10")
    ('12', '10')
    """
    return re.split(r"\D", panel, maxsplit=1)[0]


def _entry(section: ReportedPanel, claims: Sequence[Claim]) -> _Entry:
    """Return a panel with its statements, corrected ones first."""
    panel = section.panel.id
    ordered = sorted(claims, key=lambda claim: claim.verdict is not Verdict.CORRECTED)
    shown = tuple(claim for claim in ordered if panel in claim.figures)
    see = tuple(claim for claim in ordered if panel in claim.see and claim not in shown)
    return _Entry(
        panel=section.panel,
        picture=section.picture,
        seconds=section.seconds,
        verdict=panel_verdict(shown),
        claims=shown,
        see=see,
    )
