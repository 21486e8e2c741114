"""The program as `python -m rocksteady`."""

from rocksteady.cli.entry import main

main()
