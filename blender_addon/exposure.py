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
    """The same if the user wants the exposure to follow the sky, and has not animated it."""
    if scene.skyprobe.auto_exposure and not compat.is_animated(scene, DATA_PATH):
        expose(scene, horizontal_lx)


def insert_keys(scene, lux_by_frame):
    """Keyframe the exposure of `scene` for the light on its ground [lx] at consecutive frames; return why not, or an empty text."""
    if compat.is_animated(scene, DATA_PATH):
        return "the exposure keeps its own animation"
    try:
        compat.check_animatable(scene, DATA_PATH)
    except ValueError as error:
        return f"the exposure has no keyframes: {error}"
    compat.own_action(scene)
    for frame, horizontal_lx in sorted(lux_by_frame.items()):
        expose(scene, horizontal_lx)
        scene.keyframe_insert(DATA_PATH, frame=frame)
    scene.skyprobe.exposure_keys = (min(lux_by_frame), max(lux_by_frame) + 1)
    return ""


def remove_keys(scene):
    """Take away the keyframes of `insert_keys`. A user's own stay, and a curve that has lost one of ours is the user's."""
    frames = range(*scene.skyprobe.exposure_keys)
    scene.skyprobe.exposure_keys = (0, 0)
    if frames and set(frames) <= compat.key_frames(scene, DATA_PATH):
        compat.own_action(scene)
        compat.remove_keys(scene, DATA_PATH, frames)
