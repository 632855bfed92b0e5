//! The light of a sky as an ordered stack of what it is made of: each part stands before what is farther away, and belongs to a layer that can be scaled, left out, or looked at alone.
//!
//! A part at one [`Distance`] has light L and lets through T of what is behind it. Nearer over farther is
//! ```text
//! (L1, T1) over (L2, T2) = (L1 + T1 L2, T1 T2),
//! ```
//! component by component in X, Y and Z (Porter & Duff 1984, with a colour for 1 - alpha); it is associative and does not commute. Parts at one distance stand beside one another: their light adds up,
//! the product of their transmittances dims what is behind. A layer alone is its light as it arrives, dimmed by all that stands before it, so that the layers add up to the picture whatever is scaled:
//! a factor is on a layer's light, not on what it hides, and only 0 takes the layer away with both.

mod dimmed;
mod part;
#[cfg(test)]
mod tests;

use super::disc::{Disc, Point};
use super::options::Layer;
use super::sky_light::SkyLight;
use dimmed::Before;
pub use part::{Distance, Part, Transmittance};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The light of a sky, whole and by layers.
pub struct Layers {
    horizon: f64,
    /// From far to near.
    parts: BTreeMap<(Distance, Layer), Scaled>,
    /// Whether anything stands before anything.
    hides: bool,
}

/// All parts of one layer at one distance.
struct Scaled {
    scale: f32,
    smooth: Vec<Box<dyn SkyLight + Send>>,
    discs: Vec<Disc>,
    points: Vec<Point>,
    transmittances: Vec<Arc<dyn Transmittance>>,
}

/// Directions for which there is room without asking for memory.
const FEW: usize = 64;

impl Layers {
    /// A sky without light, with the horizon at the altitude `horizon` [radians].
    pub fn new(horizon: f64) -> Self {
        Self { horizon, parts: BTreeMap::new(), hides: false }
    }

    /// Adds `part` to `layer`, its light times `scale`; of scale 0 it stays away with what it hides.
    pub fn add(&mut self, layer: Layer, scale: f64, part: Part) {
        if scale > 0.0 {
            self.hides |= part.transmittance.is_some();
            let empty = || Scaled {
                scale: scale as f32,
                smooth: Vec::new(),
                discs: Vec::new(),
                points: Vec::new(),
                transmittances: Vec::new(),
            };
            let there = self.parts.entry((part.distance, layer)).or_insert_with(empty);
            there.smooth.extend(part.smooth);
            there.discs.extend(part.discs);
            there.points.extend(part.points);
            there.transmittances.extend(part.transmittance);
        }
    }

    /// The layers that there are.
    pub fn names(&self) -> Vec<Layer> {
        self.parts.keys().map(|(_, layer)| *layer).collect::<BTreeSet<_>>().into_iter().collect()
    }

