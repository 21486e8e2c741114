"""What all pictures share: colours, labels, legends, layout, the page."""
