"""Runs doctest suites: `python3 -m tests.runner PROGRAM [OPTION...]`."""
