"""
Which floor is the worst?
=========================

Six objects on three floors of a museum of 0.35 s, at 0.2 g of the ground: the colours are the
probability of falling. On the right, what the roof does to a component, and what three codes give
for it. The motions are synthetic. See :doc:`/how-to/floors`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

suite = rs.motions.make_synthetic_suite(12)
museum = rs.risk.Building.of_first_mode("museum", storeys=3, period_s=0.35)
sizes = {"stele": (0.3, 1.6), "vase": (0.16, 0.5), "case": (0.7, 1.9)}
objects = [
    rs.risk.DescribedObject(
        values={
            "name": f"{name}, {floor}",
            "floor": floor,
            "geometry": {"width_m": width, "height_m": height},
            "assessment": {"draws": 1, "levels": 8},
        }
    )
    for name, (width, height) in sizes.items()
    for floor in (0, 2, 3)
]
table = rs.assess_objects(objects, suite, buildings=[museum], pga_g=0.2, pgv_m_s=0.2)
roof = [museum.floor(3).motion(ground) for ground in suite]
_, (left, right) = plt.subplots(1, 2, layout="constrained", figsize=(9.0, 4.0))
rs.plots.plan(table, left)
rs.plots.floor_spectra(roof, right, building_period_s=0.35, height_ratio=1.0)
