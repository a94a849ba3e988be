"""The page of published and measured levels: a module a group of its sections."""
