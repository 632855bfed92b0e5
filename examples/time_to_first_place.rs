//! How long the first questions of a process take, which unpack gazetteer, map of heights and zones.

use skyprobe::places::{count, elevation_m, search};
use skyprobe::time::zone_of_place;
use std::time::Instant;

fn main() -> skyprobe::Result<()> {
    let start = Instant::now();
    let lund = search("lund, sweden", 1)[0];
    println!("first search {:6.1} ms, of {} places", start.elapsed().as_secs_f64() * 1e3, count());
    let start = Instant::now();
    elevation_m(lund.latitude_deg, lund.longitude_deg)?;
    println!("first height {:6.1} ms", start.elapsed().as_secs_f64() * 1e3);
    let start = Instant::now();
    zone_of_place(lund.latitude_deg, lund.longitude_deg)?;
    println!("first zone   {:6.1} ms", start.elapsed().as_secs_f64() * 1e3);
    Ok(())
}
