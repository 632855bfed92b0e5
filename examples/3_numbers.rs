//! 3. Numbers instead of pictures: spectral radiance along the Sun's vertical, and how polarised it is.
//!
//!     cargo run --release --example 3_numbers

use glam::DVec3;
use skyprobe::prelude::*;
use std::sync::Arc;

pub fn main() -> Result<()> {
    let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true)?);
    let sky = Sky::with_sun(30.0, 180.0, 0.0, air)?;
    let altitudes = [5.0_f64, 30.0, 60.0, 90.0];
    // Away from the Sun, which stands in the south: x = east, y = north, z = up.
    let directions: Vec<DVec3> = altitudes.iter().map(|a| DVec3::new(0.0, a.to_radians().cos(), a.to_radians().sin())).collect();
    let stokes = sky.stokes(&directions, &[450.0, 650.0], &Progress::silent())?;
    for (altitude, [blue, red]) in altitudes.iter().zip(stokes.as_chunks::<3>().0.as_chunks::<2>().0) {
        let degree = |[i, q, u]: [f64; 3]| q.hypot(u) / i;
        println!(
            "altitude {altitude:2} deg: 450 nm {:.5} W m-2 sr-1 nm-1, {:2.0} % polarised; 650 nm {:.5}, {:2.0} %",
            blue[0],
            100.0 * degree(*blue),
            red[0],
            100.0 * degree(*red)
        );
    }
    Ok(())
}
