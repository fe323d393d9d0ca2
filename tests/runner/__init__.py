"""Runs suites of doctest's: `python3 -m tests.runner PROGRAM [OPTION...]`."""
