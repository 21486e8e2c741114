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
    """Words, unit and form of a field for people, and its form in JSON."""

    words: str | None = None
    """The words before the value, by default its name; empty for a field of JSON alone."""
    text: Callable[[Any], str] | None = None
    """Formats the value; by default with its unit, or with three significant digits."""
    unit: str = ""
    """Unit of the value in text."""
    plain: Callable[[Any], Any] | None = None
    """Converts the value, or each of its items, for JSON, as `number_or_none` makes NaN null."""
    optional: bool = False
    """Whether text leaves the field out where it is None or empty."""


def facts_of(result: object, *parts: str | Fact, **texts: str) -> list[Fact]:
    """Return facts on fields and properties, by their labels.

    Labelled fields that are not named follow at the end, in the order of the class: a new field
    needs no line but its own.

    Parameters
    ----------
    result
        An object whose class has labels in its annotations.
    parts
        Names of fields and properties, with spaces between them, and facts made elsewhere, in the
        order of the JSON object.  A field without a label is for JSON alone.
    texts
        Texts of values by field, which replace those of their labels.
    """
    labels = labels_of(type(result))
    facts: list[Fact] = []
    for part in parts:
        if isinstance(part, Fact):
            facts.append(part)
        else:
            names = part.split()
            facts += [_fact(result, name, labels.get(name, Label("")), texts) for name in names]
    named = {fact.key for fact in facts}
    return facts + [
        _fact(result, name, label, texts) for name, label in labels.items() if name not in named
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


def _plain(value: Any, convert: Callable[[Any], Any] | None) -> Any:
    """Return a value in the types of JSON, each of its items converted."""
    if getattr(value, "ndim", 0):  # an array
        value = value.tolist()
    if isinstance(value, tuple | list):
        return [_plain(each, convert) for each in value]
    if isinstance(value, Mapping):
        return {key: _plain(each, convert) for key, each in value.items()}
    return value if convert is None else convert(value)
