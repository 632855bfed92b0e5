//! The header of an OpenEXR file (OpenEXR documentation, "OpenEXR File Layout"): magic number, version, attributes in the order of their names.

use super::super::{Metadata, own_fields};
use super::Packing;
use crate::post::{Picture, View};
use crate::probe::ProbeSettings;
use crate::spectrum::ColorSpace;
use std::collections::BTreeMap;

/// Longest name that the version field below allows [bytes].
const LONGEST_NAME: usize = 31;

/// Attributes by name: type and bytes.
struct Attributes(BTreeMap<String, (&'static str, Vec<u8>)>);

impl Attributes {
    fn put(&mut self, name: &str, kind: &'static str, value: Vec<u8>) {
        debug_assert!(name.len() <= LONGEST_NAME, "{name}");
        self.0.insert(name.to_owned(), (kind, value));
    }

    fn float(&mut self, name: &str, value: f64) {
        self.put(name, "float", (value as f32).to_le_bytes().to_vec());
    }

    fn floats(&mut self, name: &str, kind: &'static str, values: &[f64]) {
        self.put(name, kind, values.iter().flat_map(|&value| (value as f32).to_le_bytes()).collect());
    }

    /// UTF-8, as readers expect.
    fn text(&mut self, name: &str, value: &str) {
        self.put(name, "string", value.as_bytes().to_vec());
    }

    /// Magic number; version 2, one part of scan lines, short names; the attributes.
    fn into_bytes(self) -> Vec<u8> {
        let mut bytes = vec![0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0];
        for (name, (kind, value)) in self.0 {
            bytes.extend([name.as_bytes(), &[0], kind.as_bytes(), &[0], &(value.len() as i32).to_le_bytes(), &value].concat());
        }
        bytes.push(0);
        bytes
    }

    fn window(&mut self, name: &str, width: usize, height: usize) {
        let corners = [0, 0, width as i32 - 1, height as i32 - 1];
        self.put(name, "box2i", corners.into_iter().flat_map(i32::to_le_bytes).collect());
    }
}

/// All bytes before the table of offsets, for pixels packed by `packing`.
pub fn header(settings: &ProbeSettings, metadata: &Metadata, packing: &Packing) -> Vec<u8> {
    let mut attributes = Attributes(BTreeMap::new());
    put_layout(&mut attributes, packing);
    put_meaning(&mut attributes, settings, metadata, packing.scale());
    attributes.into_bytes()
}

/// The same for a picture with its own `fields`.
pub fn picture_header(picture: &Picture, fields: Vec<(String, String)>, packing: &Packing) -> Vec<u8> {
    let mut attributes = Attributes(BTreeMap::new());
    put_layout(&mut attributes, packing);
    let wrap_modes = wrap_modes(picture.view);
    let white_luminance = (!picture.white_luminance_assumed).then_some(picture.white_luminance);
    put_values(&mut attributes, picture.color_space, white_luminance, wrap_modes);
    for (name, value) in fields {
        attributes.text(&name, &value);
    }
    attributes.into_bytes()
}

/// What values and borders of every picture are.
fn put_values(attributes: &mut Attributes, color_space: ColorSpace, white_luminance: Option<f64>, wrap_modes: &str) {
    let space = color_space.chromaticities();
    attributes.floats("chromaticities", "chromaticities", &[space.red, space.green, space.blue, space.white].concat());
    if let Some(luminance) = white_luminance {
        attributes.float("whiteLuminance", luminance);
    }
    attributes.text("wrapmodes", wrap_modes);
    attributes.text("software", concat!("skyprobe ", env!("CARGO_PKG_VERSION")));
    if color_space != ColorSpace::Xyz {
        attributes.text("colorInteropID", color_space.interop_id());
    }
}

/// What every file must say.
fn put_layout(attributes: &mut Attributes, packing: &Packing) {
    let (width, height) = packing.size();
    let mut channels = Vec::new();
    for name in packing.channels() {
        // Type of the samples (1 half, 2 float), flags, a sample for each pixel.
        let kind: i32 = if packing.is_half() { 1 } else { 2 };
        channels.extend([name.as_bytes(), &[0], &kind.to_le_bytes(), &[0; 4]].concat());
        channels.extend([1_i32, 1].into_iter().flat_map(i32::to_le_bytes));
    }
    channels.push(0);
    attributes.put("channels", "chlist", channels);
    attributes.put("compression", "compression", vec![packing.compression()]);
    attributes.put("lineOrder", "lineOrder", vec![0]);
    attributes.window("dataWindow", width, height);
    attributes.window("displayWindow", width, height);
    attributes.float("pixelAspectRatio", 1.0);
    attributes.floats("screenWindowCenter", "v2f", &[0.0, 0.0]);
    attributes.float("screenWindowWidth", 1.0);
}

/// What lies beyond the borders, for the attribute of that name.
fn wrap_modes(view: View) -> &'static str {
    if matches!(view, View::LatLong { .. }) { "periodic,clamp" } else { "black" }
}

/// What the numbers in the file are.
fn put_meaning(attributes: &mut Attributes, settings: &ProbeSettings, metadata: &Metadata, scale: f32) {
    let wrap_modes = wrap_modes(settings.view());
    let white_luminance = settings.scale.white_luminance() / f64::from(scale);
    put_values(attributes, settings.color_space, Some(white_luminance), wrap_modes);
    let places = [("latitude", metadata.latitude_deg), ("longitude", metadata.longitude_deg), ("altitude", metadata.elevation_m)];
    // OpenEXR: UTC = local time + utcOffset.
    for (name, value) in places.into_iter().chain([("utcOffset", metadata.utc_offset_s.map(|value| -value))]) {
        if let Some(value) = value {
            attributes.float(name, value);
        }
    }
    if let Some(date) = &metadata.capture_date {
        attributes.text("capDate", date);
    }
    let warning =
        (scale != 1.0).then(|| format!("The pixels are multiplied by {scale} to fit half floats: divide by it for true values."));
    let comments: Vec<String> = warning.into_iter().chain(metadata.comments.clone()).collect();
    if !comments.is_empty() {
        attributes.text("comments", &comments.join("\n"));
    }
    for (name, value) in own_fields(settings, metadata) {
        attributes.text(&name, &value);
    }
    if scale != 1.0 {
        attributes.float("skyprobe.pixel_scale", f64::from(scale));
    }
}
