"""Where each public name is defined."""

from .risk.facades.actions import Load as Load
from .risk.facades.actions import PushingMass as PushingMass
from .risk.facades.actions import Thrust as Thrust
from .risk.facades.actions import Tie as Tie
from .risk.facades.facade import Facade as Facade
from .risk.facades.facade_check import FacadeCheck as FacadeCheck
from .risk.facades.facade_check import LimitStateCheck as LimitStateCheck
from .risk.facades.facade_demand import FacadeDemand as FacadeDemand
from .risk.facades.facade_runs import FacadeRuns as FacadeRuns
from .risk.facades.facade_runs import run_facade as run_facade
from .risk.facades.mechanism import Mechanism as Mechanism
from .risk.facades.read_facade import DescribedFacade as DescribedFacade
from .risk.facades.record_demand import RecordDemand as RecordDemand
from .risk.facades.spectrum_table import SpectrumTable as SpectrumTable
from .risk.facades.spectrum_table import read_spectrum_table as read_spectrum_table
from .risk.screens.floors import floor_accelerations as floor_accelerations
from .risk.screens.screen import Screen as Screen
from .risk.screens.screens import Screens as Screens
from .risk.spectra.design_spectrum import DesignSpectrum as DesignSpectrum
from .risk.spectra.design_spectrum import make_design_spectrum as make_design_spectrum
from .risk.spectra.elastic_spectrum import ElasticSpectrum as ElasticSpectrum

__all__: list[str]
