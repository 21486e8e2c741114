"""The entry of the program: words that it does not know, and Ctrl-C while it loads."""

import subprocess
import sys

from tests.cli.program import refused
from tests.every import every

LISTS = "rocksteady steady --help-all lists its flags"


@every(
    ("command", "given", "line"),
    [
        ("steady", "--ampl 2", f"--ampl is no flag of rocksteady steady: {LISTS}; did you mean "),
        ("steady", "--zzz", f"--zzz is no flag of rocksteady steady: {LISTS}; leave it out"),
        ("steady", "-A", "-A is given without a value: it takes one; see rocksteady steady --help"),
        (
            "steady",
            "extra",
            "'extra' is too much: rocksteady steady --help-all lists what it takes; ",
        ),
        (
            "",
            "stedy",
            "'stedy' is no command: rocksteady --help lists them; did you mean steady or ",
        ),
        ("", "zzz", "'zzz' is no command: rocksteady --help lists them; give one of these"),
        ("study", "zzz", "'zzz' is no command: rocksteady study --help lists them; give one of "),
    ],
)
def test_words_that_no_command_knows_have_the_form_of_all_errors(
    command: str, given: str, line: str
) -> None:
    assert refused(f"{command} {given}").startswith(f"rocksteady: {line}")


def test_an_interruption_while_the_program_loads_is_one_line() -> None:
    code = (
        "import os, signal, sys\n"
        "class Interrupts:\n"
        "    def find_spec(self, name, path=None, target=None):\n"
        "        if name == MODULE:\n"
        "            os.kill(os.getpid(), signal.SIGINT)\n"
        "sys.meta_path.insert(0, Interrupts())\n"
        "from rocksteady.cli.entry import main\n"
        "main()\n"
    )
    for module in ("rocksteady.cli.app", "typer", "rocksteady.cli.commands.maps"):
        done = subprocess.run(
            [sys.executable, "-c", code.replace("MODULE", repr(module)), "--version"],
            capture_output=True,
            text=True,
            check=False,
        )
        assert (done.returncode, done.stdout) == (130, ""), (module, done)
        assert done.stderr == "rocksteady: interrupted\n", module
