"""Cells of the manual: their kernel draws each picture again on dark paper, and computes once."""

from typing import Any

from rocksteady.show.style.tokens import DARK, DARKEST_PAPER, LIGHT, luminance
from tools.manual import twins

CONFIGURATION = f"""
c.IPKernelApp.log_level = 40
c.InteractiveShellApp.extensions = ["tools.manual.cells"]
c.InlineBackend.rc = {{"figure.facecolor": "{LIGHT.page}", "axes.facecolor": "{LIGHT.page}"}}
"""
"""Of a kernel: silent about its sockets, and with a page of the manual as paper."""


class Twice:
    """Runs each cell that draws a second time, on dark paper."""

    def __init__(self, shell: Any) -> None:
        """Listen to what a shell runs, and to which figures it shows."""
        from IPython.core import pylabtools

        tools: Any = pylabtools
        self._shell = shell
        self._memory = twins.Memory()
        self._draws = False
        self._dark: list[str] | None = None
        """Pictures on dark paper, while a cell runs again."""
        self._print: Any = tools.print_figure
        tools.print_figure = self.picture
        shell.events.register("pre_run_cell", self.listen)
        shell.events.register("post_run_cell", self.draw_again)

    def listen(self, cell: Any) -> None:
        """Keep the results of the functions that a cell uses."""
        if self._dark is None:
            self._draws = False
            self._memory.listen(cell.raw_cell)

    def picture(self, figure: Any, **settings: Any) -> Any:
        """Return a figure as a PNG in base64, which says on which paper it is drawn."""
        from matplotlib.colors import to_hex

        dark = luminance(to_hex(figure.get_facecolor())) < DARKEST_PAPER
        with twins.without_ground(figure):
            paper = {twins.PAPER: "dark" if dark else "light"}
            data = self._print(figure, facecolor="none", metadata=paper, **settings)
        self._draws = True
        if self._dark is not None and dark:
            self._dark.append(data)
        return data

    def draw_again(self, result: Any) -> None:
        """Run a cell that has drawn again, and show its pictures on dark paper alone."""
        from IPython import display
        from IPython.utils import capture

        show: Any = display.display  # these two have no types
        captured: Any = capture.capture_output

        if self._dark is not None or not self._draws or not result.success:
            return
        from matplotlib import rcParams

        settings: Any = rcParams  # whose keys are a type of 300 literals
        names, dark = dict(self._shell.user_ns), twins.paper(DARK)
        before = {name: settings[name] for name in dark}
        self._dark = []
        try:
            settings.update(dark)
            with self._memory.again(), twins.on_paper(DARK), captured():
                again = self._shell.run_cell(result.info.raw_cell, store_history=False)
            again.raise_error()
            for data in self._dark:
                show({"image/png": data}, raw=True)
        finally:
            settings.update(before)
            self._shell.user_ns.update(names)
            self._dark = None


def load_ipython_extension(shell: Any) -> None:
    """Run the cells of a shell in this way."""
    Twice(shell)
