"""Small files in the forms that networks and tools write, with what is true of them.

Headers as they are published, by the names and the order of their lines; numbers and places are our
own.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tests.records.writers import (
    at2,
    cosmos_channel,
    csmip_v2_channel,
    csv,
    esm,
    knet,
    samples,
    smc,
)

Floats = NDArray[np.float64]
COUNT: Final = 400
DT: Final = 0.01
GAL: Final = {name: samples(COUNT, 80.0 + 30.0 * n, seed=n) for n, name in enumerate("NEU")}


@dataclass(frozen=True, kw_only=True)
class Form:
    """A file, where its header ends, and the channels that are true [m/s^2]."""

    text: str
    head: int
    channels: Mapping[str, Floats]
    units: str
    dt_s: float = DT
    orientations: Mapping[str, str] = field(default_factory=dict)

    @property
    def lines(self) -> list[str]:
        """The lines of the file."""
        return self.text.split("\n")


def columns(form: str = "{:12.5f}", time: bool = False, names: str = "NEU") -> str:
    """Return the channels side by side, with times or without."""
    times = [f"{k * DT:10.3f}" * time for k in range(COUNT)]
    rows = zip(*(GAL[name] for name in names), strict=True)
    return "".join(
        at + "".join(form.format(v) for v in row) + "\n"
        for at, row in zip(times, rows, strict=True)
    )


def in_rows(values: Floats, per_line: int = 5, form: str = "{:15.7E}") -> str:
    """Return samples in a row, several a line."""
    cells = [form.format(value) for value in values]
    rows = ["".join(cells[at : at + per_line]) for at in range(0, len(cells), per_line)]
    return "\n".join(rows) + "\n"


THREE: Final = {name: 0.01 * values for name, values in GAL.items()}
WAYS: Final = {"N": "horizontal", "E": "horizontal", "U": "vertical"}


def three(head: str, body: str, names: tuple[str, str, str], order: str = "NEU") -> Form:
    """Return a form with three channels under the names that its file has."""
    named = dict(zip(order, names, strict=True))
    return Form(
        text=head + body,
        head=head.count("\n"),
        channels={named[key]: THREE[key] for key in order},
        units="gal",
        orientations={named[key]: WAYS[key] for key in order},
    )


def one(head: str, name: str, body: str | None = None, units: str = "gal") -> Form:
    """Return a form with the channel N alone."""
    return Form(
        text=head + (in_rows(GAL["N"]) if body is None else body),
        head=head.count("\n"),
        channels={name: THREE["N"]},
        units=units,
        orientations={name: "horizontal"},
    )


CWA: Final = three(
    "#Earthquake Information\n#Origin Time(GMT+08): 2001/01/01-23:50:42\n#Depth(km): 10.0\n"
    "#Station Information\n#StationCode: AAA\n#StartTime(GMT+08): 2001/01/01-23:50:29.000\n"
    "#RecordLength(sec): 4\n#SampleRate(Hz): 100\n#AmplitudeUnit:  gal. DCoffset(corr)\n"
    "#DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n",
    columns(time=True, names="UNE"),
    ("U", "N", "E"),
    order="UNE",
)
NSMN: Final = three(
    "STRONG GROUND MOTION RECORDS OF TURKIYE\nPLACE                   : SOMEWHERE\n"
    "EARTHQUAKE DATE         : 2001/01/01 22:31:09 (GMT)\nEARTHQUAKE DEPTH (km)   : 10.00\n"
    "STATION ID              : 9999\nRECORD TIME             : 01/01/2001 22:30:58.000000 (GMT)\n"
    "NUMBER OF DATA          : 400\nSAMPLING INTERVAL (sec) : 0.01\n"
    f"RAW PGA VALUES (gal)    : (N-S) {abs(GAL['N']).max():.6f} (E-W) {abs(GAL['E']).max():.6f}"
    f" (U-D) {abs(GAL['U']).max():.6f}\n       N-S          E-W          U-D\n",
    columns(),
    ("N-S", "E-W", "U-D"),
)
UNAM: Final = three(
    "ARCHIVO ESTANDAR DE ACELERACION:\nCLAVE DE LA ESTACION                   : AAAA\n"
    "NUMERO DE CANALES                      : 3\n"
    "ORIENTACION C1-C6 (rumbo;orientacion)  : /N00E/N90E/V\n"
    "VEL. DE MUESTREO, C1-C6 (muestras/s)   : /100/100/100\n"
    "ESC. COMPLETA DE SENSORES, C1-C6, (g)  : /2/2/2\n"
    "INTERVALO DE MUESTREO, C1-C6 (s)       : /0.01/0.01/0.01\n"
    "NUM. TOTAL DE MUESTRAS, C1-C6          : /400/400/400\n"
    "UNIDADES DE LOS DATOS                  : Gal (cm/s/s)\n"
    "FACTOR DE DECIMACION                   : 1\n"
    "---------+---------+---------\n   CANAL-1   CANAL-2   CANAL-3\n"
    "      N00E      N90E         V\n---------+---------+---------\n",
    columns(),
    ("N00E", "N90E", "V"),
)
JMA: Final = three(
    " SITE CODE= AAA,\n LAT.=  40.0\n LON.= 140.0\n SAMPLING RATE= 100Hz\n UNIT  = gal(cm/s/s)\n"
    " INITIAL TIME = 2011 03 11 14 46 30\n  NS, EW, UD\n",
    columns("{:.5f},").replace(",\n", "\n"),
    ("NS", "EW", "UD"),
)
ISESD: Final = one(
    "Event Date & Time             : 2001-01-01 01:32:39\n"
    "Station Code / Name           : 9999 / Sometown\nOrientation                   : NS\n"
    "Time Increment (s)            : 0.01\nNumber of Data                : 400\n"
    "Accelaration time series in cm/s/s\n",
    "NS",
)
IRIS: Final = one(
    "TIMESERIES XX_ABCD_00_HNN_M, 400 samples, 100 sps, 2015-01-01T00:00:00.000000, SLIST, FLOAT, "
    "CM/S**2\n",
    "XX_ABCD_00_HNN_M",
    in_rows(GAL["N"], 6, "{:.6e}\t"),
)
USGS: Final = one(
    " SOMETOWN, 1 HIGH ST\n 360 DEGREES\n EARTHQUAKE OF JANUARY 1, 2001 1442 GMT\n"
    " SAMPLES/SEC=100 FILTER TYPE=BUTTERWORTH  CORNER= 0.25 ORDER=4 DATA TYPE=AC\n"
    " NO OF POINTS=   400, UNITS=CM/SEC**2, CM/SEC, AND CM\n",
    "360 DEGREES",
)
_CM: Final = samples(403, 150.0)
_COUNTS: Final = np.rint(1e5 * samples(800)).astype(np.int64)
_GAL_PER_COUNT: Final = 3920 / 6182761
FORMS: Final[dict[str, Form]] = {
    "cwa": CWA,
    "nsmn": NSMN,
    "unam": UNAM,
    "jma": JMA,
    "isesd": ISESD,
    "iris": IRIS,
    "usgs": USGS,
    "peer": Form(
        text=at2(samples(403)),
        head=4,
        channels={"090": 9.80665 * samples(403)},
        units="g",
        orientations={"090": "horizontal"},
    ),
    "esm": Form(
        text=esm(_CM, 0.01),
        head=14,
        channels={"HNE": 0.01 * _CM},
        units="cm/s^2",
        orientations={"HNE": "horizontal"},
    ),
    "knet": Form(
        text=knet(_COUNTS, direction="U-D"),
        head=17,
        channels={"U-D": 0.01 * _GAL_PER_COUNT * (_COUNTS - _COUNTS.mean())},
        units="gal",
        orientations={"U-D": "vertical"},
    ),
    "cosmos": Form(
        text=cosmos_channel(_CM, raw_dt=0.01, azimuth=400),
        head=46,
        channels={"Up": 0.01 * _CM},
        units="cm/s^2",
        orientations={"Up": "vertical"},
    ),
    "csmip": Form(
        text=csmip_v2_channel(_CM, 0.01, name="Up"),
        head=46,
        channels={"Up": 0.01 * _CM},
        units="cm/s^2",
        orientations={"Up": "vertical"},
    ),
    "smc": Form(
        text=smc(_CM, 100.0, angles=(0, 0)).replace("component=    360", "component=     UP"),
        head=30,
        channels={"UP": 0.01 * _CM},
        units="cm/s^2",
        orientations={"UP": "vertical"},
    ),
    "csv": Form(
        text=csv(samples(403)).replace("acc (g)", "acc_ud (g)"),
        head=1,
        channels={"acc_ud": 9.80665 * samples(403)},
        units="g",
        orientations={"acc_ud": "vertical"},
    ),
}
"""A file a format."""
