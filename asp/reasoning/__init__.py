"""Plans, explanations and inferences, from descriptions and histories."""
