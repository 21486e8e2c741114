"""What rocks and what shakes it: blocks and base motions, frozen and validated."""
