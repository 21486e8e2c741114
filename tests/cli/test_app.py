"""What every command shares: errors, exit codes, files, help, and how it behaves in a shell."""

import math
import os
import re
import signal
import subprocess
import sys
import warnings
from pathlib import Path

import pytest

from rocksteady import __version__
from rocksteady.certify import command as certify
from rocksteady.cli import app
from rocksteady.cli.console import terminal
from tests.cli.bad_input import BAD_INPUT
from tests.cli.motion_files import at2, samples
from tests.cli.program import refused, rocksteady
from tests.every import every

COMMANDS = ("steady", "simulate", "attractor", "orbits", "bifurcate", "curves", "basins", "map")
"""Those that take shaking and a block."""
ORDERED = ("steady", "simulate", "attractor", "bifurcate")
"""Those that take an order."""
commands = every("command", COMMANDS)
SHAKEN = {name: f"{name} -A 2 -W 4" for name in COMMANDS} | {
    "basins": "basins -A 2 -W 4 --angles=-1:1:30 --velocities=-1:1:30",  # short of its progress
    "bifurcate": "bifurcate -A 2 -W 3:5:9",
    "curves": "curves -A 0.2:2:2 -W 3:5:2 --max-impacts 2",
    "map": "map -A 2:3:2 -W 4",
}
"""A command with its shaking."""
HEAVY = ("matplotlib", "numba", "numpy", "scipy", "xarray")
TABLES = ("dask", "h5py", "jinja2", "pandas", "xarray", "zarr")
"""What datasets and data frames bring with them."""


def process(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "rocksteady", *arguments],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, **environment},
    )


def loaded_by(*lines: list[str], code: int = 0, **environment: str) -> set[str]:
    """The modules that a fresh process has loaded after some lines, each with an exit code."""
    program = (
        "import sys, rocksteady.cli.app as app\n"
        f"assert [app.run(line) for line in {lines!r}] == [{code}] * {len(lines)}\n"
        "print('', *sys.modules, sep='\\n')"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, **environment},
    )
    return set(done.stdout.splitlines())


# ------------------------------------------------------------------------------- bad input


FIRST = {
    **dict.fromkeys((*COMMANDS, "edge", "overturn", "spectrum"), ("block", "motion")),
    **{f"certify {kind}": ("block", "motion") for kind in certify.KINDS},
    "assess": ("block", "demand"),
    "fragility": ("block", "suite of motions"),
    "record": ("file",),
}
"""What a command needs."""


@every("command", FIRST)
def test_a_command_alone_asks_for_what_it_needs(command: str) -> None:
    line = refused(command)
    assert f"{' and '.join(FIRST[command])} {'is' if command == 'record' else 'are'} not" in line
    assert f"`rocksteady {command} " in line


@pytest.mark.slow
@every("command", FIRST)
def test_examples_of_a_command_alone_run(command: str) -> None:
    for example in re.findall("`rocksteady (.*?)`", refused(command)):
        assert rocksteady(f"{example} --quiet").out


@every(
    ("line", "flags"),
    [
        ("simulate --height 2", "--height-m"),
        ("simulate --accel 0.4", "--accel-g or --accel-m-s2"),
        ("simulate --freq 1", "--freq-hz"),
        ("simulate --mass 3", "--mass-kg"),
        ("simulate --p=3", "--p-rad-s"),
        ("assess --pgv 0.4", "--pgv-m-s"),
        ("assess --width 0.5", "--width-m"),
        ("simulate --width 0.5 --height-m 2", "--width-m"),
        ("simulate --width 0.5m --height-m 2 --plot a.png", "--width-m"),
        ("fragility --width 500mm --height-m 2", "--width-m"),
    ],
)
def test_a_name_without_its_unit_suggests_the_flag(line: str, flags: str) -> None:
    assert f"did you mean {flags}?" in refused(line)


@every(
    "flags",
    [
        "-A 2 -W 2 -r 0.8 --width 84mm",
        "-A 2 -W 2 -r 0.8 --width 84 --plot a.png",
        "--width-m 0.5 --height-m 2 --width 84",
        "--left-m 0.2 --right-m 0.3 --height-m 2 --width 84mm",
    ],
)
def test_the_width_of_a_picture_is_not_that_of_a_block(flags: str) -> None:
    assert "did you mean" not in refused(f"simulate {flags}")


def test_one_thing_alone_asks_for_the_other() -> None:
    for command in (*COMMANDS, "edge"):
        assert "block is not given" in refused(f"{command} -A 2 -W 4")
        assert "motion is not given" in refused(f"{command} --width-m 0.6 --height-m 2")
        assert "motion is not given" in refused(f"{command} -r 0.8")
    assert "block is not given" in refused("overturn --kick")
    assert "block is not given" in refused("simulate --start 0.5,0")


