//! Every word that an option or a key can be: what is read is written as it was read.
#![no_main]

use libfuzzer_sys::fuzz_target;
use skyprobe::{atmosphere, ephemeris, io, places, post, probe, quality, sky, spectrum, units};

fn read<T: std::str::FromStr<Err = skyprobe::Error>>(text: &str) {
    if let Err(error) = text.parse::<T>() {
        assert!(!error.to_string().is_empty());
    }
}

fuzz_target!(|text: &str| {
    read::<atmosphere::AerosolType>(text);
    read::<atmosphere::Ground>(text);
    read::<atmosphere::Preset>(text);
    read::<atmosphere::StandardAtmosphere>(text);
    read::<ephemeris::MoonModel>(text);
    read::<ephemeris::Planet>(text);
    read::<ephemeris::SunModel>(text);
    read::<ephemeris::Target>(text);
    read::<io::Half>(text);
    read::<places::CoordinateStyle>(text);
    read::<post::PictureProjection>(text);
    read::<post::glare::AdaptationState>(text);
    read::<post::tone::Display>(text);
    read::<post::tone::OperatorName>(text);
    read::<probe::Extent>(text);
    read::<probe::GroundView>(text);
    read::<probe::Projection>(text);
    read::<probe::Rows>(text);
    read::<quality::Quality>(text);
    read::<sky::Layer>(text);
    read::<sky::Model>(text);
    read::<sky::When>(text);
    read::<spectrum::ColorSpace>(text);
    read::<units::Scale>(text);
});
