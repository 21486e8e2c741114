"""Files of every format, written from samples by the networks' descriptions of them."""

import numpy as np
from numpy.typing import NDArray

from tests.records import synthetic

Floats = NDArray[np.float64]


def samples(count: int = 403, peak: float = 1.0, seed: int = 1) -> Floats:
    """Return samples that look like a record's."""
    return synthetic(np.random.default_rng(seed), count, 0.01, peak)


def rows(values: Floats, form: str, per_line: int) -> str:
    """Return numbers in lines, each in a Fortran-like form, without anything between them."""
    cells = [form.format(value) for value in values]
    lines = ["".join(cells[at : at + per_line]) for at in range(0, len(cells), per_line)]
    return "\n".join(lines) + "\n"


def at2(
    values: Floats,
    dt: float = 0.01,
    *,
    counts: str = "NPTS= {count:6d}, DT= {dt:.5f} SEC",
    form: str = "{:15.7E}",
    per_line: int = 5,
    quantity: str = "ACCELERATION TIME SERIES IN UNITS OF G",
    component: str = "090",
) -> str:
    """Return a PEER file of values in g."""
    head = (
        "PEER NGA STRONG MOTION DATABASE RECORD\n"
        f"Somewhere-01, 1/17/1994, Hut - Far, West, {component}\n"
        f"{quantity}\n{counts.format(count=len(values), dt=dt)}\n"
    )
    return head + rows(values, form, per_line)


def esm(values: Floats, dt: float = 0.005, *, data_type: str = "ACCELERATION", **keys: str) -> str:
    """Return a file of DYNA's format of values in cm/s^2."""
    stated = {
        "EVENT_NAME": "SOMEWHERE",
        "EVENT_ID": "EM-1",
        "STATION_CODE": "HUT",
        "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS": "20190728_160919.870",
        "SAMPLING_INTERVAL_S": f"{dt:.6f}",
        "NDATA": str(len(values)),
        "STREAM": "HNE",
        "UNITS": "cm/s^2",
        "PGA_CM/S^2": f"{values[np.abs(values).argmax()]:.6f}",
        "DATA_TYPE": data_type,
        "DURATION_S": f"{len(values) * dt:.3f}",
        "TIME_PGA_S": f"{np.abs(values).argmax() * dt:.6f}",
        "USER1": "/somewhere: a program",
        "USER2": "",
        **keys,
    }
    head = "".join(f"{key}: {value}\n" for key, value in stated.items())
    return head + "".join(f"{value:.6f}\n" for value in values)


