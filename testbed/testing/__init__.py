"""What tests of robots, adversaries and domains use: fixtures (`testbed.testing.plugin`)."""
