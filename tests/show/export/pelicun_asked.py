"""Asks pelicun, in an environment of its own: ``python pelicun_asked.py TABLE NAME DEMAND UNIT
LEVEL ...`` prints the share of samples in each damage state at each level.
"""

import json
import sys
import warnings

import numpy as np
import pandas as pd

warnings.filterwarnings("ignore")
SAMPLES = 20_000


def shares(table: str, name: str, demand: str, unit: str, level: float) -> dict[str, float]:
    """Return the share of samples in each damage state, by its number."""
    from pelicun.assessment import Assessment  # type: ignore[import-not-found]

    places = pd.MultiIndex.from_product([[demand], ["0", "1"], ["1"]])
    units = pd.DataFrame([[unit] * 2], columns=places, index=["Units"])
    demands = pd.DataFrame(np.full((SAMPLES, 2), level), columns=places)
    one = {"Units": "ea", "Location": "1", "Direction": "1", "Theta_0": 1.0, "Family": "N/A"}
    asked = Assessment({"PrintLog": False, "Seed": 415, "LogFile": None})
    asked.stories = 1
    asked.demand.load_sample(pd.concat([units, demands]))
    marginals = pd.DataFrame([{**one, "Blocks": 1}], index=[name])
    asked.asset.load_cmp_model({"marginals": marginals})
    asked.asset.generate_cmp_sample(SAMPLES)
    asked.damage.load_model_parameters([table], {name})
    asked.damage.calculate()
    found = asked.damage.save_sample()
    return {str(column[-1]): float(found[column].mean()) for column in found.columns}


if __name__ == "__main__":
    table, name, demand, unit, *levels = sys.argv[1:]
    found = [shares(table, name, demand, unit, float(level)) for level in levels]
    sys.stdout.write(f"{json.dumps(found)}\n")
