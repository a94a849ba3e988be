"""History compression: it pays in histories of more than some 100 steps (`COMPRESSION`)."""
