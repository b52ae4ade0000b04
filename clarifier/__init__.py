"""Run, ask or refuse: what a phrase denotes, what is missing, how to ask."""
