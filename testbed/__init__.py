"""Intention Testbed: reasoning robots in a world that others change."""
