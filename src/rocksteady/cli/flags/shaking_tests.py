"""Flags for tables of shaking tests, and how outcomes become draws."""

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Literal, cast

from rocksteady.cli.console.refusals import FlagError, flags_of, missing
from rocksteady.cli.flags.options import Panel, given_in
from rocksteady.cli.flags.parsing import number
from rocksteady.cli.flags.record_files import (
    baseline_flag,
    column_flag,
    dt_s_flag,
    in_flags,
    resample_flag,
    units_flag,
)
from rocksteady.errors import InputError

if TYPE_CHECKING:
    from rocksteady.risk.calibration.sampling import DrawOptions
    from rocksteady.risk.observations.observations import Observations
    from rocksteady.risk.observations.prior import Prior

test_flag = Panel("Tests")
sampling_flag = Panel("Calibration")

tests_flag = partial(
    test_flag,
    "--tests FILE",
    "Read a table of tests: test, record, object and outcome (fell or stood), further "
    "gain, sigma_ln, group, session, peak_rad, sigma_rad, reversed, channel, vertical, "
    "vertical_channel.",
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
        "Read the priors of objects and of errors from a file in TOML: \\[noise] sigma_ln and "
        "outliers, \\[object] base, offset, restitution or housner_factor, scatter."
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
                    baseline=self.baseline,
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


@dataclass(frozen=True, kw_only=True)
class SamplingFlags:
    """Draws, gains and rounds; folds and temper."""

    fold: str = sampling_flag(
        "--folds NAME",
        "Hold out together the tests of one record, test, session or group.",
        default="group",
    )
    temper: str = sampling_flag(
        "--temper auto|T",
        "Set the exponent of the likelihood, in (0, 1]; auto chooses it by held-out score.",
        default="auto",
    )
    draws: int = sampling_flag("--draws N", "Set the number of draws of each object.", default=1500)
    gains: int = sampling_flag(
        "--gains N",
        "Set the number of gains of each draw and test, over the error of its amplitude.",
        default=5,
    )
    rounds: int | None = sampling_flag(
        "--rounds N",
        "Set the number of rounds of draws; default one for every 100 draws, 6 at most.",
    )
    seed: int = sampling_flag("--seed N", "Set the seed of all draws.", default=0)

    def sampling(self) -> "DrawOptions":
        """Return how many draws are made.

        Raises
        ------
        FlagError
            If a number is outside its range.
        """
        from rocksteady.risk.calibration.sampling import DrawOptions

        with flags_of({name: f"--{name}" for name in ("draws", "gains", "rounds", "seed")}):
            return DrawOptions(
                draws=self.draws, gains=self.gains, rounds=self.rounds, seed=self.seed
            )

    @property
    def exponent(self) -> 'Literal["auto"] | float':
        """The temper: a number, or "auto".

        Raises
        ------
        FlagError
            If it is neither.
        """
        return temper_of(self.temper)

    @property
    def folds(self) -> 'Literal["record", "test", "session", "group"]':
        """What is held out together.

        Raises
        ------
        FlagError
            If there is no such grouping.
        """
        known = ("record", "test", "session", "group")
        if self.fold not in known:
            raise FlagError(
                "--folds", self.fold, "tests are grouped by " + ", ".join(known), "name one"
            )
        return cast("Literal['record', 'test', 'session', 'group']", self.fold)


def temper_of(text: str) -> 'Literal["auto"] | float':
    """Return the temper of a flag: a number, or "auto".

    Raises
    ------
    FlagError
        If it is neither.
    """
    if text == "auto":
        return "auto"
    try:
        return number("--temper", text)
    except InputError:
        raise FlagError(
            "--temper", text, "it must be auto or a number in (0, 1]", "write auto, or 0.3"
        ) from None
