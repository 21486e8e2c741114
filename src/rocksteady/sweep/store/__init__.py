"""Where results are kept: a zarr store on disk that can be resumed and verified."""
