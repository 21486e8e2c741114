"""Rocking of free-standing rigid blocks on a shaking base: exact, complete and fast.

This is the flat public namespace. Its stub, `__init__.pyi`, lists where each name is defined; a
name is imported when it is first used, so that ``import rocksteady`` loads no compiled code.
"""

import lazy_loader

from rocksteady.results.gridded import use_describers
from rocksteady.results.result import use_plots

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

# Results lie below the pictures; the namespace, which imports both, connects them.
use_plots(
    {
        "Attractor": "plot_section",
        "AttractorSweep": "plot_bifurcations",
        "BackAnalysis": "plot_back_analysis",
        "BasinShares": "plot_basin_shares",
        "Basins": "plot_basins",
        "BifurcationCurve": "plot_bifurcation_curves",
        "BifurcationCurves": "plot_bifurcation_curves",
        "BifurcationDiagram": "plot_bifurcations",
        "Branch": "plot_bifurcations",
        "Calibration": "plot_ladders",
        "DoublingCascade": "plot_cascade",
        "EdgeState": "plot_edge_state",
        "Erosion": "plot_erosion",
        "FacadeCheck": "plot_capacity",
        "FacadeRuns": "plot_facade_runs",
        "FateBasins": "plot_fate_basins",
        "FatalKicks": "plot_fatal_kicks",
        "Fragility": "plot_fragility",
        "FragilityCurve": "plot_fragility",
        "HilltopSaddle": "plot_edge_state",
        "IntegratedRecord": "plot_integrated_record",
        "Manifold": "plot_manifolds",
        "NoiseFates": "plot_noise_fates",
        "Orbit": "plot_section",
        "OverturningScales": "plot_overturning_scales",
        "OverturningWindows": "plot_overturning",
        "Predictions": "plot_predictions",
        "RegionMap": "plot_regions",
        "ResponseCurve": "plot_response",
        "ResponseSpectrum": "plot_response_spectra",
        "RestingBranch": "plot_bifurcations",
        "RestingBranches": "plot_bifurcations",
        "RestitutionFit": "plot_restitution",
        "Risk": "plot_risk",
        "SteadyOrbit": "plot_orbit",
        "Trajectory": "plot_trajectory",
        "TwoStageCurve": "plot_fragility",
        "attractor map": "plot_map",
        "fate map": "plot_map",
        "rocking spectrum": "plot_rocking_spectrum",
    },
    __getattr__,
)
use_describers(
    {
        "attractor map": ({"kind", "period", "after"}, "rocksteady.dynamics.maps.map_facts"),
        "fate map": ({"fate", "cycles"}, "rocksteady.dynamics.maps.map_facts"),
        "rocking ensemble": (
            {"status", "peak_angle", "uplift_time_s"},
            "rocksteady.risk.ensemble._ensemble_facts",
        ),
        "rocking spectrum": (
            {"status", "peak_angle", "peak_velocity"},
            "rocksteady.seismic.spectra.describe",
        ),
    }
)
