"""The backend that matches each law against what is true."""
