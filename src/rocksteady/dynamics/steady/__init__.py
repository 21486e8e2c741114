"""Which symmetric steady states exist, and where: closed forms, regions, response curves."""
