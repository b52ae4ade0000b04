"""English to program text: vocabulary, model, training, constrained decoding, service."""
