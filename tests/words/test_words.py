"""Each result has words: it describes itself, or a module is named that describes its class."""

import inspect

from rocksteady.results import result
from rocksteady.results.result import Result, words_module
from tests.every import every
from tools.namespace import THINGS

KINDS = {
    name: thing
    for name, thing in THINGS.items()
    if inspect.isclass(thing) and issubclass(thing, Result)
}


@every("name", KINDS)
def test_each_public_result_is_described(name: str) -> None:
    kind = KINDS[name]
    if kind.describe is Result.describe:
        words_module(kind)
        assert any(base in result._describers for base in kind.__mro__)
