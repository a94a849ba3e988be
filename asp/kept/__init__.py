"""Controls that are grounded once and asked again and again.

Each answers one kind of question about a domain: what an action leads to, which plan is the
shortest, which explanation the smallest. The answers are those of the theories solved from
scratch; the tests hold the two equal.
"""
