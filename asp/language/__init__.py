"""The action language AL_d: text in, a checked and ground description out."""
