"""What is computed: axes, a grid, a task, its queue of jobs, and results in memory."""
