//! Portraits of the Moon's disc alone, without air: phases with earthshine, and the Earth's shadow.
//!
//! ```text
//! cargo run --release --example moon_portraits FOLDER
//! ```
//!
//! Writes `phases.png` (0, 30, 90, 150 degrees waxing, 90 waning, 165), `phases_night.png` (the same, exposed for the dark side) and
//! `eclipse.png` (the Moon 0, 15, 25, 30, 40 and 60 arcminutes from the axis of the shadow, luminance compressed as L / (L + median),
//! so that rim and umbra are seen together).

use glam::DVec3;
use skyprobe::celestial::{MoonDisc, MoonView};
use skyprobe::spectrum::{ColorSpace, Gamut, solar, wavelengths, xyz_weights};
use std::path::Path;

const SIZE: usize = 512;

/// Linear Rec. 709 of each pixel of a square around the disc [W m-2 sr-1].
fn portrait(disc: &MoonDisc) -> Vec<[f64; 3]> {
    let nodes = wavelengths(32);
    let weights = xyz_weights(&nodes, |w| solar::irradiance(w, 1.0));
    // Each component once: what is left per pixel is a mix of numbers.
    let components: Vec<[f64; 3]> = (0..disc.components())
        .map(|c| {
            let spectrum: Vec<f64> = nodes.iter().map(|&w| disc.spectrum(c, w)).collect();
            let xyz = std::array::from_fn(|i| weights.iter().zip(&spectrum).map(|(w, s)| w[i] * s).sum());
            ColorSpace::LinRec709.from_xyz(xyz)
        })
        .collect();
    let channel: [Vec<f64>; 3] = std::array::from_fn(|i| components.iter().map(|rgb| rgb[i]).collect());
    let reach = disc.view().angular_radius() * 1.08;
    (0..SIZE * SIZE)
        .map(|pixel| {
            let across = |i: usize| (2.0 * (i as f64 + 0.5) / SIZE as f64 - 1.0) * reach;
            let direction = DVec3::new(across(pixel % SIZE), 1.0, -across(pixel / SIZE)).normalize();
            disc.at(direction).map_or([0.0; 3], |point| std::array::from_fn(|i| point.mix(&channel[i])))
        })
        .collect()
}

/// Green of the pixel that outshines the given share of the disc.
fn quantile(picture: &[[f64; 3]], share: f64) -> f64 {
    let mut greens: Vec<f64> = picture.iter().map(|rgb| rgb[1]).filter(|&g| g > 0.0).collect();
    greens.sort_by(f64::total_cmp);
    greens[(greens.len() as f64 * share) as usize]
}

/// Pictures side by side, three in a row, with values from 0 to 1.
fn save(path: &Path, pictures: &[Vec<[f64; 3]>]) {
    let rows = pictures.len().div_ceil(3);
    let luminance = ColorSpace::LinRec709.matrix_to_xyz()[1];
    let image = image::RgbImage::from_fn((3 * SIZE) as u32, (rows * SIZE) as u32, |x, y| {
        let (x, y) = (x as usize, y as usize);
        let Some(picture) = pictures.get(y / SIZE * 3 + x / SIZE) else { return image::Rgb([0; 3]) };
        let rgb = Gamut::Desaturate.apply(picture[y % SIZE * SIZE + x % SIZE], luminance);
        image::Rgb(rgb.map(|value| {
            let value = value.clamp(0.0, 1.0);
            let encoded = if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 };
            (255.0 * encoded + 0.5) as u8
        }))
    });
    image.save(path).expect("the folder can be written");
    println!("{}", path.display());
}

fn exposed(picture: &[[f64; 3]], white: f64) -> Vec<[f64; 3]> {
    picture.iter().map(|rgb| rgb.map(|value| value / white)).collect()
}

fn compressed(picture: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let middle = quantile(picture, 0.5);
    picture.iter().map(|rgb| rgb.map(|value| 0.7 * value / (rgb[1].max(0.3 * rgb[0]) + middle))).collect()
}

fn main() -> skyprobe::Result<()> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "target".into());
    let folder = Path::new(&folder);
    let phases: Vec<_> = [0.0, 30.0, 90.0, 150.0, -90.0, 165.0]
        .into_iter()
        .map(|phase| Ok(portrait(&MoonDisc::with_shadow(MoonView::schematic(phase), None)?)))
        .collect::<skyprobe::Result<_>>()?;
    save(&folder.join("phases.png"), &phases.iter().map(|p| exposed(p, 1.3 * quantile(p, 0.9))).collect::<Vec<_>>());
    save(&folder.join("phases_night.png"), &phases.iter().map(|p| exposed(p, 8e-4)).collect::<Vec<_>>());
    let eclipse: Vec<_> = [0.0, 15.0, 25.0, 30.0, 40.0, 60.0]
        .into_iter()
        .map(|minutes| Ok(compressed(&portrait(&MoonDisc::new(MoonView::schematic(minutes / 60.0))?))))
        .collect::<skyprobe::Result<_>>()?;
    save(&folder.join("eclipse.png"), &eclipse);
    Ok(())
}
