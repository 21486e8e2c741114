"""Where each public name is defined."""

from .facades.checks.actions import Load as Load
from .facades.checks.actions import PushingMass as PushingMass
from .facades.checks.actions import Thrust as Thrust
from .facades.checks.actions import Tie as Tie
from .facades.checks.facade import Facade as Facade
from .facades.checks.facade_check import FacadeCheck as FacadeCheck
from .facades.checks.facade_check import LimitStateCheck as LimitStateCheck
from .facades.checks.facade_demand import FacadeDemand as FacadeDemand
from .facades.checks.facade_runs import FacadeRuns as FacadeRuns
from .facades.checks.facade_runs import run_facade as run_facade
from .facades.checks.mechanism import Mechanism as Mechanism
from .facades.checks.read_facade import DescribedFacade as DescribedFacade
from .facades.checks.record_demand import RecordDemand as RecordDemand
from .facades.checks.spectrum_table import SpectrumTable as SpectrumTable
from .facades.checks.spectrum_table import read_spectrum_table as read_spectrum_table
from .risk.screens.floors import floor_accelerations as floor_accelerations
from .risk.screens.screen import Screen as Screen
from .risk.screens.screens import Screens as Screens
from .risk.spectra.design_spectrum import DesignSpectrum as DesignSpectrum
from .risk.spectra.design_spectrum import make_design_spectrum as make_design_spectrum
from .risk.spectra.elastic_spectrum import ElasticSpectrum as ElasticSpectrum

__all__: list[str]
