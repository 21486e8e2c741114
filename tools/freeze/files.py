"""Files that a command or a call leaves behind: texts, and pictures by their pixels."""

import csv
import io
import json
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import xarray as xr
from PIL import Image

from rocksteady.sweep.store._contents import DONE
from tools.freeze.records import digest
from tools.freeze.values import STORED, TIMED, of_dataset, of_json, tidy

TEXTS = {".csv", ".md", ".toml", ".txt", ".xml"}
MARKUP = {".html", ".svg"}
"""Texts that are shown by their hash alone."""
CODE = re.compile(
    r'<script[^>]* id="(?:kernels|program)">.*?</script>'
    r'|<style>.*?</style>|content="default-[^"]*"',
    re.DOTALL,
)
"""What holds the code of the explorer's page: its answers are frozen, not its text."""
TOOK = re.compile(r"(Run time(?:</dt><dd>| )|Made by rocksteady VERSION in ).*?(?=</dd>| ·| on )")
"""Durations in pages."""
LOCKS = {"lock", "store.json", "store-copy.json"}
"""Files of a store that belong to its writer."""


def of_file(file: Path, folder: Path) -> str:
    """Return the content of a file as text, without what differs from run to run."""
    kind = file.suffix
    if kind == ".json":
        return of_json(tidy(file.read_text(encoding="utf-8"), folder))
    if kind in TEXTS:
        text = file.read_text(encoding="utf-8")
        return tidy(untimed(text) if kind == ".csv" else text, folder)
    if kind in MARKUP:
        text = TOOK.sub(r"\1DURATION", tidy(file.read_text(encoding="utf-8"), folder))
        if 'id="kernels"' in text:
            text = CODE.sub("", text)
        return f"{len(text)} characters, {digest(text)}"
    if kind == ".nc":
        with xr.open_dataset(file, engine="h5netcdf") as dataset:
            return of_dataset(dataset)
    if kind in {".png", ".gif"}:
        with Image.open(file) as picture:
            frames = []
            for k in range(getattr(picture, "n_frames", 1)):
                picture.seek(k)
                frames.append(digest(np.asarray(picture.convert("RGBA")).tobytes()))
            return f"{picture.size} pixels, {len(frames)} frames, {digest(' '.join(frames))}"
    return f"{file.stat().st_size} bytes, {digest(file.read_bytes())}"


def untimed(text: str) -> str:
    """Return a table without its durations."""
    head, *rows = csv.reader(io.StringIO(text, newline="")) if text else [[]]
    if not TIMED & set(head):
        return text
    kept = [k for k, name in enumerate(head) if name not in TIMED]
    made = io.StringIO(newline="")
    csv.writer(made).writerows([row[k] for k in kept] for row in (head, *rows))
    return made.getvalue()


def of_store(store: Path) -> str:
    """Return metadata and chunks of a store, a line each; not who has computed it and when."""
    lines = []
    for file in sorted(store.rglob("*")):
        if not file.is_file() or file.name in LOCKS:
            continue
        if file.name == "zarr.json":
            metadata = json.loads(file.read_text(encoding="utf-8"))
            found = digest(of_json(json.dumps(metadata), STORED))
        elif file.parts[-3] == DONE:  # checksums that begin with that of the sources
            found = f"{file.stat().st_size} bytes"
        else:
            found = f"{file.stat().st_size} bytes, {digest(file.read_bytes())}"
        lines.append(f"{file.relative_to(store)} {found}")
    return "\n".join(lines)


def files_of(folder: Path) -> dict[str, tuple[int, int]]:
    """Return size and time of each file of a folder."""
    found = {}
    for file in folder.rglob("*"):
        if file.is_file():
            known = file.stat()
            found[str(file.relative_to(folder))] = known.st_size, known.st_mtime_ns
    return found


def left(folder: Path, before: dict[str, tuple[int, int]]) -> Iterator[tuple[str, str]]:
    """Yield names and contents of the files that are new or changed; a store is one of them."""
    now = files_of(folder)
    changed = [name for name in sorted(now) if now[name] != before.get(name)]
    stores = {name.partition(".zarr/")[0] + ".zarr" for name in changed if ".zarr/" in name}
    for name in sorted({*stores, *(name for name in changed if ".zarr/" not in name)}):
        path = folder / name
        yield name, of_store(path) if path.is_dir() else of_file(path, folder)