def knet(
    counts: NDArray[np.int64],
    *,
    rate: int = 100,
    direction: str = "N-S",
    scale: str = "3920(gal)/6182761",
    peak: str = "",
) -> str:
    """Return a file of K-NET or KiK-net."""
    values = {
        "Origin Time": "2018/01/24 19:51:00",
        "Lat.": "41.0",
        "Long.": "142.5",
        "Depth. (km)": "30",
        "Mag.": "6.2",
        "Station Code": "AOM001",
        "Station Lat.": "41.5267",
        "Station Long.": "140.9244",
        "Station Height(m)": "39",
        "Record Time": "2018/01/24 19:51:43",
        "Sampling Freq(Hz)": f"{rate}Hz",
        "Duration Time(s)": str(len(counts) // rate),
        "Dir.": direction,
        "Scale Factor": scale,
        "Max. Acc. (gal)": peak,
        "Last Correction": "2018/01/24 19:51:43",
        "Memo.": "",
    }
    head = "".join(f"{key:<18}{value}\n" for key, value in values.items())
    lines = [counts[at : at + 8] for at in range(0, len(counts), 8)]
    return head + "".join("".join(f"{n:8d} " for n in line) + "\n" for line in lines)


def _block(numbers: Floats, form: str, per_line: int) -> tuple[str, int]:
    text = rows(numbers, form, per_line)
    return text, text.count("\n")


def cosmos_channel(
    values: Floats,
    *,
    dt_ms: float = 10.0,
    raw_dt: float = 0.005,
    azimuth: int = 340,
    quantity: str = "acceleration",
    units: str = "cm/sec2(04)",
    form: tuple[str, str, int] = ("{:10.5f}", "8F10.5", 8),
    first: str = "Corrected acceleration",
    channel: int = 1,
    label: str | None = None,
) -> str:
    """Return one channel of a COSMOS file."""
    whole = np.full(100, -999.0)
    whole[[39, 40, 41, 42, 43, 44, 53]] = [2005, 167, 6, 16, 20, 53, azimuth]
    real = np.full(100, -999.0)
    largest = np.abs(values).argmax()
    real[[29, 33, 61, 63]] = [4.4, raw_dt, dt_ms, values[largest]]
    if dt_ms > 0.0:
        real[64] = largest * dt_ms / 1000.0
    integers, integer_lines = _block(whole, "{:8.0f}", 10)
    reals, real_lines = _block(real, "{:13.6f}", 6)
    seconds = int(len(values) * dt_ms / 1000.0)
    name = {400: "Up", 401: "Down"}.get(azimuth, f"{azimuth} deg")
    return (
        f"{first}    (Format v01.20 with 13 text lines) Src: none\n"
        "Somewhere in the West            June 16,2005 13:53 PDT\n"
        "Hypocenter: 34.0580  -117.0110  H= 12km(SCSN) ML=4.9\n"
        "Origin: 06/16/2005, 20:53:26.1 UTC (SCSN)\n"
        "Statn No: 01-23075  Code:CE-J2236  CDMG Hut & Far\n"
        "Coords: 34.0460 -117.0350  Site Geology:  rock\n"
        "Recorder: SSA-2  s/n 1238 ( 1 Chns of 12  at Sta) Sensor:FBA-11  s/n 1889\n"
        "Rcrd start time:06/16/2005, 20:53:04.400 UTC (Q=2) RcrdId: 23075\n"
        f"Sta Cha:  {channel}: {label or name} (Rcrdr Chan  1) Location: ground\n"
        "Raw record length = 70.000  sec\nProcessed: 06/17/2005\nRecord filtered\n"
        "Values used when parameter or data value is unknown/unspecified:   -999, -999.0\n"
        f" 100 Integer-header values follow on  {integer_lines} lines, Format= (10I8)\n{integers}"
        f" 100 Real-header values follow on  {real_lines} lines, Format= (6F13.6)\n{reals}"
        '  1 Comment line(s) follow, each starting with a "|":\n | comment 12 acceleration pts\n'
        f"   {len(values)}  {quantity} pts, approx   {seconds} secs, units={units},"
        f"Format=({form[1]})\n{rows(values, form[0], form[2])}"
        f"/&  ----------  End of data for channel  {channel}  ----------\n"
    )


def csmip_v2_channel(
    values: Floats, dt: float = 0.005, *, channel: int = 1, name: str = "360 Deg"
) -> str:
    """Return one channel of CSMIP's volume 2: acceleration, velocity and displacement."""
    peak = values[np.abs(values).argmax()]
    at_peak = np.abs(values).argmax() * dt
    count = len(values)
    words = [
        f"Corrected accelerogram   89146-L2500       Chan  {channel}: {name}     from",
        "Uncorrected Accelerogram Data             Processed: 02/13/12, CGS",
        "Record of Mon Feb 13, 2012 13:06:45.0 PST             (Avol1 v9.2,12/11 CSMIP)",
        "CSMIP Preliminary Processing            (Origin:  To be determined)",
        "89146-L2500-12044.02                 Start time:  2/13/12, 21:06:45.0 UTC (GPS)",
        "Station No. 89146   40.941N, 123.633W      Etna  s/n 2500  (3 Chns of  3 at Sta)",
        "Hut                                       CGS",
        f"Chan  {channel}: {name}",
        *(["-"] * 7),
        f" {count} points of instrument- and baseline-corrected accel, veloc and displ data",
        f"At equally-spaced intervals of    {dt:.3f}  sec.",
        f"Peak acceleration =  {peak:10.3f}    cm/sec/sec  at   {at_peak:.3f}   sec.",
        *(["-"] * 7),
    ]
    numbers = rows(np.arange(100.0), "{:5.0f}", 16) + rows(np.zeros(100), "{:10.6f}", 8)
    blocks = "".join(
        f" {count} points of {word} data equally spaced at  {dt:.3f} sec, in {unit}. (8f10.6)\n"
        + rows(factor * values, "{:10.5f}", 8)
        for word, unit, factor in (
            ("accel", "cm/sec2", 1.0),
            ("veloc", "cm/sec", 0.1),
            ("displ", "cm", 0.01),
        )
    )
    end = f"/&  ----------  End of data for channel  {channel}  ----------\n"
    return "\n".join(words) + "\n" + numbers + blocks + end


def smc(
    values: Floats,
    rate: float | None = 200.0,
    *,
    first: str = "2 CORRECTED ACCELEROGRAM",
    comments: int = 3,
    angles: tuple[int, int] = (90, 360),
) -> str:
    """Return an SMC file of values in cm/s^2."""
    missing, blank = -32768, 1.7e38
    whole = np.full(48, missing)
    whole[:8] = [missing, 1989, 291, 17, 4, 5, 250, 111]
    whole[[12, 13, 15, 16]] = [*angles, comments, len(values)]
    real = np.full(50, blank)
    real[1] = blank if rate is None else rate
    of_motion = values if rate is not None else values[1::2]
    real[[29, 31]] = [of_motion.max(), of_motion.min()]
    if rate is not None:
        real[[28, 30]] = [of_motion.argmax() / rate, of_motion.argmin() / rate]
    words = [
        first,
        "*",
        "HUT1",
        "     1989  10  18    1704 Somewhere, CA",
        "Moment Mag=      7.1",
        "station = Hut, 1295 Shafter        component=    360",
        "epicentral dist =     89.0       pk     =    104.4",
        "inst type=SMA-1      data source = USGS",
        "*",
        "*",
        "*",
    ]
    cells = []
    for value in values:
        mantissa, exponent = f"{value:.4E}".split("E")
        cells.append(f"{mantissa:>7}E{int(exponent):+d}")
    data = "\n".join("".join(cells[at : at + 8]) for at in range(0, len(cells), 8))
    return (
        "\n".join(f"{word:<80}" for word in words)
        + "\n"
        + rows(whole.astype(float), "{:10.0f}", 8)
        + rows(real, "{:15.7E}", 5)
        + "| 12.5 of comment\n" * comments
        + data
        + "\n"
    )


def csv(values: Floats, dt: float = 0.01) -> str:
    """Return a table of times and accelerations in g."""
    lines = [f"{at * dt:.4f},{value:.6f}" for at, value in enumerate(values)]
    return "time (s),acc (g)\n" + "\n".join(lines) + "\n"
