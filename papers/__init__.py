"""The scripts that write the generated pages of the documentation."""
