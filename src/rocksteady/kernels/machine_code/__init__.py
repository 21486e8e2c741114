"""How kernels become machine code: decorators, and where that code is kept."""
