# SPDX-License-Identifier: GPL-3.0-or-later
"""The state of the air and the ground, and the filter before the sky."""

import math

from bpy.props import BoolProperty, EnumProperty, FloatProperty

from .. import choices, live
from ..limits import angle_limits, limits


class Air:
    """Properties of the air."""

    preset: EnumProperty(name="Air", description="State of the air", items=choices.PRESETS, default="clear", update=live.changed)
    aerosol: EnumProperty(
        name="Aerosol", description="Kind of the particles in the air", items=choices.AEROSOLS, default=choices.OF_PRESET,
        update=live.changed,
    )
    haze: EnumProperty(
        name="Haze",
        description="How the amount of particles is given",
        items=(
            (choices.OF_PRESET, "As the Preset", "The amount of the chosen preset"),
            ("aod550", "Optical Depth", "Vertical optical depth of the particles at 550 nm"),
            ("turbidity", "Turbidity", "Vertical optical depth of particles and molecules relative to molecules alone"),
            ("visibility_km", "Visibility", "Distance at which a dark object fades into the horizon"),
        ),
        default=choices.OF_PRESET,
        update=live.changed,
    )
    aod550: FloatProperty(
        name="Optical Depth",
        description="Vertical optical depth of the particles at 550 nm: 0.05 very clear, 0.1 clear, 0.4 hazy, 2 and more fog",
        **limits("atmosphere.aod550"),
        soft_max=1.0,
        default=0.1,
        precision=3,
        step=1,
        update=live.changed,
    )
    turbidity: FloatProperty(
        name="Turbidity",
        description="Optical depth of particles and molecules relative to molecules alone: 1 pure air, 2 clear, 6 hazy",
        **limits("atmosphere.turbidity"),
        soft_max=10.0,
        default=2.5,
        precision=2,
        update=live.changed,
    )
    visibility_km: FloatProperty(
        name="Visibility (km)",
        description="Distance at which a dark object fades into the horizon, in kilometres",
        **limits("atmosphere.visibility_km"),
        soft_min=1.0,
        soft_max=300.0,
        default=40.0,
        precision=1,
        step=100,
        update=live.changed,
    )
    use_ozone: BoolProperty(
        name="Set Ozone", description="Give the ozone column instead of leaving it to the preset", default=False,
        update=live.changed,
    )
    ozone_du: FloatProperty(
        name="Ozone (DU)",
        description="Column of ozone in Dobson units: 300 on average; it makes twilight blue",
        **limits("atmosphere.ozone_du"),
        soft_min=100.0,
        soft_max=500.0,
        default=300.0,
        precision=0,
        step=1000,
        update=live.changed,
    )
    use_humidity: BoolProperty(
        name="Set Humidity", description="Give the humidity with which the particles grow instead of the usual 80 %", default=False,
        update=live.changed,
    )
    relative_humidity: FloatProperty(
        name="Humidity (%)",
        description="Relative humidity: damp air makes the particles larger and the haze whiter",
        **limits("atmosphere.relative_humidity"),
        default=80.0,
        precision=0,
        step=100,
        update=live.changed,
    )
    use_stratosphere: BoolProperty(
        name="Set Volcanic Haze",
        description="Give the amount of volcanic haze in the stratosphere instead of leaving it to the preset",
        default=False,
        update=live.changed,
    )
    stratospheric_aod550: FloatProperty(
        name="Volcanic Haze",
        description="Vertical optical depth at 550 nm of volcanic haze in the stratosphere: 0.15 after the greatest eruptions",
        **limits("atmosphere.stratospheric_aod550"),
        soft_max=0.3,
        default=0.15,
        precision=3,
        step=1,
        update=live.changed,
    )
    ground: EnumProperty(
        name="Ground", description="What the land around reflects", items=choices.GROUNDS, default=choices.OF_PRESET,
        update=live.changed,
    )


class Filter:
    """Properties of the polarising filter."""

    filter_mode: EnumProperty(
        name="Filter",
        description="Whether the sky is seen through a polarising filter",
        items=(
            ("NONE", "None", "No filter"),
            ("VIEW", "Turns with the View", "In every direction the axis stands at the same angle from the vertical"),
            ("HELD", "Held", "One piece of glass that is held towards a direction, as before a camera"),
        ),
        default="NONE",
        update=live.changed,
    )
    filter_strength: FloatProperty(
        name="Strength", description="0 no filter, 1 an ideal one", subtype="FACTOR", **limits("polarising_filter.strength"), default=1.0,
        update=live.changed,
    )
    filter_angle: FloatProperty(
        name="Angle",
        description="Angle of the filter's axis from the vertical, clockwise as one sees it",
        subtype="ANGLE",
        **angle_limits("polarising_filter.angle_deg"),
        default=0.0,
        step=100,
        update=live.changed,
    )
    filter_altitude: FloatProperty(
        name="Altitude",
        description="Altitude above the horizon towards which the filter is held",
        subtype="ANGLE",
        **angle_limits("sun.altitude_deg"),
        default=math.radians(20.0),
        step=100,
        update=live.changed,
    )
    filter_azimuth: FloatProperty(
        name="Azimuth",
        description="Azimuth from true north through east towards which the filter is held",
        subtype="ANGLE",
        **angle_limits("sun.azimuth_deg"),
        default=0.0,
        step=100,
        update=live.changed,
    )
