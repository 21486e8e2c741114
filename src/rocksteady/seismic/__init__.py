"""What recorded ground motions do to structures and to blocks of all sizes."""
