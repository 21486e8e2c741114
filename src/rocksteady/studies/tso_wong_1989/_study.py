"""The whole study: every figure and statement of the paper, and the output folder."""

import re
import time
from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from rocksteady import __version__
from rocksteady.errors import InputError
from rocksteady.show.export import folders
from rocksteady.show.export.files import FORMATS, json_text, picture_files, save_csv, save_text
from rocksteady.show.report import svg_data_uri
from rocksteady.show.study.environment import Done, environment, nothing
from rocksteady.show.study.parts import Parts
from rocksteady.show.study.saving import fill_study
from rocksteady.studies.processes import in_processes
from rocksteady.studies.tso_wong_1989._report import ReportedPanel, report_html
from rocksteady.studies.tso_wong_1989.claims.evidence import Evidence
from rocksteady.studies.tso_wong_1989.claims.findings import Claim, Verdict
from rocksteady.studies.tso_wong_1989.claims.statements import STATEMENTS, check
from rocksteady.studies.tso_wong_1989.figures.histories import History, histories
from rocksteady.studies.tso_wong_1989.figures.panel import Panel
from rocksteady.studies.tso_wong_1989.figures.regions import Plane, planes
from rocksteady.studies.tso_wong_1989.figures.responses import Responses, responses

SCHEMA = "rocksteady/paper/1"
REFERENCE = (
    "W. K. Tso and C. M. Wong, Steady state rocking response of rigid blocks part 1: Analysis, "
    "Earthquake Engineering and Structural Dynamics 18, 89-106 (1989)"
)

FIGURES = (*planes(), *responses(), *histories())
"""Every computed figure of the paper, in its order; Figs 1 and 2 are drawings."""


@dataclass(frozen=True, kw_only=True)
class TimedPanel:
    """A panel and how long its computation took [s]."""

    panel: Panel
    seconds: float


@dataclass(frozen=True, kw_only=True)
class Study:
    """The figures and statements of the paper as computed.

    Attributes
    ----------
    panels
        The figures, in the paper's order.
    claims
        The statements with their verdicts; empty where only some figures were computed.
    seconds
        Run time of the computation [s].
    """

    panels: tuple[TimedPanel, ...]
    claims: tuple[Claim, ...]
    seconds: float

    def counts(self) -> dict[str, int]:
        """Return the number of statements for each verdict."""
        return {
            verdict.value: sum(claim.verdict is verdict for claim in self.claims)
            for verdict in Verdict
        }

    def values(self) -> dict[str, Any]:
        """Return the statements as plain values: what ``claims.json`` holds."""
        return {
            "reference": REFERENCE,
            "version": __version__,
            "counts": self.counts(),
            "claims": [
                {
                    "id": claim.id,
                    "statement": claim.statement,
                    "page": claim.page,
                    "figures": list(claim.figures),
                    "see": list(claim.see),
                    "verdict": claim.verdict.value,
                    "detail": claim.finding.detail,
                    "values": claim.finding.values,
                }
                for claim in self.claims
            ],
        }

    @property
    def steps(self) -> int:
        """Number of times that `save` reports progress."""
        return len(self.panels) + (1 if self.claims else 0)

    def save(
        self,
        folder: Path | str,
        *,
        force: bool = False,
        parts: Parts | None = None,
        done: Done = nothing,
        processes: int = 1,
    ) -> list[Path]:
        """Write the figures with their data and, for the whole study, statements and report.

        Everything is drawn into a hidden folder in it first and moved out of that at the end.

        Parameters
        ----------
        folder
            Made if it does not exist, in an existing folder.
        force
            Whether files of these names in it are replaced; others stay.
        parts
            Where finished pictures are kept, to go on with after an interruption.
        done
            Called with the name of each figure, and of the report, when it has been written.
        processes
            How many draw; default 1, which is this one.

        Returns
        -------
        list of Path
            The written files.

        Raises
        ------
        OutputError
            If the folder cannot be made or written, or a file exists and `force` is off.
        """
        only = () if self.claims else [timed.panel.id for timed in self.panels]
        check = partial(check_folder, folder, only, force=force)
        write = partial(self._write, parts=parts, done=done, processes=processes)
        return fill_study(folder, write, check, parts)

    def _write(self, stage: Path, parts: Parts | None, done: Done, processes: int) -> None:
        """Write every file into a hidden folder."""
        began = time.perf_counter()
        sections = []
        names = [dict(file_names(timed.panel)) for timed in self.panels]
        pictures = [
            None if parts is None else parts.kept(*(each[kind] for kind in FORMATS))
            for each in names
        ]
        missing = [
            partial(_drawn, timed.panel)
            for timed, kept in zip(self.panels, pictures, strict=True)
            if kept is None
        ]
        with closing(in_processes(missing, processes)) as drawn:
            for timed, its, files in zip(self.panels, names, pictures, strict=True):
                panel = timed.panel
                data, drawing = next(drawn) if files is None else (files, 0.0)
                for kind, picture in zip(FORMATS, data, strict=True):
                    (stage / its[kind]).write_bytes(picture)
                    if files is None and parts is not None:
                        parts.keep(its[kind], picture)
                save_csv("out", stage / its["csv"], panel.header, panel.rows)
                for name, (header, rows) in panel.more_tables.items():
                    save_csv("out", stage / its[name], header, rows)
                address = svg_data_uri(data[FORMATS.index("svg")])
                seconds = timed.seconds + drawing
                sections.append(ReportedPanel(panel=panel, picture=address, seconds=seconds))
                done(f"figure {panel.id}")
        if not self.claims:
            return
        save_text("out", stage / "claims.json", json_text(SCHEMA, self.values(), indent=1) + "\n")
        page = report_html(
            claims=self.claims,
            sections=sections,
            seconds=self.seconds + time.perf_counter() - began,
            version=__version__,
            environment=environment(),
        )
        save_text("out", stage / "report.html", page)
        done("report")


