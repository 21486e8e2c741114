"""What can be asked: flags, their groups, and the objects that they become."""
