"""Tables: one file for each table of the paper or of ours."""
