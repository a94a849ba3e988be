"""The messages between a driver and a robot, and the interface of a robot."""
