"""`python -m testbed.cli`, and by way of it `python -m testbed`."""

from testbed.cli import main

if __name__ == "__main__":
    main()
