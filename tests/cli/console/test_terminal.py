"""What surrounds the program decides nothing: streams, encodings, widths, signals, odd names."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from rocksteady.cli import app
from rocksteady.cli.console import terminal
from rocksteady.results.rendering import printable
from tests.cli.motion_files import at2, samples
from tests.cli.program import refused, rocksteady
from tests.every import every

PROGRAM = (sys.executable, "-m", "rocksteady")
ODD_NAMES = (
    b"$\\frac{$",
    b"[red",
    b"a\nb\tc",
    b"\xff\xfe",
    "\u202ertl".encode(),
    "漢字😀".encode(),
)


def shell(line: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a line of a shell, in which P is the program."""
    return subprocess.run(
        ["sh", "-c", line.replace("P ", f"{sys.executable} -m rocksteady ", 1)],
        capture_output=True,
        text=True,
        check=False,
        errors="replace",
        env={**os.environ, **environment},
    )


# ----------------------------------------------------------------------------------- streams


def test_messages_do_not_take_the_place_of_results_where_standard_error_is_closed() -> None:
    done = shell("P steady -A 2 -W 4 -r 8 2>&-")
    assert (done.returncode, done.stdout, done.stderr) == (2, "", "")
    done = shell("P steady -A 2 -W 4 -r 0.8 --json 2>&-")
    assert done.returncode == 0
    assert json.loads(done.stdout)["schema"] == "rocksteady/steady/1"


@pytest.mark.slow
@every("closed", ["2>/dev/full", "0<&-", "0<&- 2>&-"])
def test_streams_that_take_nothing_change_no_result(closed: str) -> None:
    done = shell(f"P steady -A 2 -W 4 -r 0.8 --json {closed}")
    assert (done.returncode, done.stdout) == (0, rocksteady("steady -A 2 -W 4 -r 0.8 --json").out)
    assert shell(f"P steady -A 2 -W 4 -r 8 {closed}").returncode == 2


@pytest.mark.slow
@pytest.mark.parametrize("command", ["steady -A 2 -W 4 -r 0.8", "steady -A 2 -W 4 -r 0.8 --json"])
def test_a_result_that_cannot_be_written_is_no_success(command: str) -> None:
    done = shell(f"P {command} >/dev/full")
    line = "rocksteady: standard output cannot be written: {}; lead it into a file, a pipe or "
    line += "/dev/null\n"
    assert (done.returncode, done.stderr) == (2, line.format("No space left on device"))
    done = shell(f"P {command} >&-")
    assert (done.returncode, done.stderr) == (2, line.format("it is closed"))


@pytest.mark.slow
@every("encoding", ["cp1252", "ascii"])
def test_no_encoding_of_the_terminal_ends_a_command(encoding: str) -> None:
    command = "bifurcate -A 2 -W 1.9:2:3 -r 0.8 --no-sweeps"
    done = shell(f"P {command}", PYTHONIOENCODING=encoding)
    assert (done.returncode, done.stderr) == (0, "")
    expected = rocksteady(command).out.encode(encoding, "backslashreplace").decode(encoding)
    assert done.stdout.encode("latin-1", "replace") == expected.encode("latin-1", "replace") or (
        encoding != "ascii"
    )
    done = shell(f"P {command} --help", PYTHONIOENCODING=encoding)
    assert (done.returncode, done.stderr) == (0, "")


# --------------------------------------------------------------------------------- environment


@every("columns", ["0", "1", "garbage", "-3", "²", "9" * 5000])
def test_no_width_of_the_terminal_takes_output_away(
    columns: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("LINES", "TERMINAL_WIDTH"):
        monkeypatch.setenv(name, columns)
    monkeypatch.delenv("COLUMNS", raising=False)
    expected = rocksteady("steady -A 2 -W 4 -r 0.8").out
    monkeypatch.setenv("COLUMNS", columns)
    for name in ("LINES", "TERMINAL_WIDTH"):
        monkeypatch.setenv(name, columns)
    assert rocksteady("steady -A 2 -W 4 -r 0.8").out.split() == expected.split()
    monkeypatch.setenv("COLUMNS", columns)
    ran = rocksteady("steady --help")
    assert (ran.code, ran.err) == (0, "")
    assert "--amplitude" in ran.out
    assert max(map(len, ran.out.splitlines())) <= terminal.WIDEST


@pytest.mark.slow
def test_settings_of_matplotlib_do_not_end_a_command(tmp_path: Path) -> None:
    (tmp_path / "matplotlibrc").write_text("text.usetex: true\nbackend: none-such\nnonsense: 1\n")
    (tmp_path / "file").touch()
    done = subprocess.run(
        [*PROGRAM, *["steady", "-A", "2", "-W", "4", "-r", "0.8", "--plot", "a.png", "--json"]],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "MPLBACKEND": "garbage", "MPLCONFIGDIR": str(tmp_path / "file")},
    )
    assert (done.returncode, done.stderr) == (0, "wrote a.png\n")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


# -------------------------------------------------------------------------------------- names