@commands
@every(
    ("given", "needles"),
    BAD_INPUT,
)
def test_bad_input_is_one_line_with_the_value(command: str, given: str, needles: list[str]) -> None:
    line = refused(f"{command} {given}")
    for needle in needles:
        assert needle in line, line


@every("command", ORDERED)
@every(
    ("order", "needles"),
    [
        ("2", ["--order/-n = 2", "odd"]),
        ("0", ["--order/-n = 0"]),
        ("-1", ["--order/-n = -1"]),
        ("1.5", ["--order", "'1.5'"]),
    ],
)
def test_a_bad_order_is_one_line_with_the_value(
    command: str, order: str, needles: list[str]
) -> None:
    line = refused(f"{SHAKEN[command]} -r 0.8 -n {order}")
    for needle in needles:
        assert needle in line, line


def test_what_typer_refuses_names_the_command_and_no_value_that_is_none_of_its_business() -> None:
    assert "see rocksteady basins --help" in refused("basins -A 1 -W 2 -r 0.8 --entropy")
    told = refused("bifurcate -A 1:2:3 -W 4 -r 0.8 -n 1 -n x")
    assert "--order" in told
    assert "given: '1'" not in told


def test_an_unknown_command_is_one_line() -> None:
    assert "'stedy'" in refused("stedy -A 2")


@commands
def test_a_value_is_never_shown_in_another_unit(command: str) -> None:
    line = refused(f"{command} --width-m 0.4 --height-m 1 --accel-g -0.4 --freq-hz 1")
    assert "--accel-g = -0.4 " in line


# ----------------------------------------------------------------------------------- files


@pytest.mark.slow
@commands
@every("flag", ["--plot", "--csv"])
def test_an_existing_file_is_left_alone_without_force(
    command: str, flag: str, tmp_path: Path
) -> None:
    file = tmp_path / "out.png"
    file.write_text("precious")
    line = refused(f"{SHAKEN[command]} -r 0.8 {flag}", file)
    assert str(file) in line
    assert "--force" in line
    assert file.read_text() == "precious"
    other = tmp_path / ("new.csv" if flag == "--plot" else "new.png")
    refused(
        f"{SHAKEN[command]} -r 0.8 {flag}", file, "--csv" if flag == "--plot" else "--plot", other
    )
    assert not other.exists(), "nothing is written where one output is refused"
    assert rocksteady(f"{SHAKEN[command]} -r 0.8 --force {flag}", file).code == 0
    assert file.read_bytes() != b"precious"
    assert [path.name for path in tmp_path.iterdir()] == ["out.png"]


@commands
@every("flag", ["--plot", "--csv"])
def test_a_missing_folder_and_a_folder_for_a_file_are_refused(
    command: str, flag: str, tmp_path: Path
) -> None:
    missing = tmp_path / "no" / "out.png"
    line = refused(f"{SHAKEN[command]} -r 0.8 {flag}", missing)
    assert str(missing) in line
    assert "does not exist" in line
    assert not missing.parent.exists()
    folder = tmp_path / "folder.png"
    folder.mkdir()
    assert "it is a folder" in refused(f"{SHAKEN[command]} -r 0.8 --force {flag}", folder)


@commands
def test_a_dash_is_no_file(command: str) -> None:
    assert "name a file" in refused(f"{SHAKEN[command]} -r 0.8 --force --csv", Path("-"))


