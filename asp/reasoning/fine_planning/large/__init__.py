"""Plans in large fine descriptions: reachability, landmarks, value pruning."""
