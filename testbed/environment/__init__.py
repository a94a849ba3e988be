"""The world and its PettingZoo environment: two agents, one core, two views."""
