"""Hazard curves (files of OpenQuake), annual rates of failure, balanced rocks."""
