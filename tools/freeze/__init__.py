"""A freeze of every answer: records of what the package prints, returns and writes."""
