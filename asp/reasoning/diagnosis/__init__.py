"""Smallest explanations of histories."""
