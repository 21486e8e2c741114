"""What a calibration guarantees, and what it does not promise."""

from typing import Final

GUARANTEES: Final = (
    "The same inputs and the same seed give the same numbers, with any number of workers.",
    "Every fate is that of a complete run: no fate and no record is interpolated.",
    (
        "A test is predicted without its own group: neither the posterior, nor the temper, nor the "
        "logistic beside it has seen that group."
    ),
    (
        "Each prediction has its Monte Carlo error, each posterior its effective draws; draws are "
        "added until that error is below 0.01, or a warning names those where it is not."
    ),
    (
        "Tests that all fell, or all stood, give a bound of alpha and no estimate; the table of "
        "parameters names it so."
    ),
    "A parameter that ends at a limit of its prior is named: another prior would move it.",
)
NOT_PROMISED: Final = (
    (
        "That outcomes determine the height, the restitution or p: of a block that falls or "
        "stands only alpha is identified, and the rest mostly comes back as it was put in."
    ),
    (
        "That alpha is that of the outline: it is the one of a rigid block that falls as this one "
        "did, with its worn edges, its joints and its foundation in it."
    ),
    (
        "That the motion follows: the same posterior that calls nine outcomes of ten gives no time "
        "history of the rotation."
    ),
    (
        "That an object that still stands bounds the PGA from above: at 0.6 g two thirds "
        "of 59 records leave one standing whose static limit by West is 0.42 g."
    ),
    (
        "That a tempered likelihood is Bayesian: its exponent is chosen by the score of held-out "
        "tests, since model errors make tests alike. The untempered result stands beside it."
    ),
    (
        "That physics wins with many tests: 20 beat a logistic on intensity measures by 0.09 of "
        "accuracy in one laboratory; with 400 both come near the ceiling."
    ),
)
