"""Plans in large fine descriptions: relaxed reachability, landmarks, value pruning."""
