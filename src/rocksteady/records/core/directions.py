"""Direction of a channel, from its name in the file or from the file's own name."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from rocksteady.records.core.recording import Orientation

_SENSES: Final = {
    sense: frozenset(words.split())
    for sense, words in {
        "upwards": "up u upward upwards",
        "downwards": "dwn down dn downward downwards",
        "negative": "negative neg minus",
        "neither": "v vert vertical vrt ver z ud updown vertikal verticale",
        "short": "up u u-d updo dwn down dn d v1 v2 v3 az accz agz dusey d\u00fc\u015fey"
        " \u4e0a\u4e0b \u5782\u76f4 \u7ad6"
        " \u03ba\u03b1\u03c4\u03b1\u03ba\u03cc\u03c1\u03c5\u03c6\u03b7"
        " \u0432\u0435\u0440\u0442\u0438\u043a\u0430\u043b\u044c\u043d\u0430\u044f",
        "level": "h h1 h2 l l1 t t1 long longitudinal tran trans transverse transversal lateral hor"
        " hor1 hor2 horizontal",
    }.items()
}
_UPWARDS: Final = _SENSES["upwards"]
_DOWNWARDS: Final = _SENSES["downwards"]
_NEGATIVE: Final = _SENSES["negative"]
_WITHOUT_SENSE: Final = _SENSES["neither"]
_VERTICAL: Final = _WITHOUT_SENSE | _SENSES["short"]
_OF_A_STRUCTURE: Final = _SENSES["level"]
"""Horizontal directions of an instrument or a structure, whose azimuth is not in their name."""

_FILLERS: Final = re.compile(
    r"a|ag|acc\w*|acel\w*|beschl\w*|i?vme|i|samples?|values?|data|\u52a0\u901f\u5ea6|column"
    r"|ch(?:a?n(?:nel)?)?|comp(?:onent)?|ground|base|input|table|motion|time|hist|history"
    r"|un?corr\w*|filtered|record(?:ed)?|positive|pos|ve|is|sensor|dir(?:ection)?|axis"
    r"|orient\w*|trace|code|id|cmpt?|eje|asse|axe|kanal|\u043a\u043e\u043c\u043f\u043e\u043d\u0435\u043d\u0442\u0430|richtung|bile\w+|componente"
)
"""Words beside those of a direction that carry no direction."""

_HAN: Final = re.compile(r"\u52a0\u901f\u5ea6|\u5206\u91cf|\u6210\u5206|\u65b9?\u5411")
"""Acceleration, component and direction, which stand beside a direction without a blank."""

_SIGNED: Final = re.compile(
    r"[-+]\s*(?:u-?d|up?|z|v(?:ert)?|d(?:ow)?n?|dwn)|(?:u-?d|z|v(?:ert)?|up?|d(?:ow)?n?|dwn)\s*[-+]"
    r"|d-?u|down-?up|[-+]\s*vertical"
)
"""Names of a vertical channel with a sign, or from below to above, whose sense may be either."""

_ROTATED: Final = re.compile(
    r"r|rad(?:ia)?l|tang(?:ential)?|[fs][np]|(?:fault|strike)[\s_-]?(?:normal|parallel)"
    r"|(?:gm)?rot[id](?:\d+\w*)?|rotated\b.*|[a-z][ghnl][rt](?:\d\d)?|geo(?:metric)?[\s_-]?mean"
    r"|srss|larger|maxrot|resultant"
)
"""Components that somebody turned, or combined, from those that were recorded."""

_COMPASS: Final = {
    word: azimuth
    for azimuth, words in {
        0.0: "n ns n-s s-n sn north north-south nord norte nord-sud norte-sur norte-sul"
        " nord-s\u00fcd kuzey-g\u00fcney k-g \u5357\u5317",
        90.0: "e ew e-w w-e we eo e-o o-e o-w east east-west este est ost est-ouest este-oeste"
        " est-ovest ost-west leste-oeste do\u011fu-bat\u0131 d-b \u6771\u897f \u4e1c\u897f",
        180.0: "s south sud sur",
        22.5: "nne",
        45.0: "ne",
        135.0: "se",
        157.5: "sse",
        202.5: "ssw",
        225.0: "sw",
        292.5: "wnw",
        315.0: "nw",
        337.5: "nnw",
        270.0: "w west oeste ouest ovest",
    }.items()
    for word in words.split()
}
_QUADRANT: Final = re.compile(r"([ns])\s*(\d+(?:\.\d*)?)\s*(?:deg\w*)?\s*([ew])")
# 1, 2 and 3 alone number channels.
_DEGREES: Final = re.compile(r"(?:[nh]\s*(?=\d{3}))?(?![123]$)(\d{1,3}(?:\.\d*)?)\s*(?:deg\w*)?")
# Band, instrument, direction: the three letters of a SEED channel, with its location behind them.
# Of seismometers (H) the bands are named, as letters of words would else pass for theirs.
_SEED: Final = re.compile(r"(?:[a-mo-z][gnl]|[behlmsv]h)([enz123xyrt])(?:\d\d|--)?")
_SEED_ID: Final = re.compile(
    r"(?:(?:[A-Z0-9]{1,2}[._])?[A-Z0-9]{1,5}[._])?(?:\d\d|--)?[._]?([A-Z]_?[GHNL]_?[ENZ123XYRT])"
    r"(?:[._](?:\d\d|--|[A-Z]|[A-Z0-9]{2}[._](?:\d\d|--)))?"
)
"""Network, station, location and channel of SEED, as in ``XX_HUT_00_HNE_M``."""

_BESIDE: Final = re.compile(
    r"\s*(?:\((?:sta|rcrdr)\.?\s*ch[^)]*\)|,?\s*(?:location|loc)\s*:.*"
    r"|\(?\bGL\s?[+-]?\s?\d+(?:\.\d+)?\s?m?\)?)$",
    re.IGNORECASE,
)
"""Number and place of a channel, behind its direction: ``(STA CHN: 14)``, ``Location: Roof``."""


TAIL: Final = re.compile(
    r"(?:[-_. ](?:hor[12]?|h[12]|up|dwn|down|dn|vert?|ud|ns|ew|[neswvz]|[a-z][gnl][enz123])"
    r"|[-_. ]?\d{3}|(?<=[A-Za-z0-9])[-_.]?(?:up|dwn)|(?-i:(?<=[A-Z0-9])DOWN))$",
    re.IGNORECASE,
)
"""The end of a file's name that distinguishes a component from the others of its station."""

