"""What is done to a finished picture: a probe, or a scene that it lit.

>>> import skyprobe as sp
>>> from skyprobe import post
>>> sky = sp.Sky.with_sun(altitude_deg=8.0, azimuth_deg=200.0, atmosphere=sp.Atmosphere(quality="draft"))
>>> probe = sky.render(width=512)
>>> pixels, report = post.glare(probe.pixels, projection="latlong")
>>> report.state
'photopic'

Arrays are linear, float32, of shape (H, W, 3), row 0 at the top; what is given is never changed.
"""

from ._core import GlareReport, glare, point_spread_function

__all__ = ["GlareReport", "glare", "point_spread_function"]
