"""Runs the program in this process and looks at everything that it leaves behind."""

import contextlib
import io
import json
from dataclasses import dataclass
from functools import cache
from typing import Any

from rocksteady.cli.app import run as run_program


@dataclass(frozen=True)
class Ran:
    """Exit code, standard output and standard error of one run."""

    code: int
    out: str
    err: str

    @property
    def json(self) -> dict[str, Any]:
        """The one object on standard output, which may hold nothing else."""
        assert self.out.count("\n") == 1, self.out
        values = json.loads(self.out, parse_constant=_refused)
        assert isinstance(values, dict)
        return values


def _refused(constant: str) -> None:
    message = f"{constant} is no JSON"
    raise AssertionError(message)


def rocksteady(command: str, *more: object) -> Ran:
    """Run ``rocksteady COMMAND``, split at its spaces, with further arguments as they are."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = run_program([*command.split(), *map(str, more)])
    return Ran(code, out.getvalue(), err.getvalue())


@cache
def ran_once(command: str) -> Ran:
    """Run a command that reads and writes no file, once for all tests of a process."""
    return rocksteady(command)


def refused(command: str, *more: object) -> str:
    """Run a command that must be refused in one line, and return the line."""
    ran = rocksteady(command, *more)
    assert ran.code == 2, ran
    assert ran.out == "", "nothing goes to standard output"
    assert ran.err.endswith("\n")
    line = ran.err[:-1]
    assert "\n" not in line, ran.err
    assert line.startswith("rocksteady: ")
    assert "None" not in line
    return line
