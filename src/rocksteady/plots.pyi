"""Where each public name is defined."""

from .show.film.animation import animate as animate
from .show.film.still import plot_block as block
from .show.plots.attractor_kinds import plot_attractor_kinds as attractor_kinds
from .show.plots.channels import plot_channels as channels
from .show.plots.branches.bifurcations import plot_bifurcations as bifurcations
from .show.plots.branches.cascades import plot_cascade as cascade
from .show.plots.branches.curves import plot_bifurcation_curves as bifurcation_curves
from .facades.plots.capacity import plot_facade_capacity as facade_capacity
from .facades.plots.run_displacements import plot_facade_runs as facade_runs
from .facades.plots.section import plot_facade_section as facade_section
from .show.plots.maps import plot_outcomes as outcomes
from .show.plots.motion import plot_base as base
from .show.plots.motion import plot_phase_portrait as phase_portrait
from .show.plots.motion import plot_trajectory as trajectory
from .show.plots.neighbours import plot_neighbours as neighbours
from .show.plots.observations.back_analysis import plot_back_analysis as back_analysis
from .show.plots.observations.ladders import plot_test_ladders as test_ladders
from .show.plots.observations.posteriors import plot_posterior as posterior
from .show.plots.observations.predictions import plot_predictions as predictions
from .show.plots.observations.reliability import plot_reliability as reliability
from .show.plots.observations.residuals import plot_residuals as residuals
from .show.plots.observations.restitution import plot_restitution as restitution
from .show.plots.observations.scores import plot_learning as learning
from .show.plots.observations.survey import plot_survey as survey
from .show.plots.orbits import plot_multipliers as multipliers
from .show.plots.orbits import plot_poincare_section as poincare_section
from .show.plots.overturning import plot_free_rocking as free_rocking
from .show.plots.overturning import plot_overturning as overturning
from .show.plots.overturning_noise import plot_noise_fates as noise_fates
from .show.plots.overturning_scales import plot_fatal_kicks as fatal_kicks
from .show.plots.overturning_scales import plot_overturning_scales as overturning_scales
from .show.plots.portraits.basins import plot_basins as basins
from .show.plots.portraits.basins import plot_erosion as erosion
from .show.plots.portraits.basins import plot_safe_basin as safe_basin
from .show.plots.portraits.edges import plot_edge_state as edge_state
from .show.plots.portraits.entropies import plot_basin_entropies as basin_entropies
from .show.plots.portraits.entropies import plot_uncertainty as uncertainty
from .show.plots.portraits.fate_basins import plot_fate_basins as fate_basins
from .show.plots.portraits.manifolds import plot_manifolds as manifolds
from .show.plots.portraits.shares import plot_basin_shares as basin_shares
from .certify.plots import plot_proved_region as proved_region
from .show.plots.records import plot_husid as husid
from .show.plots.records import plot_integrated_record as integrated_record
from .show.plots.records import plot_response_spectra as response_spectra
from .show.plots.risk.assessment import plot_assessment as assessment
from .show.plots.risk.floor_spectra import plot_floor_spectra as floor_spectra
from .show.plots.risk.fragility import plot_fragility as fragility
from .show.plots.risk.hazard import plot_risk as risk
from .show.plots.risk.hazard_curve import plot_hazard_curve as hazard_curve
from .show.plots.risk.objects import plot_objects as objects
from .show.plots.risk.placed_spectra import plot_placed_spectra as placed_spectra
from .show.plots.risk.plan import plot_plan as plan
from .show.plots.risk.screens import plot_screens as screens
from .show.plots.risk.tornado import plot_tornado as tornado
from .show.plots.value_rows import plot_rows as rows
from .show.plots.spectra import plot_rocking_spectrum as rocking_spectrum
from .show.plots.spectra import plot_share_that_falls as share_that_falls
from .show.plots.spectra import plot_spectrum_map as spectrum_map
from .show.plots.spectra import plot_suite_spectrum as suite_spectrum
from .show.plots.steady import plot_response as response
from .show.plots.steady import plot_steady_orbit as steady_orbit
from .show.plots.steady import plot_steady_regions as steady_regions
from .show.plots.steady_states import plot_steady_states as steady_states

__all__ = [
    "animate",
    "assessment",
    "attractor_kinds",
    "back_analysis",
    "base",
    "basin_entropies",
    "basin_shares",
    "basins",
    "bifurcation_curves",
    "bifurcations",
    "block",
    "cascade",
    "channels",
    "edge_state",
    "erosion",
    "facade_capacity",
    "facade_runs",
    "facade_section",
    "fatal_kicks",
    "fate_basins",
    "floor_spectra",
    "fragility",
    "free_rocking",
    "hazard_curve",
    "husid",
    "integrated_record",
    "learning",
    "manifolds",
    "multipliers",
    "neighbours",
    "noise_fates",
    "objects",
    "outcomes",
    "overturning",
    "overturning_scales",
    "phase_portrait",
    "placed_spectra",
    "plan",
    "poincare_section",
    "posterior",
    "predictions",
    "proved_region",
    "reliability",
    "residuals",
    "response",
    "response_spectra",
    "restitution",
    "risk",
    "rocking_spectrum",
    "rows",
    "safe_basin",
    "screens",
    "share_that_falls",
    "spectrum_map",
    "steady_orbit",
    "steady_regions",
    "steady_states",
    "suite_spectrum",
    "survey",
    "test_ladders",
    "tornado",
    "trajectory",
    "uncertainty",
]
