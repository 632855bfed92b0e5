//! The light of a sky by its sources: each can be scaled, left out, or looked at alone.

use super::disc::{Disc, Point};
use super::options::Layer;
use super::sky_light::SkyLight;
use std::collections::BTreeMap;

/// What one layer is made of.
#[derive(Default)]
pub struct Part {
    /// Light that can be asked for in any direction.
    pub smooth: Vec<Box<dyn SkyLight + Send>>,
    /// Discs above the horizon.
    pub discs: Vec<Disc>,
    /// Points above the horizon.
    pub points: Vec<Point>,
}

/// The light of a sky, whole and by layers.
pub struct Layers {
    horizon: f64,
    parts: BTreeMap<Layer, (f32, Part)>,
}

/// Directions for which there is room without asking for memory.
const FEW: usize = 64;

impl Layers {
    /// A sky without light, with the horizon at the altitude `horizon` [radians].
    pub fn new(horizon: f64) -> Self {
        Self { horizon, parts: BTreeMap::new() }
    }

    /// Adds `part` to `layer`, its light times `scale`; a layer of scale 0 stays away.
    pub fn add(&mut self, layer: Layer, scale: f64, part: Part) {
        if scale > 0.0 {
            let (_, there) = self.parts.entry(layer).or_insert_with(|| (scale as f32, Part::default()));
            there.smooth.extend(part.smooth);
            there.discs.extend(part.discs);
            there.points.extend(part.points);
        }
    }

    /// The layers that there are.
    pub fn names(&self) -> Vec<Layer> {
        self.parts.keys().copied().collect()
    }

    /// The light of `layer` alone; none if there is no such layer.
    pub fn only(&self, layer: Layer) -> OneLayer<'_> {
        OneLayer { horizon: self.horizon, part: self.parts.get(&layer) }
    }

    fn each(&self) -> impl Iterator<Item = OneLayer<'_>> {
        self.parts.values().map(|part| OneLayer { horizon: self.horizon, part: Some(part) })
    }
}

/// One layer of [`Layers`].
pub struct OneLayer<'a> {
    horizon: f64,
    part: Option<&'a (f32, Part)>,
}

impl OneLayer<'_> {
    /// Adds the smooth radiance along a circle of equal altitude to `out`; `space` is as long.
    fn add_circle(&self, altitude: f64, azimuths: &[f64], space: &mut [[f32; 3]], out: &mut [[f32; 3]]) {
        let Some((scale, part)) = self.part else { return };
        for light in &part.smooth {
            light.radiance_circle(altitude, azimuths, space);
            for (sum, value) in out.as_flattened_mut().iter_mut().zip(space.as_flattened()) {
                *sum += scale * value;
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

impl SkyLight for OneLayer<'_> {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        fill(out, |space, out| self.add_circle(altitude, azimuths, space, out));
    }

    fn horizon_altitude(&self) -> f64 {
        self.horizon
    }

    fn discs(&self) -> Vec<Disc> {
        let Some((scale, part)) = self.part else { return Vec::new() };
        let scaled = |disc: &Disc| Disc { irradiance: disc.irradiance.map(|value| value * f64::from(*scale)), ..disc.clone() };
        part.discs.iter().map(scaled).collect()
    }

    fn points(&self) -> Vec<Point> {
        let Some((scale, part)) = self.part else { return Vec::new() };
        let scaled = |point: &Point| Point { irradiance: point.irradiance.map(|value| value * f64::from(*scale)), ..*point };
        part.points.iter().map(scaled).collect()
    }
}

impl SkyLight for Layers {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        let mut smooth = self.parts.values().flat_map(|(scale, part)| part.smooth.iter().map(move |light| (*scale, light)));
        if let (Some((1.0, only)), None) = (smooth.next(), smooth.next()) {
            return only.radiance_circle(altitude, azimuths, out);
        }
        fill(out, |space, out| self.each().for_each(|layer| layer.add_circle(altitude, azimuths, space, out)));
    }

    fn horizon_altitude(&self) -> f64 {
        self.horizon
    }

    fn discs(&self) -> Vec<Disc> {
        self.each().flat_map(|layer| layer.discs()).collect()
    }

    fn points(&self) -> Vec<Point> {
        self.each().flat_map(|layer| layer.points()).collect()
    }

    fn layers(&self) -> Vec<(&'static str, Box<dyn SkyLight + '_>)> {
        let mut layers: Vec<(_, Box<dyn SkyLight + '_>)> =
            self.parts.keys().map(|&layer| (layer.name(), Box::new(self.only(layer)) as _)).collect();
        layers.sort_by_key(|(name, _)| *name);
        layers
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// The same light everywhere.
    struct Even(f32);

    impl SkyLight for Even {
        fn radiance_circle(&self, _: f64, _: &[f64], out: &mut [[f32; 3]]) {
            out.fill([self.0, 2.0 * self.0, 0.0]);
        }

        fn horizon_altitude(&self) -> f64 {
            0.0
        }

        fn discs(&self) -> Vec<Disc> {
            Vec::new()
        }
    }

    #[test]
    fn the_whole_is_the_sum_of_its_layers() {
        let mut layers = Layers::new(-0.01);
        let point = Point { direction: DVec3::Z, irradiance: [1.0, 2.0, 3.0] };
        layers.add(Layer::Sky, 1.0, Part { smooth: vec![Box::new(Even(1.0)), Box::new(Even(0.5))], ..Default::default() });
        layers.add(Layer::Airglow, 2.0, Part { smooth: vec![Box::new(Even(0.25))], ..Default::default() });
        layers.add(Layer::Stars, 0.5, Part { points: vec![point], ..Default::default() });
        layers.add(Layer::Zodiacal, 0.0, Part { smooth: vec![Box::new(Even(9.0))], ..Default::default() });
        assert_eq!(layers.names(), [Layer::Sky, Layer::Stars, Layer::Airglow]);
        for count in [1, 3, FEW + 1] {
            let azimuths = vec![0.0; count];
            let mut whole = vec![[7.0; 3]; count];
            layers.radiance_circle(0.3, &azimuths, &mut whole);
            assert_eq!(whole, vec![[2.0, 4.0, 0.0]; count]);
            let mut sum = vec![[0.0; 3]; count];
            for layer in Layer::ALL {
                let mut own = vec![[7.0; 3]; count];
                layers.only(layer).radiance_circle(0.3, &azimuths, &mut own);
                sum.as_flattened_mut().iter_mut().zip(own.as_flattened()).for_each(|(sum, own)| *sum += own);
            }
            assert_eq!(sum, whole);
        }
        assert_eq!(layers.points()[0].irradiance, [0.5, 1.0, 1.5]);
        assert_eq!(layers.horizon_altitude(), -0.01);
    }
}
