"""Who computes the cells of a sweep: this thread, several threads, or the workers of a cluster.

An executor is a context manager: it takes the task and the number of workers, makes ready, and
yields a `Team`.  No executor changes an answer, because a cell is computed from its coordinates and
its number alone.  A new one is a module here and an entry of `choice.EXECUTORS`.
"""
