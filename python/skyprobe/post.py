"""What is done to a finished picture: a probe, or a scene that it lit.

>>> import skyprobe as sp
>>> from skyprobe import post
>>> sky = sp.Sky.with_sun(altitude_deg=8.0, azimuth_deg=200.0, atmosphere=sp.Atmosphere(quality="draft"))
>>> probe = sky.render(width=512)
>>> pixels, report = post.glare(probe.pixels, projection="latlong", scale=probe.scale)
>>> report.state
'photopic'

>>> picture, report = post.tone_map(pixels, "sky", projection="latlong", scale=probe.scale)
>>> picture.dtype, picture.shape
(dtype('uint8'), (256, 512, 3))

A time-lapse is exposed by an eye that takes time:

>>> eye = post.Adaptation(light_s=0.5, dark_s=1.0)
>>> frames = {"projection": "latlong", "scale": probe.scale}
>>> for frame in [pixels, 0.5 * pixels]:
...     luminance = eye.step(post.auto_exposure(frame, **frames).adaptation, seconds=1 / 24)
...     picture, report = post.tone_map(frame, adaptation=luminance, **frames)

Arrays are linear, float32, of shape (H, W, 3), row 0 at the top; what is given is never changed. An array does not know what its numbers stand for:
``scale`` says it, or else "blender" is assumed with a :class:`~skyprobe.ScaleWarning`.
"""

from ._core import Adaptation, GlareReport, Metering, ToneReport, auto_exposure, glare, point_spread_function, tone_map

__all__ = [
    "Adaptation",
    "GlareReport",
    "Metering",
    "ToneReport",
    "auto_exposure",
    "glare",
    "point_spread_function",
    "tone_map",
]
