"""Rocking of free-standing rigid blocks on a shaking base: exact, complete and fast.

The names that one begins with stand here, all others in public modules beside and below: what a
run returns in `rocksteady.histories`, pictures in `rocksteady.plots`. The stubs, as `__init__.pyi`,
list where each name is defined; a name is imported when it is first used, so that
``import rocksteady`` loads no compiled code.
"""

import lazy_loader

from rocksteady.results.result import use_plots, use_words

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

# Results lie below the pictures; the namespace, which imports both, connects them.
use_plots(
    {
        "Assessment": "assessment",
        "Attractor": "poincare_section",
        "AttractorSweep": "bifurcations",
        "Attractors": "attractor_kinds",
        "BackAnalysis": "back_analysis",
        "BasinAttractor": "poincare_section",
        "BasinEntropies": "basin_entropies",
        "BasinFamily": "poincare_section",
        "BasinShares": "basin_shares",
        "Basins": "basins",
        "BifurcationCurve": "bifurcation_curves",
        "BifurcationCurves": "bifurcation_curves",
        "BifurcationDiagram": "bifurcations",
        "Block": "block",
        "Branch": "bifurcations",
        "Calibration": "test_ladders",
        "DimensionlessBlock": "block",
        "Cascade": "cascade",
        "EdgeState": "edge_state",
        "Erosion": "erosion",
        "FacadeCheck": "facade_capacity",
        "DescribedFacade": "facade_section",
        "DescribedObject": "block",
        "FacadeRuns": "facade_runs",
        "FateBasins": "fate_basins",
        "FatalKicks": "fatal_kicks",
        "Fragility": "fragility",
        "FragilityCurve": "fragility",
        "HazardCurve": "hazard_curve",
        "HilltopSaddle": "edge_state",
        "IntegratedRecord": "integrated_record",
        "Manifold": "manifolds",
        "Measures": "integrated_record",
        "Mechanism": "facade_capacity",
        "Neighbours": "neighbours",
        "NoiseFates": "noise_fates",
        "ObjectFacts": "block",
        "ObjectPrior": "block",
        "ObjectsTable": "objects",
        "Observations": "survey",
        "Orbit": "poincare_section",
        "OverturningScales": "overturning_scales",
        "OverturningWindows": "overturning",
        "Predictions": "predictions",
        "ProvedRegion": "proved_region",
        "RecordSet": "channels",
        "RegionBoundaries": "steady_regions",
        "RegionMap": "steady_regions",
        "ResponseCurve": "response",
        "ResponseSpectrum": "response_spectra",
        "RestingBranch": "bifurcations",
        "RestingBranches": "bifurcations",
        "RestitutionFit": "restitution",
        "Risk": "risk",
        "Screens": "screens",
        "StateFragility": "fragility",
        "SteadyOrbit": "steady_orbit",
        "SteadyStates": "steady_states",
        "Survey": "survey",
        "Trajectory": "trajectory",
        "UncertaintyExponent": "uncertainty",
        "attractor map": "outcomes",
        "fate map": "outcomes",
        "rocking spectrum": "rocking_spectrum",
    }
    | dict.fromkeys(
        (
            "BandNoise",
            "BaseMotion",
            "FourierSeries",
            "Harmonic",
            "Impulses",
            "Piecewise",
            "Pulse",
            "Record",
            "Recording",
            "Still",
            "SyntheticMotion",
        ),
        "base",
    )
    | dict.fromkeys(("BasinEntropy", "BasinShare", "BoundaryCheck", "FateShare"), "rows")
    | dict.fromkeys(("HazardBranchCheck", "Installation", "IntegrityDrop", "Screen"), "rows"),
    lambda name: getattr(__getattr__("plots"), name),
)
use_words(
    {
        "rocksteady.certify.proof_words": ("Certificate", "CheckedCertificate", "ProvedRegion"),
        "rocksteady.facades.check_words": (
            *("DescribedFacade", "FacadeCheck", "FacadeRuns", "Mechanism"),
        ),
        "rocksteady.words.assessment": ("Assessment",),
        "rocksteady.words.attractors": ("Attractor", "AttractorSweep", "Attractors"),
        "rocksteady.words.back_analysis": ("BackAnalysis", "Survey"),
        "rocksteady.words.basin_measures": (
            *("BasinEntropies", "BasinEntropy", "BoundaryCheck", "UncertaintyExponent"),
        ),
        "rocksteady.words.basin_shares": ("BasinFamily", "BasinShares"),
        "rocksteady.words.basins": ("BasinAttractor", "BasinShare", "Basins"),
        "rocksteady.words.bifurcation_curves": ("BifurcationCurve", "BifurcationCurves"),
        "rocksteady.words.blocks": ("Block", "DimensionlessBlock"),
        "rocksteady.words.branches": ("Branch", "BranchPoint", "Cascade"),
        "rocksteady.words.calibration": ("Calibration", "Posterior", "StoredPosterior"),
        "rocksteady.words.diagrams": ("Bifurcation", "BifurcationDiagram"),
        "rocksteady.words.edges": ("EdgeState", "HilltopSaddle", "Manifold"),
        "rocksteady.words.fragility": ("Fragility", "FragilityCurve", "StateFragility"),
        "rocksteady.words.gridded": ("Gridded",),
        "rocksteady.words.hazard": ("HazardBranchCheck", "HazardCurve", "Risk"),
        "rocksteady.words.installation": ("Installation",),
        "rocksteady.words.kicks": ("FatalKicks",),
        "rocksteady.words.motions": ("DescribedMotion",),
        "rocksteady.words.neighbours": ("Neighbours",),
        "rocksteady.words.noise_fates": ("NoiseFates",),
        "rocksteady.words.objects": ("DescribedObject", "FormulaAssessment", "ObjectFacts"),
        "rocksteady.words.objects_table": ("ObjectsTable",),
        "rocksteady.words.observations": ("ObjectPrior", "Observations", "Prior"),
        "rocksteady.words.orbits": ("Orbit",),
        "rocksteady.words.overturning": ("OverturningWindows",),
        "rocksteady.words.overturning_scales": ("OverturningScales",),
        "rocksteady.words.predictions": ("Predictions", "Scores", "Validation"),
        "rocksteady.words.records": ("IntegratedRecord", "Measures", "ResponseSpectrum"),
        "rocksteady.words.recordings": ("RecordSet", "Recording"),
        "rocksteady.words.resting": ("RestingBranch", "RestingBranches", "RestingPoint"),
        "rocksteady.words.restitution": ("RestitutionFit",),
        "rocksteady.words.safe_basins": ("Erosion", "FateBasins", "FateShare", "IntegrityDrop"),
        "rocksteady.words.screens": ("Screen", "Screens"),
        "rocksteady.words.steady": (
            *("RegionBoundaries", "RegionMap", "ResponseCurve", "SteadyOrbit", "SteadyStates"),
        ),
        "rocksteady.words.trajectory": ("Trajectory",),
    }
)
