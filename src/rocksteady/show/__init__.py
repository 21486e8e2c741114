"""Pictures: they take results, accept and return axes, and never compute."""
