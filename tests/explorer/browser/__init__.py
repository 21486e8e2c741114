"""Tests of the explorer's page in Chromium; a package, so that its browser ends with its tests."""
