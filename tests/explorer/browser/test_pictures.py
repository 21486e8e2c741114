"""Every scene, tab and state of the laboratory looks as it did, some light, some dark."""

import numpy as np
import pytest
from PIL import Image

from tests.explorer.browser.pictured import FOLDER, LOOKS, SHEETS, SIZES, sheet
from tests.explorer.browser.watched import Explorer

MOST = 7.0
"""Mean difference of a picture from the one kept, of 255; a part that is missing makes more."""


@pytest.mark.slow
@pytest.mark.parametrize("name", SHEETS)
def test_scenes_and_tabs_look_as_they_did(name: str, explorer: Explorer) -> None:
    """Every second view in each sheet, so that each is seen in both sizes and in both themes."""
    size, look, addresses = SHEETS[name]
    first = ([*SIZES].index(size) + [*LOOKS].index(look)) % 2
    views = [*addresses][first::2]
    whole = np.asarray(Image.open(FOLDER / f"{name}.png").convert("RGB"), dtype=float)
    kept = np.concatenate(np.split(whole, len(addresses), axis=1)[first::2], axis=1)
    made = np.asarray(sheet(explorer, name, views), dtype=float)
    assert made.shape == kept.shape
    columns = np.abs(made - kept).mean(axis=(0, 2)).reshape(len(views), -1).mean(axis=1)
    changed = {view: round(far, 1) for view, far in zip(views, columns, strict=True) if far > MOST}
    assert changed == {}, f"look; then python -m tests.explorer.browser.pictured {name}"
