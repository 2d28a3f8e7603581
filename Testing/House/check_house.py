# SPDX-License-Identifier: BSD-3-Clause
"""Runs one check of the house, or all of them: python3 check_house.py CHECKOUT [CHECK].

It needs nothing but Python and reads nothing but the checkout. Each check is a function that
gives a sentence for each thing it finds wrong. A check fails if it finds anything.
"""

import sys
import time

import forms
import guards
import includes
import listed
import named_formats
import named_tools
import similarities
import sizes
import systems
from tree import Tree

CHECKS = {check.__name__: check
          for module in (includes, sizes, listed, forms, guards, named_formats, named_tools,
                        similarities, systems)
          for check in module.CHECKS}


def run(tree, name):
    """Whether a check passes. Prints what it proves and what it found."""
    start = time.monotonic()
    found = list(CHECKS[name](tree))
    print(f"{name}: {CHECKS[name].__doc__}")
    for sentence in found:
        print(f"  {sentence}")
    print(f"  {len(found)} found in {time.monotonic() - start:.1f} s")
    return not found


def main():
    tree = Tree(sys.argv[1])
    results = [run(tree, name) for name in (sys.argv[2:] or CHECKS)]
    sys.exit(not all(results))


if __name__ == "__main__":
    main()
