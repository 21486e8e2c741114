"""The house style: the same pictures under any theme, and every setting of the user's as it was."""

import threading
from collections.abc import Iterator

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import matplotlib.style
import pytest
from matplotlib.colors import to_rgb

from rocksteady import DimensionlessBlock, Harmonic, plots, simulate
from rocksteady.histories import Trajectory
from rocksteady.show.export.files import figure_bytes
from rocksteady.show.figures.single import simulation_figure
from rocksteady.show.style import palette

THEMES = ["dark_background", "classic"]
HOSTILE = {"text.usetex": True, "savefig.bbox": "tight", "figure.autolayout": True}
"""Settings that some people have in their `matplotlibrc`."""


def rocking() -> Trajectory:
    block = DimensionlessBlock(restitution=0.8)
    return simulate(block, Harmonic(amplitude=2.0, frequency_ratio=1.7), cycles=3)


@pytest.fixture(autouse=True)
def settings_left_as_they_were() -> Iterator[None]:
    settings = dict(mpl.rcParams)
    yield
    plt.close("all")
    assert dict(mpl.rcParams) == settings


@pytest.mark.slow
@pytest.mark.parametrize("theme", [*THEMES, HOSTILE], ids=[*THEMES, "hostile"])
def test_a_whole_figure_is_the_same_under_any_theme(theme: str | dict[str, object]) -> None:
    run = rocking()
    plain = figure_bytes(simulation_figure(run), "png")
    with matplotlib.style.context(theme):
        assert figure_bytes(simulation_figure(run), "png") == plain


def test_new_axes_follow_a_dark_theme_and_its_size() -> None:
    with (
        mpl.rc_context(),
        matplotlib.style.context(["dark_background", {"figure.figsize": (3, 2)}]),
    ):
        axes = plots.trajectory(rocking())
        assert axes.figure.get_size_inches().tolist() == [3.0, 2.0]  # type: ignore[union-attr]
        assert to_rgb(axes.get_facecolor()) == (0.0, 0.0, 0.0)
        axes.figure.canvas.draw()
        texts = [*axes.get_xticklabels(), *axes.get_yticklabels(), axes.xaxis.label]
        assert {to_rgb(text.get_color()) for text in texts} == {(1.0, 1.0, 1.0)}
        assert not axes.spines["top"].get_visible(), "what the theme leaves open is the house style"


def test_settings_that_change_inside_the_style_stay() -> None:
    before = mpl.rcParams["interactive"], mpl.rcParams["keymap.grid"]
    try:
        for applied in (palette.style, palette.style_beneath):
            mpl.rcParams.update({"interactive": False, "keymap.grid": ["g"]})
            with applied():
                mpl.rcParams.update({"interactive": True, "keymap.grid": ["j"]})
            assert (mpl.rcParams["interactive"], mpl.rcParams["keymap.grid"]) == (True, ["j"])
    finally:
        mpl.rcParams.update({"interactive": before[0], "keymap.grid": before[1]})


@pytest.mark.parametrize("second", [palette.style, palette.style_beneath])
def test_two_threads_do_not_take_the_style_for_the_users_settings(second: type) -> None:
    """One that begins while the other draws, and ends later, would restore the other's style."""
    before = dict(mpl.rcParams)
    inside, leave = threading.Event(), threading.Event()

    def other() -> None:
        inside.set()
        with second():
            leave.wait(10.0)

    thread = threading.Thread(target=other)
    with palette.style():
        thread.start()
        inside.wait(10.0)
        thread.join(0.2)
    leave.set()
    thread.join()
    assert dict(mpl.rcParams) == before
