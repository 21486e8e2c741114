"""Executors: they compute the cells of a sweep, in this process, in others or on a GPU.

An executor is a context manager.  It takes the task and the number of workers, starts the workers,
and yields a `Pool`.  No executor changes a result, because a cell is computed from its coordinates
and its number alone.  A new one is a module here and an entry of `choice.EXECUTORS`.
"""