    /// The light of `layer` alone, as it arrives; none if there is no such layer.
    pub fn only(&self, layer: Layer) -> OneLayer<'_> {
        OneLayer { layers: self, layer }
    }

    /// The parts of `layer`, or of all, from far to near.
    fn each(&self, layer: Option<Layer>) -> impl Iterator<Item = (Distance, &Scaled)> {
        let of_layer = move |(key, _): &(&(Distance, Layer), _)| layer.is_none_or(|layer| layer == key.1);
        self.parts.iter().filter(of_layer).map(|((distance, _), part)| (*distance, part))
    }

    /// All that dims light of `distance`.
    fn before(&self, distance: Distance) -> Before {
        let nearer = self.parts.iter().filter(|((other, _), _)| *other > distance);
        nearer.flat_map(|(_, part)| part.transmittances.iter().cloned()).collect()
    }

    /// Adds up the smooth radiance of `layer`, or of all, along a circle of equal altitude, from far to near.
    fn circle(&self, layer: Option<Layer>, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        fill(out, |space, out| {
            if !self.hides {
                return self.each(layer).for_each(|(_, part)| part.add_circle(altitude, azimuths, space, out));
            }
            for distance in Distance::ALL {
                let here = || self.parts.iter().filter(move |((other, _), _)| *other == distance);
                for one in here().flat_map(|(_, part)| &part.transmittances) {
                    one.transmittance_circle(altitude, azimuths, space);
                    out.as_flattened_mut().iter_mut().zip(space.as_flattened()).for_each(|(light, share)| *light *= share);
                }
                let lit = here().filter(|((_, other), _)| layer.is_none_or(|layer| layer == *other));
                lit.for_each(|(_, part)| part.add_circle(altitude, azimuths, space, out));
            }
        });
    }

    fn seen_discs(&self, layer: Option<Layer>) -> Vec<Disc> {
        let seen = |(distance, part): (Distance, &Scaled)| {
            let scale = f64::from(part.scale);
            let scaled = part.discs.iter().map(|disc| Disc { irradiance: disc.irradiance.map(|v| v * scale), ..disc.clone() });
            let before = self.before(distance);
            if before.is_empty() {
                return scaled.collect::<Vec<_>>();
            }
            scaled.filter_map(|disc| dimmed::disc(&disc, self.horizon, &before)).collect()
        };
        self.each(layer).flat_map(seen).collect()
    }

    fn seen_points(&self, layer: Option<Layer>) -> Vec<Point> {
        let seen = |(distance, part): (Distance, &Scaled)| {
            let scale = f64::from(part.scale);
            let scaled = part.points.iter().map(|point| Point { irradiance: point.irradiance.map(|v| v * scale), ..*point });
            let before = self.before(distance);
            if before.is_empty() {
                return scaled.collect::<Vec<_>>();
            }
            scaled.map(|point| dimmed::point(&point, &before)).collect()
        };
        self.each(layer).flat_map(seen).collect()
    }
}

impl Scaled {
    /// Adds the smooth radiance along a circle of equal altitude to `out`; `space` is as long.
    fn add_circle(&self, altitude: f64, azimuths: &[f64], space: &mut [[f32; 3]], out: &mut [[f32; 3]]) {
        for light in &self.smooth {
            light.radiance_circle(altitude, azimuths, space);
            for (sum, value) in out.as_flattened_mut().iter_mut().zip(space.as_flattened()) {
                *sum += self.scale * value;
            }
        }
    }
}

/// Fills `out` with what `add` adds, given space as long.
fn fill(out: &mut [[f32; 3]], mut add: impl FnMut(&mut [[f32; 3]], &mut [[f32; 3]])) {
    out.fill([0.0; 3]);
    if out.len() <= FEW {
        add(&mut [[0.0; 3]; FEW][..out.len()], out);
    } else {
        add(&mut vec![[0.0; 3]; out.len()], out);
    }
}

/// One layer of [`Layers`] as it arrives: scaled, and dimmed by what stands before it.
pub struct OneLayer<'a> {
    layers: &'a Layers,
    layer: Layer,
}

impl SkyLight for OneLayer<'_> {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        self.layers.circle(Some(self.layer), altitude, azimuths, out);
    }

    fn horizon_altitude(&self) -> f64 {
        self.layers.horizon
    }

    fn discs(&self) -> Vec<Disc> {
        self.layers.seen_discs(Some(self.layer))
    }

    fn points(&self) -> Vec<Point> {
        self.layers.seen_points(Some(self.layer))
    }
}

impl SkyLight for Layers {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        let mut smooth = self.parts.values().flat_map(|part| part.smooth.iter().map(move |light| (part.scale, light)));
        if let (Some((1.0, only)), None, false) = (smooth.next(), smooth.next(), self.hides) {
            return only.radiance_circle(altitude, azimuths, out);
        }
        self.circle(None, altitude, azimuths, out);
    }

    fn horizon_altitude(&self) -> f64 {
        self.horizon
    }

    fn discs(&self) -> Vec<Disc> {
        self.seen_discs(None)
    }

    fn points(&self) -> Vec<Point> {
        self.seen_points(None)
    }

    fn layers(&self) -> Vec<(&'static str, Box<dyn SkyLight + '_>)> {
        let mut layers: Vec<(_, Box<dyn SkyLight + '_>)> =
            self.names().into_iter().map(|layer| (layer.name(), Box::new(self.only(layer)) as _)).collect();
        layers.sort_by_key(|(name, _)| *name);
        layers
    }
}
