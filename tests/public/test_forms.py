"""Forms of what the package writes: what version 0.1.0 wrote is read by every later one.

Stores have a test of their own, `tests/sweep/store/test_forms.py`.
"""

import re
import zipfile
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path

import pytest

import rocksteady as rs
from rocksteady.calibration import read_posterior
from rocksteady.proofs import check_certificate
from tests.every import every
from tools.freeze.records import FOLDER, loaded

KEYS = Path(__file__).with_name("json-keys.txt")
"""Of each schema the keys that its objects have, each with the block or flag that it belongs to."""
WRITTEN = Path(__file__).with_name("written-0.1.0.zip")
"""A calibration by four synthetic tests, and a certificate of each kind."""
CERTIFIED = ("chaos", "fate", "orbit", "point", "region")


def written() -> dict[str, set[str]]:
    """The keys of the JSON objects that commands print, by schema, from the recorded answers."""
    found: dict[str, set[str]] = defaultdict(set)
    for part in ("commands", "long-commands"):
        for text in loaded((FOLDER / f"{part}.txt").read_text(encoding="utf-8")).values():
            for schema in re.findall(r'^schema: "(\S+)"$', text, re.MULTILINE):
                found[schema] |= set(re.findall(r"^(\w+): ", text, re.MULTILINE))
                found[schema] -= {"rocksteady"}  # begins what stands on standard error
    return found


def promised() -> dict[str, set[str]]:
    """The keys that stay as long as the number of their schema."""
    lines = KEYS.read_text(encoding="utf-8").splitlines()
    return {
        schema: set(keys.split()) for schema, _, keys in (each.partition(": ") for each in lines)
    }


def test_a_key_goes_only_with_the_number_of_its_schema() -> None:
    """A schema with a new number gets a line of its own; a new key is added to its line."""
    now = written()
    lost = {schema: keys - now[schema] for schema, keys in promised().items() if schema in now}
    assert {schema: sorted(keys) for schema, keys in lost.items() if keys} == {}
    assert {schema: sorted(keys - promised()[schema]) for schema, keys in now.items()} == {
        schema: [] for schema in now
    }
    assert len(now) > 20


def test_every_schema_has_a_number() -> None:
    numbers = [re.fullmatch(r"rocksteady/[a-z-]+/([1-9]\d*)", schema) for schema in promised()]
    assert all(numbers)


# ------------------------------------------------------------------------ files that are read


@pytest.fixture
def files(tmp_path: Path) -> Path:
    with zipfile.ZipFile(WRITTEN) as archive:
        archive.extractall(tmp_path)
    return tmp_path


def test_a_calibration_of_version_0_1_0_is_read(files: Path) -> None:
    stored = read_posterior(files / "fit")
    posterior = stored.posteriors["synthetic block"]
    assert posterior.values.shape == (50, len(posterior.space.names))
    assert posterior.values[0, :2].tolist() == [0.2317424160267462, 6.235041780124618]
    assert posterior.weights[:2].tolist() == [0.016309456967446876, 0.0008454720119823452]
    assert stored.predictions.p[:2].tolist() == [0.015986117078231228, 0.302647743736466]
    assert sorted(stored.trained) == [f"test {number}" for number in (1, 3, 5, 7)]
    assert (stored.model, stored.seed) == (rs.Linear(), 0)


@every("kind", CERTIFIED)
def test_a_certificate_of_version_0_1_0_holds(kind: str, files: Path) -> None:
    found = check_certificate(files / "certificates" / f"{kind}.json", leaves=None)
    assert (found.kind, found.verdict) == (kind, "holds")


def test_a_form_to_come_is_refused_with_both_names(files: Path) -> None:
    def refused(file: Path, form: str, read: Callable[[Path], object], read_from: Path) -> None:
        text, now = file.read_text(encoding="utf-8"), 2 if form == "calibrate" else 1
        file.write_text(text.replace(f'{form}/{now}"', f'{form}/{now + 1}"', 1), encoding="utf-8")
        words = f"its form is .*{form}/{now + 1}.* .*/{now}"
        with pytest.raises(rs.errors.InputError, match=words):
            read(read_from)

    refused(files / "fit" / "fit.json", "calibrate", read_posterior, files / "fit")
    for kind in CERTIFIED:
        file = files / "certificates" / f"{kind}.json"
        refused(file, "rocking-certificate", check_certificate, file)
