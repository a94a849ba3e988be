"""Text for terminals and pages."""
