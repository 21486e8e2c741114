"""Posteriors on disk: what `calibrate` writes and `predict` reads back, to the last bit."""

import csv
import hashlib
import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked, checked_result
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.results.cells import read_cell
from rocksteady.results.description import Description, Fact
from rocksteady.results.numbers import plural
from rocksteady.results.result import Result
from rocksteady.risk.calibration._predicting import Source, listed, predict_all
from rocksteady.risk.calibration._space import Space
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.risk.calibration.held_out.predictions import OUTCOMES, Predictions
from rocksteady.risk.calibration.held_out.recalibration import PLAIN, Platt
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampling import DrawOptions
from rocksteady.risk.observations.files.small_files import content_of, text_of
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.observations import Observations
from rocksteady.risk.observations.prior import OutcomeErrors
from rocksteady.risk.observations.shaking_test import ShakingTest
from rocksteady.risk.observations.spread import PriorRange
from rocksteady.sweep.run import Execution

FORM = "rocksteady/calibrate/1"
"""Form of fit.json: a later one has another number."""
TABLES = ("posterior.csv", "predictions.csv")
FILES = ("fit.json", *TABLES)
WEIGHTS = ("weight", "untempered_weight", "prior_weight")
HINT = "name the folder that calibrate --out has written"


def posterior_rows(calibration: Calibration) -> tuple[list[str], list[list[object]]]:
    """Return header and rows of posterior.csv: a row for each draw of each object."""
    posteriors = list(calibration.posteriors.values())
    names = list(dict.fromkeys(name for each in posteriors for name in each.names))
    sessions = dict.fromkeys(session for each in posteriors for session in each.sessions)
    names += [label for session in sessions for label in _labels(session)]
    rows: list[list[object]] = []
    for name, each in calibration.posteriors.items():
        columns = {key: each.values[:, place].tolist() for place, key in enumerate(each.names)}
        columns |= {
            label: each.sessions[session][:, place].tolist()
            for session in each.sessions
            for place, label in enumerate(_labels(session))
        }
        weights = (each.weights, each.untempered_weights, each.prior_weights)
        lists = [column.tolist() for column in weights]
        for draw in range(len(each.values)):
            cells = [columns[key][draw] if key in columns else "" for key in names]
            rows.append([name, draw, *cells, *(column[draw] for column in lists)])
    return ["object", "draw", *names, *WEIGHTS], rows


def _labels(session: str) -> tuple[str, str]:
    """Return the columns of mean and deviation of a session's ln(gain)."""
    return f"ln gain of session {session}", f"its deviation, session {session}"


@checked_result
@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class StoredPosterior(Result):
    """Posteriors of a calibration, from its folder.

    Attributes
    ----------
    posteriors
        Weighted draws by object, without the fates of the training tests.
    predictions
        Predictions of the training tests, each without its group.
    trained
        Hash (SHA-256) of each training test, by its name.
    sampling, model
        Sampling and model of the calibration.
    recalibration
        Line over the log odds of predictions of other tests.
    """

    posteriors: Mapping[str, Posterior]
    predictions: Predictions
    trained: Mapping[str, str]
    sampling: DrawOptions
    model: Model
    recalibration: Platt = PLAIN

    def predict(
        self, tests: Observations | Sequence[ShakingTest], *, run: Execution | None = None
    ) -> Predictions:
        """Predict tests as the calibration itself does; see `Calibration.predict`."""
        source = Source(
            posteriors=self.posteriors,
            sampling=self.sampling,
            model=self.model,
            recalibration=self.recalibration,
        )
        return predict_all(listed(tests), self.trained, self.predictions, source, run)

    def describe(self) -> Description:
        """Return objects and draws."""
        draws = {name: len(each.values) for name, each in self.posteriors.items()}
        return Description(
            headline=f"posterior of {plural(len(draws), 'object')} from "
            f"{plural(len(self.trained), 'test')}",
            facts=[
                Fact("objects", list(draws), "objects"),
                Fact("draws", draws),
                Fact("tests", len(self.trained), "tests"),
                Fact("seed", self.sampling.seed, "seed"),
            ],
        )


