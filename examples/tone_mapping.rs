//! Pictures of tone mapping: `cargo run --release --example tone_mapping FOLDER`.
//!
//! Writes `day_to_night.png` (one evening and two nights by the sky operator at one setting, a camera of 60 degrees), `operators.png` (a low Sun by all operators)
//! and `night_operators.png` (a moonlit night by all operators).

use skyprobe::atmosphere::AirParameters;
use skyprobe::ephemeris::{Place, SunModel};
use skyprobe::post::tone::{Display, OperatorName, Sheet, ToneMapper, ToneMapping};
use skyprobe::post::{Picture, View};
use skyprobe::probe::{Grid, Probe, ProbeSettings, render};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use skyprobe::sky::{Atmosphere, LightOptions, Sky};
use skyprobe::time::{Time, ZoneChoice};
use std::path::Path;
use std::sync::Arc;

/// Width of the probes that the camera looks into [pixels].
const PROBE_WIDTH: usize = 8192;

/// A camera: size of its pictures [pixels], angle between left and right border, height of the middle above the horizon [degrees].
struct Camera {
    size: (usize, usize),
    field_of_view_deg: f64,
    altitude_deg: f64,
}

const UPRIGHT: Camera = Camera { size: (640, 800), field_of_view_deg: 60.0, altitude_deg: 30.0 };

const WIDE: Camera = Camera { size: (1280, 640), field_of_view_deg: 90.0, altitude_deg: 20.0 };

fn sky_at(air: &Arc<Atmosphere>, time: Time) -> skyprobe::Result<Sky> {
    Sky::new(Place::new(55.71, 13.19, 20.0)?, time, SunModel::Iau, Arc::clone(air))
}

/// The time in the twelve hours after `noon` when the Sun stands at `altitude_deg`.
fn time_of(air: &Arc<Atmosphere>, noon: Time, altitude_deg: f64) -> skyprobe::Result<Time> {
    let (mut low, mut high) = (0.0, 12.0);
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        let above = sky_at(air, noon.plus_hours(middle)?)?.sun().altitude_deg > altitude_deg;
        if above { low = middle } else { high = middle }
    }
    noon.plus_hours(low)
}

fn probe_of(sky: &Sky) -> skyprobe::Result<Probe> {
    let light = sky.light_by(&LightOptions::default(), &Progress::silent())?;
    render(&light, &ProbeSettings { width: PROBE_WIDTH, ..Default::default() }, &Progress::silent())
}

/// What `camera` sees of `probe` towards `azimuth_deg`: the mean over each of its pixels.
fn photograph(probe: &Probe, camera: &Camera, azimuth_deg: f64) -> skyprobe::Result<Picture> {
    let &Camera { size: (width, height), field_of_view_deg, altitude_deg } = camera;
    let grid: Grid = probe.grid();
    let (sin, cos) = altitude_deg.to_radians().sin_cos();
    let (east, north) = azimuth_deg.to_radians().sin_cos();
    let forward = glam::DVec3::new(east * cos, north * cos, sin);
    let right = glam::DVec3::new(north, -east, 0.0);
    let up = right.cross(forward);
    let scale = 2.0 * (0.5 * field_of_view_deg).to_radians().tan() / width as f64;
    let mut pixels = Vec::with_capacity(3 * width * height);
    const PARTS: usize = 4;
    for row in 0..height {
        for column in 0..width {
            let mut sum = [0.0; 3];
            for part in 0..PARTS * PARTS {
                let dx = ((part % PARTS) as f64 + 0.5) / PARTS as f64 + column as f64 - 0.5 * width as f64;
                let dy = ((part / PARTS) as f64 + 0.5) / PARTS as f64 + row as f64 - 0.5 * height as f64;
                let (x, y) =
                    grid.coordinates((forward + right * dx * scale - up * dy * scale).normalize()).expect("all directions");
                let nearest = |at: f64, size: usize| (at.max(0.0) as usize).min(size - 1);
                let pixel = probe.pixel(nearest(x.rem_euclid(probe.width as f64), probe.width), nearest(y, probe.height));
                (0..3).for_each(|k| sum[k] += pixel[k] / (PARTS * PARTS) as f32);
            }
            pixels.extend(sum);
        }
    }
    let view = View::Perspective { horizontal_field_of_view_deg: field_of_view_deg };
    Picture::new(width, height, pixels, probe.settings.color_space, probe.settings.scale.white_luminance(), view)
}

fn save(path: &Path, sheet: &Sheet) {
    let image = image::RgbImage::from_raw(sheet.width as u32, sheet.height as u32, sheet.pixels.clone());
    image.expect("a sheet has all its pixels").save(path).expect("the folder can be written");
    println!("{}", path.display());
}

fn main() -> skyprobe::Result<()> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "target".into());
    let folder = Path::new(&folder);
    let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Standard, true)?);
    let parse = |text: &str| Time::parse(text, ZoneChoice::InText);
    let noon = parse("2005-09-03T13:05:00+02:00")?;
    let evening = |altitude: f64| -> skyprobe::Result<Sky> { sky_at(&air, time_of(&air, noon.clone(), altitude)?) };
    // West of the meridian by the azimuth of sunset.
    let azimuth = evening(0.0)?.sun().azimuth_deg;
    let mut shots = vec![("noon".to_string(), sky_at(&air, noon.clone())?, azimuth)];
    for altitude in [20.0, 10.0, 5.0, 2.0, 0.0, -3.0, -6.0, -9.0, -12.0] {
        shots.push((format!("Sun {altitude}"), evening(altitude)?, azimuth));
    }
    let moon = || -> skyprobe::Result<Sky> { sky_at(&air, parse("2005-11-16T00:15:00+01:00")?) };
    let milky_way = sky_at(&air, parse("2005-09-03T23:30:00+02:00")?)?;
    shots.push(("full Moon".into(), moon()?, 185.0));
    shots.push(("starlight".into(), milky_way, 235.0));
    let cell = (UPRIGHT.size.0 / 2, UPRIGHT.size.1 / 2);
    let mut strip = Sheet::new(shots.len(), 6, cell)?;
    for (index, (label, sky, azimuth)) in shots.iter().enumerate() {
        let picture = photograph(&probe_of(sky)?, &UPRIGHT, *azimuth)?;
        let settings = ToneMapping::with(OperatorName::Sky);
        let mapper = ToneMapper::new(&picture, &settings, &Progress::silent())?;
        println!(
            "{label}: Sun at {:.2} degrees, adapted to {:.3e} cd m-2, EV {:.2}",
            sky.sun().altitude_deg,
            mapper.adaptation(),
            mapper.ev100()
        );
        strip.put(index, &mapper, Display::Srgb, label);
    }
    save(&folder.join("day_to_night.png"), &strip);

    let low_sun = evening(8.0)?;
    for (name, sky, azimuth) in [("operators.png", &low_sun, low_sun.sun().azimuth_deg), ("night_operators.png", &moon()?, 185.0)]
    {
        let picture = photograph(&probe_of(sky)?, &WIDE, azimuth)?;
        save(&folder.join(name), &Sheet::compare(&picture, &ToneMapping::default(), &Progress::silent())?);
    }
    Ok(())
}
