"""Search over sets of states: it pays from the office of Table 1 on (`STATE_SET_SEARCH`)."""
