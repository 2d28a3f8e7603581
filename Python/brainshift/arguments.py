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


def positive(name, value, unit=" mm"):
    """`value` as a finite number above 0."""
    number = float(value)
    if not (math.isfinite(number) and number > 0.0):
        raise ValueError(f"{name} is {number}{unit}; it must be above 0{unit}")
    return number
