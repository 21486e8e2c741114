"""Where each public name is defined."""

from .dynamics.maps.noise_fates import NoiseFates as NoiseFates
from .dynamics.overturning.kicks import FatalKicks as FatalKicks
from .dynamics.overturning.window_lists import OverturningWindow as OverturningWindow
from .dynamics.overturning.windows import OverturningWindows as OverturningWindows
from .seismic.spectra.overturning_scales import OverturningScales as OverturningScales

__all__: list[str]
