"""The agents of the testbed: robots that pursue a goal, adversaries that interfere."""

DISTRIBUTION = "intention-testbed"
