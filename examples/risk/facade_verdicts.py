"""
Where do the checks of a facade disagree?
=========================================

Bare walls over slenderness and height, under ten synthetic records scaled to 0.25 g. Letters name
the checks of SLV that accept a wall: linear (L), nonlinear static (S), dynamic (D). See
:doc:`/guides/facades`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

suite = rs.motions.make_synthetic_suite(10)
records = [each.scaled(0.25 * 9.80665 / each.peak_acceleration_m_s2) for each in suite]
demand = rs.codes.FacadeDemand(slv=rs.codes.RecordDemand(records=records))
heights, slenderness = range(2, 13, 2), range(5, 26, 2)
fig, ax = plt.subplots()
for h in heights:
    for ratio in slenderness:
        size = {"thickness_m": h / ratio, "height_m": h}
        wall = rs.codes.Facade(name="wall", **size, confidence_factor=1.0)
        checks = rs.check_facade(wall, demand, runs=rs.codes.run_facade(wall, records)).checks
        letters = [each.method.split()[-1][0].upper() for each in checks if each.satisfied]
        ax.text(ratio, h, "".join(letters) or "\N{EN DASH}", ha="center", va="center")
ax.grid(visible=False)
ax.set(xlim=(4, 26), ylim=(1, 13), xticks=slenderness, yticks=heights)
ax.set(xlabel="height / thickness", ylabel="height [m]", title="Checks that accept, by letter")
