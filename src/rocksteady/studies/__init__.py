"""Published papers, done again through the public interface of the package."""
