"""What is computed: axes, a grid, a task, its queue of pieces, and results in memory."""
