"""`python -m testbed`: the module of the command line, which imports what a command needs."""

from runpy import run_module

if __name__ == "__main__":
    run_module("testbed.cli", run_name="__main__", alter_sys=True)
