"""Labels and units of axes, and the house style of all figures."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from threading import RLock
from typing import Any

from rocksteady.show.style import tokens

LABELS = {
    "amplitude": r"amplitude  $A = a_{\max}/(\alpha g)$",
    "frequency_ratio": r"frequency ratio  $\Omega = \omega/p$",
    "frequency_hz": "frequency [Hz]",
    "restitution": r"restitution  $\delta$",
    "alpha_ratio": r"ratio of slendernesses  $\alpha_-/\alpha_+$",
    "p_ratio": r"ratio of rates  $p_-/p_+$",
    "negative_restitution": r"restitution, negative side  $\delta_-$",
    "angle": r"angle  $\theta/\alpha$",
    "velocity": r"velocity  d$(\theta/\alpha)$/d$(pt)$",
    "lyapunov": r"Lyapunov exponent  $\chi$ [per forcing period]",
    "orbit_period": "period of the orbit [forcing periods]",
    "peak": r"peak  $|\theta|_{\max}/\alpha$",
    "flight_peak": r"peak of each flight  $|\theta|_{\max}/\alpha$",
    "flight_peak_deg": r"largest tilt of each flight  $|\theta|_{\max}$ [°]",
    "flight_extreme_deg": r"extreme tilt of each flight  $\theta$ [°]",
    "flight_extreme": r"extreme of each flight  $\theta/\alpha$",
    "periods": "time [forcing periods]",
    "kick": "distance from the orbit, with its side",
    "angle_at_start": r"angle at the start  $\theta/\alpha$",
    "velocity_at_start": r"velocity at the start  d$(\theta/\alpha)$/d$(pt)$",
    "phase_at_start": r"phase at the start  $\varphi$ [rad]",
    "acceleration_m_s2": r"acceleration  $a_{\max}$ [m/s$^2$]",
    "alpha": r"slenderness  $\alpha$ [rad]",
    "radius": r"half-diagonal  $R$ [m]",
    "p": r"frequency parameter  $p$ [rad/s]",
    "width": "width [m]",
    "height": "height [m]",
    "orbit_extremes": r"highest and lowest  $\theta/\alpha$  of the orbit",
    "orbit_extremes_deg": r"highest and lowest tilt  $\theta$ [°]",
    "periods_short": "time [periods]",
    "half_cycle": r"time since impact  $\omega t/2\pi$ [forcing periods]",
    "half_cycle_s": "time since impact [s]",
    "rocking_period": r"size of the block  $2\pi/p$ [s]",
    "peak_velocity": r"peak  $|\dot\theta|_{\max}/(\alpha p)$",
    "overturned_share": "share of records that fall [%]",
    "pivot_time": "pivot time  $pt$",
    "seconds": "time [s]",
    "ground_acceleration": "acceleration [g]",
    "ground_velocity": "velocity [m/s]",
    "ground_displacement": "displacement [m]",
    "husid": "part of Arias intensity",
    "period": "period  $T$ [s]",
    "pseudo_acceleration": "pseudo-acceleration [g]",
    "base": r"base  $a/(\alpha g)$",
    "base_g": "base  $a$ [g]",
    "base_velocity": r"velocity of the base  $vp/(\alpha g)$",
    "base_displacement": r"displacement of the base  $dp^2/(\alpha g)$",
    "base_velocity_m_s": "velocity of the base [m/s]",
    "base_displacement_m": "displacement of the base [m]",
    "position_m": "position [m]",
    "ground_m": "position on the ground [m]",
    "ground_radius": "position on the ground  $x/R$",
    "height_m": "height [m]",
    "position_radius": "position  $x/R$",
    "height_radius": "height  $y/R$",
    "phase": "phase of the shaking at the impact [rad]",
    "speed": r"speed after the impact  $|$d$(\theta/\alpha)$/d$(pt)|$",
    "falling": "probability of falling",
    "integrity": "integrity (1 on a still base)",
    "free_amplitude": r"amplitude  $\theta_0/\alpha$",
    "free_period": "period  $pT$",
    "multiplier_real": r"real part of the multipliers  Re $\mu$",
    "multiplier_imaginary": r"imaginary part  Im $\mu$",
    "angle_deg": r"tilt  $\theta$ [°]",
    "peak_deg": r"largest tilt  $|\theta|_{\max}$ [°]",
    "highest_deg": r"highest tilt  $\theta$ [°]",
    "lowest_deg": r"lowest tilt  $\theta$ [°]",
    "angle_deg_at_start": r"tilt at the start  $\theta$ [°]",
    "velocity_deg_s_at_start": r"velocity at the start  $\dot\theta$ [°/s]",
    "velocity_deg_s": r"velocity  $\dot\theta$ [°/s]",
    "speed_deg_s": r"speed after the impact  $|\dot\theta|$ [°/s]",
    "accel_g": r"acceleration  $a_{\max}$ [g]",
}
LABELS |= {
    name: LABELS[same]
    for name, same in (("time_s", "seconds"), ("freq_hz", "frequency_hz"), ("pt", "pivot_time"))
}
"""Axis labels with their units; angles, amplitudes and ratios have none."""


def in_colours(inks: tokens.Inks) -> dict[str, Any]:
    """Return the settings of Matplotlib that are colours, for light or dark paper."""
    parts = ("axes.edgecolor", "axes.labelcolor", "text.color", "xtick.color", "ytick.color")
    papers = ("figure.facecolor", "axes.facecolor")
    return {
        **dict.fromkeys(parts, inks.ink),
        **dict.fromkeys(papers, inks.paper),
        "grid.color": inks.hair,
    }


STYLE: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "text.usetex": False,  # a user's setting that needs another program
    "text.parse_math": True,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.labelsize": 9.0,
    "axes.linewidth": 0.7,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.linewidth": 0.5,
    "hatch.linewidth": 0.6,
    "legend.fontsize": 8.0,
    "legend.frameon": False,
    "lines.linewidth": 1.3,
    "figure.dpi": 100.0,
    "savefig.dpi": 200.0,
    "figure.constrained_layout.use": True,
    "pdf.fonttype": 42,
    "ps.fonttype": 42,
    "svg.fonttype": "path",
    "svg.hashsalt": "rocksteady",
    **in_colours(tokens.LIGHT),
}
"""The house style, on light paper."""


def axis_label(name: str) -> str:
    r"""Return the label of an axis of a map, on which angle, velocity and phase are at the start.

    Examples
    --------
    >>> axis_label("radius"), axis_label("phase")
    ('half-diagonal  $R$ [m]', 'phase at the start  $\\varphi$ [rad]')
    """
    return LABELS.get(f"{name}_at_start") or LABELS.get(name) or name.replace("_", " ")


def axis_value(name: str, value: float) -> str:
    """Return a value of such an axis in words.

    Examples
    --------
    >>> axis_value("frequency_ratio", 2.0), axis_value("radius", 0.5)
    ('frequency ratio = 2', 'half-diagonal = 0.5 m')
    """
    words, _, unit = axis_label(name).partition(" [")
    return f"{words.partition('  ')[0]} = {value:.4g} {unit.rstrip(']')}".rstrip()


def shortened(name: str, longest: int = 32) -> str:
    """Return a name cut in the middle, so that it leaves room for others in a title.

    Examples
    --------
    >>> shortened("RSN77"), shortened("a-file-with-a-very-long-name", 15)
    ('RSN77', 'a-file-…ng-name')
    """
    if len(name) <= longest:
        return name
    half = (longest - 1) // 2
    return f"{name[:half]}…{name[-half:]}"


_NO_LOOK = frozenset(
    {
        "animation",
        "backend",
        "backend_fallback",
        "date",
        "docstring",
        "interactive",
        "keymap",
        "macosx",
        "pgf",
        "timezone",
        "tk",
        "toolbar",
        "webagg",
    }
)
"""Groups of Matplotlib's settings that no picture of ours depends on, pyplot's own among them."""
_TURN = RLock()
"""The settings are global: two threads that took turns out of order would restore each other's."""


