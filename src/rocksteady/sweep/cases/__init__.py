"""What is computed: axes, grid, task, queue of pieces, results in memory."""
