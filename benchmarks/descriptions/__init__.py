"""Random small descriptions, and whether each way of reasoning is true to their definition."""
