"""Measurements of reasoning and planning, side by side; `python -m benchmarks --help`."""
