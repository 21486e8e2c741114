"""A small diagram about a symmetry breaking, for the tests of its values and of its text."""

from functools import cache

from rocksteady import Block, Branch, DimensionlessBlock, Harmonic, find_branches, find_orbits
from rocksteady.cli.flags.range import Range

BARE = DimensionlessBlock(restitution=0.8)
SIZED = Block.rectangle(width=0.4, height=1.2, restitution=0.8)
WITHIN = (1.9, 2.0)


def span_of(block: Block | DimensionlessBlock, parameter: str = "frequency_ratio") -> Range:
    """Return the axis of the diagram, or one of another parameter about the same point."""
    ends = {"frequency_ratio": WITHIN, "amplitude": (1.95, 2.05), "restitution": (0.78, 0.82)}
    low, high = ends[parameter]
    values = (low, 0.5 * (low + high), high)
    given = {"amplitude": 2.0, "frequency_ratio": 1.95, parameter: low}
    return Range(
        parameter=parameter,
        values=values,
        body=block,
        amplitude=given["amplitude"],
        frequency_ratio=given["frequency_ratio"],
    )


@cache
def branches_of(parameter: str = "frequency_ratio") -> tuple[Branch, ...]:
    """Return the symmetric branch, and that which leaves it where the symmetry breaks."""
    span = span_of(BARE, parameter)
    bare, shaking = span.at(span.values[-1])
    assert isinstance(shaking, Harmonic)
    starts = find_orbits(bare, shaking, max_period=1, max_impacts=2)[:1]
    return tuple(find_branches(starts, parameter, span.within, max_period=1, max_impacts=2))
