"""Words in quotes are what a shell takes for the same words, and can be printed."""

import os
import shlex
import subprocess

import pytest

from rocksteady.cli.console.shell import command_of, quoted
from rocksteady.results.rendering import printable

WORDS = [
    "a b",
    "it's",
    "new\nline",
    "tab\there 1",
    "\x1b[31m'",
    "\u202eü 波",
    "raw\udcff7",
    "\\",
    "",
]


@pytest.mark.parametrize("word", WORDS)
def test_a_shell_reads_a_quoted_word_as_it_was(word: str) -> None:
    text = quoted(word)
    assert printable(text) == text
    script = f"printf %s {text}".encode()
    ran = subprocess.run(["bash", "-c", script], capture_output=True, check=True)
    assert ran.stdout == os.fsencode(word)


def test_a_usual_command_is_that_of_the_standard_library() -> None:
    words = ["rocksteady", "record", "a b.csv", "--scale", "0.5"]
    assert command_of(words) == shlex.join(words)
