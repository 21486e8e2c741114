"""One flight of the linear model: its closed form, first zero, extrema and derivatives."""