_CERTAIN: Final = re.compile(r"[-_. ].*|[A-Z]+|dwn")
"""Ends of names that are no end of a word, as in ``backup``, nor a number."""


@dataclass(frozen=True, kw_only=True)
class Pointing:
    """Direction of positive values of a channel.

    Parameters
    ----------
    orientation
        Horizontal or vertical, where that is known.
    azimuth_deg
        Clockwise from north, where a horizontal direction is known [degrees].
    down
        Whether positive values of a vertical channel point downwards; None where only "vertical"
        is stated, which networks use for upwards.
    unclear
        Whether a vertical sense is named and not understood as a whole: a sign, DU, "not up".
    rotated
        Whether the name is one of a component that was turned from those recorded.
    """

    orientation: Orientation | None = None
    azimuth_deg: float | None = None
    down: bool | None = None
    unclear: bool = False
    rotated: bool = False


def pointing(component: str | None) -> Pointing:
    """Return the direction of a channel by its name.

    Parameters
    ----------
    component
        As the file names it.

    Examples
    --------
    >>> [pointing(name).down for name in ("DWN", "Vert, positive down", "UP", "HNZ", "090")]
    [True, True, False, None, None]
    """
    written = "" if component is None else without_place(component)[0]
    written = written.replace("(+)", "").replace("(-)", "-").strip("()[] ")
    if (of_seed := _SEED_ID.fullmatch(written)) is not None:
        written = of_seed[1].replace("_", "")
    text = written.lower().replace("\u0307", "").replace("\xb0", "")  # of a Turkish capital I
    text = _HAN.sub("", text)
    text = text.replace("/", "-") if text in {"n/s", "e/w", "u/d", "e/o"} else text
    rotated = _ROTATED.fullmatch(text) is not None
    signed = _SIGNED.fullmatch(text) is not None
    if signed or text in _VERTICAL:
        down = True if text in _DOWNWARDS or text == "d" else _or_none(text)
        return Pointing(orientation="vertical", down=None if signed else down, unclear=signed)
    azimuth = _azimuth(text)
    if azimuth is not None or text in _OF_A_STRUCTURE or rotated:
        return Pointing(orientation="horizontal", azimuth_deg=azimuth, rotated=rotated)
    words = [word for word in re.split(r"[\W_]+", text) if word and not _filler(word)]
    named = set(words) & (_UPWARDS | _DOWNWARDS | _WITHOUT_SENSE - {"v", "z"}) - {"u"}
    named = named or set(re.findall(r"(?<![a-z])(?:u-?d|d-?u)(?![a-z])", text))
    vertical = _vertical(text)
    if named or vertical.orientation is not None:
        return vertical
    seed = _SEED.fullmatch(words[0] if len(words) == 1 else text)
    if seed is None:
        rest = re.sub(r"[^\W_]+", lambda word: "" if _filler(word[0]) else word[0], text)
        rest = rest.strip(" _-,.:;()")
        return pointing(rest) if len(rest) > 1 and rest != text else Pointing()
    # A channel named 3 is the vertical one of some networks and not of others.
    towards: dict[str, Orientation | None] = {"z": "vertical", "3": None}
    return Pointing(
        orientation=towards.get(seed[1], "horizontal"),
        azimuth_deg={"n": 0.0, "e": 90.0}.get(seed[1]),
    )


