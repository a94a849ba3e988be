"""The page of published and measured: a module per group of its sections."""
