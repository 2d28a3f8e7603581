# SPDX-License-Identifier: BSD-3-Clause
"""Files of landmarks for tests, and what is said where they are refused."""

import brainshift
from brainshift_testing import messages, scratch


def written(name, text):
    path = scratch(name)
    with open(path, "wb") as file:
        file.write(text if isinstance(text, bytes) else text.encode())
    return path


def refusal(name, text, **named):
    """The one sentence with which a file is refused."""
    with messages():
        try:
            brainshift.read_points(written(name, text), **named)
        except ValueError as error:
            return str(error)
    raise AssertionError(f"{text!r} was read")
