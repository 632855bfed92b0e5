//! How long one waits for a probe of 2048 x 1024 pixels at quality `standard`: the first in a new air, which is solved for it, and the next with another time.
//!
//! ```text
//! cargo run --release --example time_to_first_probe
//! ```

use skyprobe::atmosphere::AirParameters;
use skyprobe::ephemeris::{Place, SunModel};
use skyprobe::probe::{Probe, ProbeSettings, render};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use skyprobe::sky::{Atmosphere, Sky};
use skyprobe::time::{Time, ZoneChoice};
use std::sync::Arc;
use std::time::Instant;

fn probe_at(time: &str, air: &Arc<Atmosphere>) -> skyprobe::Result<Probe> {
    let place = Place::new(55.71, 13.19, 20.0)?;
    let sky = Sky::new(place, Time::parse(time, ZoneChoice::InText)?, SunModel::Iau, air.clone())?;
    let light = sky.light(&Progress::silent())?;
    render(&light, &ProbeSettings { width: 2048, ..Default::default() }, &Progress::silent())
}

fn main() -> skyprobe::Result<()> {
    let start = Instant::now();
    let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Standard, true)?);
    let first = probe_at("2005-06-21T13:00:00+02:00", &air)?;
    println!("first probe, {} x {}, solve included: {:.2} s", first.width, first.height, start.elapsed().as_secs_f64());
    for time in ["2005-06-21T18:30:00+02:00", "2005-06-21T22:15:00+02:00"] {
        let start = Instant::now();
        probe_at(time, &air)?;
        println!("next probe, {time}: {:.3} s", start.elapsed().as_secs_f64());
    }
    Ok(())
}
