"""What the build of the manual needs beside its pages: see docs/conf.py."""
