//! Files of pictures: EXR, HDR, PNG; written whole or not at all.

pub mod atomic;
pub mod exr;
mod files;
pub mod hdr;
mod leftovers;
mod limits;
pub mod metadata;
mod names;
pub mod png;
mod read;
mod row_file;
mod sample_map;
mod stream;
mod write;

pub use atomic::{check_writable, write_atomically};
pub use files::{STANDARD, check_files, each_once, is_same_file};
pub use limits::PictureLimits;
pub use metadata::Metadata;
pub use png::Depth;
pub use read::{PictureHints, read_exr_bytes, read_hdr_bytes, read_picture};
pub use sample_map::SampleMap;
pub use stream::render_to_files;
pub(crate) use stream::render_with;
pub use write::{write_picture, write_sheet, write_toned};

use crate::error::{Error, Result};
use crate::parameter::parameters;
use crate::post::tone::{Exposure, Frame, OperatorName, ToneMapper, ToneMapping};
use crate::probe::{Probe, ProbeSettings, Projection};
use crate::progress::Progress;
use crate::words::{Words, words};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Whether and how an EXR file uses half floats, which end at 65504: the Sun's disc is brighter. They also have no more than
/// a few steps below 1e-6: a dark night needs float32.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Half {
    /// Float32.
    #[default]
    Off,
    /// Half floats; a pixel over 65504 is an error.
    Refuse,
    /// Half floats; if a pixel is over 65504, all are multiplied by a power of two, which the header states as `skyprobe.pixel_scale`
    /// and in its comments. [`exr::half_scale`] tells it beforehand.
    Scale,
}

words!(Half, "half", { Off => "off", Refuse => "refuse", Scale => "scale" });

parameters! {
    /// Choices that belong to the file rather than to the light.
    pub struct FileOptions in "file", named "" in messages {
        /// Whether and how EXR files have half floats, which end at 65504, below the Sun's disc in most scales.
        half: Half = Half::default() => words(Half::WORDS).default("\"off\"").option("half", "NAME")
            .more("refuse: a brighter pixel is an error. scale: all pixels are multiplied by a power of two, which the header states. off: float32.");
        /// Exposure of PNG files relative to the automatic one.
        exposure_stops: f64 = 0.0 => number(-20.0, 20.0, "stops").default("0.0").option("exposure", "STOPS");
        /// Tone mapping operator of PNG files.
        operator: OperatorName = OperatorName::default() => words(OperatorName::WORDS).default("\"sky\"").option("operator", "NAME")
            .more("More choices: skyprobe tonemap, on an EXR or HDR file.");
        /// Write each layer into EXR files beside their sum, in channels such as stars.R.
        ///
        /// Colours outside the space are then dealt with layer by layer ([`Layer`](crate::sky::Layer)).
        layers: bool = false => flag().default("false").option("separate-layers", "");
    }
}

impl FileOptions {
    /// How a probe is brought to a PNG.
    ///
    /// # Errors
    /// [`Error::Input`] for an exposure out of range.
    fn tone_mapping(&self) -> Result<ToneMapping> {
        self.check_ranges()?;
        Ok(ToneMapping { exposure: Exposure::Automatic { stops: self.exposure_stops }, ..ToneMapping::with(self.operator) })
    }
}

/// A kind of file, by the suffix of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// OpenEXR.
    Exr,
    /// Radiance RGBE.
    Hdr,
    /// Tone-mapped, to look at.
    Png,
}

impl Format {
    /// The format that the suffix of `path` names: `.exr`, `.hdr` or `.png`, in either case.
    ///
    /// # Errors
    /// [`Error::Input`] for the parameter `output`.
    pub fn of(path: &Path) -> Result<Self> {
        let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_ascii_lowercase());
        match suffix.as_deref() {
            Some("exr") => Ok(Self::Exr),
            Some("hdr") => Ok(Self::Hdr),
            Some("png") => Ok(Self::Png),
            _ => Err(Error::input("output", path.display(), "the name of a file that ends in .exr, .hdr or .png")),
        }
    }
}

/// Checks before any work that [`save`] can write to `path`: a known suffix, a folder that can be written to.
///
/// # Errors
/// [`Error::Input`] for an unknown suffix, [`Error::File`] for a place that cannot be written to.
pub fn check_output(path: impl AsRef<Path>) -> Result<()> {
    Format::of(path.as_ref())?;
    check_writable(path.as_ref())
}

