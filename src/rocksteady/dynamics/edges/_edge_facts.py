"""Facts that edge states, saddles and manifolds have in common."""

from rocksteady.model.equations import Model
from rocksteady.model.facts import AnyBlock, case_text, harmonic_values
from rocksteady.model.motions.segments import Harmonic
from rocksteady.results.description import Fact
from rocksteady.results.numbers import number


def case_of(block: AnyBlock, motion: Harmonic, model: Model) -> list[Fact]:
    """Return the facts of what moves, by what and in which model."""
    values = harmonic_values(block, motion)
    return [
        *(Fact(key, value) for key, value in values.items()),
        Fact("model", model.name, "model"),
    ]


def place(block: AnyBlock, motion: Harmonic, model: Model) -> str:
    """Return what moves and by what, for a headline."""
    shaking = f"A = {number(motion.amplitude, 4)}, Ω = {number(motion.frequency_ratio, 4)}"
    return f"{shaking}, {case_text(block)}, {model.name} model"
