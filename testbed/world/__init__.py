"""The transition function of a domain, with two backends."""
