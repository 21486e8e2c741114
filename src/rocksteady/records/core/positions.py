"""Where a sensor stands, by words about it: on the ground, below it, or in a structure."""

import re
from typing import Final

from rocksteady.records.core.recording import Position

_PLACES: Final[dict[Position, re.Pattern[str]]] = {
    "borehole": re.compile(
        r"\b(?:bore|down)[\s-]?hole|\bunderground\b|\bin[\s-]hole\b|\bburied\b|\bforage\b"
        r"|\bbohrloch\b"
        r"|\bG\.?L\.?\s?-\s?(?!0+(?:\.0*)?\s?m?\b)\d|\(\s*-\s*\d+(?:\.\d+)?\s*m\s*\)"
        r"|\b(?:(?:sensor|burial|installation|instrument)[\s_-]depth\w*|depth_m)\D{0,8}"
        r"(?!0+(?:\.0*)?\b)\d|\d\s*(?:m|ft|met(?:er|re)s?|feet)\s*below\s+(?:the\s+)?(?:gr|surf)"
        r"|\bdepth of (?:instrument|sensor)|\bat depth\b|\bsubsurface\b|\bocean bottom\b|\bOBS\b"
        r"|\bwithin rock\b|\b(?:elevation|location|quote)\s*:?\s*-\d|\bpozo \d"
        r"|\bgeotech\w*\s+array|^\s*depth\s*[:=]\s*[1-9]\d{0,2}(?:\.\d+)?\s*m\b"
        r"|\u5b54\u5185|\u5730\u4e0b|\u4e95\u4e0b",
        re.IGNORECASE | re.MULTILINE,
    ),
    "surface": re.compile(
        r"\bfree[\s-]?field|\bFF\b|\b(?:ground|soil|rock)[\s-]?surface|^\s*surface\b|\bGL\s?-\s?0"
        r"|\bpoint\s*:\s*ground\b|\bcampo liber?o\b|\bcampo libre\b|\bchamp libre\b|\bfreifeld\b",
        re.IGNORECASE | re.MULTILINE,
    ),
    "structure": re.compile(
        r"(?<![a-z])(?:roof(?:top)?|(?<!valley )floors?|ceiling|podium|deck|crest|girder"
        r"|basement(?!\s+rock)|penthouse|mezzanine|mid-?span)(?![a-z])|\b\d+(?:st|nd|rd|th)\s+(?:fl|level|lvl)"
        r"|\blocation\s*:\s*(?:pier|abutment|column|tower)\b|\bstor(?:e?y|eys|ies)\b|\bb?\d{1,2}F\b"
        r"|\bpile\s?cap\b|\b(?:top of|bridge|dam) (?:the )?(?:building|bldg|tower|top|pier)\b"
        r"|\bpier top\b|\btunnel\b|\b(?:planta|piano|piso|level|nivel|plancher|entrepiso|kat):? \d"
        r"|\b(?:bent cap|tank top|top of pile|machine room|gallery|obergeschoss|untergeschoss)\b"
        r"|\b(?:copertura|terrazza|toiture|livello|\u00e9tage|etage|\u00e7at\u0131)\b"
        r"|\b(?:primo|secondo|terzo) piano\b|\b\d\. ?(?:og|ug|kat)\b"
        r"|\b\d/F\b|\bdam,? (?:\w+ )?abutment\b|\u5c4b\u4e0a"
        r"|\b(?:azoteas?|s[oó]tano|techo|tetto|toit|dach|keller)\b",
        re.IGNORECASE | re.MULTILINE,
    ),
}

_BUILT: Final = re.compile(
    r"\bbldg\b|\bbuilding\b|\b\d+[\s-]story\b|\bover(?:crossing|pass)\b|\bviaduct\b|\bbridge\b"
    r"|\binterchange\b",
    re.IGNORECASE,
)
"""Names of stations that are structures, where a network has instruments all over them."""


def of_station(name: str, words: str) -> Position:
    """Return where a channel of a network's array stands: by words about it, else by its station.

    Parameters
    ----------
    name
        Name of the station, which may be that of a building.
    words
        What is said of the channel.
    """
    place = position_of(words)
    if place == "unknown":
        place = position_of(name)
    return "structure" if place == "unknown" and _BUILT.search(name) else place


def position_of(words: str) -> Position:
    """Return where a sensor stands by words about it, or unknown.

    Examples
    --------
    >>> [position_of(words) for words in ("90 Deg Location: Roof", "Downhole 30 m", "HNE")]
    ['structure', 'borehole', 'unknown']
    """
    return next((place for place, named in _PLACES.items() if named.search(words)), "unknown")
