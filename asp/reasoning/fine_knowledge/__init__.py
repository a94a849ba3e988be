"""What a robot knows at the fine resolution, and what follows from it."""
