"""Tables of three samples that tests write and read."""

from pathlib import Path

from rocksteady.records import Recording, read_recordings

G = 9.80665
THREE = [1.0, -2.5, 0.5]


def read(tmp_path: Path, text: str, **given: object) -> tuple[Recording, ...]:
    path = tmp_path / "table.txt"
    path.write_text(text, encoding="utf-8")
    return read_recordings(path, **given)  # type: ignore[arg-type]
