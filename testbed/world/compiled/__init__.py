"""A world compiled from a ground description."""
