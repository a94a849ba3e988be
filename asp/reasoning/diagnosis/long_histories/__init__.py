"""History compression: it pays in histories of more than some thirty steps (`Compression`)."""
