"""The link between a driver and its robots: in process, or over zenoh between processes."""
