"""Commands that write something to read or to touch: reports, studies, the explorer's page."""
