"""Colours, labels and units of all figures, defined once.

The fills distinguish attractors for normal and for colour-blind sight; lines on white take darker
shades of the same hues.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from threading import RLock
from typing import Any

REST = "#fcfaf3"
SYMMETRIC = "#76c6fe"
UNSYMMETRIC = "#bda613"
SUBHARMONIC = "#477f68"
APERIODIC = "#6f3584"
ROCKING = "#8fd0c6"
OVERTURNED = "#272728"
UNDECIDED = "#9a9a9a"

TINTS = (0.0, 0.6, -0.45, 0.8, -0.25, 0.35)
"""Of a fill, where several attractors share it: parts of white, or of black below 0.  Each step is
one of lightness, which is seen in grey and by the colour-blind too."""
MARKS = ("o", "s", "D", "^", "v", "P", "X", "p", "h", "*")
"""Of attractors that share a picture."""

INK = OVERTURNED
FAINT = "#8b8b8b"
NUMBER = "#5b5b5c"
"""Numbers and labels on the fills."""
GRID = "#dedede"
LINES = ("#1273b8", "#8d2709", "#49a397", "#48096b", "#9c8718", "#5d645b")
"""Line colours in the order of their use, which the colour-blind distinguish too; with the dashes
below they differ in grey too."""
SUBHARMONIC_LINES = ("#186432", "#3ea682", "#40068d", "#63686e", "#462033")
"""Line colours of subharmonic orbits, one after another by their periods; no two are alike, nor
alike the first and the fifth line colour, beside which they stand."""
SWEEPS = ("#f2b24a", "#d0605e")
"""Dots of the motions met by an upward and a downward sweep; lines are drawn over them."""
MANIFOLDS_ON_FILLS = {"stable": "#d0605e", "unstable": "#8a3fc4"}
"""Manifolds over pictures of basins, whose fills are the same on light and dark paper."""
DASHES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (6, 2, 1.5, 2)), (0, (1, 1)), "-")
IMPACT = "#b0531b"
BASE = "#477f68"
LINK = "#1273b8"
BLOCK = SYMMETRIC
GROUND = "#e9e6dc"

DARK_PAPER = "#000000"
DARK_INK = "#f2f2f2"
DARK_NUMBER = "#c4c4c6"
DARK_FAINT = "#9a9a9a"
DARK_GRID = "#3a3a3c"
DARK_LINES = ("#6db9f2", "#c97b55", "#48c1a2", "#ad49f2", "#f9e299", "#7d7c97")
DARK_SUBHARMONIC_LINES = ("#58a088", "#b8e8e8", "#b85828", "#5858d0", "#287070")
DARK_SWEEPS = ("#d8a440", "#a8484f")
DARK_IMPACT = "#f08a4b"
DARK_BASE = "#6cc5a1"
"""The same on dark paper; the fills are those of light paper."""

PERIODS = ("#a9d8f7", "#e08214", "#1b9e77", "#d9a0cf", "#1f4e9c", "#b2322d", "#f2e14c")
"""Fills of cells by the period of their orbits, 1, 2, ...; the last is that of all longer ones."""
SEQUENTIAL = ("#fff6dd", "#fdd490", "#f59a4c", "#d4572b", "#7c1d12")
"""Ends and steps of a palette from nothing to most."""
DIVERGING = ("#2470b3", "#6cadd6", "#c9e0ef", "#f7f7f7", "#f9d3bf", "#e8825f", "#ad1a2c")
"""The same of a palette about zero."""

REGION_FILLS = {1: "#d5edff", 2: "#ffffff", 3: "#f0e7b0", 4: "#e9e6dc", 5: "#dcc8e4"}

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
    "base_velocity": r"velocity of the base  $vp/(\alpha g)$",
    "base_displacement": r"displacement of the base  $dp^2/(\alpha g)$",
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
    "time_s": "time [s]",
    "angle_deg": r"tilt  $\theta$ [°]",
    "peak_deg": r"largest tilt  $|\theta|_{\max}$ [°]",
    "highest_deg": r"highest tilt  $\theta$ [°]",
    "lowest_deg": r"lowest tilt  $\theta$ [°]",
    "angle_deg_at_start": r"tilt at the start  $\theta$ [°]",
    "velocity_deg_s_at_start": r"velocity at the start  $\dot\theta$ [°/s]",
    "velocity_deg_s": r"velocity  $\dot\theta$ [°/s]",
    "speed_deg_s": r"speed after the impact  $|\dot\theta|$ [°/s]",
    "accel_g": r"acceleration  $a_{\max}$ [g]",
    "freq_hz": "frequency [Hz]",
    "base_acceleration_g": "acceleration of the base [g]",
    "pt": "pivot time  $pt$",
}
"""Axis labels with their units; angles, amplitudes and ratios have none."""

STYLE: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "text.usetex": False,  # a user's setting that needs another program
    "text.parse_math": True,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.labelsize": 9.0,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": GRID,
    "grid.linewidth": 0.5,
    "hatch.linewidth": 0.6,
    "xtick.color": INK,
    "ytick.color": INK,
    "text.color": INK,
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
}


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


def tinted(colour: str, part: float) -> str:
    """Return a colour mixed with a part of white, or of black where the part is below 0."""
    end = 255 if part > 0.0 else 0
    channels = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    mixed = (round(c + abs(part) * (end - c)) for c in channels)
    return "#" + "".join(f"{c:02x}" for c in mixed)


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


@contextmanager
def style() -> Iterator[None]:
    """Apply the house style inside a ``with`` block, and leave the user's own settings alone.

    A picture is the same under any theme of the user's: what the style leaves open has
    Matplotlib's default.
    """
    _, default = _settings()
    look = {name: default[name] for name in default if name.partition(".")[0] not in _NO_LOOK}
    with _applied(look | STYLE):
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
