"""The program as `python -m rocksteady`."""

from rocksteady.cli.app import main

main()
