"""Why flags are refused that are valid alone: in one line with the flags, and what to do."""

from rocksteady.errors import ModelError


class FlagError(ModelError):
    """Flags are missing, contradict each other, or have no meaning for a command.

    The message reads ``NAME = VALUE is not accepted: VALID; HINT``, or ``FINDING: VALID; HINT``.

    Parameters
    ----------
    valid, hint
        As for `rocksteady.errors.RocksteadyError`.
    name, value
        Likewise, where one flag is meant.
    finding
        What is wrong, as a clause that names the flags, where no value is.
    """

    _verdict = "is not accepted"

    def __init__(
        self,
        *,
        valid: str,
        hint: str,
        name: str = "",
        value: object = None,
        finding: str | None = None,
    ) -> None:
        super().__init__(name=name, value=value, valid=valid, hint=hint)
        if finding is not None:
            self.args = (f"{finding}: {valid}; {hint}",)


def missing(flag: str, *, valid: str, hint: str) -> FlagError:
    """Return the error of a flag that is needed and not given."""
    return FlagError(finding=f"{flag} is not given", valid=valid, hint=hint)


def both(one: str, other: str, *, valid: str, hint: str = "leave one out") -> FlagError:
    """Return the error of two flags of which at most one may be given."""
    return FlagError(finding=f"{one} and {other} are both given", valid=valid, hint=hint)
