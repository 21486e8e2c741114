"""Remains of a network's header in a file that the network's reader does not recognise.

As a table its counts, or half its header, could pass for samples.
"""

import re
from typing import Final

from rocksteady.records.core.assembling import other_quantity
from rocksteady.records.core.text import RecordText

_WITHIN: Final = 120
"""Lines of words and of numbers that the longest header has before its samples."""

_TRACES: Final = {
    "K-NET or KiK-net": re.compile(
        r"\s*(?:Origin Time|Depth\. \(km\)|Station (?:Code|Lat\.|Long\.|Height\(m\))|Record Time|"
        r"Sampling Freq\(Hz\)|Duration Time\(s\)|Scale Factor .*\(gal\)|Max\. Acc\. \(gal\)|"
        r"Last Correction|Memo\.)\s(?!\s*:)",
        re.IGNORECASE,
    ),
    "ESM, ITACA or AFAD": re.compile(
        r"\s*(?:EVENT_(?:NAME|ID|DATE_\w+|TIME_\w+|LATITUDE\w*|LONGITUDE\w*|DEPTH\w*)|MAGNITUDE_\w+|"
        r"STATION_\w+|NETWORK|VS30_\S*|SITE_CLASS\w*|DATE_TIME_FIRST\w*|SAMPLING_INTERVAL_S|NDATA|"
        r"DURATION_S|STREAM|PGA_\S*|TIME_PGA_S|BASELINE_CORRECTION|FILTER_\w+|\w+_CUT_FREQUENCY_HZ|"
        r"DATABASE_VERSION|HEADER_FORMAT|DATA_(?:TYPE|TIMESTAMP\w*|LICENSE|CITATION|CREATOR)|"
        r"INSTRUMENT\w*|USER\d|ORIGINAL_DATA\w*|EPICENTRAL_DISTANCE_KM)\s*:"
    ),
    "COSMOS": re.compile(
        r".*(?:\(Format v\d|(?:Integer|Real)-header values|\bpts\s*,\s*approx|Rcrdr Chan"
        r"|Comment line\(s\) follow|Values used when parameter|End.of.data for chan)",
        re.IGNORECASE,
    ),
    "CSMIP": re.compile(
        r".*(?:corrected accelerogram|Accelerogram points at|points of \w+ data|instrument- and "
        r"|Units of uncor|CHAN\s+\d+\s*:)",
        re.IGNORECASE,
    ),
    "SMC": re.compile(
        r"(?:\*\s*$|.*(?:-32768\s+-32768|1\.?7\d*E\+38|0\.17\d*E\+39|inst type=.*data source))",
        re.IGNORECASE,
    ),
    "PEER": re.compile(
        r".*(?:PEER NGA|PEER STRONG MOTION|STRONG.MOTION DATABASE RECORD|ACCELERATION TIME "
        r"(?:SERIES|HISTORY) IN UNITS|NPTS\W.*\bDT\b)",
        re.IGNORECASE,
    ),
}
"""A line that files of this network have."""

_SPECTRA: Final = re.compile(
    r"peer\b.*\bspectrum\b|\W*(?:pseudo\W*)?(?:response|fourier)\b.*\bspectr(?:a|um)\b(?!.*(?:compatib|match))",
    re.IGNORECASE,
)


def network_of(text: RecordText) -> tuple[str, int] | None:
    """Return the network of which two different traces stand in a file, and the line of one.

    Parameters
    ----------
    text
        A file that no reader of a network recognises.
    """
    seen: dict[str, set[str]] = {}
    for at, line in enumerate(text.heads[:_WITHIN]):
        for network, trace in _TRACES.items():
            if match := trace.match(line):
                traces = seen.setdefault(network, set())
                traces.add(match[0].strip().lower())
                if len(traces) > 1:
                    return network, at
    return None


def refuse_spectra(text: RecordText) -> None:
    """Raise where the first line is that of a file of spectra.

    Raises
    ------
    RecordFileError
        As above.
    """
    if _SPECTRA.match(text.first) is not None:
        raise other_quantity(text, "spectra", "its first line names another quantity")
