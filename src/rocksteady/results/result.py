"""Base class of results: repr, summary, HTML, JSON, rows and plot, all from one description."""

import copyreg
import functools
import importlib
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, TypeVar

from rocksteady.errors import ModelError, Words, with_call_errors
from rocksteady.results.description import Description
from rocksteady.results.rendering import as_html, as_text

if TYPE_CHECKING:
    import pandas as pd

_plots: dict[str, Callable[[], Any]] = {}
_words: dict[str, str] = {}
"""Modules with the words of a class, by its name."""
_describers: dict[type, Callable[[Any], Description]] = {}
"""Functions of these modules, by class."""

R = TypeVar("R")


class Result:
    """A result; what it says stands in a module of words, and all else follows from it."""

    @with_call_errors
    def describe(self) -> Description:
        """Return the facts, tables and notes of the result."""
        words_module(type(self))
        return next(_describers[kind] for kind in type(self).__mro__ if kind in _describers)(self)

    @with_call_errors
    def summary(self, *, more: bool = False) -> str:
        """Return the answer as text of 80 columns, as the command prints it.

        Parameters
        ----------
        more
            Whether facts, tables and notes follow, as with ``--more``.
        """
        return as_text(self.describe(), more=more)

    @with_call_errors
    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain values under the names of the command's JSON."""
        return self.describe().to_dict()

    @with_call_errors
    def to_dataframe(self) -> "pd.DataFrame":
        """Return the rows of the result; without a table one row, of its plain facts."""
        return self.describe().to_dataframe()

    @with_call_errors
    def plot(self, *arguments: Any, **options: Any) -> Any:
        """Plot the result; arguments and axes are those of the function `plot_*` of its kind."""
        return plotting_function(type(self).__name__)(self, *arguments, **options)

    def __repr__(self) -> str:
        """Return one line."""
        return f"<{type(self).__name__}: {self.describe().headline}>"

    def _repr_html_(self) -> str:
        """Return the result as HTML, for notebooks."""
        return as_html(self.describe())


def read_only(values: Mapping[Any, Any]) -> MappingProxyType[Any, Any]:
    """Return a mapping that cannot be written to, and is pickled and copied as a dict is."""
    return MappingProxyType(dict(values))


copyreg.pickle(MappingProxyType, lambda values: (read_only, (dict(values),)))


def use_plots(names: Mapping[str, str], importer: Callable[[str], Any]) -> None:
    """Decide which public function plots which kind of result.

    Results lie below the plots, so that the package's namespace, which imports both, connects them.

    Parameters
    ----------
    names
        Name of the plotting function in `rocksteady.plots` by the name of the class.
    importer
        Returns the plotting function of a name.
    """
    for kind, name in names.items():
        _plots[kind] = functools.partial(importer, name)


def use_words(modules: Mapping[str, Sequence[str]]) -> None:
    """Decide which module has the words of which kinds of results, by the names of these.

    Results lie below their words, so that the package's namespace, which imports neither, connects
    them.
    """
    for module, kinds in modules.items():
        _words.update(dict.fromkeys(kinds, module))


def words_module(kind: type) -> Any:
    """Return the module that has the words of a class, or of one that it is derived from."""
    names = (base.__name__ for base in kind.__mro__)
    return importlib.import_module(next(_words[name] for name in names if name in _words))


def describes(kind: type[R]) -> Callable[[Callable[[R], Description]], Callable[[R], Description]]:
    """Make a function of a module of words describe a class."""

    def use(function: Callable[[R], Description]) -> Callable[[R], Description]:
        _describers[kind] = function
        return function

    return use


def plotting_function(kind: str) -> Callable[..., Any]:
    """Return the function that plots a kind of result.

    Raises
    ------
    ModelError
        If none does.
    """
    if kind not in _plots:
        raise ModelError(
            "plot",
            Words(f"has no picture of a {kind}"),
            f"there are pictures of {', '.join(sorted(_plots))}",
            "read summary()",
        )
    function: Callable[..., Any] = _plots[kind]()
    return function
