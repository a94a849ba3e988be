"""Packaged domains: one AL_d text per domain, and the levels L1 to L8 made of texts (P 4)."""
