"""Parameters of the paper's time histories (Figs 8 to 13), and of runs started near them."""

from dataclasses import dataclass

from rocksteady.sweeps import Axis

RESTITUTION = 0.8
"""Of every time history in the paper."""
KICK = 1e-4
"""How far from an unstable orbit the drawn runs begin.  The paper's distance is the rounding of its
computer, which it does not state; this one leaves every orbit within the paper's time axes that the
paper's own run leaves there."""
KICKS = Axis.logarithmic("kick", 1e-6, 1e-2, 161).points
"""Distances over which fates are counted, on either side."""
SIDES = (1, -1)


@dataclass(frozen=True, kw_only=True)
class Case:
    """Parameters of one of the paper's time histories.

    Attributes
    ----------
    id
        As the paper numbers it.
    amplitude, frequency_ratio
        A and Omega, which is the frequency in Hz as well, since p = 2 pi.
    order, branch
        Order and branch of the symmetric steady state on which it starts.
    periods
        End of the time axis [forcing periods].
    says
        What the paper shows, in our words.
    chosen
        What the scan does not show and was chosen.
    """

    id: str
    amplitude: float
    frequency_ratio: float
    order: int
    branch: int
    periods: int
    says: str
    chosen: tuple[str, ...] = ()


AXIS_ILLEGIBLE = "The end of the time axis is not legible in the scan."
NO_AMPLITUDE = (
    "The amplitude of Fig. 13 is not printed; the text refers to the same system as in Fig. 12, so "
    "A = 2 is taken."
)

CASES = (
    Case(
        id="8a", amplitude=1.0, frequency_ratio=1.0, order=1, branch=2, periods=10,
        says="At 1 Hz the block leaves the in-phase harmonic motion after a few cycles and "
        "topples.",
    ),
    Case(
        id="8b", amplitude=1.0, frequency_ratio=2.0, order=1, branch=2, periods=24,
        says="At 2 Hz the block leaves the in-phase harmonic motion and reaches the stable "
        "out-of-phase harmonic one.",
    ),
    Case(
        id="8c", amplitude=1.0, frequency_ratio=8.0, order=1, branch=2, periods=20,
        says="At 8 Hz the block leaves the in-phase harmonic motion and reaches the stable "
        "out-of-phase harmonic one.",
    ),
    Case(
        id="9a", amplitude=2.0, frequency_ratio=3.5, order=3, branch=2, periods=20,
        says="At 3.5 Hz the block leaves the in-phase 1/3 subharmonic and topples.",
    ),
    Case(
        id="9b", amplitude=2.0, frequency_ratio=4.0, order=3, branch=2, periods=40,
        says="At 4 Hz the block leaves the in-phase 1/3 subharmonic and settles to the stable "
        "out-of-phase harmonic motion.",
    ),
    Case(
        id="9c", amplitude=2.0, frequency_ratio=5.0, order=3, branch=2, periods=40,
        says="At 5 Hz the block leaves the in-phase 1/3 subharmonic and settles to the stable "
        "out-of-phase 1/3 subharmonic.",
    ),
    Case(
        id="10", amplitude=6.0, frequency_ratio=4.0, order=1, branch=1, periods=10,
        says="A typical stable out-of-phase harmonic motion.",
    ),
    Case(
        id="11a", amplitude=4.0, frequency_ratio=6.0, order=3, branch=1, periods=32,
        says="A stable out-of-phase 1/3 subharmonic with two peaks in each half cycle.",
    ),
    Case(
        id="11b", amplitude=2.0, frequency_ratio=6.0, order=3, branch=1, periods=28,
        says="A stable out-of-phase 1/3 subharmonic; its second peak has all but gone.",
    ),
    Case(
        id="12a", amplitude=2.0, frequency_ratio=2.0, order=1, branch=1, periods=40,
        says="The symmetric harmonic motion is stable.", chosen=(AXIS_ILLEGIBLE,),
    ),
    Case(
        id="12b", amplitude=2.0, frequency_ratio=1.9, order=1, branch=1, periods=40,
        says="The symmetric harmonic motion is unstable; the block shifts gradually to a stable "
        "unsymmetric harmonic one.",
    ),
    Case(
        id="12c", amplitude=2.0, frequency_ratio=1.8, order=1, branch=1, periods=32,
        says="As at 1.9, with more asymmetry.",
    ),
    Case(
        id="12d", amplitude=2.0, frequency_ratio=1.7, order=1, branch=1, periods=20,
        says="The unsymmetric motion has gone: the block overturns.", chosen=(AXIS_ILLEGIBLE,),
    ),
    Case(
        id="13a", amplitude=2.0, frequency_ratio=4.4, order=3, branch=1, periods=40,
        says="The symmetric 1/3 subharmonic is stable.", chosen=(NO_AMPLITUDE,),
    ),
    Case(
        id="13b", amplitude=2.0, frequency_ratio=4.2, order=3, branch=1, periods=80,
        says="The symmetric 1/3 subharmonic is unstable; the block settles to an unsymmetric one.",
        chosen=(NO_AMPLITUDE,),
    ),
    Case(
        id="13c", amplitude=2.0, frequency_ratio=3.6, order=3, branch=1, periods=32,
        says="No 1/3 subharmonic is stable; the block settles to the symmetric harmonic motion.",
        chosen=(NO_AMPLITUDE,),
    ),
    Case(
        id="13d", amplitude=2.0, frequency_ratio=3.0, order=3, branch=1, periods=32,
        says="After a few subharmonic cycles the block overturns.",
        chosen=(NO_AMPLITUDE, AXIS_ILLEGIBLE),
    ),
)  # fmt: skip
