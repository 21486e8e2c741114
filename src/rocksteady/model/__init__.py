"""The nouns: blocks and base motions, frozen and validated where they are made."""
