# SPDX-License-Identifier: BSD-3-Clause
"""What tests of files that are written share: a full disk, the reason why nothing was written, and
what must not be left."""

import contextlib
import os
import resource
import signal

from brainshift_testing import assert_says, messages


@contextlib.contextmanager
def full_disk(limit):
    """A process that may write no more than `limit` bytes into a file finds every disk full."""
    heard = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, heard)


def assert_fails(save, *words):
    """Saving raises an error with these words, and ParaView's output window is told. Returns what
    it is told."""
    with messages() as said:
        try:
            save()
        except OSError as error:
            assert_says(str(error), *words)
        else:
            raise AssertionError(f"it must fail with {words}")
    assert said.text
    return said.text


def assert_nothing_left(name):
    """No part of a file or folder lies beside it."""
    left = [file for file in os.listdir(os.path.dirname(name)) if file.startswith(".part-")]
    assert not left, left
