"""Where each public name is defined."""

from .check import Installation as Installation
from .check import KernelCheck as KernelCheck
from .check import check_installation as check_installation

__all__: list[str]
