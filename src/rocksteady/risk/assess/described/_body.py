"""Geometry, mass and content of an object as one rigid body, nominal or at the end of a range."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from rocksteady.errors import InputError, ModelError, Words
from rocksteady.kernels.elementary.arrays import cos, hypot, sin
from rocksteady.model.blocks.block import Block
from rocksteady.model.blocks.housner_forms import Restitution
from rocksteady.model.blocks.outlines import Outline
from rocksteady.model.blocks.sides import with_point_mass
from rocksteady.risk.assess.described.schema import Geometry, ObjectInput, Range, Value
from rocksteady.risk.observations.files.toml_tables import named

Choose = Callable[[str, Value], float]
"""Returns the number to compute with, of a key ("content.mass_kg") and its value."""

FRAME = ("columns", "cap_mass_ratio")
"""Keys of a frame, of which the others describe one column, a body with its mass in mid-height."""
FORMS: Mapping[str, tuple[str, ...]] = {
    "width_m and height_m": ("width_m", "height_m", "base_width_m", "offset_m",
                             "mass_centre_height_m", "gyration_m", "inertia_kg_m2", "mass_kg",
                             *FRAME),
    "left_m, right_m and mass_centre_height_m": ("left_m", "right_m", "mass_centre_height_m",
                                                 "height_m", "gyration_m", "inertia_kg_m2",
                                                 "mass_kg"),
    "alpha_rad or alpha_deg, and p_rad_s": ("alpha_rad", "alpha_deg", "p_rad_s", *FRAME),
}  # fmt: skip
"""The three ways to give a geometry, each with all keys that go with it."""


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

    def with_mass(self, mass_kg: float, height_m: float) -> "Body":
        """Return the body with a point mass above the middle between mass centre and nothing else.

        The mass is added straight below or above the mass centre, at a height above the base.
        """
        assert self.mass_kg is not None
        return self.with_share(mass_kg / self.mass_kg, height_m)

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


def nominal(_: str, value: Value) -> float:
    """Return the middle of a range."""
    return value.middle if isinstance(value, Range) else value


def body_of(given: ObjectInput, source: str, choose: Choose = nominal) -> Body:
    """Return the object with its content as one body.

    Raises
    ------
    ModelError, InputError
        If its geometry is given twice or in part, no body has it, or it has several parts that are
        not stated to be fixed to each other.
    """
    shape = given.geometry
    form = _form(shape, source)
    numbers = {
        key: choose(f"geometry.{key}", value)
        for key in shape.__struct_fields__
        if (value := getattr(shape, key)) is not None
    }
    if form == 2:
        body = _of_slenderness(numbers, given.gravity_m_s2)
    else:
        body = _of_sizes(numbers, source) if form == 0 else _of_edges(numbers)
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
        if given.content is not None:
            raise ModelError(
                named(source, "geometry", "columns"),
                Words("stands beside [content]"),
                "columns carry their cap alone",
                "leave [content] out, or add it to cap_mass_ratio",
            )
    if not given.fixed_parts and (given.content is not None or shape.columns == 1):
        raise ModelError(
            named(source, "", "fixed_parts"),
            Words("is not true"),
            f"{given.parts} are computed as one body, in which nothing rocks or slides on its own",
            "add fixed_parts = true (in a table: yes) where they are fixed to each other, or "
            "describe what can rock by itself",
        )
    if given.content is None:
        return body
    if body.mass_kg is None:
        raise ModelError(
            named(source, "geometry", "mass_kg"),
            Words("is missing"),
            "content needs the mass of the object beside its own",
            "add mass_kg, without its content, or leave [content] out"
            + (", and give sizes in place of alpha and p" if form == 2 else ""),
        )
    mass = choose("content.mass_kg", given.content.mass_kg)
    height = choose("content.mass_centre_height_m", given.content.mass_centre_height_m)
    return body.with_mass(mass, height)


def _form(shape: Geometry, source: str) -> int:
    """Return which of the three ways a geometry is given in."""
    given = [key for key in shape.__struct_fields__ if getattr(shape, key) is not None]
    heads = (("width_m", "height_m"), ("left_m", "right_m"), ("alpha_rad", "alpha_deg", "p_rad_s"))
    extra: set[str] = {"height_m"} if set(heads[1]) & set(given) else set()  # goes with edges too
    places = [place for place, head in enumerate(heads) if set(head) & (set(given) - extra)]
    table = f"{source}: [geometry]"
    ways = "; ".join(FORMS)
    if not places:
        raise ModelError(
            table, Words("has no size"), f"it is one of: {ways}", "add width_m and height_m"
        )
    if len(places) > 1:
        keys = [next(key for key in heads[place] if key in given) for place in places]
        raise ModelError(
            table,
            Words(f"has both {keys[0]} and {keys[1]}"),
            f"the size is given in one way: {ways}",
            f"leave {keys[0]} or {keys[1]} out",
        )
    (form,) = places
    framed = bool(set(FRAME) & set(given))
    moved = ("base_width_m", "offset_m", "mass_centre_height_m") if framed else ()
    fits = [key for key in FORMS[list(FORMS)[form]] if key not in moved]
    for key in given:
        if key not in fits:
            raise ModelError(
                f"{table} {key}",
                Words(f"does not go with {next(k for k in heads[form] if k in given)}"),
                f"beside it stand {', '.join(fits)}",
                "leave it out",
            )
    needed: list[tuple[str, ...]] = [("width_m",), ("height_m",)]
    if form == 1:
        needed = [("left_m",), ("right_m",), ("mass_centre_height_m",)]
    elif form == 2:
        needed = [("alpha_rad", "alpha_deg"), ("p_rad_s",)]
    needed += [(key,) for key in FRAME if framed]
    for choice in needed:
        if not set(choice) & set(given):
            raise ModelError(
                f"{table} {' or '.join(choice)}",
                Words("is missing"),
                f"a frame has {' and '.join(FRAME)}"
                if choice[0] in FRAME
                else f"a geometry is one of: {ways}",
                "add it",
            )
    for first, second in (("gyration_m", "inertia_kg_m2"), ("alpha_rad", "alpha_deg")):
        if first in given and second in given:
            raise ModelError(
                table,
                Words(f"has both {first} and {second}"),
                "one of the two is enough",
                f"leave {first} or {second} out",
            )
    if "inertia_kg_m2" in given and "mass_kg" not in given:
        raise ModelError(
            f"{table} mass_kg",
            Words("is missing"),
            "inertia_kg_m2 needs the mass beside it",
            "add mass_kg, or give gyration_m = sqrt(I/M)",
        )
    return form


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
