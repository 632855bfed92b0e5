# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene's exposure by the light of the sky.

A grey card of reflectance 0.18 on the open ground under the illuminance E [lx] has the radiance 0.18 E / (683 pi) in the unit of the
pixels. A picture exposed for it shows 0.18, so the exposure is -log2(E / (683 pi)) stops.
"""

import math

from . import compat, jobs

DATA_PATH = "view_settings.exposure"
# Below this the sky is as good as black [lx].
DARKEST_LX = 1e-6


def stops(horizontal_lx):
    """Return the exposure [stops] for which a grey card on the ground is rendered as it is under `horizontal_lx`."""
    return -math.log2(max(horizontal_lx, DARKEST_LX) / (jobs.LUMINOUS_EFFICACY * math.pi))


def exposure_value(horizontal_lx):
    """Return the exposure value at ISO 100 of an incident light meter of constant C = 250 (ISO 2720): log2(E / 2.5)."""
    return math.log2(max(horizontal_lx, DARKEST_LX) / 2.5)


def expose(scene, horizontal_lx):
    """Set the exposure of `scene` for the light on its ground."""
    wanted = stops(horizontal_lx) + scene.skyprobe.exposure_offset
    limits = scene.view_settings.bl_rna.properties["exposure"]
    wanted = min(max(wanted, limits.hard_min), limits.hard_max)
    if abs(scene.view_settings.exposure - wanted) > 1e-4:
        scene.view_settings.exposure = wanted


def follow(scene, horizontal_lx):
    """The same if the user wants the exposure to follow the sky."""
    if scene.skyprobe.auto_exposure:
        expose(scene, horizontal_lx)


def may_key(scene):
    """Whether the exposure of `scene` has no keyframes or driver but ours."""
    return scene.skyprobe.exposure_keyed or not compat.is_animated(scene, DATA_PATH)


def insert_key(scene, frame, horizontal_lx):
    """Keyframe the exposure of `scene` for the light on its ground at `frame`."""
    expose(scene, horizontal_lx)
    scene.keyframe_insert(DATA_PATH, frame=frame)
    scene.skyprobe.exposure_keyed = True


def remove_keys(scene):
    """Take away the keyframes of `insert_key`; a user's own stay."""
    if scene.skyprobe.exposure_keyed:
        compat.remove_curve(scene, DATA_PATH)
        scene.skyprobe.exposure_keyed = False