def without_place(component: str) -> tuple[str, str]:
    """Return the name of a channel without its number and place, and these.

    Examples
    --------
    >>> without_place("UP       (STA CHN: 15)"), without_place("90 Deg  Location: Roof")
    (('UP', '(STA CHN: 15)'), ('90 Deg', 'Location: Roof'))
    """
    at = beside.start() if (beside := _BESIDE.search(component)) else len(component)
    return component[:at].strip(), component[at:].strip(" ,")


def contradiction(one: Pointing, other: Pointing) -> tuple[str, str] | None:
    """Return two directions in words where they cannot both be true."""
    if one.orientation is None or other.orientation is None:
        return None
    if one.orientation != other.orientation:
        return one.orientation, other.orientation
    if one.orientation == "vertical":
        # Without a sense, vertical is upwards, but not against a name that states one.
        if None in {one.down, other.down} or one.down == other.down:
            return None
        return ("downwards", "upwards") if one.down else ("upwards", "downwards")
    if one.azimuth_deg is None or other.azimuth_deg is None:
        return None
    apart = abs((one.azimuth_deg - other.azimuth_deg + 180.0) % 360.0 - 180.0)
    return None if apart <= 1.0 else (f"{one.azimuth_deg:g} deg", f"{other.azimuth_deg:g} deg")


def together(names: Iterable[str]) -> str | None:
    """Return the first name of a direction, or all that differ; None where none is understood.

    Examples
    --------
    >>> together(("090 DEG", "E")), together(("UP", "E", "x")), together(("x",))
    ('090 DEG', 'UP / E', None)
    """
    known: list[str] = []
    for name in names:
        direction_of = pointing(name)
        if direction_of.orientation is None:
            continue
        if not known or any(contradiction(direction_of, pointing(named)) for named in known):
            known.append(name)
    return " / ".join(known) or None


