"""Showing a file in the browser of the desktop, where there is one."""

import os
import sys
import webbrowser
from pathlib import Path


def show(file: Path) -> bool:
    """Open a file in the browser; return whether there was one.

    Without a window system nothing is opened: a browser in the terminal shows no page with a
    script, and would hold the program.
    """
    if not has_window():
        return False
    try:
        return webbrowser.open(file.as_uri())
    except (webbrowser.Error, OSError):
        return False


def has_window() -> bool:
    """Return whether there is a window system, or a browser that the user has named."""
    named = ("BROWSER", "DISPLAY", "WAYLAND_DISPLAY")
    return sys.platform in {"win32", "darwin"} or any(map(os.environ.get, named))
