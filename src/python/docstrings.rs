//! Signatures and docstrings of what takes parameters by name, which `skyprobe schema --format python-docs` prints.

macro_rules! docstring {
    (Atmosphere) => {
        r#"Atmosphere(*, preset='clear', aerosol=None, aod550=None, turbidity=None, visibility_km=None, ozone_du=None, ground=None, stratospheric_aod550=None, stratospheric_altitude_km=None, relative_humidity=None, phase_function=None, angstrom_exponent=None, single_scattering_albedo=None, asymmetry=None, aerosol_scale_height_km=None, standard_atmosphere=None, surface_pressure_hpa=None, quality='standard', polarisation=True, wavelengths_nm=None, cache=True)
--

The state of the air. It is solved on first use, once, and can be shared by any number of skies and threads.

What is left out comes from the preset. At most one of ``aod550``, ``turbidity`` and ``visibility_km`` is given.

Parameters
----------
preset
    Where to start from. "clear", "pure", "hazy", "polluted", "urban", "maritime", "desert", "antarctic", "fog",
    "volcanic" or "thesis". A preset fills in what is left out: the kind and amount of aerosol, the ground, ozone
    and temperature.
aerosol
    Kind of aerosol. "none", "continental_clean", "continental_average", "continental_polluted", "urban",
    "maritime_clean", "maritime_polluted", "maritime_tropical", "desert", "arctic", "antarctic", "fog" or "thesis";
    by default the preset's.
aod550
    Amount of aerosol as its vertical optical depth at 550 nm. 0 to 50; by default the preset's. Clear is 0.1, murky
    0.5, fog 2 and more.
turbidity
    Amount of aerosol as turbidity: the optical depth of aerosol and molecules over that of the molecules at 550 nm.
    1 to 64; by default the preset's. Pure air is 1, clear 2, hazy 4 to 6, light fog 64.
visibility_km
    Amount of aerosol as horizontal visibility at the ground. 0.05 to 4000; by default the preset's. At most that of
    pure air, about 340 km at the sea; the optical depth must not exceed 50. [km]
ozone_du
    Ozone column. 0 to 1000; by default the preset's, mostly 300. It makes the twilight blue. [Dobson units]
ground
    The ground by name, or its albedo. "grass", "forest", "soil", "desert", "snow", "sea", "city" or "asphalt", or a
    number from 0 to 1; by default the preset's.
stratospheric_aod550
    Optical depth at 550 nm of volcanic haze in the stratosphere. 0 to 1; by default the preset's, mostly 0.
    Droplets of sulphuric acid, as after a great eruption; they come on top of the aerosol near the ground.
stratospheric_altitude_km
    Altitude of the middle of the volcanic haze. 12 to 40; by default 20. [km]
relative_humidity
    Relative humidity, with which the particles grow. 0 to 99; by default 80. Amounts are those of the grown
    particles. [%]
phase_function
    How the aerosol scatters. "mie", "henyey_greenstein" or "cornette_shanks"; by default mie; henyey_greenstein if
    an asymmetry is given or the aerosol is not made of particles.
angstrom_exponent
    Spectral slope of the aerosol's extinction, which becomes (wavelength / 550 nm)^-exponent. -1 to 4; by default
    the aerosol's own spectrum.
single_scattering_albedo
    Share of the aerosol's extinction that is scattering, at all wavelengths. 0 to 1; by default the aerosol's own
    spectrum.
asymmetry
    Asymmetry parameter: how much the aerosol scatters forward, by the function of Henyey and Greenstein. -0.99 to
    0.99; by default the aerosol's.
aerosol_scale_height_km
    Height in which the aerosol thins out to 1/e, or depth of a layer of fog. 0.1 to 20; by default the aerosol's.
    [km]
standard_atmosphere
    Profile of temperature and density, and shape of the ozone profile. "us_standard_1976", "tropical",
    "midlatitude_summer", "midlatitude_winter", "subarctic_summer" or "subarctic_winter"; by default the preset's.
surface_pressure_hpa
    Pressure at the ground, which scales the molecules at all altitudes. 100 to 1100; by default that of the
    standard atmosphere. [hPa]
quality
    How finely the light is solved. "draft", "standard", "high" or "reference".
polarisation
    Solve light with its polarisation. As a scalar it is wrong by several per cent: only to compare with scalar
    codes.
wavelengths_nm
    Wavelengths at which light is solved instead of those of the quality. Ascending, 300 to 1000, shape (W,). A
    probe and an illuminance need at least four, from 450 or less to 650 or more. [nm]
cache
    Whether light that was solved earlier is used again, and what is solved is kept, on this machine (see
    ``SKYPROBE_CACHE_DIR``; drafts are not kept).
"#
    };
    (Night) => {
        r#"Night(*, when='auto', star_limit=8.5, solar_flux_sfu=130.0, zenith_brightness=None, bortle=None, led_share=0.5)
--

What of the night is in a sky with place and time, and how bright what varies is.

At most one of ``zenith_brightness`` and ``bortle`` is given.

Parameters
----------
when
    When Moon, stars and the other lights of the night are in the sky. "auto", "always" or "never". auto: Moon and
    planets always, all else while the Sun's centre is below the horizon or the Sun totally eclipsed; by day it is
    less than a thousandth of the light. A Sun that is put has no night.
star_limit
    Stars to this magnitude are drawn one by one. -2 to 8.5. The light of fainter ones is part of the Milky Way. [V]
solar_flux_sfu
    Solar radio flux at 10.7 cm, on which the airglow depends. 60 to 300. 70 at the Sun's minimum, 130 on average,
    200 at its maximum. [solar flux units]
zenith_brightness
    Brightness of the moonless zenith over a lit country, natural light (22.0) included. 15 to 22; by default no
    artificial light. [mag arcsec-2]
bortle
    The same as a class of light pollution on Bortle's scale: 1 is as dark as it gets, 9 an inner city. 1 to 9; by
    default no artificial light.
led_share
    Share of the artificial light that comes from white LEDs; the rest is that of sodium lamps. 0 to 1.
"#
    };
    (PolarisingFilter) => {
        r#"PolarisingFilter(*, strength=1.0, angle_deg=0.0, held_towards_deg=None)
--

A polarising filter between the sky and the picture: what is seen is I + strength (Q cos 2c + U sin 2c), where c is
the angle of its axis from the vertical. The half of the light that any filter takes is made up for by the exposure.

Parameters
----------
strength
    See the sky through a polarising filter of this strength: 1 is ideal. 0 to 1. Exposed so that unpolarised light
    stays as it is.
angle_deg
    Angle of the filter's axis from the vertical, clockwise as one sees it. -180 to 180. [degrees]
held_towards_deg
    Altitude and azimuth towards which the filter is held, one piece of glass for the whole picture. Altitude -90 to
    90, azimuth -360 to 360; by default it turns with the view. The closer one looks along its axis, the less it
    does. [degrees]
"#
    };
    (Sky.render) => {
        r#"render($self, *, width=2048, projection='latlong', rows='centre', extent='full', turn_deg=0.0, ground='on', sun_disc=True, moon_disc=True, scale='blender', color_space='lin_rec709', gamut='desaturate', polarising_filter=None, tolerance=None, layers=None, progress=None)
--

An image of the light from all directions.

Parameters
----------
width
    Width of the picture, an even number. 64 to 16384. The height follows: half of it for a full latitude-longitude
    picture, a quarter for its upper half, the same for a fisheye. [pixels]
projection
    How directions are laid out. "latlong" or "fisheye". A fisheye has the zenith in its centre.
rows
    Where the rows of a latitude-longitude picture lie. "centre" or "corner". centre is for Blender and most
    viewers, corner for Mitsuba: first and last row on the poles.
extent
    The full sphere, or its upper half. "full" or "upper".
turn_deg
    How far the sky in the picture is turned clockwise as seen from above, to the right. -360 to 360. In a
    latitude-longitude picture by turn / 360 of its width. [degrees]
ground
    What is seen below the horizon: the lit ground, black, or the sky again. "on", "off" or "mirrored".
sun_disc
    Draw the Sun's disc. With its exact energy at every width; left out to light the scene with a Sun lamp.
moon_disc
    Draw the Moon's disc; planets and stars always are. Left out to light the scene with a lamp for it.
scale
    What the number 1.0 in a pixel stands for. "blender", "mitsuba" or "luminance". blender: luminance / 683;
    mitsuba: mean W m-2 sr-1 nm-1; luminance: cd m-2.
color_space
    Colour space of the pixels, always linear. "lin_rec709", "acescg", "lin_rec2020" or "xyz".
gamut
    What becomes of colours outside that space. "desaturate", "clip" or "keep". desaturate: towards the grey of
    their luminance. clip: negative numbers become 0. keep: they stay negative.
polarising_filter
    What is held before the sky.
tolerance
    Relative error that interpolated directions may have. 0.0001 to 0.5; by default as many directions as the
    quality says.
layers
    Factors on the light of layers, 0 to leave one out, as in stars=2. 0 to 1000000000 for each, such as
    ``{"moon": 0.0, "stars": 10.0}``; see ``layer_names``.
progress
    Called with stage and fraction; returning False raises Cancelled.
"#
    };
    (Sky.render_to_file) => {
        r#"render_to_file($self, path, *, width=2048, projection='latlong', rows='centre', extent='full', turn_deg=0.0, ground='on', sun_disc=True, moon_disc=True, scale='blender', color_space='lin_rec709', gamut='desaturate', polarising_filter=None, tolerance=None, layers=None, separate_layers=False, half=None, exposure_stops=0.0, operator='sky', progress=None)
--

Render straight into a file, which appears whole or not at all: the same picture as ``render(...).save(path)``,
without ever being in memory as a whole (but for a PNG).

Parameters
----------
path
    Its suffix says the format: .exr (float), .hdr (Radiance RGBE) or .png (tone mapped, to look at).
width, projection, rows, extent, turn_deg, ground, sun_disc, moon_disc, scale, color_space, gamut, polarising_filter, tolerance, layers
    As for ``render``.
separate_layers
    Whether an EXR file holds each layer beside their sum, in channels such as ``stars.R``.
half, exposure_stops, operator
    As for ``Probe.save``.
progress
    Called with stage and fraction; returning False raises Cancelled, and no file is left behind.
"#
    };
    (Probe.save) => {
        r#"save($self, path, *, half=None, exposure_stops=0.0, operator='sky', progress=None)
--

Write the probe; the file appears whole or not at all.

Parameters
----------
path
    Its suffix says the format: .exr (float), .hdr (Radiance RGBE) or .png (tone mapped, to look at).
half
    EXR with half floats, which end at 65504. True or "refuse": a brighter pixel, such as the Sun's disc, is an
    InputError; "scale": all pixels are multiplied by a power of two, which the header states.
exposure_stops
    Exposure of PNG files relative to the automatic one. -20 to 20. [stops]
operator
    Tone mapping operator of PNG files. "sky", "filmic", "aces", "exposure", "reinhard", "reinhard_local",
    "ashikhmin", "logarithmic" or "linear". More choices: skyprobe tonemap, on an EXR or HDR file.
progress
    Called with stage and fraction; returning False raises Cancelled, and no file is left behind.
"#
    };
}

pub(super) use docstring;
