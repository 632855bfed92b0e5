# SPDX-License-Identifier: GPL-3.0-or-later
"""Ranges of properties, as the library has them."""

import math

from .parameter_table import PARAMETERS


def limits(path):
    """Return `min` and `max` of the parameter `path`, such as atmosphere.ozone_du."""
    row = PARAMETERS[path]
    return {"min": row["low"], "max": row["high"]}


def angle_limits(path):
    """Return the same in radians, of a parameter in degrees."""
    return {end: math.radians(value) for end, value in limits(path).items()}