@pytest.fixture(params=ODD_NAMES, ids=range(len(ODD_NAMES)))
def odd(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A record whose name is markup, a formula, a control, or no text at all."""
    file = tmp_path / f"{os.fsdecode(request.param)}.at2"
    at2(file, samples()[:200])
    return file


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:Glyph")
def test_no_name_of_a_record_ends_a_command(odd: Path, tmp_path: Path) -> None:
    plot, csv = tmp_path / "a.png", tmp_path / "a.csv"
    block = "--width-m 0.4 --height-m 2"
    ran = rocksteady(f"record {block} --plot", plot, "--csv", csv, odd)
    assert ran.code == 0, ran.err
    assert "".join(printable(odd.stem).split()) in "".join(ran.out.split())
    assert rocksteady("record --json", odd).json["file"] == str(odd)
    ran = rocksteady(f"simulate {block} --force --plot", plot, "--csv", csv, "--record", odd)
    assert ran.code == 0, ran.err
    assert rocksteady(f"simulate {block} --json --record", odd).json["record"]
    store, nc = tmp_path / "a.zarr", tmp_path / "a.nc"
    sizes = "spectrum --alpha-rad 0.2 --periods-s 1:2:2 --force"
    files = ("--plot", plot, "--csv", csv, "--netcdf", nc, "--out", store, "--record", odd)
    ran = rocksteady(sizes, *files)
    assert ran.code == 0, ran.err
    for line in ran.err.splitlines():
        assert line.isprintable()
    assert csv.read_text(encoding="utf-8")


def test_no_name_of_a_file_makes_two_lines(tmp_path: Path) -> None:
    file = tmp_path / "two\nlines\x1b.csv"
    ran = rocksteady("steady -A 2 -W 4 -r 0.8 --csv", file)
    assert (ran.code, ran.err) == (0, f"wrote {printable(file)}\n")
    assert "two\\nlines\\x1b.csv" in refused("steady -A 2 -W 4 -r 0.8 --csv", file)
    assert "\\x1b" in refused("steady", "--no\x1b\nflag")
    assert len(refused("steady", "x" * 100_000)) < 1000


# ------------------------------------------------------------------------------------- signals


@pytest.mark.slow
@every(("name", "command"), [("SIGINT", "map"), ("SIGTERM", "spectrum"), ("SIGHUP", "map")])
def test_a_sweep_that_a_signal_ends_says_how_it_goes_on(
    name: str, command: str, tmp_path: Path
) -> None:
    at2(tmp_path / "a.at2", samples())
    flags = {
        "map": "map -A 0.1:6:2000 -W 0.2:8:2000 -r 0.8 --chunk 1024 --out out.zarr",
        "spectrum": "spectrum --record a.at2 --alpha-rad 0.05:0.4:400 --periods-s 0.5:5:400 "
        "--chunk 64 --out out.zarr",
    }
    running = subprocess.Popen(
        [*PROGRAM, *flags[command].split()],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    done = tmp_path / "out.zarr" / "done" / "c"
    while running.poll() is None and not (done.is_dir() and any(done.iterdir())):
        time.sleep(0.05)
    running.send_signal(getattr(signal, name))
    try:
        out, err = running.communicate(timeout=60)
    finally:
        running.kill()
    assert (running.returncode, out) == (128 + getattr(signal, name), "")
    lines = err.splitlines()
    assert lines[-2] == f"  rocksteady {flags[command]} --resume"
    assert " cells are kept in out.zarr; to go on:" in lines[-3]
    words = "interrupted" if name == "SIGINT" else f"interrupted by {name}"
    assert lines[-1] == f"rocksteady: {words}"


def test_a_signal_that_is_ignored_stays_so() -> None:
    done = shell("trap '' HUP; P steady -A 2 -W 4 -r 0.8 --json")
    assert done.returncode == 0
    code = (
        "import signal\nfrom rocksteady.cli.console import terminal\n"
        "signal.signal(signal.SIGHUP, signal.SIG_IGN)\nterminal.catch_signals()\n"
        "assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN\n"
        "assert callable(signal.getsignal(signal.SIGTERM))\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


# ------------------------------------------------------------------------- errors of others


@every(
    ("error", "words"),
    [
        (MemoryError("Unable to allocate 7 TiB"), "more memory is needed"),
        (UnicodeDecodeError("utf-8", b"\xff", 0, 1, "bad"), "cannot be read as text"),
        (PermissionError(13, "Permission denied", "/a/b"), "/a/b cannot be read or written"),
        (OSError(28, "No space left on device"), "No space left on device"),
    ],
)
def test_errors_of_the_surroundings_are_one_line(
    error: Exception, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(_: object) -> None:
        raise error

    monkeypatch.setattr("rocksteady.cli.flags.block_and_shaking.BlockFlags.described", broken)
    assert words in refused("steady -A 2 -W 4 -r 0.8")


@pytest.fixture
def _signals() -> Iterator[None]:
    """Signals and streams of the tests, put back afterwards."""
    usual = {name: signal.getsignal(getattr(signal, name)) for name in terminal.ENDING}
    errors = sys.stderr
    yield
    sys.stderr = errors
    for name, handler in usual.items():
        signal.signal(getattr(signal, name), handler)
    terminal.received.clear()


@pytest.mark.usefixtures("_signals")
def test_the_code_names_the_signal(monkeypatch: pytest.MonkeyPatch) -> None:
    def stopped(_: object) -> None:
        signal.raise_signal(signal.SIGTERM)

    monkeypatch.setattr(sys, "argv", ["rocksteady", "steady", "-A", "2", "-W", "4", "-r", "0.8"])
    monkeypatch.setattr("rocksteady.cli.flags.block_and_shaking.BlockFlags.described", stopped)
    with pytest.raises(SystemExit) as left:
        app.main()
    assert left.value.code == 143
