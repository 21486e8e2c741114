"""Files after kills and power failures: the new one or the one before it, whole, of every kind."""

import os
import shutil
import stat
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from rocksteady import durable
from rocksteady.errors import OutputError
from rocksteady.show.export.files import save_text
from rocksteady.show.export.folders import CALIBRATION, check_folder, fill_folder
from tests.disk import after_losses, recorded
from tests.outputs import WRITERS

ROOT = str(Path(__file__).parents[1])


def nothing() -> None:
    """Refuse nothing."""


KILLS = """
import os, shutil, signal, sys
from pathlib import Path
from rocksteady.durable import PREFIX
from tests.outputs import WRITERS
root, name, step = Path(sys.argv[1]), sys.argv[2], int(sys.argv[3])
write = WRITERS[name]
write(root / "old" / name, 1.0)
write(root / "new" / name, 2.0)
old, new = ((root / which / name).read_bytes() for which in ("old", "new"))

def kill_at(left):
    def here():
        nonlocal left
        left -= 1
        if left < 0:
            os.kill(os.getpid(), signal.SIGKILL)
    def watched(function):
        def wrapped(*arguments, **options):
            here()
            result = function(*arguments, **options)
            here()
            return result
        return wrapped
    for name in ("replace", "unlink", "mkdir", "rmdir", "fsync", "open", "close"):
        setattr(os, name, watched(getattr(os, name)))

moment, there = 0, []
while True:
    place = root / str(moment)
    place.mkdir()
    shutil.copy(root / "old" / name, place / name)
    child = os.fork()
    if child == 0:
        kill_at(moment)
        write(place / name, 2.0)
        os._exit(0)
    status = os.waitpid(child, 0)[1]
    found = (place / name).read_bytes()
    assert found in (old, new), moment
    there.append(found == new)
    rest = [path.name for path in place.iterdir() if path.name != name]
    assert all(path.startswith(PREFIX) for path in rest), rest
    if os.WIFEXITED(status):
        assert os.WEXITSTATUS(status) == 0 and there[-1] and not rest
        break
    write(place / name, 2.0)
    assert [path.name for path in place.iterdir()] == [name], "the next write removes what is left"
    moment += step
assert there == sorted(there)
print(moment)
"""


@pytest.fixture
def content(tmp_path: Path, request: pytest.FixtureRequest) -> tuple[str, bytes, bytes]:
    """Name of an output, and its old and its new content."""
    name: str = request.param
    found = []
    for which, value in (("old", 1.0), ("new", 2.0)):
        (tmp_path / which).mkdir()
        WRITERS[name](tmp_path / which / name, value)
        found.append((tmp_path / which / name).read_bytes())
    assert found[0] != found[1]
    return name, found[0], found[1]


@pytest.mark.slow
@pytest.mark.parametrize("content", WRITERS, indirect=True)
@pytest.mark.parametrize("there", [True, False])
def test_a_power_failure_leaves_the_old_file_or_the_new_one(
    content: tuple[str, bytes, bytes], there: bool, tmp_path: Path
) -> None:
    name, old, new = content
    place = tmp_path / "place"
    place.mkdir()
    if there:
        (place / name).write_bytes(old)
    with recorded(place) as recorder:
        WRITERS[name](place / name, 2.0)
    allowed = {old if there else None, new}
    lost = tmp_path / "lost"
    lost.mkdir()
    seen = set()
    for moment, folder in after_losses(recorder.moments, lost, draws=6):
        found = (folder / name).read_bytes() if (folder / name).is_file() else None
        assert found in allowed, moment.what
        assert found == new or moment is not recorder.moments[-1], "announced, and not there"
        seen.add(found)
    assert seen == allowed


def careless(file: Path, *, force: bool) -> None:
    """Write as one does without thinking of a power failure, but for the file itself."""
    staged = file.with_name("staged")
    with staged.open("w", encoding="utf-8") as stream:
        stream.write("new")
        if force:
            stream.flush()
            os.fsync(stream.fileno())
    staged.replace(file)


@pytest.mark.parametrize("force", [True, False])
def test_the_disk_finds_those_that_do_not_force(force: bool, tmp_path: Path) -> None:
    place, lost = tmp_path / "place", tmp_path / "lost"
    place.mkdir()
    lost.mkdir()
    (place / "a").write_text("old", encoding="utf-8")
    with recorded(place) as recorder:
        careless(place / "a", force=force)
    losses = after_losses(recorder.moments[-1:], lost, draws=6)
    found = {(folder / "a").read_text(encoding="utf-8") for _, folder in losses}
    assert "old" in found  # the folder was not forced
    assert ("" in found) is not force