@checked
def read_posterior(folder: Path | str) -> StoredPosterior:
    """Read the posteriors of a calibration from its folder.

    Parameters
    ----------
    folder
        With ``fit.json``, ``posterior.csv`` and ``predictions.csv``.

    Returns
    -------
    StoredPosterior
        It predicts as the calibration did, to the last bit.

    Raises
    ------
    InputError
        If a file is missing or not as it was written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from rocksteady import Block, Linear, calibrate
    >>> from rocksteady.calibration import DrawOptions, make_synthetic_tests, read_posterior
    >>> from rocksteady.export import write_calibration
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.3, height=1.2)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(2))
    >>> calibration = calibrate(
    ...     tests, sampling=DrawOptions(draws=30, rounds=1, gains=1), model=Linear()
    ... )
    >>> with TemporaryDirectory() as folder:
    ...     files = write_calibration(calibration, folder)
    ...     stored = read_posterior(folder)
    >>> bool((stored.predict(tests).p == calibration.predict(tests).p).all())
    True
    """
    path = Path(folder)
    contents = {name: content_of(path / name, "folder", HINT) for name in FILES}
    texts = {
        name: text_of(content, name, name.rpartition(".")[2]) for name, content in contents.items()
    }
    try:
        fit = json.loads(texts["fit.json"])
        if (form := fit["schema"]) != FORM:
            raise ValueError(f"its form is {form}, and this version of rocksteady reads {FORM}")
        sampling = DrawOptions(
            draws=fit["draws"], gains=fit["gains"], error=fit["error"], seed=fit["seed"]
        )
        model: Model = (
            Linear() if fit["model"] == "linear" else Nonlinear(tolerance=fit["tolerance"])
        )
        noise = OutcomeErrors(
            **{key: PriorRange.parse(text) for key, text in fit["inputs"]["noise"].items()}
        )
        spaces = {
            name: Space(
                block=ObjectPrior(name=name, **spreads),
                noise=noise,
                sessions=bool(fit["sessions"][name]),
            )
            for name, spreads in fit["inputs"]["objects"].items()
        }
        _refuse_changed(contents, fit["files"])
        rows = _rows(texts["posterior.csv"])
        predictions = _predictions(texts["predictions.csv"])
        if list(predictions.test) != list(fit["trained"]):
            raise ValueError("predictions.csv has other tests than fit.json")
        return StoredPosterior(
            posteriors={
                name: _posterior(name, space, rows, fit["sessions"][name])
                for name, space in spaces.items()
            },
            predictions=predictions,
            trained=dict(fit["trained"]),
            sampling=sampling,
            model=model,
            recalibration=Platt(**fit["recalibration"]),
        )
    except KeyError as error:
        why = f"{error} is missing"
    except (TypeError, ValueError, AttributeError, OverflowError, RecursionError) as error:
        why = str(error)
    raise InputError("folder", folder, f"its files are not those of a calibration: {why}", HINT)


def _refuse_changed(contents: Mapping[str, bytes], hashes: Mapping[str, str]) -> None:
    """Refuse tables that are not those which were written beside fit.json.

    A table cut at the end of a line, or of another calibration, would be read without a fault.
    """
    for name in TABLES:
        if hashlib.sha256(contents[name]).hexdigest() != hashes[name]:
            message = f"{name} is not the file that was written with fit.json"
            raise ValueError(message)


def _posterior(
    name: str, space: Space, rows: Sequence[Mapping[str, Any]], sessions: Sequence[str]
) -> Posterior:
    """Return the posterior of an object."""
    rows_of_object = [row for row in rows if row["object"] == name]
    labels = [label for session in sessions for label in _labels(session)]
    keys = (*space.names, *WEIGHTS, *labels)
    table = np.array([[float(row[key]) for key in keys] for row in rows_of_object]).reshape(
        len(rows_of_object), len(keys)
    )
    if not rows_of_object or not np.isfinite(table).all():
        raise ValueError(f"posterior.csv has no draws of {name}, or one is no number")
    size = space.size
    return Posterior(
        object=name,
        space=space,
        values=np.ascontiguousarray(table[:, :size]),
        weights=table[:, size].copy(),
        untempered_weights=table[:, size + 1].copy(),
        prior_weights=table[:, size + 2].copy(),
        fates=np.empty((len(rows_of_object), 0)),
        sessions={
            session: table[:, size + 3 + 2 * place : size + 5 + 2 * place].copy()
            for place, session in enumerate(sessions)
        },
    )


def _rows(text: str) -> list[dict[str, str]]:
    """Return the lines of a table by their columns."""
    header, *rows = csv.reader(io.StringIO(text, newline=""))
    return [dict(zip(header, map(read_cell, row), strict=True)) for row in rows if row]


def _predictions(text: str) -> Predictions:
    """Return the predictions of the training tests."""
    rows = _rows(text)
    outcomes = {word: fell for fell, word in OUTCOMES.items()}

    def numbers(key: str) -> Floats:
        return np.array([float(row[key] or "nan") for row in rows])  # a band may be missing

    return Predictions(
        test=tuple(row["test"] for row in rows),
        object=tuple(row["object"] for row in rows),
        group=tuple(row["group"] for row in rows),
        p=numbers("p"),
        low=numbers("low"),
        high=numbers("high"),
        mc_error=numbers("mc_error"),
        effective_draws=numbers("effective_draws"),
        held_out=(True,) * len(rows),
        fell=tuple(outcomes[row["outcome"]] for row in rows),
    )
