# SPDX-License-Identifier: GPL-3.0-or-later
"""Finish a rendered picture: the glare of the eye on the Render Result and, if asked for, tone mapping. New images; the render itself stays as it is."""

import contextlib
import math
import os
import tempfile

import bpy
import numpy
from skyprobe import post

from . import compat
from .failures import Telling

# Linear light with glare, and what a screen shows of it.
IMAGE_NAME = "Skyprobe Glare"
SCREEN_IMAGE_NAME = "Skyprobe Finished"

STATES = (
    ("auto", "Automatic", "By the mean luminance of the picture"),
    ("photopic", "Photopic", "The eye by day: small pupil, no halo"),
    ("mesopic", "Mesopic", "The eye in twilight and under lamps: wide pupil, faint halo"),
    ("scotopic", "Scotopic", "The eye by night: wide pupil, halo"),
)

LIGHTS = (
    ("AUTO", "Automatic", "What exceeds 20 times the mean luminance of the picture"),
    ("VALUE", "Threshold", "What exceeds a luminance"),
    ("ALL", "All Light", "All light, as in the eye"),
)

TONES = (
    ("NONE", "None", "Only the linear picture with glare, for Blender's own view transform"),
    ("sky", "Sky", "Made for skies by day and night: adaptation, dim colours of the night"),
    ("filmic", "Filmic", "In the manner of AgX"),
    ("aces", "ACES", "Fitted to the ACES transform"),
    ("exposure", "Exposure", "1 - exp(-light), as film"),
    ("reinhard", "Reinhard", "Reinhard et al. 2002, the same curve everywhere"),
    ("reinhard_local", "Reinhard, Local", "Reinhard et al. 2002, with local contrast"),
    ("ashikhmin", "Ashikhmin", "Ashikhmin 2002"),
    ("logarithmic", "Logarithmic", "In proportion to the logarithm of luminance"),
    ("linear", "Linear", "In proportion to luminance, clamped"),
)


def render_result():
    """Return the image that holds the last render, or None."""
    return next((image for image in bpy.data.images if image.type == "RENDER_RESULT"), None)


def rendered_pixels(scene):
    """Return the linear pixels of the last render of `scene`, (H, W, 3) float32, row 0 at the top.

    Blender gives no access to them, so they take the way through a float EXR in a temporary folder. RuntimeError if nothing was rendered.
    """
    with _float_exr(scene.render.image_settings), tempfile.TemporaryDirectory(dir=bpy.app.tempdir or None) as folder:
        path = os.path.join(folder, "render.exr")
        # The scene says both whose render is meant and how it is written.
        render_result().save_render(path, scene=scene)
        loaded = bpy.data.images.load(path)
        try:
            return image_pixels(loaded)
        finally:
            bpy.data.images.remove(loaded)


def image_pixels(image):
    """Return the pixels of `image`, (H, W, 3) float32, row 0 at the top."""
    width, height = image.size
    flat = numpy.empty(width * height * image.channels, dtype=numpy.float32)
    image.pixels.foreach_get(flat)
    pixels = flat.reshape(height, width, image.channels)[::-1]
    # A black and white render has one channel, with or without alpha.
    return numpy.ascontiguousarray(pixels[:, :, :3] if image.channels >= 3 else numpy.repeat(pixels[:, :, :1], 3, axis=2))


def show_pixels(name, pixels):
    """Put `pixels`, (H, W, 3), row 0 at the top, into the image `name`, and show it in every open image editor; return the image.

    Linear light (float32) makes a float image, bytes (uint8) one for the screen.
    """
    height, width, _ = pixels.shape
    is_light = pixels.dtype == numpy.float32
    image = bpy.data.images.get(name)
    if image is not None and tuple(image.size) != (width, height):
        image.scale(width, height)
    if image is None:
        image = bpy.data.images.new(name, width, height, alpha=False, float_buffer=is_light)
    flat = numpy.ones((height, width, 4), dtype=numpy.float32)
    flat[:, :, :3] = pixels[::-1] if is_light else pixels[::-1] / 255.0
    image.pixels.foreach_set(flat.ravel())
    image.update()
    screen = bpy.context.screen
    for area in screen.areas if screen else ():
        if area.type == "IMAGE_EDITOR":
            area.spaces.active.image = image
            area.tag_redraw()
    return image


def view_of(scene):
    """Return the keywords of skyprobe.post.glare that say where the pixels of `scene` look; ValueError for a camera without one centre."""
    camera = scene.camera.data if scene.camera and scene.camera.type == "CAMERA" else None
    if camera is None:
        raise ValueError("camera = none: must be in the scene, or set the field of view by hand")
    if camera.type == "PANO":
        kind, angle = _panorama(camera)
        if kind == "EQUIRECTANGULAR":
            return {"projection": "latlong"}
        if kind == "FISHEYE_EQUIDISTANT":
            return {"projection": "fisheye", "field_of_view_deg": math.degrees(angle)}
        raise ValueError(f"camera = {kind}: must be perspective, equirectangular or equidistant fisheye")
    if camera.type != "PERSP":
        raise ValueError("camera = orthographic: set the field of view by hand")
    # The border of the picture in the camera's frame knows sensor, aspect and shift.
    corners = camera.view_frame(scene=scene)
    breadth = max(corner.x for corner in corners) - min(corner.x for corner in corners)
    return {"projection": "perspective", "field_of_view_deg": math.degrees(2.0 * math.atan2(0.5 * breadth, -corners[0].z))}


