# SPDX-License-Identifier: GPL-3.0-or-later
"""What enumerations offer: (name in the library, label, what it is)."""

# An item of an enumeration that leaves a value to the preset.
OF_PRESET = "preset"

PRESETS = (
    ("clear", "Clear", "A clear day in the country, over grass"),
    ("pure", "Pure", "Molecules and ozone only, over grass"),
    ("hazy", "Hazy", "A hazy summer day in the country"),
    ("polluted", "Polluted", "A polluted day over land"),
    ("urban", "Urban", "A large town"),
    ("maritime", "Maritime", "The open sea"),
    ("desert", "Desert", "Dusty air over sand"),
    ("antarctic", "Antarctic", "The clearest air there is, over snow"),
    ("fog", "Fog", "A layer of fog over land"),
    ("volcanic", "Volcanic", "A clear day after a great eruption: purple twilights"),
    ("thesis", "Thesis", "Simple haze without ozone, as in the thesis that this work began with"),
)
AEROSOLS = (
    (OF_PRESET, "As the Preset", "The particles of the chosen preset"),
    ("none", "None", "No particles at all"),
    ("continental_clean", "Continental, Clean", "Remote land, no soot"),
    ("continental_average", "Continental, Average", "Settled land with some soot"),
    ("continental_polluted", "Continental, Polluted", "Land near towns and industry"),
    ("urban", "Urban", "A large town: much soot"),
    ("maritime_clean", "Maritime, Clean", "Open sea: salt"),
    ("maritime_polluted", "Maritime, Polluted", "Sea near inhabited coasts: salt and soot"),
    ("maritime_tropical", "Maritime, Tropical", "Tropical sea: salt, little else"),
    ("desert", "Desert", "Mineral dust"),
    ("arctic", "Arctic", "Far north in spring: haze from the continents"),
    ("antarctic", "Antarctic", "Droplets of sulphate"),
    ("fog", "Fog", "Droplets of water in a layer with a top"),
    ("thesis", "Thesis", "Simple haze that only scatters"),
)
GROUNDS = (
    (OF_PRESET, "As the Preset", "The ground of the chosen preset"),
    ("grass", "Grass", "A meadow"),
    ("forest", "Forest", "A wood from above"),
    ("soil", "Soil", "Bare dry earth"),
    ("desert", "Desert", "Pale sand"),
    ("snow", "Snow", "Clean fresh snow"),
    ("sea", "Sea", "The open sea"),
    ("city", "City", "Roofs, streets, some trees"),
    ("asphalt", "Asphalt", "Worn asphalt"),
)
# Bortle's classes by their number.
NO_TOWNS = "none"
TOWNS = (
    (NO_TOWNS, "None", "A natural sky without artificial light"),
    ("1", "1: Excellent Dark Site", "As dark as it gets: the Milky Way casts shadows"),
    ("2", "2: Truly Dark Site", "Clouds are black holes in the sky"),
    ("3", "3: Rural", "A glow at the horizon"),
    ("4", "4: Rural, Near Suburbs", "Domes of light over towns; the Milky Way still has structure"),
    ("5", "5: Suburban", "Only hints of the Milky Way at the horizon"),
    ("6", "6: Bright Suburban", "The Milky Way shows at the zenith only"),
    ("7", "7: Suburbs and City", "The whole sky is grey; hardly a trace of the Milky Way"),
    ("8", "8: City", "The sky glows; one can read headlines by it"),
    ("9", "9: Inner City", "Only Moon, planets and the brightest stars are left"),
)
QUALITIES = (
    ("draft", "Draft", "As the live preview"),
    ("standard", "Standard", "For pictures"),
    ("high", "High", "For pictures that are measured"),
    ("reference", "Reference", "To check the others; slow"),
)
# Width of a probe by its name among users of panoramas.
WIDTHS = (
    ("1024", "1k", "1024 x 512: light only"),
    ("2048", "2k", "2048 x 1024: light and soft backgrounds"),
    ("4096", "4k", "4096 x 2048: backgrounds"),
    ("8192", "8k", "8192 x 4096: large backgrounds, the Moon's face"),
    ("16384", "16k", "16384 x 8192: as fine as Blender takes"),
    ("OTHER", "Other", "A width of your own"),
)
# Layers of the light, by their names in the library.
LAYERS = (
    ("sky", "Sky", "Light of Sun and Moon scattered by the air, and the ground"),
    ("sun", "Sun", "The disc of the Sun, as a lamp or in the map"),
    ("moon", "Moon", "The disc of the Moon, as a lamp or in the map"),
    ("stars", "Stars", "The stars, one by one"),
    ("planets", "Planets", "Mercury to Neptune"),
    ("milky_way", "Milky Way", "The light of all fainter stars"),
    ("zodiacal", "Zodiacal Light", "Sunlight on the dust between the planets"),
    ("airglow", "Airglow", "The faint glow of the upper air itself"),
    ("light_pollution", "Town Light", "Light of towns that the air scatters"),
)
