"""The published studies: how they are loaded, measured and compared."""