@contextlib.contextmanager
def _float_exr(settings):
    """Make images be saved as float EXR with colours, for a while. From 5.0 on the kind of file comes first."""
    names = [name for name in ("media_type", "file_format", "color_mode", "color_depth") if hasattr(settings, name)]
    before = [(name, getattr(settings, name)) for name in names]
    wanted = {"media_type": "IMAGE", "file_format": "OPEN_EXR", "color_mode": "RGB", "color_depth": "32"}
    try:
        for name in names:
            setattr(settings, name, wanted[name])
        yield
    finally:
        for name, value in before:
            setattr(settings, name, value)


def _panorama(camera):
    """Return kind and fisheye angle [radians] of a panoramic `camera`: its own from 5.0 on, Cycles' before."""
    holder = camera if hasattr(camera, "panorama_type") else camera.cycles
    return holder.panorama_type, holder.fisheye_fov


class SKYPROBE_OT_glare(Telling, bpy.types.Operator):
    """Add the glare of the eye to the last render, as a new image"""

    bl_idname = "skyprobe.glare"
    bl_label = "Add Glare"
    bl_options = {"REGISTER", "UNDO"}

    state: bpy.props.EnumProperty(name="Eye", description="State to which the eye is adapted", items=STATES, default="auto")
    light: bpy.props.EnumProperty(name="Glaring", description="Which light glares", items=LIGHTS, default="AUTO")
    threshold: bpy.props.FloatProperty(
        name="Threshold", description="Luminance above which light glares [cd/m\N{SUPERSCRIPT TWO}]", default=10000.0, min=0.0, max=1e12
    )
    size: bpy.props.FloatProperty(
        name="Size", description="Size of the filter in sizes of the picture: at 2 every pixel reaches every other", default=2.0, min=0.01, max=2.0
    )
    streaks: bpy.props.FloatProperty(name="Streaks", description="Contrast of the fine rays", default=0.6, min=0.0, max=1.0, subtype="FACTOR")
    seed: bpy.props.IntProperty(name="Seed", description="Draws the fine rays", default=0, min=0)
    white_luminance: bpy.props.FloatProperty(
        name="White",
        description="Luminance of a pixel of value 1 [cd/m\N{SUPERSCRIPT TWO}]: 683 under a skyprobe sky",
        default=683.0,
        min=1e-6,
        max=1e9,
    )
    tone: bpy.props.EnumProperty(name="Tone Mapping", description="How the picture comes to the screen, as a second image", items=TONES, default="NONE")
    exposure_stops: bpy.props.FloatProperty(
        name="Exposure", description="Relative to the automatic one [stops]", default=0.0, min=-20.0, max=20.0, soft_min=-5.0, soft_max=5.0
    )
    own_view: bpy.props.BoolProperty(name="Own Field of View", description="Instead of that of the scene's camera", default=False)
    field_of_view: bpy.props.FloatProperty(
        name="Field of View",
        description="Angle between left and right border",
        default=math.radians(39.6),
        min=math.radians(0.01),
        max=math.radians(179.0),
        subtype="ANGLE",
    )

    @classmethod
    def poll(cls, context):
        if render_result() is None:
            cls.poll_message_set("Render the scene first")
            return False
        return context.scene is not None

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "state")
        layout.prop(self, "light")
        if self.light == "VALUE":
            layout.prop(self, "threshold")
        for name in ("size", "streaks", "seed", "white_luminance", "own_view"):
            layout.prop(self, name)
        if self.own_view:
            layout.prop(self, "field_of_view")
        layout.prop(self, "tone")
        if self.tone != "NONE":
            layout.prop(self, "exposure_stops")

    def run(self, context):
        window_manager = context.window_manager
        window_manager.progress_begin(0.0, 1.0)
        try:
            report = self._run(context, lambda stage, fraction: window_manager.progress_update(fraction))
        except RuntimeError as error:
            # What Blender says when it cannot save its render.
            raise OSError(f"Render Result: {error}") from None
        finally:
            window_manager.progress_end()
        told = "" if report.threshold is None else f", above {report.threshold:.4g} cd/m\N{SUPERSCRIPT TWO}"
        self.report({"INFO"}, f"Skyprobe: {report.state} eye, {report.glaring_pixels} pixels glare{told}")
        if any(report.repairs) or report.too_bright:
            self.report({"WARNING"}, f"Skyprobe: {sum(report.repairs)} values of the render are no light and were repaired")
        return {"FINISHED"}

    def _run(self, context, progress):
        scene = context.scene
        if self.own_view:
            view = {"projection": "perspective", "field_of_view_deg": math.degrees(self.field_of_view)}
        else:
            view = view_of(scene)
        view |= {"white_luminance": self.white_luminance, "color_space": compat.working_color_space()}
        pixels, report = post.glare(
            rendered_pixels(scene),
            **view,
            state=self.state,
            threshold=self.threshold if self.light == "VALUE" else None,
            all_light=self.light == "ALL",
            size=self.size,
            streaks=self.streaks,
            seed=self.seed,
            progress=progress,
        )
        show_pixels(IMAGE_NAME, pixels)
        if self.tone != "NONE":
            mapped, _ = post.tone_map(pixels, self.tone, exposure_stops=self.exposure_stops, **view, progress=progress)
            show_pixels(SCREEN_IMAGE_NAME, mapped)
        return report


class SKYPROBE_PT_finish(bpy.types.Panel):
    bl_label = "Finish"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "Sky"

    def draw(self, context):
        self.layout.operator(SKYPROBE_OT_glare.bl_idname, icon="LIGHT_SUN")


CLASSES = (SKYPROBE_OT_glare, SKYPROBE_PT_finish)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
