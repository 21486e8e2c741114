"""Posteriors on disk: what `calibrate` writes and `predict` reads back, to the last bit."""

import csv
import hashlib
import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from rocksteady.arrays import Floats
from rocksteady.errors import InputError
from rocksteady.model.checks.arguments import checked
from rocksteady.model.equations import Linear, Model, Nonlinear
from rocksteady.results.cells import read_cell
from rocksteady.risk.calibration.calibration import Calibration
from rocksteady.risk.calibration.held_out.predictions import OUTCOMES, Predictions
from rocksteady.risk.calibration.held_out.rivals import LogisticCurve, Stack
from rocksteady.risk.calibration.posterior import Posterior
from rocksteady.risk.calibration.sampler.space import Space
from rocksteady.risk.calibration.stored_posterior import StoredPosterior
from rocksteady.risk.observations.object_prior import ObjectPrior
from rocksteady.risk.observations.spread import PriorRange
from rocksteady.small_files import content_of, text_of

FORM = "rocksteady/calibrate/2"
"""Form of fit.json: a later one has another number."""
TABLES = ("posterior.csv", "predictions.csv")
FILES = ("fit.json", *TABLES)
WEIGHTS = ("weight", "prior_weight")
MODELS = {"linear": Linear, "nonlinear": Nonlinear}
LENGTHS = ("middle", "width", "slopes")
HINT = "name the folder that calibrate --out has written"


def posterior_rows(calibration: Calibration) -> tuple[list[str], list[list[object]]]:
    """Return header and rows of posterior.csv: a row for each draw of each object."""
    posteriors = list(calibration.posteriors.values())
    pairs = [_pairs(each) for each in posteriors]
    names = list(dict.fromkeys(name for each in posteriors for name in each.names))
    names += dict.fromkeys(label for each in pairs for label in each)
    rows: list[list[object]] = []
    for each, columns in zip(posteriors, pairs, strict=True):
        columns |= {key: each.values[:, place] for place, key in enumerate(each.names)}
        lists = {key: column.tolist() for key, column in columns.items()}
        weights = zip(each.weights.tolist(), each.prior_weights.tolist(), strict=True)
        for draw, pair in enumerate(weights):
            cells = [lists[key][draw] if key in lists else "" for key in names]
            rows.append([each.object, draw, *cells, *pair])
    return ["object", "draw", *names, *WEIGHTS], rows


def _pairs(posterior: Posterior) -> dict[str, Floats]:
    """Return mean and deviation of errors and of sessions' ln(gain) by their columns."""
    columns: dict[str, Floats] = {}
    sessions = {f"ln gain of session {key}": pair for key, pair in posterior.sessions.items()}
    for key, pair in (dict(posterior.errors) | sessions).items():
        columns |= {key: pair[:, 0], f"deviation of {key}": pair[:, 1]}
    return columns


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
    >>> from rocksteady.calibration import make_synthetic_tests, read_posterior
    >>> from rocksteady.export import write_calibration
    >>> from rocksteady.motions import make_synthetic_suite
    >>> column = Block.rectangle(width=0.3, height=1.2)
    >>> tests = make_synthetic_tests(column, make_synthetic_suite(2))
    >>> calibration = calibrate(tests, most_runs=200, model=Linear())
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
            raise ValueError(f"its form is {form}, and {FORM} is read: calibrate again")
        _refuse_changed(contents, fit)
        model: Model = (
            MODELS[fit["model"]]()
            if fit["model"] != "nonlinear"
            else Nonlinear(tolerance=fit["tolerance"])
        )
        rows = _rows(texts["posterior.csv"])
        predictions = _predictions(texts["predictions.csv"])
        if list(predictions.test) != list(fit["trained"]):
            raise ValueError("predictions.csv has other tests than fit.json")
        stack = Stack(**fit["stack"])
        parts = [*asdict(stack).values(), *map(np.ravel, fit["curve"].values())]
        sizes = {len(fit["curve"][key]) for key in LENGTHS}
        if not np.isfinite(np.hstack(parts)).all() or len(sizes) > 1:
            raise ValueError("its logistic has another length, or a number that is none")
        if not (stack.block > 0.0 and stack.logistic >= 0.0):
            raise ValueError(
                f"its slopes of block and logistic are {stack.block}, {stack.logistic}"
            )
        curve: dict[str, Any] = {
            key: tuple(each) if isinstance(each, list) else each
            for key, each in fit["curve"].items()
        }
        return StoredPosterior(
            posteriors={
                name: _posterior(
                    name, spreads, fit["inputs"]["noise"][name], rows, fit["sessions"][name]
                )
                for name, spreads in fit["inputs"]["objects"].items()
            },
            predictions=predictions,
            trained=dict(fit["trained"]),
            seed=fit["seed"],
            model=model,
            curve=LogisticCurve(**curve),
            stack=stack,
        )
    except KeyError as error:
        why = f"{error} is missing"
    except (TypeError, ValueError, AttributeError, OverflowError, RecursionError) as error:
        why = str(error)
    raise InputError("folder", folder, f"its files are not those of a calibration: {why}", HINT)


