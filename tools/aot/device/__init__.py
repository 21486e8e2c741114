"""Programs of a device (a GPU): the kernels of one lane, as PTX, and emulated on this processor."""
