use super::*;
use crate::sky::Surface;
use glam::DVec3;
use proptest::prelude::*;

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

/// The same factors everywhere.
struct Glass([f32; 3]);

impl Transmittance for Glass {
    fn transmittance_circle(&self, _: f64, _: &[f64], out: &mut [[f32; 3]]) {
        out.fill(self.0);
    }
}

/// Nothing comes through from above the horizontal at `altitude`, all from below it.
struct Blind {
    altitude: f64,
}

impl Transmittance for Blind {
    fn transmittance_circle(&self, altitude: f64, _: &[f64], out: &mut [[f32; 3]]) {
        out.fill([if altitude > self.altitude { 0.0 } else { 1.0 }; 3]);
    }
}

fn light(value: f32) -> Part {
    Part::smooth(Box::new(Even(value)))
}

fn glass(factor: f32) -> Arc<dyn Transmittance> {
    Arc::new(Glass([factor; 3]))
}

fn seen(light: &dyn SkyLight) -> [f32; 3] {
    let mut out = [[7.0; 3]];
    light.radiance_circle(0.3, &[0.1], &mut out);
    out[0]
}

fn star() -> Point {
    Point { direction: DVec3::new(0.0, 0.6, 0.8), irradiance: [1.0, 2.0, 3.0] }
}

fn moon(altitude_deg: f64) -> Disc {
    let (up, north) = altitude_deg.to_radians().sin_cos();
    Disc {
        is_sun: false,
        direction: DVec3::new(0.0, north, up),
        horizontal_radius: 0.0047,
        vertical_radius: 0.0045,
        irradiance: [1.0, 2.0, 3.0],
        surface: Surface::LimbDarkened([[0.0; 2]; 3]),
    }
}

