"""Every statement of the paper: how it is checked, and whether it holds."""
