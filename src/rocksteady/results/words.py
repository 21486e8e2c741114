"""Words on fields: what people read of a value stands in the annotation of its field.

``beta: Annotated[float, Label("beta", number)]`` in a result, or the same as the type that a
property returns, is all that text, HTML, JSON and data frames need: `facts_of` makes the fact.
"""

import inspect
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, NamedTuple

from rocksteady.results.description import Fact
from rocksteady.results.numbers import quantity


class Label(NamedTuple):
    """What people read of a field, and its form in JSON."""

    words: str | None = None
    """The words before the value, by default its name; empty of what JSON alone has."""
    text: Callable[[Any], str] | None = None
    """Writes the value; by default with its unit, or with three significant digits."""
    unit: str = ""
    """Unit in which people read it."""
    plain: Callable[[Any], Any] | None = None
    """Makes it plain, or each item of it, as `number_or_none` where NaN is null in JSON."""
    optional: bool = False
    """Whether people read nothing where it is None or has no text."""


def facts_of(result: object, *parts: str | Fact, **texts: str) -> list[Fact]:
    """Return facts on fields and properties, by their labels.

    What has a label and is not named follows at the end, in the order of the class: a new field
    needs no line but its own.

    Parameters
    ----------
    result
        An object whose class has labels in its annotations.
    parts
        Names of fields and properties, with spaces between them, and facts made elsewhere, in the
        order of the JSON object.  What has no label is for JSON alone.
    texts
        Values as people read them, by name, in place of what their labels write.
    """
    labels = labels_of(type(result))
    facts: list[Fact] = []
    for part in parts:
        if isinstance(part, Fact):
            facts.append(part)
        else:
            names = part.split()
            facts += [_fact(result, name, labels.get(name, Label("")), texts) for name in names]
    rest = labels.keys() - {fact.key for fact in facts}
    return facts + [
        _fact(result, name, label, texts) for name, label in labels.items() if name in rest
    ]


def labels_of(kind: type) -> Mapping[str, Label]:
    """Return the labels of a class by field and property, in the order of their definition."""
    labels: dict[str, Label] = {}
    for base in reversed(kind.__mro__):
        annotations = dict(inspect.get_annotations(base))
        for name, member in vars(base).items():
            if isinstance(member, property) and member.fget:
                annotations[name] = member.fget.__annotations__.get("return")
        for name, annotation in annotations.items():
            for label in getattr(annotation, "__metadata__", ()):
                if isinstance(label, Label):
                    labels[name] = label
    return labels


def _fact(result: object, name: str, label: Label, texts: Mapping[str, str]) -> Fact:
    """Return the fact of a field or property."""
    value = getattr(result, name)
    text = texts.get(name, "")
    if not (text or value is None):
        write = label.text or (partial(quantity, unit=label.unit) if label.unit else None)
        text = write(value) if write else ""
    words = name.replace("_", " ") if label.words is None else label.words
    if label.optional and not (text or value):
        words = ""
    return Fact(name, _plain(value, label.plain), words, text)


def _plain(value: Any, one: Callable[[Any], Any] | None) -> Any:
    """Return a value in the types of JSON."""
    if getattr(value, "ndim", 0):  # an array
        value = value.tolist()
    if isinstance(value, tuple | list):
        return [_plain(each, one) for each in value]
    if isinstance(value, Mapping):
        return {key: _plain(each, one) for key, each in value.items()}
    return value if one is None else one(value)
