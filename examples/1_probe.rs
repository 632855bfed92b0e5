//! 1. A light probe in five lines: a place, a time, a file.
//!
//!     cargo run --release --example 1_probe -- sky.exr

use skyprobe::prelude::*;
use std::sync::Arc;

fn main() -> Result<()> {
    write(&std::env::args().nth(1).unwrap_or_else(|| "sky.exr".to_owned()))
}

pub fn write(file: &str) -> Result<()> {
    let scene = Scene::from_json(r#"{"place": "Lund, Sweden", "time": "2005-06-21T13:00", "probe": {"width": 1024}}"#)?;
    let sky = scene.sky(Arc::new(scene.atmosphere()?.with_cache(Cache::of_user())))?;
    let probe = render(&sky.light_by(&scene.light, &Progress::silent())?, &scene.probe, &Progress::silent())?;
    save(file, &probe, &scene.file, &describe(&sky, scene.sun_model, &scene.light, &scene.probe))
}
