"""The kernels as a WebAssembly module: a loader, and types that are made from the kernels."""
