"""Results in words: their answers, facts, tables and datasets, above all that computes."""
