# SPDX-License-Identifier: GPL-3.0-or-later
"""The lights of the night, and how much of each layer of the light is shown."""

from bpy.props import EnumProperty, FloatProperty

from .. import choices, live
from ..limits import limits


class Night:
    """Properties of the night."""

    night_when: EnumProperty(
        name="Show",
        description="When Moon, planets, stars and the other lights of the night are in the sky",
        items=(
            ("auto", "As It Gets Dark", "Moon and planets always; moonlight, stars and diffuse light while the Sun is below the horizon or totally eclipsed"),
            ("always", "Always", "All of them by day too, where they are less than a thousandth of the light"),
            ("never", "Never", "The light of the Sun only"),
        ),
        default="auto",
        update=live.changed,
    )
    star_limit: FloatProperty(
        name="Star Limit",
        description="Stars to this magnitude are drawn one by one, fainter ones as part of the Milky Way. A larger number is fainter: 6.5 is what the eye can see",
        **limits("night.star_limit"),
        default=8.5,
        precision=1,
        step=50,
        update=live.changed,
    )
    light_pollution: EnumProperty(
        name="Town Light",
        description="How much artificial light the air scatters, on Bortle's scale of dark skies",
        items=choices.TOWNS,
        default=choices.NO_TOWNS,
        update=live.changed,
    )
    solar_flux: FloatProperty(
        name="Airglow (sfu)",
        description="How strongly the upper air glows, by the Sun's radio flux at 10.7 cm in solar flux units: "
        "70 at the minimum of its activity, 130 on average, 200 at the maximum",
        **limits("night.solar_flux_sfu"),
        soft_max=200.0,
        default=130.0,
        precision=0,
        step=1000,
        update=live.changed,
    )
    led_share: FloatProperty(
        name="LED Share",
        description="How much of the town light comes from white LEDs; the rest comes from orange sodium lamps",
        subtype="FACTOR",
        **limits("night.led_share"),
        default=0.5,
        update=live.changed,
    )


def _layer(name, label, description):
    return FloatProperty(
        name=label,
        description=f"{description}. Factor on its light: 1 is as bright as it is, 0 leaves it out",
        min=0.0,
        max=1e6,
        soft_max=10.0,
        default=1.0,
        precision=2,
        step=10,
        update=live.changed,
    )


class Layers:
    """A factor for each layer of the light, named layer_ and the layer's name in the library."""

    __annotations__ = {f"layer_{name}": _layer(name, label, description) for name, label, description in choices.LAYERS}
