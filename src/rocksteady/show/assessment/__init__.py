"""Assessments on paper and on disk: the folder of one object, for a client and for loss tools."""
