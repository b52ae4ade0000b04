"""The inside of the little language: allow-list, interpreter, solver, and the worker process."""
