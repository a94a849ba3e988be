"""What robots have in common: the domain they reason about, history, relevance, diagnosis."""
