"""
Does this facade hold?
======================

Left, a facade with a roof load and a tie, and where it leans when it is about to fall. Right, its
capacity curve, with the demand of the code at the limit state of life safety. See
:doc:`/guides/facades`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

roof = rs.codes.Load(name="roof", weight_kn=6.0, x_m=0.3, z_m=5.0)
tie = rs.codes.Tie(name="tie rods", force_kn=3.0, z_m=4.6)
wall = rs.codes.Facade(name="front", thickness_m=0.45, height_m=5.0, loads=(roof,), ties=(tie,))
site = rs.codes.ElasticSpectrum(ag_g=0.2, f0=2.5, tc_star_s=0.35, soil="B")
check = rs.check_facade(wall, rs.codes.FacadeDemand(slv=site))
fig, (left, right) = plt.subplots(1, 2, figsize=(7.36, 4.6), layout="constrained")
rs.plots.facade_section(wall, left)
rs.plots.facade_capacity(check, right)
