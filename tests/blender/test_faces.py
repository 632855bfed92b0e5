"""A scene is the same in JSON, in Python, on the command line, in headers of pictures and in Blender's panel."""

import os

import pytest

from blender import hosts

# What the panel can say, beside what is in every scene.
SAID = {
    "latitude", "longitude", "elevation_m", "time", "zone",
    "atmosphere.preset", "atmosphere.quality", "atmosphere.aerosol", "atmosphere.ground", "atmosphere.aod550", "atmosphere.turbidity",
    "atmosphere.visibility_km", "atmosphere.ozone_du", "atmosphere.relative_humidity", "atmosphere.stratospheric_aod550",
    "night.when", "night.star_limit", "night.solar_flux_sfu", "night.bortle", "night.led_share",
    "layers.sky", "layers.sun", "layers.moon", "layers.stars", "layers.planets", "layers.milky_way", "layers.zodiacal", "layers.airglow", "layers.light_pollution",
    "polarising_filter.strength", "polarising_filter.angle_deg", "polarising_filter.held_towards_deg",
    "probe.width", "probe.sun_disc", "probe.moon_disc",
}
# What another sky would be.
REFUSED = {
    "sun", "model", "sun_model", "probe.projection", "probe.extent", "probe.ground", "night.zenith_brightness",
    "atmosphere.ground", "atmosphere.polarisation", "atmosphere.wavelengths_nm", "atmosphere.stratospheric_altitude_km", "atmosphere.phase_function",
    "atmosphere.angstrom_exponent", "atmosphere.single_scattering_albedo", "atmosphere.asymmetry", "atmosphere.aerosol_scale_height_km",
    "atmosphere.standard_atmosphere", "atmosphere.surface_pressure_hpa",
}
# What another file of the same sky would be.
TOLD = {
    "tolerance", "output", "probe.rows", "probe.turn_deg", "probe.scale", "probe.color_space", "probe.gamut",
    "file.half", "file.exposure_stops", "file.operator", "file.layers",
}


@pytest.mark.parametrize("host", hosts.VERSIONS[-1:], indirect=True)
def test_random_scenes_go_into_the_panel_and_come_back_or_are_refused_by_name(host):
    answer = host.run("faces_steps.said_in_settings", count=200)
    assert answer["wrong"] == []
    assert set(answer["varied"]) == SAID
    assert set(answer["refused"]) == REFUSED
    assert set(answer["told"]) == TOLD


@pytest.mark.parametrize("host", hosts.VERSIONS[-1:], indirect=True)
def test_panel_module_and_command_line_make_the_same_picture(host, tmp_path):
    binary = os.environ.get("SKYPROBE_BINARY", str(hosts.ROOT / "target" / "release" / "skyprobe"))
    for found in host.run("faces_steps.pictures", folder=str(tmp_path), binary=binary):
        assert found["module"] == 0.0 and found["panel"] <= 1e-6, found
