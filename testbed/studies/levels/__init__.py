"""The levels L1 to L8 and other maps (P 4, Tables 2 and 3): how their trials are drawn and played,
what is counted of them, and the published figures beside it."""
