//! Rebuilds `data/aerosol_particles.bin`: Mie theory for all kinds of particles that hazes are mixed from. Some minutes.
//!
//! ```text
//! cargo run --release --example tabulate_mie data/aerosol_particles.bin
//! ```

use skyprobe::atmosphere::particle_tables;
use std::time::Instant;

fn main() -> std::io::Result<()> {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("usage: tabulate_mie FILE");
        std::process::exit(2);
    };
    let start = Instant::now();
    let bytes = particle_tables::tabulate();
    std::fs::write(&path, &bytes)?;
    println!("{path}: {} bytes, {:.1} s", bytes.len(), start.elapsed().as_secs_f64());
    Ok(())
}