def direction(component: str | None) -> tuple[Orientation | None, float | None]:
    """Return whether a channel is horizontal or vertical, and its azimuth [degrees].

    Parameters
    ----------
    component
        As the file names it.

    Examples
    --------
    >>> [direction(name) for name in ("S69E", "N-S", "HNZ", "090", "DWN")]  # doctest: +ELLIPSIS
    [('horizontal', 111.0), ('horizontal', 0.0), ('vertical', None), ('horizontal', 90.0), ...]
    >>> direction("HN1"), direction("sensor 7")
    (('horizontal', None), (None, None))
    """
    result = pointing(component)
    return result.orientation, result.azimuth_deg


def pointing_of_name(stem: str) -> Pointing:
    """Return the direction that the end of a file's name states, where it can mean nothing else.

    Examples
    --------
    >>> pointing_of_name("RSN77_SFERN_PULDWN").down, pointing_of_name("backup").orientation
    (True, None)
    """
    tail = TAIL.search(stem)
    if stem.lower() in _UPWARDS | _DOWNWARDS | _WITHOUT_SENSE and len(stem) > 1:
        return pointing(stem)
    if tail is None or _CERTAIN.fullmatch(tail[0]) is None or re.search(r"\d{3}$", tail[0]):
        return Pointing()
    word = tail[0].strip("-_. ").lower()
    return pointing(word)


def tells_nothing(component: str | None) -> bool:
    """Return whether no word of a channel's name can be about its direction."""
    words = re.split(r"[\W_]+", (component or "").lower())
    return all(_filler(word) or word.isdecimal() for word in words if word)


def _filler(word: str) -> bool:
    """Return whether a word carries no direction."""
    return _FILLERS.fullmatch(word) is not None


def _or_none(word: str) -> bool | None:
    """Return that a word points upwards, or None where it states no sense."""
    return False if word in _UPWARDS else None


def _vertical(text: str) -> Pointing:
    """Return the vertical direction that several words state together, if they do as a whole.

    A sense may be stated twice, as in ``DWN (positive down)``, and must be the same.
    """
    plain = re.sub(r"(?<![a-z])u-d(?![a-z])", "ud", text)
    words = {word for word in re.split(r"[\W_]+", plain) if word and not _filler(word)}
    known = _UPWARDS | _DOWNWARDS | _WITHOUT_SENSE | _NEGATIVE | {"hnz", "hlz"}
    others = words - known
    if not words - _NEGATIVE or (others and not words & known):
        return Pointing()
    if others:
        # "down hole NS" is no vertical channel, and "UPSIDE DOWN" may be one.
        level = any(_azimuth(word) is not None for word in others)
        return Pointing(unclear=not level)
    down, up = bool(words & _DOWNWARDS), bool(words & _UPWARDS)
    signed = re.search(r"(?:^|[\s(,_])-\s*[a-z]|[a-z]\s*-(?=$|[\s),])", plain) is not None
    # "UP (positive down)" contradicts itself, as "negative" does beside no sense or two.
    if signed or (down and up) or (words & _NEGATIVE and not down and not up):
        return Pointing(orientation="vertical", unclear=True)
    if down == up:
        return Pointing(orientation="vertical")
    return Pointing(orientation="vertical", down=down != bool(words & _NEGATIVE))


def _azimuth(text: str) -> float | None:
    """Return the azimuth [degrees] that the name of a direction states."""
    if text in _COMPASS:
        return _COMPASS[text]
    if quadrant := _QUADRANT.fullmatch(text):
        degrees = float(quadrant[2]) if quadrant[3] == "e" else -float(quadrant[2])
        return (degrees if quadrant[1] == "n" else 180.0 - degrees) % 360.0
    number = _DEGREES.fullmatch(text)
    if number is None or float(number[1]) > 360.0:
        return None
    return float(number[1]) % 360.0