def _drawn(panel: Panel) -> tuple[list[bytes], float]:
    """Return the figure of a panel in each format of a picture, and how long that took [s]."""
    start = time.perf_counter()
    pictures = [*picture_files(panel.draw(), command=panel.command).values()]
    return pictures, time.perf_counter() - start


def parts_of(only: Sequence[str], folder: Path | str, *, resume: bool, force: bool) -> Parts:
    """Return the finished parts of the study in its folder; arguments as for `Parts`."""
    inputs = {"study": "paper", "only": chosen_figures(only), "environment": environment()}
    return Parts(folder, inputs, resume=resume, force=force, sweeps=False)


def reproduce(*, only: Sequence[str] = (), done: Done = nothing) -> Study:
    """Compute every figure and every statement of the paper.

    Parameters
    ----------
    only
        Figures, as "12b"; the statements are then left out.  All without.
    done
        Called with the name of each figure and statement when it is computed.

    Returns
    -------
    Study
        Nothing is drawn or written yet; see `Study.save`.

    Raises
    ------
    InputError
        If the paper has no such figure.

    Examples
    --------
    >>> study = reproduce(only=["10"])
    >>> print(study.panels[0].panel.computed)
    Stable: the half cycle's largest multiplier is 0.8 in modulus (a complex pair). Peak 0.41873, \
of the closed form 0.41873.
    """
    chosen = chosen_figures(only)
    began = time.perf_counter()
    evidence = Evidence()
    sources: dict[str, Plane | Responses | History] = {
        **evidence.planes,
        **evidence.responses,
        **evidence.histories,
    }
    panels = []
    for name in chosen:
        start = time.perf_counter()
        panel = sources[name].panel()
        panels.append(TimedPanel(panel=panel, seconds=time.perf_counter() - start))
        done(f"figure {name}")
    claims = () if only else check(evidence, done=done)
    return Study(panels=tuple(panels), claims=claims, seconds=time.perf_counter() - began)


def steps(only: Sequence[str] = ()) -> int:
    """Return the number of times that `reproduce` reports progress."""
    return len(chosen_figures(only)) + (0 if only else len(STATEMENTS))


def chosen_figures(only: Sequence[str]) -> tuple[str, ...]:
    """Return figures in the paper's order; all of them where none is named.

    Raises
    ------
    InputError
        If the paper has no such figure.
    """
    for name in only:
        if name not in FIGURES:
            raise InputError(
                "only", name, "the computed figures are " + " ".join(FIGURES), "name one of them"
            )
    return tuple(name for name in FIGURES if not only or name in only)


def file_names(panel: Panel) -> Iterator[tuple[str, str]]:
    """Yield kind and name of each file of a panel."""
    for kind in (*FORMATS, "csv"):
        yield kind, f"figure-{panel.id}.{kind}"
    for name in panel.more_tables:
        yield name, f"figure-{panel.id}-{name}.csv"


def check_folder(folder: Path | str, only: Sequence[str] = (), *, force: bool = False) -> None:
    """Refuse, before anything is computed, a folder into which the study could not be written.

    Parameters
    ----------
    folder, force
        As for `Study.save`.
    only
        As for `reproduce`.

    Raises
    ------
    OutputError
        If its parent is missing or not writable, it is a file, or it holds files of these names and
        `force` is off.
    """
    names = "|".join(re.escape(name) for name in chosen_figures(only))
    ours = rf"figure-({names})(\.({'|'.join(FORMATS)})|(-\w+)?\.csv)"
    ours += "" if only else r"|claims\.json|report\.html"
    folders.check_folder(folder, ours, force=force)
