"""The page of published and measured levels: a module per group of its sections."""
