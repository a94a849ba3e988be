"""Descriptions as answer set programs: the literal translation, and the compact one."""
