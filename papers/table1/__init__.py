"""The page of published and measured: a module a group of its sections."""
