"""English words of the pages and plots of facades."""

from typing import Final

from rocksteady.facades.checks.remark import TEMPLATES

ENGLISH: Final[dict[str, str]] = {
    "and": "and",
    # Plots
    "wall": "wall",
    "parapet": "parapet",
    "pinnacle": "pinnacle",
    "gable": "gable",
    "the_wall": "the wall",
    "the_parapet": "the parapet",
    "the_pinnacle": "the pinnacle",
    "the_gable": "the gable",
    "hinge": "hinge",
    "axis_position": "position [m]",
    "axis_height": "height above the hinge [m]",
    "axis_displacement": "displacement d [mm]",
    "axis_acceleration": "spectral acceleration a [g]",
    "axis_share": "largest displacement d/d₀",
    "capacity_curve": "capacity a(d)",
    "period_of": "{symbol} = {period}",
    "spectrum_of": "{state} spectrum, {damping} %",
    "demand_static": "static demand {state}",
    "demand_dynamic": "mean of runs {state}",
    "demand_linear": "linear demand {state}",
    "capacity_linear": "capacity of the linear checks",
    "mean_largest": "mean {share}",
    "sign_as recorded": "as recorded",
    "sign_reversed": "reversed",
    # Frame of the page
    "lang": "en-GB",
    "skip": "To the content",
    "contents": "Contents",
    "kicker": "Rocksteady · Facade checked with Circolare 2019 n. 7, C8.7.1",
    "title": "{name}: are the checks satisfied?",
    "footer": (
        "Implements published equations; the engineer verifies. No statement of compliance with "
        "any code."
    ),
    # Verdicts
    "satisfied": "satisfied",
    "not_satisfied": "not satisfied",
    "no_verdict": "no verdict",
    "differ": "methods disagree",
    "SLD": "damage limitation SLD",
    "SLV": "life safety SLV",
    "SLC": "collapse SLC",
    "method_linear": "linear kinematic analysis",
    "method_nonlinear static": "nonlinear kinematic analysis",
    "method_dynamic": "nonlinear dynamic analysis",
    "headline_all": "Every check with a demand is satisfied.",
    "headline_one": "1 of {all} checks is not satisfied.",
    "headline_some": "{failed} of {all} checks are not satisfied.",
    "headline_no": "No check is satisfied.",
    "sentence_holds": "{state}: satisfied with the {methods}.",
    "sentence_fails": "{state}: not satisfied with the {methods}.",
    "sentence_differs": "{state}: satisfied with the {passed}, not with the {failed}.",
    "sentence_none": (
        "No check: neither a demand nor records are given. The capacity of the linear checks is "
        "{linear}, and the displacement of zero capacity d₀ = {d0}."
    ),
    "why_agree": "All methods agree.",
    "why_nothing": "Give a demand, or 7 records or more, for a verdict.",
    # Table of checks
    "checks_caption": ("Each check with its formula. † Not checked against the printed standard."),
    "col_state": "limit state",
    "col_method": "method",
    "col_formula": "formula, page",
    "col_quantity": "quantity",
    "col_demand": "demand",
    "col_capacity": "capacity",
    "col_ratio": "ratio",
    "col_verdict": "check",
    "pages": "pp. {page}",
    "quantity_linear": "spectral acceleration {demand} ≤ {capacity}",
    "quantity_nonlinear static": "spectral displacement {demand} ≤ {capacity}",
    "quantity_dynamic": "no run beyond d₀, mean of largest d ≤ {capacity}",
    "beyond_all": "beyond d₀",
    # Pictures
    "alt_section": (
        "Section of {the}, {thickness} thick and {height} high, with its hinge {inset} from "
        "the outer face, {loads} loads, {masses} pushing masses, {ties} ties and {thrusts} thrusts."
    ),
    "alt_capacity": (
        "Capacity over displacement, from {a0} at zero to zero at {d0}, with the limits {slv} of "
        "SLV and {slc} of SLC{drops}{demands}."
    ),
    "alt_demand": "{state} {demand}",
    "alt_drops": "; it changes where actions end, at {places}",
    "alt_demands": "; demands: {demands}",
    "alt_runs": (
        "Largest displacement over d₀ of {records} records and {signs} signs; {beyond} records go "
        "beyond d₀; {mean}."
    ),
    "alt_mean": "the mean is {mean}",
    "alt_no_mean": "there is no mean",
    "capacity_note": (
        "Section to scale; the dashed outline leans by 5° for illustration. A line through the "
        "origin is a period; a square or diamond left of its limit satisfies it. Arrows at the "
        "edge mark values beyond the picture."
    ),
    # Sections
    "section_why": "Reasons and remarks",
    "section_runs": "Records",
    "section_wall": "The wall",
    "section_parapet": "The parapet",
    "section_pinnacle": "The pinnacle",
    "section_gable": "The gable",
    "section_mechanism": "The mechanism",
    "section_demand": "Demand",
    "section_method": "Method",
    "section_limits": "Assumptions and limits",
    "section_inputs": "Inputs",
    # Notes
    "mind_linear": "The runs use the linear equations, which hold for small rotations.",
    "remarks_caption": "How each demand is obtained",
    # The facade
    "fact_kind": "kind",
    "fact_thickness": "thickness",
    "fact_height": "height above the hinge",
    "fact_length": "length",
    "fact_base": "length of the base",
    "fact_unit_weight": "unit weight",
    "fact_weight": "weight",
    "fact_hinge": "hinge, from the outer face",
    "fact_z": "height of the hinge above the ground z",
    "fact_modulus": "elastic modulus E",
    "fact_free": "vibration",
    "free": "free to vibrate (C8.7.1.9)",
    "bound": "bound to the building",
    "fact_fc": "confidence factor FC",
    "fact_level": "knowledge level {level}",
    "fact_sides": "rocking",
    "one_sided": "one-sided: the building behind stops it",
    "two_sided": "two-sided: it rocks to both sides",
    "fact_restitution": "coefficient of restitution",
    "housner": "from conservation of angular momentum",
    "facade_caption": "Geometry and material",
    "acting_caption": (
        "Actions on the whole length; x inwards from the outer face, z above the hinge."
    ),
    "col_name": "name",
    "col_kind": "kind",
    "col_force": "force",
    "col_end": "up to collapse",
    "end_counts": "counted",
    "end_not": "not counted",
    "end_at": "to d = {place}",
    "kind_load": "vertical load, moves with it",
    "kind_mass": "mass, pushes in an earthquake only",
    "kind_tie": "tie, pulls inwards",
    "kind_thrust": "thrust, pushes outwards",
    # The mechanism
    "mechanism_caption": (
        "Quantities from geometry and weights. † Not checked against the printed standard."
    ),
    "col_symbol": "symbol",
    "col_meaning": "meaning",
    "col_value": "value",
    "col_source": "from",
    "m_alpha0": "activation multiplier",
    "m_e_star": "participating mass fraction, mass spread",
    "m_e_lumped": "participating mass fraction, mass at the centres",
    "m_linear": "capacity of the linear checks",
    "m_t0": "period of elastic vibration",
    "m_arm": "height of the displacement d",
    "m_mass": "participating mass",
    "m_a0": "activation acceleration, mass spread",
    "m_a0_lumped": "the same, mass at the centres",
    "m_d0": "displacement of zero capacity",
    "m_dslv": "displacement capacity of SLV, 0.4 d₀",
    "m_dslc": "displacement capacity of SLC, 0.6 d₀",
    "m_tslv": "secant period of SLV",
    "m_tslc": "secant period of SLC",
    "m_theta0": "rotation of zero restoring moment, slenderness of the block",
    "m_p": "frequency parameter, with FC",
    "m_lambda": "factor of the ground acceleration, with FC",
    "m_uplift": "uplift acceleration, with all that acts at rest",
    "m_run": "activation acceleration of the runs, with FC",
    "m_fc": "confidence factor",
    "equivalent": "equivalent block",
    # Demand
    "demand_none": "No demand is given.",
    "demand_caption": "Demand of each limit state",
    "demand_spectrum": ("NTC 2018 elastic spectrum: a_g {ag}, F₀ {f0}, T_C* {tc}, S {s}, C_C {cc}"),
    "demand_table": "table of {count} periods, {low} to {high}, damping {damping} %",
    "demand_records": "{count} records, mean of their spectra",
    # Records
    "runs_intro": (
        "{records} records, {signs}: {the} is a rigid block that rocks outwards only, and the "
        "motion is followed to rest or to a fall. Of each record the larger displacement "
        "counts."
    ),
    "runs_intro_two_sided": (
        "{records} records, {signs}: {the} is a rigid block that rocks to both sides, and the "
        "motion is followed to rest or to a fall. Of each record the larger displacement "
        "counts."
    ),
    "signs_2": "both signs",
    "signs_1": "one sign",
    "runs_caption": "Largest displacement of each record, for each sign that was run.",
    "col_record": "record",
    "col_pga": "PGA",
    "col_scale": "factor",
    "col_largest": "larger/d₀",
    "status_at-rest": "at rest",
    "status_rocking": "rocking",
    "status_overturned": "falls",
    "status_lost-contact": "lost contact",
    "status_undecided": "undecided",
    "beyond": "beyond d₀",
    "still": "does not lift",
    "vertical": "with vertical",
    "mean_row": "mean",
    "runs_note": "A bar with an arrow goes beyond d₀.",
    # Method
    "method_1_name": "Kinematic analysis.",
    "method_1": (
        "{The} turns outwards about its hinge. With weights P that move with it, masses Q that "
        "push it, ties T and thrusts H, the stabilising moment is M = ΣP(x − x_h) + ΣTz − ΣHz and "
        "the overturning moment at α = 1 is D = Σ(P + Q)z: α₀ = M/D (1)†. With "
        "e* = D²/(Σ(P + Q) Σ(P + Q)z²) (5)†, a₀ = α₀ g/(e* FC) (3)†, and the capacity falls "
        "linearly to zero at d₀ = z_d M/ΣPz, z_d = Σ(P + Q)z²/D. α₀ counts all that acts at rest; "
        "d₀ counts what is verified to act up to collapse (C8.7.1.2.1.6)†."
    ),
    "method_2_name": "Linear check.",
    "method_2": (
        "SLD: the peak acceleration at the base S_e(0) is at most min a₀ (8)†. SLV: S_e(0) divided "
        "by the behaviour factor q = 2 is at most min a₀†. min a₀ is the smaller of two: with the "
        "mass spread over each body, and with the mass at its centre. An element free to vibrate: "
        "S_e(T₀, z) with 5 % damping is at most α₀ g/FC for both, T₀ = 6.2 (L/t) L √(W/(g E)) (9)†."
    ),
    "method_3_name": "Nonlinear static check.",
    "method_3": (
        "T_SLV = 1.68 π √(d_SLV/a(d_SLV)) (10)†, T_SLC = 1.56 π √(d_SLC/a(d_SLC)) (11)†. The "
        "demand is S_D(T) = S_e(T) T²/(4π²) (12)†, with a damping of 8 % for SLV and 10 % for SLC."
    ),
    "method_4_name": "Dynamic check.",
    "method_4": (
        "No run goes beyond d₀, and the mean over 7 records or more of the largest displacements "
        "is at most d_SLV or d_SLC (C8.7.1.2.1.9)†. Between impacts a run solves "
        "θ″ = −p² [sin(θ₀ − θ) − λ (a/g) cos(θ₀ − θ)] with p² = g √(M² + K²)/(I FC), λ = FC D/K, "
        "K = ΣPz, θ₀ = atan(M/K), and d = z_d (M/K) θ/θ₀: a rigid block, not an "
        "oscillator. What ends and holds is left out from the beginning; what ends and does not "
        "hold acts throughout."
    ),
    # Assumptions
    "assumed": "Assumed",
    "assumed_bullets": (
        "d_SLV = 0.4 d₀ and d_SLC = 0.6 d₀ alone: the second condition on each could not be "
        "read, and the limits may be smaller†."
    ),
    "assumed_t0": (
        "With records the largest spectral displacement is taken from period 0 to T_SLV or "
        "T_SLC: the lower end T₀ could not be read†. The demand is never smaller for it."
    ),
    "assumed_mean": (
        "Records represent the site and the limit state; the mean of the largest displacements "
        "needs 7 of them. One run beyond d₀ fails the check, whatever the mean."
    ),
    "assumed_fc": (
        "FC divides the stabilising moment in the runs too: {the} lifts at 1/FC of the "
        "acceleration and returns more slowly."
    ),
    "assumed_block": (
        "The equivalent block is exact where all masses lie in line with the hinge and nothing "
        "else acts; with ties, thrusts and pushing masses it is accurate to the order of θ²."
    ),
    "assumed_balance": "A run beyond d₀ counts as a fall, even where {the} comes back.",
    "assumed_restitution": (
        "The coefficient of restitution is a choice: measured values of masonry scatter, and a "
        "larger one takes less from the motion at each impact."
    ),
    "not_covered": "Not covered",
    "not_rigid": (
        "One rigid, monolithic body: a wall of leaves without bond falls apart before it turns."
    ),
    "not_crushing": "No crushing of the masonry at the hinge beyond the given inset.",
    "not_sliding": "No sliding of {the} or of its loads.",
    "not_diaphragm": (
        "No flexible floors, roofs or diaphragms: loads keep their weight, and the building behind "
        "does not move relative to the ground."
    ),
    "not_ties": (
        "Ties pull with a constant force until they end: no stretching, no yielding, no pull-out."
    ),
    "not_corners": "No bond with cross walls and no friction against them.",
    "not_height": (
        "No amplification over the height of the building, unless the demand is a floor spectrum "
        "or the records are those of a floor."
    ),
    # Inputs
    "inputs_files": "Files that were read, with the SHA-256 of their bytes.",
    "inputs_file": "file",
    "inputs_command": "Command that makes this page again, with the same files:",
    "inputs_motions": "Records, with the first 16 digits of the SHA-256 of their samples.",
    "inputs_made": "Made by rocksteady {version} (kernels {kernels}, NumPy {numpy}).",
    # Remarks of the checks
    **{f"remark_{key}": text for key, text in TEMPLATES.items()},
}
