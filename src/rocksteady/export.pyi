"""Where each public name is defined."""

from .explorer.view import ExplorerView as ExplorerView
from .show.assessment.folder import write_assessment as write_assessment
from .show.assessment.object_report import write_assessment_page as write_assessment_page
from .show.calibration.calibration_folder import write_calibration as write_calibration
from .show.export.components import LossComponent as LossComponent
from .show.export.components import LossState as LossState
from .show.export.dataset import write_dataset as write_dataset
from .show.export.ensemble_rows import write_runs_csv as write_runs_csv
from .show.export.manifest import make_manifest as make_manifest
from .show.export.manifest import write_manifest as write_manifest
from .show.export.openquake import write_openquake as write_openquake
from .show.export.pelicun import write_pelicun as write_pelicun
from .show.export.tests_folder import write_tests as write_tests
from .facades.page.facade_folder import write_facade as write_facade

__all__: list[str]
