"""How tables and datasets name the impacts that count."""

from rocksteady.kernels.core.tables import COUNTED

COUNTED_IMPACTS = f"impacts that leave with {COUNTED:g} or more in du/d(pt)"