@pytest.mark.parametrize(
    ("names", "step"),
    [
        (["a.csv"], 5),
        pytest.param(list(WRITERS), 4, marks=pytest.mark.slow),
    ],
)
def test_a_kill_leaves_the_old_file_or_the_new_one(
    names: list[str], step: int, tmp_path: Path
) -> None:
    for name in names:
        root = tmp_path / name
        for folder in ("old", "new"):
            (root / folder).mkdir(parents=True)
        done = subprocess.run(
            [sys.executable, "-c", KILLS, root, name, str(step)],
            env={**os.environ, "PYTHONPATH": ROOT},
            capture_output=True,
            text=True,
            timeout=200,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        assert int(done.stdout) >= 10


def study(stage: Path, value: str) -> None:
    for name in ("a.csv", "b.svg", "claims.json", "report.html"):
        if name == "b.svg":
            (stage / name).write_text(f"{value} {name}", encoding="utf-8")
        else:
            save_text("out", stage / name, f"{value} {name}")


def test_a_power_failure_leaves_whole_files_in_the_folder_of_a_study(tmp_path: Path) -> None:
    place = tmp_path / "place"
    place.mkdir()
    fill_folder(place / "out", lambda stage: study(stage, "old"), nothing)
    (place / "out" / "thesis").write_text("mine", encoding="utf-8")
    with recorded(place) as recorder:
        fill_folder(place / "out", lambda stage: study(stage, "new"), nothing)
    lost = tmp_path / "lost"
    lost.mkdir()
    for moment, folder in after_losses(recorder.moments, lost, draws=4):
        assert (folder / "out" / "thesis").read_text(encoding="utf-8") == "mine"
        for name in ("a.csv", "b.svg", "claims.json", "report.html"):
            found = (folder / "out" / name).read_text(encoding="utf-8")
            end = moment is recorder.moments[-1]
            assert found in {f"new {name}", "" if end else f"old {name}"}, moment.what


# ------------------------------------------------------------------------- what may be written over


def test_private_names_cannot_be_foreseen(tmp_path: Path) -> None:
    names = set()
    for _ in range(3):

        def note(staged: Path) -> None:
            assert staged.parent.stat().st_mode & 0o777 == 0o700
            assert staged.parent.stat().st_uid == os.getuid()
            names.add(staged.parent.name)
            staged.write_text("x", encoding="utf-8")

        durable.write(tmp_path / "a", note)
    assert len(names) == 3
    assert [path.name for path in tmp_path.iterdir()] == ["a"]


def test_a_link_stays_and_what_it_leads_to_is_written(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    for name in ("there", "missing"):
        target = tmp_path / "elsewhere" / name
        if name == "there":
            target.write_text("old", encoding="utf-8")
        (tmp_path / name).symlink_to(target)
        save_text("--csv", tmp_path / name, "new")
        assert (tmp_path / name).is_symlink()
        assert target.read_text(encoding="utf-8") == "new"


def test_another_name_of_the_file_keeps_what_it_held(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("old", encoding="utf-8")
    (tmp_path / "b").hardlink_to(tmp_path / "a")
    save_text("--csv", tmp_path / "a", "new")
    assert (tmp_path / "b").read_text(encoding="utf-8") == "old"


def test_who_may_read_a_file_does_not_change(tmp_path: Path) -> None:
    (tmp_path / "a").touch(mode=0o600)
    save_text("--csv", tmp_path / "a", "new")
    assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == 0o600


def odd_places(folder: Path) -> dict[str, str]:
    """Make things in whose place no file may be put; return why, by their names."""
    (folder / "folder").mkdir()
    os.mkfifo(folder / "pipe")
    (folder / "to-folder").symlink_to(folder / "folder")
    (folder / "to-pipe").symlink_to(folder / "pipe")
    (folder / "to-null").symlink_to("/dev/null")
    (folder / "circle").symlink_to(folder / "circle")
    (folder / "lost").symlink_to(folder / "nowhere" / "a")
    return {
        "folder": "it is a folder",
        "pipe": "a device or a pipe",
        "to-folder": "it is a folder",
        "to-pipe": "a device or a pipe",
        "to-null": "a device or a pipe",
        "circle": "symbolic links",
        "lost": "the folder that the link leads to does not exist",
    }


def test_what_is_no_file_is_never_replaced(tmp_path: Path) -> None:
    places = odd_places(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    for name, why in places.items():
        with pytest.raises(OutputError, match=why):
            save_text("--csv", tmp_path / name, "new")
    for device in ("/dev/null", "/dev/zero", "/dev/full"):
        with pytest.raises(OutputError, match="a device or a pipe"):
            save_text("--csv", Path(device), "new")
        assert stat.S_ISCHR(Path(device).stat().st_mode)
    assert sorted(tmp_path.rglob("*")) == before


def test_a_study_replaces_no_folder_and_no_pipe(tmp_path: Path) -> None:
    odd_places(tmp_path)
    for name in ("folder", "pipe", "to-null", "lost"):
        with pytest.raises(OutputError, match="move it, or name another folder"):
            check_folder(tmp_path, name, force=True)
    (tmp_path / "dangling").symlink_to(tmp_path / "nothing")
    with pytest.raises(OutputError, match="it holds dangling; add --force"):
        check_folder(tmp_path, "dangling")
    check_folder(tmp_path, "dangling", force=True)
    for _ in range(2):
        shutil.rmtree(tmp_path / "folder", ignore_errors=True)
        fill_folder(tmp_path, lambda stage: save_text("out", stage / "dangling", "new"), nothing)
        assert (tmp_path / "dangling").is_symlink()
        assert (tmp_path / "nothing").read_text(encoding="utf-8") == "new"


@pytest.mark.parametrize("force", [False, True])
def test_of_two_writers_into_one_new_folder_one_wins(force: bool, tmp_path: Path) -> None:
    """Both begin with nothing there; without force the second is told what the first has left."""
    begun, refused = threading.Barrier(2), []

    def write(stage: Path, text: str) -> None:
        for name in ("fit.json", f"{text}.csv"):
            (stage / name).write_text(text, encoding="utf-8")
        begun.wait()

    def writer(text: str) -> None:
        try:
            CALIBRATION.fill(tmp_path / "out", lambda stage: write(stage, text), force=force)
        except OutputError as error:
            refused.append(str(error))

    texts = ("posterior", "parameters")
    writers = [threading.Thread(target=writer, args=(text,)) for text in texts]
    for each in writers:
        each.start()
    for each in writers:
        each.join()
    winner = (tmp_path / "out" / "fit.json").read_text(encoding="utf-8")
    assert {each.name for each in (tmp_path / "out").iterdir()} == {"fit.json", f"{winner}.csv"}
    assert (tmp_path / "out" / f"{winner}.csv").read_text(encoding="utf-8") == winner
    assert len(refused) == (not force)
    assert all("it holds fit.json and 1 more; add --force" in each for each in refused)


def test_one_file_has_many_names(tmp_path: Path) -> None:
    file, new = tmp_path / "a.csv", tmp_path / "new.csv"
    file.write_text("a", encoding="utf-8")
    (tmp_path / "link.csv").symlink_to(file)
    (tmp_path / "folder").symlink_to(tmp_path)
    os.link(file, tmp_path / "hard.csv")
    for name in ("link.csv", "hard.csv", "folder/a.csv", "folder/../" + tmp_path.name + "/a.csv"):
        assert durable.same_file(file, tmp_path / name)
    assert durable.same_file(new, tmp_path / "folder" / "NEW.csv"), "where case is ignored"
    for one, other in ((file, new), (file, tmp_path / "A.csv"), (new, tmp_path / "b.csv")):
        assert durable.same_file(one, other) == (other.exists() and one.samefile(other))


def test_a_folder_that_somebody_else_has_made_is_not_taken_for_a_leftover(tmp_path: Path) -> None:
    """Only what has the name, the rights and the kind of a private folder is removed."""
    left = tmp_path / f"{durable.PREFIX}ab_12xyz"
    left.mkdir(mode=0o700)
    opened = tmp_path / f"{durable.PREFIX}settings"
    opened.mkdir(mode=0o755)
    hidden, elsewhere = tmp_path / ".partial-download", tmp_path / "elsewhere"
    for folder in (hidden, elsewhere):
        folder.mkdir(mode=0o700)
    linked = tmp_path / f"{durable.PREFIX}a_link_1"
    linked.symlink_to(elsewhere)
    for folder in (left, opened, hidden, elsewhere):
        (folder / "notes.txt").write_text("mine", encoding="utf-8")
    save_text("path", tmp_path / "answer.txt", "new")
    assert not left.exists()
    for folder in (opened, hidden, elsewhere, linked):
        assert (folder / "notes.txt").read_text(encoding="utf-8") == "mine"
