"""Flags for tables of shaking tests."""

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from rocksteady.cli.console.refusals import flags_of, missing
from rocksteady.cli.flags.options import Panel, given_in
from rocksteady.cli.flags.record_files import (
    baseline_flag,
    cleaning_of,
    column_flag,
    dt_s_flag,
    filter_flag,
    in_flags,
    resample_flag,
    trim_flag,
    units_flag,
)
from rocksteady.errors import InputError

if TYPE_CHECKING:
    from rocksteady.risk.observations.observations import Observations
    from rocksteady.risk.observations.prior import Prior

test_flag = Panel("Tests")

tests_flag = partial(
    test_flag,
    "--tests FILE",
    "Read a table of tests: test, record, object and outcome (fell or stood), further "
    "gain, sigma_ln, group, session, peak_rad, sigma_rad, reversed, channel, vertical, "
    "vertical_channel, transverse, transverse_channel.",
)
objects_flag = partial(
    test_flag,
    "--objects FILE",
    "Read the table of objects: sizes as 0.4, 0.38:0.42 or 0.4+-0.01; default objects.csv "
    "beside --tests.",
)
PRIOR = (
    "--prior FILE",
    (
        "Read the priors of objects and of errors from a file in TOML: \\[noise] sigma_ln, "
        "outliers and session_ln, \\[object] base, offset, restitution or housner_factor, scatter."
    ),
)
records_flag = partial(
    test_flag,
    "--records DIR",
    "Folder of the records; default records/ beside --tests, or its own folder.",
)


@dataclass(frozen=True, kw_only=True)
class TableFlags:
    """Tables of tests and of objects, and the folder of their records."""

    tests: Path | None = tests_flag()
    objects: Path | None = objects_flag()
    records: Path | None = records_flag()
    units: str | None = units_flag()
    dt_s: float | None = dt_s_flag()
    column: str | None = column_flag()
    resample: bool = resample_flag()
    baseline: str = baseline_flag()
    filter: str | None = filter_flag()
    trim: str | None = trim_flag()

    @property
    def given(self) -> dict[str, object]:
        """The flags that were given, with their values."""
        return given_in(self)

    @property
    def files(self) -> list[Path]:
        """The tables that are read, that of objects too where no flag names it."""
        if self.tests is None:
            return [] if self.objects is None else [self.objects]
        return [self.tests, self.objects or self.tests.parent / "objects.csv"]

    def record_files(self, tests: "Observations") -> list[Path]:
        """Return the files of the records that were read."""
        if self.tests is None:
            return []
        beside = self.tests.parent / "records"
        folder = self.records or (beside if beside.is_dir() else self.tests.parent)
        tables = {file.name for file in self.files}
        return [folder / name for name in tests.sources if name not in tables]

    def observations(self) -> "Observations":
        """Return the tests with their objects.

        Raises
        ------
        InputError, FlagError
            If a file cannot be read, a line is not valid, or there is no table.
        """
        from rocksteady.risk.observations.read_tests import read_tests

        if self.tests is None:
            raise missing(
                "--tests",
                valid="outcomes come from a table of tests",
                hint="add --example for synthetic tests, or --tests with your table",
            )
        flags = {"tests": "--tests", "objects": "--objects", "records": "--records"}
        try:
            with flags_of(flags):
                return read_tests(
                    self.tests,
                    records=self.records,
                    objects=self.objects,
                    units=self.units,
                    dt_s=self.dt_s,
                    column=self.column,
                    resample=self.resample,
                    cleaning=cleaning_of(self),
                )
        except InputError as error:
            hint = in_flags(error.hint.partition(", else ")[0])  # --ignore-header is of one file
            raise InputError(error.name, error.value, in_flags(error.valid), hint) from None


def prior_of(file: Path | None) -> "Prior | None":
    """Return what is known before the tests; None without a file."""
    if file is None:
        return None
    from rocksteady.risk.observations.prior import read_prior

    with flags_of({"prior": "--prior"}):
        return read_prior(file)
