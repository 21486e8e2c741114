"""Pictures, films, reports and files: they take results and never compute."""
