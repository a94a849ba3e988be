"""Table 1 (P 4): two robots from the same initial states, under the same exogenous actions."""
