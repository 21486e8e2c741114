"""Every scene and tab looks as it did, on a desktop and a phone, one of them light, one dark."""

import numpy as np
import pytest
from PIL import Image

from tests.explorer.browser.pictured import FOLDER, LOOKS, SIZES, VIEWS, sheet
from tests.explorer.browser.watched import Explorer

MOST = 7.0
"""Mean difference of a picture from the one kept, of 255; a part that is missing makes more."""


@pytest.mark.slow
@pytest.mark.parametrize("look", LOOKS)
@pytest.mark.parametrize("size", SIZES)
def test_scenes_and_tabs_look_as_they_did(size: str, look: str, explorer: Explorer) -> None:
    """Every second view in each sheet, so that each is seen in both sizes and in both themes."""
    first = ([*SIZES].index(size) + [*LOOKS].index(look)) % 2
    views = [*VIEWS][first::2]
    whole = np.asarray(Image.open(FOLDER / f"{size}-{look}.png").convert("RGB"), dtype=float)
    kept = np.concatenate(np.split(whole, len(VIEWS), axis=1)[first::2], axis=1)
    made = np.asarray(sheet(explorer, size, look, views), dtype=float)
    assert made.shape == kept.shape
    columns = np.abs(made - kept).mean(axis=(0, 2)).reshape(len(views), -1).mean(axis=1)
    changed = {name: round(far, 1) for name, far in zip(views, columns, strict=True) if far > MOST}
    assert changed == {}, "look; then python -m tests.explorer.browser.pictured"
