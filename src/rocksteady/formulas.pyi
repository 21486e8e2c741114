"""Where each public name is defined."""

from .dynamics.overturning.free_rocking import equivalent_damping as equivalent_damping
from .dynamics.overturning.free_rocking import free_rocking_peaks as free_rocking_peaks
from .dynamics.overturning.free_rocking import free_rocking_period as free_rocking_period
from .dynamics.overturning.thresholds import overturning_amplitude as overturning_amplitude
from .dynamics.overturning.thresholds import overturning_impulse as overturning_impulse
from .dynamics.steady.regions import heteroclinic_amplitude as heteroclinic_amplitude
from .dynamics.steady.regions import melnikov_amplitude as melnikov_amplitude
from .dynamics.steady.regions import symmetry_breaking_amplitude as symmetry_breaking_amplitude
from .dynamics.steady.regions import symmetry_breaking_frequencies as symmetry_breaking_frequencies
from .dynamics.steady.states import steady_states as steady_states
from .model.blocks.outlines import Outline as Outline
from .model.blocks.sides import Side as Side
from .model.blocks.sides import housner_restitution as housner_restitution
from .model.blocks.sides import impact_restitution as impact_restitution

__all__: list[str]
