"""How blocks of all sizes fare on recorded ground motions."""
