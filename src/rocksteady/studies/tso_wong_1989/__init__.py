"""Which figures and statements of Tso and Wong (1989) hold when they are computed again."""
