"""`python -m rocksteady`."""

from rocksteady.cli.app import main

main()
