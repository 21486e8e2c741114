"""Calibrations on paper and on disk: the folder and the page of one."""
