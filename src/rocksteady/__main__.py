"""The program as `python -m rocksteady`."""

from rocksteady.cli.start import main

main()
