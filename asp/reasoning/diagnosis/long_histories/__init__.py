"""Explanations of long histories, of which the past is compressed."""
