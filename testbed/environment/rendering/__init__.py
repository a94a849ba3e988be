"""A game as a picture, as text, and in a notebook."""
