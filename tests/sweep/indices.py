"""Indices of any kind into an axis, for arrays that are read where they are used."""

from typing import Any

from hypothesis import strategies as st


def indexers(length: int) -> st.SearchStrategy[Any]:
    places = st.integers(-length, length - 1)
    # An empty slice with a negative step is too much for xarray.
    slices = st.slices(length).filter(lambda part: len(range(*part.indices(length))) > 0)
    return places | slices | st.lists(places, min_size=1, max_size=4)
