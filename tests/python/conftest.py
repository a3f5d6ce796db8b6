"""Where the program is: beside the package that is tested."""

import os

import pytest


@pytest.fixture(scope="session")
def vitrel_program():
    return os.environ["VITREL_PROGRAM"]