@commands
@every("flag", ["--plot", "--csv"])
def test_an_unwritable_folder_is_refused_before_anything_is_computed(
    command: str, flag: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Not by chmod: the tests may run as root, for whom every folder is writable.
    monkeypatch.setattr(os, "access", lambda *_: False)
    line = refused(f"{SHAKEN[command]} -r 0.8 {flag}", tmp_path / "out.png")
    assert "not writable" in line
    assert list(tmp_path.iterdir()) == []


@commands
def test_an_unknown_figure_format_is_refused_with_the_known_ones(
    command: str, tmp_path: Path
) -> None:
    line = refused(f"{SHAKEN[command]} -r 0.8 --plot", tmp_path / "out.gif")
    for ending in (".png", ".svg", ".pdf"):
        assert ending in line
    refused(f"{SHAKEN[command]} -r 0.8 --plot", tmp_path / "out")


@commands
def test_two_outputs_in_one_file_are_refused(command: str, tmp_path: Path) -> None:
    file = tmp_path / "out.png"
    assert "same file" in refused(f"{SHAKEN[command]} -r 0.8 --plot", file, "--csv", file)


@pytest.mark.slow
@commands
def test_a_disk_that_fills_leaves_nothing_behind(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_self: Path, _target: Path) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    monkeypatch.setattr(os, "link", full)  # the move of a file to where none is
    monkeypatch.setattr("rocksteady.cli.console.progress.QUIET", math.inf)
    line = refused(f"{SHAKEN[command]} -r 0.8 --csv", tmp_path / "out.csv")
    assert "No space left on device" in line
    assert list(tmp_path.iterdir()) == []


@commands
def test_bad_input_leaves_no_file(command: str, tmp_path: Path) -> None:
    refused(f"{SHAKEN[command]} -r 1.2 --plot", tmp_path / "a.png", "--csv", tmp_path / "a.csv")
    assert list(tmp_path.iterdir()) == []


# ------------------------------------------------------------------------- help and version


@commands
def test_help_names_every_flag_with_its_meaning(
    command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "100")
    ran = rocksteady(f"{command} --help-all")
    assert (ran.code, ran.err) == (0, "")
    import typer

    for parameter in typer.main.get_command(app.app).commands[command].params:  # type: ignore[attr-defined]
        for flag in parameter.opts:
            assert flag in ran.out, flag
        assert parameter.help, parameter.name
    assert "rocksteady" in ran.out
    assert "Examples:" in ran.out
    for unit in ("[m]", "[rad]", "[rad/s]", "[m/s^2]", " Hz", " in g"):
        assert unit in ran.out, unit


def test_the_program_lists_its_commands() -> None:
    for command in COMMANDS:
        assert f"\n  {command} " in rocksteady("--help").out


def test_version() -> None:
    assert rocksteady("--version").out == f"rocksteady {__version__}\n"


@pytest.mark.slow
@every(
    "arguments",
    [
        ["--help"],
        ["steady", "--help"],
        ["record", "-h"],
        ["--version"],
    ],
)
def test_help_loads_nothing_heavy(arguments: list[str]) -> None:
    loaded = loaded_by(arguments)
    assert loaded & set(HEAVY) == set()
    assert "rich" in loaded or arguments == ["--version"]


def test_a_refusal_of_flags_loads_nothing_heavy() -> None:
    refused_line = ["simulate", "-A", "2", "-W", "4", "-r", "1.2"]
    assert loaded_by(refused_line, code=2) & set(HEAVY) == set()


def test_a_summary_loads_no_tables(tmp_path: Path) -> None:
    """A dataset, and what it imports with it, takes longer than most of what it would hold."""
    record = at2(tmp_path / "quake.at2", samples())
    lines = (
        "steady -A 2 -W 4 -r 0.8",
        "simulate -A 2 -W 4 -r 0.8",
        "attractor -A 2 -W 4 -r 0.8",
        "orbits -A 2 -W 1.9 -r 0.8",
        "map -A 1:6:3 -W 1:8:3 -r 0.8",
        "map -A 1:6:3 -W 1:8:3 -r 0.8 --fate --json",
        "basins -A 2 -W 4 -r 0.8 --angles=-1:1:4 --velocities=-1:1:4",
        "basins -A 2:3:2 -W 4 -r 0.8 --angles=-1:1:4 --velocities=-1:1:4",
        "overturn --pulse ricker -W 3 -r 0.9",
        "overturn --kick --start 0.5,0 --width-m 0.6 --height-m 1.8",
        f"spectrum --record {record} --alpha-rad 0.2 --periods-s 2:4:2",
        f"spectrum --record {record} --width-m 0.5 --height-m 2",
    )
    assert loaded_by(*map(str.split, lines)) & {*TABLES, "matplotlib"} == set()


@pytest.mark.slow
def test_a_picture_of_a_history_loads_no_more_than_it_shows(tmp_path: Path) -> None:
    """Compilers, statistics and tables of many cases would take most of its first seconds."""
    picture = tmp_path / "history.png"
    line = f"simulate -A 2 -W 4 -r 0.8 --cycles 2 --plot {picture}".split()
    loaded = loaded_by(line, ROCKSTEADY_KERNELS="python")
    assert loaded & {*TABLES, "numba", "scipy", "rocksteady.dynamics.basins"} == set()
    assert "matplotlib" in loaded
    assert picture.stat().st_size > 10_000


@pytest.mark.slow
@every(
    ("call", "code", "lines"),
    [
        ("sys.exit(app.run(['simulate', '-A', '2', '-W', '4', '-r', '0.8']))", 0, 1),
        ("rs.formulas.steady_states(2.0, 4.0, 0.8)", 0, 2),
        ("sys.exit(app.run(['simulate', '--help']))", 0, 0),
    ],
)
def test_without_a_library_a_line_says_so_and_plain_python_runs(
    call: str, code: int, lines: int
) -> None:
    without = (
        "import sys, warnings\n"
        "from rocksteady.kernels.machine_code import compilation\n"
        "compilation.library = lambda: None\n"
        "import rocksteady as rs, rocksteady.cli.app as app\n"
        "if 'app' in sys.argv[1]: warnings.showwarning = app._warn\n"
    )
    own = {name: value for name, value in os.environ.items() if name != "ROCKSTEADY_KERNELS"}
    done = subprocess.run(
        [sys.executable, "-c", without + call, call],
        capture_output=True,
        text=True,
        check=False,
        env=own,
    )
    assert done.returncode == code
    assert len(done.stderr.splitlines()) == lines
    assert lines == 0 or "kernels run as plain Python, " in done.stderr


# -------------------------------------------------------------------------- as a subprocess


def test_python_m_rocksteady_is_the_program() -> None:
    done = process("steady", "-A", "2", "-W", "4", "-r", "0.8", "--json")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == rocksteady("steady -A 2 -W 4 -r 0.8 --json").out
    done = process("steady", "-A", "2", "-W", "4", "-r", "1.2")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("rocksteady: --restitution/-r = 1.2 ")


@every("shell", ["bash", "zsh", "fish"])
def test_the_completion_script_of_each_shell_calls_the_program_back(shell: str) -> None:
    # Asked for by name: --show-completion looks at the shell that runs, which under make is none.
    done = process(_ROCKSTEADY_COMPLETE=f"source_{shell}")
    assert done.returncode == 0
    assert f"_ROCKSTEADY_COMPLETE=complete_{shell}" in done.stdout


def test_completion_knows_commands_and_flags() -> None:
    done = process(_ROCKSTEADY_COMPLETE="complete_bash", COMP_WORDS="rocksteady si", COMP_CWORD="1")
    assert done.stdout.split() == ["simulate"]
    words = "rocksteady steady --freq"
    done = process(_ROCKSTEADY_COMPLETE="complete_bash", COMP_WORDS=words, COMP_CWORD="2")
    assert set(done.stdout.split()) == {"--frequency-ratio", "--freq-hz"}


@pytest.mark.slow
@every(
    "arguments",
    ["--help", "steady -A 2 -W 4 -r 0.8", "steady -A 1:6:300 -W 1:4:30 -r 0.8 --json"],
)
def test_a_closed_pipe_is_no_error(arguments: str) -> None:
    read, write = os.pipe()
    os.close(read)
    try:
        done = subprocess.run(
            [sys.executable, "-m", "rocksteady", *arguments.split()],
            stdout=write,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    finally:
        os.close(write)
    assert (done.returncode, done.stderr) == (0, "")


# --------------------------------------------------------------------------- what goes wrong


@every("command", COMMANDS)
def test_an_internal_error_says_so_and_ends_with_101(
    command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(_: object) -> None:
        raise ZeroDivisionError("by nought")

    monkeypatch.setattr("rocksteady.cli.flags.block_and_shaking.BlockFlags.described", broken)
    ran = rocksteady(f"{SHAKEN[command]} -r 0.8")
    assert ran.code == 101
    assert ran.out == ""
    assert "Traceback" in ran.err
    last = ran.err.splitlines()[-1]
    assert last.startswith("rocksteady: internal error: ZeroDivisionError: by nought")
    assert "report" in last


def test_an_interruption_inside_compiled_code_ends_with_130(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def stopped(_: object) -> None:
        raise SystemError("returned a result with an exception set") from KeyboardInterrupt()

    monkeypatch.setattr("rocksteady.cli.flags.block_and_shaking.BlockFlags.described", stopped)
    ran = rocksteady("edge -A 0.2 -W 2 -r 0.8")
    assert (ran.code, ran.out, ran.err) == (130, "", "rocksteady: interrupted\n")


@commands
def test_an_interruption_ends_with_130(command: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def stopped(_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("rocksteady.cli.flags.block_and_shaking.BlockFlags.described", stopped)
    ran = rocksteady(f"{SHAKEN[command]} -r 0.8")
    assert (ran.code, ran.out) == (130, "")
    assert ran.err == "rocksteady: interrupted\n"


def test_an_interruption_while_one_is_dealt_with_ends_with_130_too(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def stopped(_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(app, "run", stopped)
    monkeypatch.setattr(warnings, "showwarning", warnings.showwarning)
    monkeypatch.setattr(sys, "stderr", sys.stderr)
    usual = {name: signal.getsignal(getattr(signal, name)) for name in terminal.ENDING}
    try:
        with pytest.raises(SystemExit) as left:
            app.main()
        assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN  # Python's own end takes a while
    finally:
        for name, handler in usual.items():
            signal.signal(getattr(signal, name), handler)
    assert left.value.code == 130
