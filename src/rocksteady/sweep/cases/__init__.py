"""What is computed: axes, grid, task, queue of jobs, results in memory."""
