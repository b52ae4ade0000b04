"""Expert pairs of sentence and program, and what must hold after each."""
