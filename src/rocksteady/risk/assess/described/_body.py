"""Geometry, mass and content of an object as one rigid body, nominal or at the end of a range."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.elementary.arrays import cos, hypot, sin
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.housner_forms import Restitution
from rocksteady.model.blocks.outlines import Outline
from rocksteady.model.blocks.sides import with_point_mass
from rocksteady.risk.assess.described.schema import Content, Geometry, ObjectInput, Range, Value
from rocksteady.risk.observations.files.toml_tables import named

FRAME = ("columns", "cap_mass_ratio")
"""Keys of a frame, of which the others describe one column, a body with its mass in mid-height."""


class Form(NamedTuple):
    """A way to give a geometry.

    Attributes
    ----------
    words
        What gives the size.
    heads
        Keys that the way is recognised by.
    needed
        Keys without which it is not complete, each with those that may stand in its place.
    keys
        All keys that go with it.
    """

    words: str
    heads: tuple[str, ...]
    needed: tuple[tuple[str, ...], ...]
    keys: tuple[str, ...]


SIZES = Form(
    words="width_m and height_m",
    heads=("width_m", "height_m"),
    needed=(("width_m",), ("height_m",)),
    keys=("width_m", "height_m", "base_width_m", "offset_m", "mass_centre_height_m", "gyration_m",
          "inertia_kg_m2", "mass_kg", *FRAME),
)  # fmt: skip
EDGES = Form(
    words="left_m, right_m and mass_centre_height_m",
    heads=("left_m", "right_m"),
    needed=(("left_m",), ("right_m",), ("mass_centre_height_m",)),
    keys=("left_m", "right_m", "mass_centre_height_m", "height_m", "gyration_m", "inertia_kg_m2",
          "mass_kg"),
)  # fmt: skip
SLENDERNESS = Form(
    words="alpha_rad or alpha_deg, and p_rad_s",
    heads=("alpha_rad", "alpha_deg", "p_rad_s"),
    needed=(("alpha_rad", "alpha_deg"), ("p_rad_s",)),
    keys=("alpha_rad", "alpha_deg", "p_rad_s", *FRAME),
)
FORMS = (SIZES, EDGES, SLENDERNESS)
WAYS = "; ".join(form.words for form in FORMS)


@dataclass(frozen=True, kw_only=True)
class Body:
    """A rigid body on two edges.

    Attributes
    ----------
    left, right
        Horizontal distances from the edges to the mass centre [m].
    centre_height
        Height of the mass centre [m].
    gyration
        Radius of gyration about the mass centre [m].
    height
        Full height [m].
    ends
        Horizontal distances from the left and right end of the outline to the mass centre [m].
    mass_kg
        Mass [kg], of a frame that of one column; None where the file does not give it.
    rectangle
        Width and height [m] where it is a homogeneous rectangle on its full width.
    columns, cap_mass_ratio
        Number of columns of a frame, each of which is this body, and mass of the cap over that of
        all of them; None of a single body, as one pier with its cap.
    """

    left: float
    right: float
    centre_height: float
    gyration: float
    height: float
    ends: tuple[float, float]
    mass_kg: float | None = None
    rectangle: tuple[float, float] | None = None
    columns: int | None = None
    cap_mass_ratio: float = 0.0

    @property
    def whole_mass_kg(self) -> float | None:
        """Mass on the base, of a frame that of all columns and the cap [kg]; None if not known."""
        if self.mass_kg is None or self.columns is None:
            return self.mass_kg
        return self.mass_kg * self.columns * (1.0 + self.cap_mass_ratio)

    def block(self, restitution: Restitution, gravity: float) -> Block:
        """Return the block, or the frame."""
        if self.columns is not None:
            column = replace(self, columns=None, ends=(0.0, 0.0)).block(1.0, gravity)
            return column.capped(
                columns=self.columns, cap_mass_ratio=self.cap_mass_ratio, restitution=restitution
            )
        if self.rectangle is not None:
            width, height = self.rectangle
            return Block.rectangle(
                width=width, height=height, restitution=restitution, gravity=gravity
            )
        block = Block.asymmetric(
            left=self.left,
            right=self.right,
            height=2.0 * self.centre_height,
            gyration=self.gyration,
            restitution=restitution,
            gravity=gravity,
        )
        outline = Outline(
            height=max(self.height, self.centre_height),
            left_overhang=max(self.ends[0] - self.left, 0.0),
            right_overhang=max(self.ends[1] - self.right, 0.0),
        )
        return replace(block, outline=outline)

    def with_share(self, share: float, height_m: float) -> "Body":
        """Return the body with a point mass, a share of its own, in line with its mass centre."""
        centre, gyration = with_point_mass(
            self.centre_height, self.gyration, share=share, at_height=height_m
        )
        mass = None if self.mass_kg is None else self.mass_kg * (1.0 + share)
        return replace(
            self,
            centre_height=centre,
            gyration=gyration,
            height=max(self.height, height_m),
            mass_kg=mass,
            rectangle=None,
        )

    def wider(self, factor: float) -> "Body":
        """Return the body on a base whose edges stand further from the mass centre by a factor.

        What stands on it stays as it is, and so does its moment of inertia.
        """
        return replace(self, left=self.left * factor, right=self.right * factor, rectangle=None)

    def with_centre(self, factor: float) -> "Body":
        """Return the body with its mass centre higher by a factor, and its gyration as it was.

        A column of a frame is higher by that factor, with its mass in mid-height.
        """
        height = self.height if self.columns is None else self.height * factor
        return replace(
            self, centre_height=self.centre_height * factor, height=height, rectangle=None
        )


def middle(value: Value) -> float:
    """Return a number, or the middle of a range."""
    return value.middle if isinstance(value, Range) else value


def body_of(given: ObjectInput, source: str, key: str = "", end: float = 0.0) -> Body:
    """Return the object with its content as one body.

    Parameters
    ----------
    given
        The object.
    source
        What it comes from, for messages.
    key, end
        Key whose value is another number, as "content.mass_kg"; of other ranges the middle counts.

    Raises
    ------
    ModelError, InputError
        If its geometry is given twice or in part, no body has it, or it has several parts that are
        not stated to be fixed to each other.
    """
    shape, content = given.geometry, given.content
    form = _form(shape, source)
    numbers = _numbers("geometry", shape, key, end)
    if form is SLENDERNESS:
        body = _of_slenderness(numbers, given.gravity_m_s2)
    else:
        body = _of_sizes(numbers, source) if form is SIZES else _of_edges(numbers)
    if body.centre_height > body.height:
        raise InputError(
            named(source, "geometry", "mass_centre_height_m"),
            body.centre_height,
            f"it is at most height_m, {body.height:g}",
            "measure it again",
        )
    if shape.columns is not None:
        ratio = numbers["cap_mass_ratio"]
        if shape.columns == 1:
            body = body.with_share(ratio, body.height)
        else:
            body = replace(body, columns=shape.columns, cap_mass_ratio=ratio)
        if content is not None:
            raise ModelError(
                named(source, "geometry", "columns"),
                Words("stands beside [content]"),
                "columns carry their cap alone",
                "leave [content] out, or add it to cap_mass_ratio",
            )
    if not given.fixed_parts and (content is not None or shape.columns == 1):
        raise ModelError(
            named(source, "", "fixed_parts"),
            Words("is not true"),
            f"{given.parts} are computed as one body, in which nothing rocks or slides on its own",
            "add fixed_parts = true (in a table: yes) where they are fixed to each other, or "
            "describe what can rock by itself",
        )
    if content is None:
        return body
    if body.mass_kg is None:
        raise ModelError(
            named(source, "geometry", "mass_kg"),
            Words("is missing"),
            "content needs the mass of the object beside its own",
            "add mass_kg, without its content, or leave [content] out"
            + (", and give sizes in place of alpha and p" if form is SLENDERNESS else ""),
        )
    point = _numbers("content", content, key, end)
    return body.with_share(point["mass_kg"] / body.mass_kg, point["mass_centre_height_m"])


def _numbers(table: str, given: Geometry | Content, key: str, end: float) -> dict[str, float]:
    """Return the numbers of a table: of a range the middle, or the end that is chosen."""
    return {
        name: end if key == f"{table}.{name}" else middle(value)
        for name in given.__struct_fields__
        if (value := getattr(given, name)) is not None
    }


def _form(shape: Geometry, source: str) -> Form:
    """Return which of the three ways a geometry is given in."""
    given = [key for key in shape.__struct_fields__ if getattr(shape, key) is not None]
    # A height goes with edges too.
    heads = [key for key in given if key != "height_m" or not {*EDGES.heads} & {*given}]
    forms = [form for form in FORMS if {*form.heads} & {*heads}]
    table = f"{source}: [geometry]"
    if not forms:
        raise ModelError(
            table, Words("has no size"), f"it is one of: {WAYS}", "add width_m and height_m"
        )
    first, *others = [next(key for key in form.heads if key in given) for form in forms]
    _refuse_both(table, [first, *others[:1]], f"the size is given in one way: {WAYS}")
    (form,) = forms
    framed = bool({*FRAME} & {*given})
    moved = ("base_width_m", "offset_m", "mass_centre_height_m") if framed else ()
    keys = [key for key in form.keys if key not in moved]
    for key in given:
        if key not in keys:
            raise ModelError(
                f"{table} {key}",
                Words(f"does not go with {first}"),
                f"beside it stand {', '.join(keys)}",
                "leave it out",
            )
    valid = f"a geometry is one of: {WAYS}"
    for choice in form.needed:
        _require(table, given, choice, valid)
    for key in FRAME if framed else ():
        _require(table, given, (key,), f"a frame has {' and '.join(FRAME)}")
    for pair in (("gyration_m", "inertia_kg_m2"), ("alpha_rad", "alpha_deg")):
        _refuse_both(table, [key for key in pair if key in given], "one of the two is enough")
    if "inertia_kg_m2" in given:
        hint = "add mass_kg, or give gyration_m = sqrt(I/M)"
        _require(table, given, ("mass_kg",), "inertia_kg_m2 needs the mass beside it", hint)
    return form


def _refuse_both(table: str, keys: Sequence[str], valid: str) -> None:
    """Refuse two keys of which one is enough."""
    if len(keys) > 1:
        first, second = keys
        raise ModelError(
            table,
            Words(f"has both {first} and {second}"),
            valid,
            f"leave {first} or {second} out",
        )


def _require(
    table: str, given: Sequence[str], choice: Sequence[str], valid: str, hint: str = "add it"
) -> None:
    """Refuse a geometry with none of some keys."""
    if not {*choice} & {*given}:
        raise ModelError(f"{table} {' or '.join(choice)}", Words("is missing"), valid, hint)


def _of_sizes(numbers: Mapping[str, float], source: str) -> Body:
    """Return the body of an outline: width and height."""
    width, height = numbers["width_m"], numbers["height_m"]
    base = numbers.get("base_width_m", width)
    offset = numbers.get("offset_m", 0.0)
    centre = numbers.get("mass_centre_height_m", 0.5 * height)
    checks = (
        ("base_width_m", base, base <= width, f"the base is at most as wide as width_m, {width:g}"),
        ("offset_m", offset, abs(offset) < 0.5 * base,
         f"the mass centre must stand above the base, {0.5 * base:g} m to either side"),
    )  # fmt: skip
    for key, value, fits, valid in checks:
        if not fits:
            raise InputError(
                named(source, "geometry", key), value, valid, "measure it again, or leave it out"
            )
    whole = base == width and offset == 0.0 and centre == 0.5 * height
    plain = whole and not {"gyration_m", "inertia_kg_m2"} & set(numbers)
    return Body(
        left=0.5 * base + offset,
        right=0.5 * base - offset,
        centre_height=centre,
        gyration=_gyration(numbers, hypot(width, height) / math.sqrt(12.0)),
        height=height,
        ends=(0.5 * width + offset, 0.5 * width - offset),
        mass_kg=numbers.get("mass_kg"),
        rectangle=(width, height) if plain else None,
    )


def _of_edges(numbers: Mapping[str, float]) -> Body:
    """Return the body of base edges and mass centre."""
    left, right = numbers["left_m"], numbers["right_m"]
    centre = numbers["mass_centre_height_m"]
    height = numbers.get("height_m", 2.0 * centre)
    return Body(
        left=left,
        right=right,
        centre_height=centre,
        gyration=_gyration(numbers, hypot(left + right, height) / math.sqrt(12.0)),
        height=height,
        ends=(left, right),
        mass_kg=numbers.get("mass_kg"),
    )


def _of_slenderness(numbers: Mapping[str, float], gravity: float) -> Body:
    """Return the homogeneous rectangle of a slenderness and a frequency parameter."""
    alpha = numbers.get("alpha_rad", math.radians(numbers.get("alpha_deg", 0.0)))
    p = numbers["p_rad_s"]
    diagonal = 1.5 * gravity / (p * p)
    width, height = diagonal * sin(alpha), diagonal * cos(alpha)
    return Body(
        left=0.5 * width,
        right=0.5 * width,
        centre_height=0.5 * height,
        gyration=diagonal / math.sqrt(12.0),
        height=height,
        ends=(0.5 * width, 0.5 * width),
        rectangle=(width, height),
    )


def _gyration(numbers: Mapping[str, float], default: float) -> float:
    """Return the radius of gyration about the mass centre [m]."""
    if "inertia_kg_m2" in numbers:
        return math.sqrt(numbers["inertia_kg_m2"] / numbers["mass_kg"])
    return numbers.get("gyration_m", default)