#[test]
fn the_whole_is_the_sum_of_its_layers() {
    let mut layers = Layers::new(-0.01);
    layers.add(Layer::Sky, 1.0, Part { smooth: vec![Box::new(Even(1.0)), Box::new(Even(0.5))], ..Default::default() });
    layers.add(Layer::Airglow, 2.0, light(0.25));
    layers.add(Layer::Stars, 0.5, Part::points(vec![star()]));
    layers.add(Layer::Zodiacal, 0.0, light(9.0));
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

#[test]
fn what_is_nearer_dims_what_is_farther_and_nothing_else() {
    let stack = |cloud: Distance, air: Distance| {
        let mut layers = Layers::new(0.0);
        layers.add(Layer::Sky, 1.0, light(8.0));
        layers.add(Layer::Stars, 1.0, Part::points(vec![star()]));
        layers.add(Layer::Airglow, 1.0, light(2.0).at(cloud).with_transmittance(glass(0.5)));
        layers.add(Layer::Zodiacal, 1.0, light(1.0).at(air).with_transmittance(glass(0.25)));
        (seen(&layers)[0], layers.points()[0].irradiance[0])
    };
    // 1 + (2 + 8 / 2) / 4; the other order is another sky; side by side they do not dim one another.
    assert_eq!(stack(Distance::Clouds, Distance::NearAir), (2.5, 0.125));
    assert_eq!(stack(Distance::NearAir, Distance::Clouds), (2.0 + (1.0 + 8.0 / 4.0) / 2.0, 0.125));
    assert_eq!(stack(Distance::Clouds, Distance::Clouds), (1.0 + 2.0 + 8.0 / 8.0, 0.125));
    assert_eq!(stack(Distance::Space, Distance::Space), (11.0, 1.0));
    assert!(Distance::ALL.is_sorted());
}

#[test]
fn a_layer_that_is_left_out_hides_nothing_and_a_brighter_one_hides_as_before() {
    let stack = |scale: f64| {
        let mut layers = Layers::new(0.0);
        layers.add(Layer::Sky, 1.0, light(8.0));
        layers.add(Layer::Airglow, scale, light(2.0).at(Distance::Clouds).with_transmittance(glass(0.5)));
        seen(&layers)[0]
    };
    assert_eq!([stack(0.0), stack(1.0), stack(3.0)], [8.0, 6.0, 10.0]);
}

#[test]
fn a_disc_is_dimmed_where_something_stands_before_it() {
    let behind = |one: Arc<dyn Transmittance>, altitude_deg: f64| {
        let mut layers = Layers::new(0.0);
        layers.add(Layer::Moon, 2.0, Part::discs(vec![moon(altitude_deg)]));
        layers.add(Layer::Sky, 1.0, light(0.0).at(Distance::Clouds).with_transmittance(one));
        layers.discs()
    };
    for altitude_deg in [30.0, 0.1, 89.99] {
        let even = &behind(Arc::new(Glass([0.5, 0.25, 0.125])), altitude_deg)[0];
        for (found, expected) in even.irradiance.iter().zip([1.0, 1.0, 0.75]) {
            assert!((found - expected).abs() < 1e-12, "{altitude_deg} {:?}", even.irradiance);
        }
        assert_eq!(even.surface.brightness(0.3, -0.2), [0.5, 0.25, 0.125]);
    }
    // The upper half of the disc is hidden; and nothing is left of one behind a wall.
    let half = &behind(Arc::new(Blind { altitude: 30_f64.to_radians() }), 30.0)[0];
    assert!((half.irradiance[1] / 4.0 - 0.5).abs() < 0.01, "{:?}", half.irradiance);
    assert_eq!(half.surface.brightness(0.0, 0.1), [0.0; 3]);
    assert_eq!(half.surface.brightness(0.0, -0.1), [1.0; 3]);
    assert!(behind(glass(0.0), 30.0).is_empty());
    // Of a disc half set, the part that is seen counts: all of it is above the blind's edge.
    assert!(behind(Arc::new(Blind { altitude: 0.0 }), 0.0).is_empty());
    assert!(behind(glass(f32::NAN), 30.0)[0].irradiance[0].is_nan());
}

/// Distance, layer, factor on it, light and transmittance of a part.
type Random = (usize, usize, f32, [f32; 3]);

fn stack_of(parts: &[Random]) -> Layers {
    let mut layers = Layers::new(0.0);
    for &(distance, layer, value, factors) in parts {
        let part = light(value).at(Distance::ALL[distance]).with_transmittance(Arc::new(Glass(factors)));
        // One factor a layer, as all layers of a sky have.
        layers.add(Layer::ALL[layer], 1.0 + layer as f64, part);
    }
    layers
}

fn close(found: f64, expected: f64) -> bool {
    (found - expected).abs() <= 2e-6 * expected.abs() + 1e-12
}

fn parts() -> impl Strategy<Value = Vec<Random>> {
    let factor = || prop_oneof![Just(0.0_f32), Just(1.0_f32), 0.0_f32..1.0];
    let part = (0..4_usize, 0..Layer::ALL.len(), 0.0_f32..10.0, [factor(), factor(), factor()]);
    prop::collection::vec(part, 1..8)
}

proptest! {
    /// Each part arrives through all that is nearer, scaled; layers apart are the picture; a point, too.
    #[test]
    fn a_stack_is_what_its_parts_are_through_all_that_is_nearer(parts in parts()) {
        let mut layers = stack_of(&parts);
        let through = |distance: usize, k: usize| -> f64 {
            parts.iter().filter(|nearer| nearer.0 > distance).map(|nearer| f64::from(nearer.3[k])).product()
        };
        let expected = |k: usize| -> f64 {
            let colour = [1.0, 2.0, 0.0][k];
            parts.iter().map(|part| (1.0 + part.1 as f64) * colour * f64::from(part.2) * through(part.0, k)).sum()
        };
        let whole = seen(&layers);
        let alone = layers.layers();
        prop_assert_eq!(alone.len(), layers.names().len());
        for k in 0..3 {
            prop_assert!(close(f64::from(whole[k]), expected(k)), "{whole:?}, {}", expected(k));
            let sum: f64 = alone.iter().map(|(_, layer)| f64::from(seen(&**layer)[k])).sum();
            prop_assert!(close(sum, f64::from(whole[k])), "{sum} {whole:?}");
        }
        drop(alone);
        layers.add(Layer::Stars, 4.0, Part::points(vec![star()]));
        let point = layers.points()[0];
        for k in 0..3 {
            prop_assert!(close(point.irradiance[k], 4.0 * star().irradiance[k] * through(0, k)), "{point:?}");
        }
    }

    /// It does not matter which neighbours in the order are put together first.
    #[test]
    fn over_is_associative(values in [0.0_f32..10.0, 0.0..10.0, 0.0..10.0], factors in [0.0_f32..1.0, 0.0..1.0, 0.0..1.0]) {
        let part = |i: usize| (values[i], factors[i]);
        let over = |near: (f32, f32), far: (f32, f32)| (near.0 + near.1 * far.0, near.1 * far.1);
        let stack = |parts: &[(f32, f32)]| {
            let distances = [Distance::FarAir, Distance::Clouds, Distance::NearAir];
            let mut layers = Layers::new(0.0);
            layers.add(Layer::Stars, 1.0, Part::points(vec![star()]));
            for (&(value, factor), distance) in parts.iter().zip(distances) {
                layers.add(Layer::Sky, 1.0, light(value).at(distance).with_transmittance(glass(factor)));
            }
            [f64::from(seen(&layers)[0]), layers.points()[0].irradiance[1]]
        };
        let whole = stack(&[part(0), part(1), part(2)]);
        for grouped in [stack(&[over(part(1), part(0)), part(2)]), stack(&[part(0), over(part(2), part(1))])] {
            prop_assert!((0..2).all(|k| close(grouped[k], whole[k])), "{grouped:?} {whole:?}");
        }
    }

    /// What lets all through is not there, to the last bit; behind what lets nothing through is nothing.
    #[test]
    fn clear_is_a_sum_and_opaque_hides(parts in parts(), value in 0.0_f32..10.0) {
        let clear: Vec<Random> = parts.iter().map(|&(distance, layer, value, _)| (distance, layer, value, [1.0; 3])).collect();
        let mut bare = Layers::new(0.0);
        for &(distance, layer, value, _) in &parts {
            bare.add(Layer::ALL[layer], 1.0 + layer as f64, light(value).at(Distance::ALL[distance]));
        }
        prop_assert_eq!(seen(&stack_of(&clear)), seen(&bare));
        let far: Vec<Random> = parts.into_iter().filter(|part| part.0 < 3).collect();
        let mut hidden = stack_of(&far);
        hidden.add(Layer::Stars, 1.0, Part::points(vec![star()]));
        hidden.add(Layer::Moon, 1.0, Part::discs(vec![moon(40.0)]));
        hidden.add(Layer::Sky, 1.0, light(value).at(Distance::NearAir).with_transmittance(glass(0.0)));
        prop_assert_eq!(seen(&hidden)[0], value);
        prop_assert_eq!(hidden.points()[0].irradiance, [0.0; 3]);
        prop_assert!(hidden.discs().is_empty());
    }
}
