"""Equations of motion of a block: linear for slender blocks, or the full ones."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Literal, get_args

from rocksteady.errors import InputError, ModelError
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.dimensionless import DimensionlessBlock
from rocksteady.model.checks.arguments import checked
from rocksteady.model.checks.bounds import Bounds
from rocksteady.model.motions.segments import Motion

if TYPE_CHECKING:
    from rocksteady.arrays import Floats
    from rocksteady.kernels.core.tuples import Tables
    from rocksteady.model.motions.record import Record

TOLERANCE = 1e-10
"""Default relative error that a motion may have."""

LEAST_TOLERANCE = 1e-13
LARGEST_TOLERANCE = 1e-3


@checked
@dataclass(frozen=True, kw_only=True)
class Linear:
    """Linear equations of motion, of slender blocks (eqs 4, 5): flights in closed form."""

    @property
    def name(self) -> str:
        """The name, "linear"."""
        return "linear"

    def sides(self, block: Block | DimensionlessBlock) -> "Floats":
        """Return restitution, lean and rate of a block's sides, shape (2, 3).

        Parameters
        ----------
        block
            The block.
        """
        from rocksteady.model.linear_tables import side_table

        return side_table(block)

    def lower(
        self,
        block: Block | DimensionlessBlock,
        motion: "Motion | Record",
        vertical: "Motion | Record | None" = None,
    ) -> "Tables":
        """Return the tables from which the kernels compute: segments (n, 9) and sides (2, 3).

        Parameters
        ----------
        block
            The block.
        motion
            The base motion; its last segment is endless.
        vertical
            None: the linear equations have no term for vertical motion.

        Raises
        ------
        ModelError
            If there is a vertical motion, or a record shakes a dimensionless block.
        InputError
            If a record's samples are too long or too strong for the block.
        """
        from rocksteady.model.linear_tables import lower

        refuse_vertical(vertical)
        return lower(block, motion)


@checked
@dataclass(frozen=True, kw_only=True)
class Nonlinear:
    """Full equations of motion (eqs 1, 2), which need a `Block` for its slenderness.

    Parameters
    ----------
    tolerance
        The error that the motion may have, as a part of it, from 1e-13 to 1e-3.  Each step leaves
        out 1e-5 of that at most.  Errors grow as the motion itself spreads.

    Raises
    ------
    InputError
        If the tolerance is outside its range.

    Examples
    --------
    >>> Nonlinear(tolerance=1e-8)
    Nonlinear(tolerance=1e-08)
    """

    tolerance: Annotated[
        float,
        Bounds(
            LEAST_TOLERANCE,
            LARGEST_TOLERANCE,
            "[]",
            "give the error of the motion that you accept, as 1e-10",
        ),
    ] = TOLERANCE

    @property
    def name(self) -> str:
        """The name, "nonlinear"."""
        return "nonlinear"

    def sides(self, block: Block | DimensionlessBlock) -> "Floats":
        """Return a block's sides as `Linear` does, with slenderness and step error, shape (2, 5).

        Parameters
        ----------
        block
            The block.

        Raises
        ------
        ModelError
            If the block has no slenderness.
        """
        from rocksteady.model.nonlinear_tables import side_table

        return side_table(slender_block(block), self.tolerance)

    def lower(
        self,
        block: Block | DimensionlessBlock,
        motion: "Motion | Record",
        vertical: "Motion | Record | None" = None,
    ) -> "Tables":
        """Return the tables from which the kernels compute: segments (n, 12) and sides (2, 5).

        Parameters
        ----------
        block
            The block.
        motion
            The horizontal base motion; the last segment is endless.
        vertical
            The vertical one, upwards positive: a record, or segments without sinusoid.

        Raises
        ------
        ModelError
            If the block has no slenderness, the vertical motion has a sinusoid, an impulse or no
            end, or there is one beside a Fourier series.
        InputError
            If a record's samples are too long or too strong for the block.
        """
        from rocksteady.model.nonlinear_tables import lower

        return lower(slender_block(block), motion, vertical, self.tolerance)


Model = Linear | Nonlinear
ModelName = Literal["linear", "nonlinear"]


def as_model(name: str, value: Model | str | None) -> Model | None:
    """Return the equations of motion of a name; what is no text as it is.

    Raises
    ------
    InputError
        If a text is no name.
    """
    if not isinstance(value, str):
        return value
    if value not in get_args(ModelName):
        hint = 'give "linear" or "nonlinear"'
        raise InputError(name, value, "there are two equations of motion", hint)
    return Linear() if value == "linear" else Nonlinear()


ModelChoice = Annotated[Model | ModelName | None, as_model]
"""An argument: a model, its name, or None to have one chosen."""


class OfLinear:
    """What only the linear model has: a part of the classes of its results."""

    @property
    def model(self) -> Model:
        """`Linear()`, the equations of motion that hold."""
        return Linear()


def chosen_model(model: object, block: Block | DimensionlessBlock) -> Model:
    """Return the equations of motion that hold for a block, chosen where none are given.

    The full ones for a `Block`, whose slenderness is known, and the linear ones for a
    `DimensionlessBlock`: the one rule of every function and command.  The two can differ in fate:
    under 0.4 g at 1 Hz a rack of 0.6 x 2 m falls by the linear equations, and stands by the others.

    Parameters
    ----------
    model
        What was given: `Linear`, `Nonlinear` or None.
    block
        The block.

    Raises
    ------
    InputError
        If it is no model.
    ModelError
        If the nonlinear model meets a block without slenderness.
    """
    if model is None:
        return Nonlinear() if isinstance(block, Block) else Linear()
    if isinstance(model, Linear):
        return model
    if not isinstance(model, Nonlinear):
        valid = "it must be a Linear or a Nonlinear"
        raise InputError("model", model, valid, 'give "linear" or "nonlinear"')
    slender_block(block)
    return model


def slender_block(block: Block | DimensionlessBlock) -> Block:
    """Return a block that has a slenderness.

    Raises
    ------
    ModelError
        If it has none.
    """
    if not isinstance(block, Block):
        raise ModelError(
            "block",
            type(block).__name__,
            "the nonlinear model needs the block's slenderness alpha",
            "give a Block, as Block.from_p(alpha=..., p=...), in place of a DimensionlessBlock",
        )
    return block


def refuse_vertical(vertical: "Motion | Record | None") -> None:
    """Refuse vertical motion in the linear model.

    Raises
    ------
    ModelError
        If there is one.
    """
    if vertical is not None:
        raise ModelError(
            "vertical",
            vertical,
            "the linear equations of motion have no term for it",
            "take Nonlinear(), or leave it out",
        )
