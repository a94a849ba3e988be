"""Programs per problem, landmarks and value pruning: they pay from rooms of 64 cells on."""