_PAPER: ContextVar[dict[str, Any]] = ContextVar("paper", default={})  # noqa: B039
"""Settings that differ from `STYLE`."""


@contextmanager
def on_paper(inks: tokens.Inks, **settings: Any) -> Iterator[None]:
    """Draw and save figures in the house style on another paper, inside a ``with`` block.

    Parameters
    ----------
    inks
        Colours of the paper.
    **settings
        Further settings of Matplotlib, with ``_`` for a dot.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> with on_paper(tokens.DARK), style():
    ...     tokens.inks_of(Figure().add_subplot()).dark
    True
    """
    further = {name.replace("_", "."): value for name, value in settings.items()}
    token = _PAPER.set({**in_colours(inks), **further})
    try:
        yield
    finally:
        _PAPER.reset(token)


@contextmanager
def style() -> Iterator[None]:
    """Apply the house style inside a ``with`` block, and leave the user's own settings alone.

    A picture is the same under any theme of the user's: what the style leaves open has
    Matplotlib's default.
    """
    _, default = _settings()
    look = {name: default[name] for name in default if name.partition(".")[0] not in _NO_LOOK}
    with _applied(look | STYLE | _PAPER.get()):
        yield


@contextmanager
def style_beneath() -> Iterator[None]:
    """Apply those settings of the house style that the user has left at Matplotlib's defaults.

    For figures among a user's own: a dark theme stays dark, and its text legible.
    """
    current, default = _settings()
    with _TURN:  # what another thread has applied is not the user's
        free = [name for name in STYLE if current[name] == default[name]]
        with _applied({name: STYLE[name] for name in free}):
            yield


@contextmanager
def _applied(settings: dict[str, Any]) -> Iterator[None]:
    """Apply settings and take back these alone.

    ``rc_context`` takes back all: after a backend was loaded inside, also that it made pyplot
    interactive, and a notebook shows no figure after that.
    """
    current, _ = _settings()
    with _TURN:
        before = {name: current[name] for name in settings}
        current.update(settings)
        try:
            yield
        finally:
            current.update(before)


def _settings() -> tuple[Any, Any]:
    """Return Matplotlib's settings and their defaults; their keys are a type of 300 literals."""
    import matplotlib as mpl

    return mpl.rcParams, mpl.rcParamsDefault
