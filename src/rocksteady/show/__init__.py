"""How results are shown: plots, films, reports and files, drawn without computing anything."""
