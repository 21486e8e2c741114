"""Where each public name is defined."""

from .seismic.measures.intensity import Measures as Measures
from .seismic.measures.response_spectrum import ResponseSpectrum as ResponseSpectrum
from .seismic.measures.response_spectrum import (
    compute_average_acceleration as compute_average_acceleration,
)
from .seismic.measures.response_spectrum import (
    compute_response_spectrum as compute_response_spectrum,
)
from .seismic.measures.scalar import Measure as Measure
from .seismic.measures.scalar import compute_measure as compute_measure
from .seismic.measures.time_course import IntegratedRecord as IntegratedRecord
from .seismic.measures.time_course import Peak as Peak
from .seismic.measures.time_course import integrate_record as integrate_record
from .seismic.spectra.suite import compute_suite_spectrum as compute_suite_spectrum

__all__: list[str]
