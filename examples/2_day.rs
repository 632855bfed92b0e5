//! 2. A day over one air: it is solved once, each hour costs a gather. Prints the Sun's altitude and the illuminance of the ground.
//!
//!     cargo run --release --example 2_day

use skyprobe::prelude::*;
use std::sync::Arc;

pub fn main() -> Result<()> {
    let air = AirParameters { preset: Preset::Hazy, ground: Some(Ground::Surface(Surface::Grass)), ..Default::default() };
    let air = Arc::new(Atmosphere::new(&air, Quality::Draft, true)?);
    let lund = Place::new(55.71, 13.19, 20.0)?;
    for hour in (0..24).step_by(3) {
        let time = Time::parse(&format!("2005-06-21T{hour:02}:00"), ZoneChoice::Named("Europe/Stockholm"))?;
        let sky = Sky::new(lund, time, SunModel::Iau, air.clone())?;
        let light = sky.illuminance(&Progress::silent())?;
        let lux = light.direct_horizontal_lx + light.moon_horizontal_lx + light.diffuse_horizontal_lx;
        println!("{hour:02}:00  Sun {:6.2} deg  {lux:12.4} lx", sky.sun().altitude_deg);
    }
    Ok(())
}
