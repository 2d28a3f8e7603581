# SPDX-License-Identifier: BSD-3-Clause
"""Checks the arguments of the public functions. Each error names the argument and its value."""

import math


def vector(name, values):
    """`values` as a tuple of three finite numbers."""
    numbers = tuple(float(value) for value in values)
    if len(numbers) != 3:
        raise ValueError(f"{name} has {len(numbers)} numbers; it must have 3")
    if not all(math.isfinite(number) for number in numbers):
        raise ValueError(f"{name} is {numbers}; its numbers must be finite")
    return numbers


def positive(name, value):
    """`value` in mm as a finite number above 0."""
    number = float(value)
    if not (math.isfinite(number) and number > 0.0):
        raise ValueError(f"{name} is {number} mm; it must be above 0 mm")
    return number


def at_least(limit, name, value):
    """`value` as a finite number that is `limit` or more."""
    number = float(value)
    if not (math.isfinite(number) and number >= limit):
        raise ValueError(f"{name} is {number}; it must be at least {limit}")
    return number
