"""Facades, parapets and gables by Circolare 2019 n. 7: checks, pictures, page and command."""

from rocksteady.show.export.files import NUMBERS

NUMBERS["facade"] = 2
