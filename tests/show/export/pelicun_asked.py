"""Asks pelicun, in an environment of its own: ``python pelicun_asked.py TABLE NAME DEMAND UNIT
LEVEL ...`` prints the shares of samples that reach each damage state, for each level.
"""

import json
import sys
import warnings

import numpy as np
import pandas as pd

warnings.filterwarnings("ignore")
SAMPLES = 20_000


def shares(table: str, name: str, demand: str, unit: str, level: float) -> list[float]:
    """Return the share of samples that reach each damage state."""
    from pelicun.assessment import Assessment  # type: ignore[import-not-found]

    places = pd.MultiIndex.from_product([[demand], ["0", "1"], ["1"]])
    rows = np.vstack([[unit] * 2, np.full((SAMPLES, 2), level)])
    one = {"Units": "ea", "Location": "1", "Direction": "1", "Theta_0": 1.0, "Family": "N/A"}
    asked = Assessment({"PrintLog": False, "Seed": 415, "LogFile": None})
    asked.stories = 1
    asked.demand.load_sample(pd.DataFrame(rows, ["Units", *range(SAMPLES)], places))
    marginals = pd.DataFrame([{**one, "Blocks": 1}], index=[name])
    asked.asset.load_cmp_model({"marginals": marginals})
    asked.asset.generate_cmp_sample(SAMPLES)
    asked.damage.load_model_parameters([table], {name})
    asked.damage.calculate()
    in_state = asked.damage.save_sample().mean().to_numpy()  # from none to the last
    return [float(in_state[place:].sum()) for place in range(1, len(in_state))]


if __name__ == "__main__":
    table, name, demand, unit, *levels = sys.argv[1:]
    sys.stdout.write(
        json.dumps([shares(table, name, demand, unit, float(level)) for level in levels])
    )
