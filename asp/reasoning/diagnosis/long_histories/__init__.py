"""History compression: it pays in histories of many hidden events (`COMPRESSION`)."""
