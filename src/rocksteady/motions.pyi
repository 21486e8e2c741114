"""Where each public name is defined."""

from .model.motions.band_noise import BandNoise as BandNoise
from .model.motions.band_noise import add_noise as add_noise
from .model.motions.combine import add as add
from .model.motions.combine import cut as cut
from .model.motions.combine import delay as delay
from .model.motions.combine import join as join
from .model.motions.combine import scale as scale
from .model.motions.floor import Floor as Floor
from .model.motions.fourier import FourierSeries as FourierSeries
from .model.motions.impulses import Impulses as Impulses
from .model.motions.segments import Segment as Segment
from .model.motions.synthetic_suite import make_synthetic_suite as make_synthetic_suite
from .risk.counted.suite import place_on_spectrum as place_on_spectrum

__all__: list[str]
