"""The spine: one turn, from a sentence to a motion."""