def fit_hash(fit: Mapping[str, Any]) -> str:
    """Return the hash (SHA-256) of what fit.json states, its own hash left out."""
    rest = {key: value for key, value in fit.items() if key != "sha256"}
    text = json.dumps(rest, sort_keys=True, ensure_ascii=True)
    return hashlib.sha256(text.encode()).hexdigest()


def _refuse_changed(contents: Mapping[str, bytes], fit: Mapping[str, Any]) -> None:
    """Refuse files that are not those which were written together.

    A table cut at the end of a line, or of another calibration, would be read without a fault.
    """
    if fit_hash(fit) != fit["sha256"]:
        message = "fit.json has been altered since it was written"
        raise ValueError(message)
    for name in TABLES:
        if hashlib.sha256(contents[name]).hexdigest() != fit["files"][name]:
            message = f"{name} is not the file that was written with fit.json"
            raise ValueError(message)


def _posterior(
    name: str,
    spreads: Mapping[str, str],
    noise: Mapping[str, str],
    rows: Sequence[Mapping[str, Any]],
    sessions: Sequence[str],
) -> Posterior:
    """Return the posterior of an object."""
    space = Space(block=ObjectPrior(name=name, **spreads))
    rows_of_object = [row for row in rows if row["object"] == name]
    labels = {key: key for key in noise} | {
        session: f"ln gain of session {session}" for session in sessions
    }
    pairs = [part for label in labels.values() for part in (label, f"deviation of {label}")]
    keys = (*space.names, *WEIGHTS, *pairs)
    table = np.array([[float(row[key]) for key in keys] for row in rows_of_object]).reshape(
        len(rows_of_object), len(keys)
    )
    if not rows_of_object or not np.isfinite(table).all():
        raise ValueError(f"posterior.csv has no draws of {name}, or one is no number")
    columns = dict(zip(keys, table.T, strict=True))
    moments = {
        key: np.stack([columns[label], columns[f"deviation of {label}"]], axis=1)
        for key, label in labels.items()
    }
    return Posterior(
        object=name,
        space=space,
        values=np.ascontiguousarray(table[:, : space.size]),
        weights=columns["weight"].copy(),
        prior_weights=columns["prior_weight"].copy(),
        errors={key: moments[key] for key in noise},
        noise={key: PriorRange.parse(text) for key, text in noise.items()},
        sessions={session: moments[session] for session in sessions},
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
        block=numbers("block"),
        logistic=numbers("logistic"),
        mc_error=numbers("mc_error"),
        effective_draws=numbers("effective_draws"),
        held_out=(True,) * len(rows),
        fell=tuple(outcomes[row["outcome"]] for row in rows),
    )
