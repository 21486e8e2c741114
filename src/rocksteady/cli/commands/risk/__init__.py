"""Commands on falling objects: fragility, assess, screens."""
