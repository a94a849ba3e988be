"""Plans of large problems: search over sets of states, and programs per problem."""
