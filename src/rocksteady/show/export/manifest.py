"""Manifest of a run: version, seed, command, and hashes of what went in."""

import hashlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rocksteady.errors import InputError
from rocksteady.kernels.machine_code.sources import sources_hash
from rocksteady.model.checks.arguments import checked
from rocksteady.model.motions.base_motion import BaseMotion
from rocksteady.model.motions.record import Record
from rocksteady.show.export.components import text_value
from rocksteady.show.export.ensemble_rows import check_ensemble
from rocksteady.show.export.files import json_text, save_text

if TYPE_CHECKING:
    import xarray

SCHEMA = "rocksteady/run/1"


@checked
def make_manifest(
    motions: Sequence[Record | BaseMotion] | None = None,
    *,
    files: Sequence[Path | str] = (),
    ensemble: "xarray.Dataset | None" = None,
    command: str = "",
    settings: Mapping[str, Any] | None = None,
    warnings: Sequence[str] = (),
) -> dict[str, Any]:
    """Return the manifest of a run: inputs, hashes, seeds, versions.

    It has no date and no folder: the same run gives the same manifest anywhere.

    Parameters
    ----------
    motions
        Records and base motions that were run.
    files
        Files that were read.
    ensemble
        From `rocksteady.run_ensemble`: its model, measure, seed, scatter and warnings.
    command
        Command line that repeats the run.
    settings
        Further settings by name.
    warnings
        Warnings, as sentences.

    Returns
    -------
    dict
        For `rocksteady.export.write_manifest`. SHA-256 hashes are of a file's bytes, and of a
        record's samples [m/s^2] as 64-bit floats, least significant byte first.

    Raises
    ------
    InputError
        If a file cannot be read, or the dataset is no ensemble.

    Examples
    --------
    >>> from rocksteady import Record
    >>> shock = Record(acceleration_m_s2=[0.0, 1.0, -1.0, 0.0], dt_s=0.3, name="shock")
    >>> manifest = make_manifest([shock], command="rocksteady fragility ...")
    >>> manifest["records"][0]["sha256"][:16]
    '82184ba548ed5f52'
    """
    from rocksteady import __version__

    values: dict[str, Any] = {
        "rocksteady": __version__,
        "kernels": sources_hash(),
        "numpy": np.__version__,
        "command": text_value("command", command),
        "settings": dict(settings or {}),
    }
    sentences = [text_value("warnings", sentence) for sentence in warnings]
    if ensemble is not None:
        check_ensemble(ensemble)
        kept = {key: ensemble.attrs.get(key) for key in ("model", "measure", "seed", "scatter")}
        values["ensemble"] = kept | {"cells": int(ensemble["status"].size)}
        sentences += json.loads(ensemble.attrs.get("warnings", "[]"))
    values["records"] = [_of_motion(motion) for motion in motions or ()]
    values["files"] = [_of_file(Path(file)) for file in files]
    values["warnings"] = list(dict.fromkeys(sentences))
    return values


@checked
def write_manifest(path: Path | str, manifest: Mapping[str, Any]) -> Path:
    """Write the manifest of a run as JSON.

    Parameters
    ----------
    path
        The file, which is replaced.
    manifest
        From `rocksteady.export.make_manifest`.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        If a setting is nothing that JSON has.
    OutputError
        If the file cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = write_manifest(f"{folder}/run.json", make_manifest(command="rocksteady"))
    ...     print(file.read_text(encoding="utf-8").splitlines()[1].strip())
    "schema": "rocksteady/run/1",
    """
    file = Path(path)
    try:
        text = json_text(SCHEMA, dict(manifest), indent=2)
    except (TypeError, ValueError, RecursionError) as error:
        raise InputError(
            "manifest", manifest, "it must be numbers, texts, lists and tables of them", str(error)
        ) from error
    save_text("path", file, text + "\n")
    return file


def _of_motion(motion: Record | BaseMotion) -> dict[str, Any]:
    """Return what identifies a motion."""
    if isinstance(motion, Record):
        return {
            "name": motion.name,
            "samples": len(motion.acceleration_m_s2),
            "dt_s": motion.dt_s,
            "sha256": hashlib.sha256(motion.acceleration_m_s2.astype("<f8").tobytes()).hexdigest(),
        }
    parts = [
        _of_motion(part) if isinstance(part, Record) else {"name": repr(part)}
        for part in (motion.horizontal, motion.vertical)
        if part is not None
    ]
    return parts[0] if len(parts) == 1 else {**parts[0], "vertical": parts[1]}


def _of_file(file: Path) -> dict[str, Any]:
    """Return what identifies a file, without its folder."""
    try:
        with file.open("rb") as stream:
            digest = hashlib.file_digest(stream, "sha256").hexdigest()
        return {"name": file.name, "bytes": file.stat().st_size, "sha256": digest}
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError("files", file, f"it cannot be read ({reason})", "name another") from error
