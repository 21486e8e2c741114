"""What a calibration guarantees, and what it does not promise."""

from typing import Final

GUARANTEES: Final = (
    (
        "The same inputs and the same seed give the same numbers to the last bit, on any processor "
        "and with any number of threads and workers."
    ),
    (
        "Every run is complete, and no record is interpolated; probabilities come from surfaces "
        "that are fitted to these runs."
    ),
    (
        "A test is predicted without its own group: posterior, logistic and the weights of both "
        "are fitted to the tests of other groups."
    ),
    (
        "Each prediction has its Monte Carlo error, each posterior its effective draws: with fewer "
        "than 200, or Pareto's k above 0.7, there is no answer."
    ),
    (
        "Where tests contradict a default prior it is widened, and the first line says so; a prior "
        "that was given is kept, and the conflict named."
    ),
    (
        "Tests that all fell, or all stood, give a bound of alpha and no estimate; the table of "
        "parameters names it so."
    ),
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
        "That the Monte Carlo error holds all that a prediction misses: falls and survivals "
        "alternate in bands of gain and size that are finer than the surfaces."
    ),
    (
        "That the block predicts better than a logistic on intensity measures: with many tests "
        "both come near the ceiling."
    ),
)