/// Writes `probe` to `path` in the format that its suffix names, whole or not at all.
///
/// # Errors
/// [`Error::Input`] for an unknown suffix, options out of range, or pixels that half floats cannot hold; [`Error::File`].
pub fn save(path: impl AsRef<Path>, probe: &Probe, options: &FileOptions, metadata: &Metadata) -> Result<()> {
    save_with_progress(path, probe, (options, metadata), &Progress::silent())
}

/// As [`save`]. Progress is the stage "write", for a PNG after "tone map".
///
/// # Errors
/// As [`save`]; [`Error::Cancelled`], and there is no file.
pub fn save_with_progress(
    path: impl AsRef<Path>,
    probe: &Probe,
    (options, metadata): (&FileOptions, &Metadata),
    progress: &Progress<'_>,
) -> Result<()> {
    let path = path.as_ref();
    let tone = options.tone_mapping()?;
    let format = Format::of(path)?;
    check_writable(path)?;
    probe.validate()?;
    match format {
        Format::Png => {
            let mapper = ToneMapper::new(Frame::from(probe), &tone, progress)?;
            write_toned(path, &mapper, Depth::Eight, progress)
        }
        Format::Exr | Format::Hdr => stream::write_probe(path, probe, (options, metadata), progress),
    }
}

/// Name and value of what the headers of all formats say about a probe.
fn own_fields(settings: &ProbeSettings, metadata: &Metadata) -> Vec<(String, String)> {
    let mut fields = vec![
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("projection", settings.projection.name().to_owned()),
        ("extent", settings.extent.name().to_owned()),
        ("ground", settings.ground.name().to_owned()),
        ("sun_disc", settings.sun_disc.to_string()),
        ("moon_disc", settings.moon_disc.to_string()),
        ("scale", settings.scale.name().to_owned()),
        ("color_space", settings.color_space.name().to_owned()),
    ];
    if settings.projection == Projection::LatLong {
        fields.push(("rows", settings.rows.name().to_owned()));
    }
    // Absent in pictures that are not turned, as in those of other programs.
    if settings.turn_deg != 0.0 {
        fields.push(("turn_deg", settings.turn_deg.to_string()));
    }
    for (name, value) in [("sun_altitude_deg", metadata.sun_altitude_deg), ("sun_azimuth_deg", metadata.sun_azimuth_deg)] {
        if let Some(value) = value {
            fields.push((name, format!("{value:.6}")));
        }
    }
    if let Some(config) = &metadata.config_json {
        fields.push(("config", config.clone()));
    }
    fields.into_iter().map(|(name, value)| (format!("skyprobe.{name}"), value)).collect()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) fn gradient(settings: ProbeSettings) -> Probe {
        let count = 3 * settings.width * settings.height();
        Probe::new((0..count).map(|k| 0.01 + (k % 977) as f32 * 0.37).collect(), settings).unwrap()
    }

    #[test]
    fn suffixes_choose_and_unknown_ones_are_refused() {
        for (name, format) in [("a.exr", Format::Exr), ("b.HDR", Format::Hdr), ("c.d.png", Format::Png)] {
            assert_eq!(Format::of(Path::new(name)).unwrap(), format);
        }
        for name in ["sky", "sky.jpg", ".exr", ""] {
            assert!(Format::of(Path::new(name)).unwrap_err().to_string().starts_with("output = "), "{name}");
        }
    }

    #[test]
    fn every_format_is_written_and_read_by_others() {
        let folder = tempfile::tempdir().unwrap();
        let probe = gradient(ProbeSettings { width: 64, ..Default::default() });
        for name in ["sky.exr", "sky.hdr", "sky.png"] {
            let path = folder.path().join(name);
            check_output(&path).unwrap();
            save(&path, &probe, &FileOptions::default(), &Metadata::default()).unwrap();
            assert!(std::fs::metadata(&path).unwrap().len() > 100);
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 3);
        let png = image::open(folder.path().join("sky.png")).unwrap().to_rgb8();
        assert_eq!(png.dimensions(), (64, 32));
    }

    #[test]
    fn bad_options_leave_no_file() {
        let folder = tempfile::tempdir().unwrap();
        let probe = gradient(ProbeSettings { width: 64, ..Default::default() });
        let options = FileOptions { exposure_stops: f64::NAN, ..Default::default() };
        assert!(save(folder.path().join("a.png"), &probe, &options, &Metadata::default()).is_err());
        assert!(save(folder.path().join("a.txt"), &probe, &FileOptions::default(), &Metadata::default()).is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
