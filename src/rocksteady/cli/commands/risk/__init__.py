"""Commands that say whether an object falls: screens, assessments."""
