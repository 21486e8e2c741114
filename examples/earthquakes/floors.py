"""
Which floor is the worst?
=========================

Objects in a museum of 0.35 s, at 0.2 g of the ground, in the colours of the probability of falling;
on the right what the roof does to a component, and three codes. The motions are synthetic. See
:doc:`/how-to/floors`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

suite = rs.motions.make_synthetic_suite(12)
museum = rs.risk.Building.of_first_mode("museum", storeys=3, period_s=0.35)
objects = [
    rs.risk.DescribedObject(
        values={"name": f"{name}, {floor}", "floor": floor, "geometry": geometry}
    )
    for name, width, height in (("stele", 0.3, 1.6), ("vase", 0.16, 0.5), ("case", 0.7, 1.9))
    for geometry in [{"width_m": width, "height_m": height}]
    for floor in (0, 2, 3)
]
peaks = rs.risk.Peaks(pga_g=0.2, pgv_m_s=0.2)
table = rs.assess_objects(objects, suite, buildings=[museum], demand=peaks)
roof = [museum.floor(3).motion(ground) for ground in suite]
_, (left, right) = plt.subplots(1, 2, layout="constrained", figsize=(9.0, 4.0))
rs.plots.plan(table, left)
rs.plots.floor_spectra(roof, right, building_period_s=0.35, height_ratio=1.0)
