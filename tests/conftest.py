"""How Hypothesis runs in every test; continuous integration keeps its own fixed seed."""

import os

from hypothesis import HealthCheck, settings

# No deadline: the first call of a kernel compiles it, and no deadline foresees that.
settings.register_profile("compiled", settings.default, deadline=None)
# Without compilation each call is some hundred times slower, so that fewer have to do.
settings.register_profile(
    "plain",
    settings.default,
    deadline=None,
    max_examples=20,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("plain" if os.environ.get("ROCKSTEADY_KERNELS") == "python" else "compiled")
