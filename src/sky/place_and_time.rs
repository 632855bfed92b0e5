//! The sky over a place at a time.

use super::atmosphere::Atmosphere;
use super::disc::{Disc, SOLAR_LIMB_DARKENING, Surface};
use super::dome::{Gathering, SkyDome};
use super::filter::PolarisingFilter;
use super::irradiance::{Illuminance, Irradiance, diffuse_horizontal};
use super::model::check_tolerance;
use crate::atmosphere::molecules;
use crate::ephemeris::{Body, Place, Refraction, SunModel, horizontal_from_direction, sun, sun_at};
use crate::error::{Error, Result, check_range};
use crate::light::{Gathered, LightField, Observer, transverse};
use crate::progress::Progress;
use crate::spectrum::{ColorSpace, CubicSpline};
use crate::time::Time;
use crate::units::{LUMINOUS_EFFICACY, Scale};
use glam::DVec3;
use rayon::prelude::*;
use std::sync::Arc;

/// Wavelength for which refraction is traced: near the peak of daylight vision [nm].
const REFRACTION_NM: f64 = 550.0;

/// The sky over an observer with the Sun at one position. Cheap to make: the light is solved by its [`Atmosphere`], once.
///
/// Light travels straight in the air; refraction moves and flattens the disc of the Sun where it is drawn, and with it its air mass.
pub struct Sky {
    place: Option<Place>,
    time: Option<Time>,
    elevation_m: f64,
    sun: Body,
    refraction: Refraction,
    atmosphere: Arc<Atmosphere>,
}

impl Sky {
    /// The sky over `place` at `time`.
    ///
    /// # Errors
    /// None at present; a later layer of the sky may need data that it lacks.
    pub fn new(place: Place, time: Time, sun_model: SunModel, atmosphere: Arc<Atmosphere>) -> Result<Self> {
        let refraction = refraction(&atmosphere, place.elevation_m);
        let sun = sun(&place, &time, sun_model, &refraction);
        Ok(Self { elevation_m: place.elevation_m, place: Some(place), time: Some(time), sun, refraction, atmosphere })
    }

    /// A sky with the Sun put at an airless altitude and an azimuth [degrees], at 1 au, for an observer at `elevation_m` [m].
    ///
    /// # Errors
    /// [`Error::Input`] for an altitude outside -90 to 90, an azimuth outside -360 to 360, an elevation outside -500 to 60000 m.
    pub fn with_sun(altitude_deg: f64, azimuth_deg: f64, elevation_m: f64, atmosphere: Arc<Atmosphere>) -> Result<Self> {
        check_range("elevation_m", elevation_m, -500.0, 60_000.0, "m")?;
        let refraction = refraction(&atmosphere, elevation_m);
        let sun = sun_at(altitude_deg, azimuth_deg, &refraction)?;
        Ok(Self { place: None, time: None, elevation_m, sun, refraction, atmosphere })
    }

    /// The place, if the sky has one.
    pub fn place(&self) -> Option<&Place> {
        self.place.as_ref()
    }

    /// The time, if the sky has one.
    pub fn time(&self) -> Option<&Time> {
        self.time.as_ref()
    }

    /// Height of the observer [m].
    pub fn elevation_m(&self) -> f64 {
        self.elevation_m
    }

    /// The Sun.
    pub fn sun(&self) -> &Body {
        &self.sun
    }

    /// Everything that is placed in the sky, the Sun first.
    pub fn bodies(&self) -> Vec<Body> {
        vec![self.sun.clone()]
    }

    /// The air.
    pub fn atmosphere(&self) -> &Arc<Atmosphere> {
        &self.atmosphere
    }

    /// Spectral radiance without the Sun's disc towards unit vectors `directions` (east, north, up) at `wavelengths_nm`:
    /// shape (directions, wavelengths), row-major [W m-2 sr-1 nm-1]. Between the solved wavelengths the radiance relative to the Sun's spectrum is interpolated.
    ///
    /// # Errors
    /// [`Error::Input`] for directions that are not unit vectors and wavelengths that were not solved; [`Error::Cancelled`].
    pub fn spectral_radiance(&self, directions: &[DVec3], wavelengths_nm: &[f64], progress: &Progress) -> Result<Vec<f64>> {
        self.atmosphere.check_wavelengths(wavelengths_nm)?;
        check_directions(directions)?;
        let field = self.field(progress)?;
        let sunlight = self.sunlight(wavelengths_nm);
        let rows = self.gather_each(field, directions, progress, |gathered, look| {
            let relative: Vec<f64> = (0..gathered.wavelengths).map(|w| field.radiance(gathered, 0, w, look.cosine)).collect();
            self.at_wavelengths(&relative, wavelengths_nm, &sunlight)
        })?;
        Ok(rows.concat())
    }

    /// Stokes parameters I, Q, U of the sky in `directions` at `wavelengths_nm` [W m-2 sr-1 nm-1], the Sun's disc excluded, row-major, shape
    /// (directions, wavelengths, 3). Directions are unit vectors (east, north, up). Q > 0 is polarised vertically, in the plane of view direction and zenith; U > 0 along the direction
    /// 45 degrees clockwise from the vertical as the observer sees it.
    ///
    /// # Errors
    /// As [`Self::spectral_radiance`]; [`Error::Input`] if the atmosphere was made without polarisation.
    pub fn stokes(&self, directions: &[DVec3], wavelengths_nm: &[f64], progress: &Progress) -> Result<Vec<f64>> {
        self.atmosphere.check_wavelengths(wavelengths_nm)?;
        check_directions(directions)?;
        if !self.atmosphere.is_polarised() {
            return Err(Error::input("polarisation", "false", "true, to know more of the light than its radiance"));
        }
        let field = self.field(progress)?;
        let sunlight = self.sunlight(wavelengths_nm);
        let nodes = &self.atmosphere.profile().wavelengths_nm;
        let rows: Vec<Vec<f64>> = self.gather_each(field, directions, progress, |gathered, look| {
            let stokes: Vec<[f64; 3]> =
                (0..gathered.wavelengths).map(|w| field.stokes(gathered, 0, w, look.transverse, look.cosine)).collect();
            let radiance = self.at_wavelengths(&stokes.iter().map(|s| s[0]).collect::<Vec<_>>(), wavelengths_nm, &sunlight);
            // The degree of polarisation is what is smooth over wavelength and may be negative.
            let [q, u] = [1, 2].map(|k| {
                CubicSpline::new(nodes, &stokes.iter().map(|s| if s[0] > 0.0 { s[k] / s[0] } else { 0.0 }).collect::<Vec<_>>())
            });
            let at = |(&wavelength, i): (&f64, f64)| [i, i * q.value(wavelength), i * u.value(wavelength)];
            wavelengths_nm.iter().zip(radiance).flat_map(at).collect()
        })?;
        Ok(rows.concat())
    }

    /// Gathers in each direction and takes what `result` makes of it.
    fn gather_each<T: Send>(
        &self,
        field: &LightField,
        directions: &[DVec3],
        progress: &Progress,
        result: impl Fn(&Gathered, &Look) -> T + Sync,
    ) -> Result<Vec<T>> {
        let observer = self.observer();
        let sun = self.sun.direction();
        let parts = progress.parts("gather", directions.len());
        directions
            .par_iter()
            .map(|direction| {
                let direction = direction.normalize();
                let mu = direction.z.clamp(-1.0, 1.0);
                // Counterclockwise from the Sun, against the compass.
                let azimuth = (self.sun.azimuth_deg - horizontal_from_direction(direction).1).to_radians();
                let look = Look { cosine: direction.dot(sun), transverse: transverse(mu, azimuth, observer.sun_zenith) };
                let value = result(&field.gather(&observer, mu, &[azimuth]), &look);
                parts.finish_one()?;
                Ok(value)
            })
            .collect()
    }

    /// Spectral irradiance by the Sun and by the sky at `wavelengths_nm`.
    ///
    /// # Errors
    /// [`Error::Input`] for wavelengths that were not solved; [`Error::Cancelled`].
    pub fn irradiance(&self, wavelengths_nm: &[f64], progress: &Progress) -> Result<Irradiance> {
        self.atmosphere.check_wavelengths(wavelengths_nm)?;
        let field = self.field(progress)?;
        let sunlight = self.sunlight(wavelengths_nm);
        let transmittance = self.disc_transmittance(field);
        let direct_normal = self.at_wavelengths(&transmittance, wavelengths_nm, &sunlight);
        let diffuse = diffuse_horizontal(field, &self.observer(), progress)?;
        Ok(Irradiance {
            direct_horizontal: direct_normal.iter().map(|e| e * self.disc_cosine()).collect(),
            direct_normal,
            diffuse_horizontal: self.at_wavelengths(&diffuse, wavelengths_nm, &sunlight),
        })
    }

    /// Illuminance by the Sun and by the sky.
    ///
    /// # Errors
    /// [`Error::Input`] if the wavelengths of the air make no colour; [`Error::Cancelled`].
    pub fn illuminance(&self, progress: &Progress) -> Result<Illuminance> {
        let weights = self.xyz_weights()?;
        let field = self.field(progress)?;
        let luminous = |values: &[f64]| LUMINOUS_EFFICACY * values.iter().zip(&weights).map(|(v, w)| v * w[1]).sum::<f64>();
        let direct_normal_lx = luminous(&self.disc_transmittance(field));
        let direct_horizontal_lx = direct_normal_lx * self.disc_cosine();
        let diffuse_horizontal_lx = luminous(&diffuse_horizontal(field, &self.observer(), progress)?);
        Ok(Illuminance {
            direct_normal_lx,
            direct_horizontal_lx,
            diffuse_horizontal_lx,
            global_horizontal_lx: direct_horizontal_lx + diffuse_horizontal_lx,
        })
    }

    /// Irradiance by the Sun's disc through the air on a surface that faces it, as RGB in `color_space`, in the units of a probe's pixels times steradians:
    /// a lamp of this strength lights a scene as the disc in the probe does.
    ///
    /// # Errors
    /// As [`Self::illuminance`].
    pub fn sun_irradiance_rgb(&self, scale: Scale, color_space: ColorSpace, progress: &Progress) -> Result<[f64; 3]> {
        let xyz = self.sun_irradiance_xyz(self.field(progress)?)?;
        Ok(color_space.from_xyz(xyz.map(|v| v * scale.factor())))
    }

    /// All light around the observer, ready to be made into a probe.
    ///
    /// # Errors
    /// As [`Self::illuminance`].
    pub fn light(&self, progress: &Progress) -> Result<SkyDome> {
        self.filtered_light(None, None, progress)
    }

    /// The same, seen through a polarising filter, or with directions gathered until interpolation between them is within `tolerance` (relative, as
    /// [`LightOptions::tolerance`](super::LightOptions)) rather than at the directions of the quality.
    ///
    /// # Errors
    /// As [`Self::light`]; [`Error::Input`] for a filter or a tolerance out of range, and if there is a filter and the atmosphere was made without polarisation.
    pub fn filtered_light(
        &self,
        filter: Option<&PolarisingFilter>,
        tolerance: Option<f64>,
        progress: &Progress,
    ) -> Result<SkyDome> {
        if let Some(filter) = filter {
            filter.validate()?;
            if !self.atmosphere.is_polarised() {
                return Err(Error::input("polarisation", "false", "true, to see the sky through a polarising filter"));
            }
        }
        tolerance.map(check_tolerance).transpose()?;
        let weights = self.xyz_weights()?;
        let field = self.field(progress)?;
        let (observer, horizon) = (self.observer(), self.horizon());
        let discs = self.sun_disc(field, horizon)?;
        let what = Gathering {
            field,
            numbers: &self.atmosphere.quality().numbers(),
            filter: filter.copied(),
            tolerance,
            weights,
            observer,
            horizon,
            sun: (self.sun.altitude_deg.to_radians(), self.sun.azimuth_deg.to_radians()),
        };
        SkyDome::gather(&what, discs, progress)
    }

    fn field(&self, progress: &Progress) -> Result<&LightField> {
        self.atmosphere.field(progress)
    }

    fn observer(&self) -> Observer {
        Observer { altitude_km: self.altitude_km(), sun_zenith: (90.0 - self.sun.altitude_deg).to_radians() }
    }

    /// Depressions below sea level lie on the ground of the model.
    fn altitude_km(&self) -> f64 {
        (self.elevation_m / 1000.0).max(0.0)
    }

    /// Geometric altitude of the horizon [radians].
    fn horizon(&self) -> f64 {
        let radius = self.atmosphere.profile().planet_radius_km;
        -(radius / (radius + self.altitude_km())).acos()
    }

    /// Square of 1 au over the Sun's distance.
    fn nearness(&self) -> f64 {
        self.sun.distance_au.powi(-2)
    }

    fn xyz_weights(&self) -> Result<Vec<[f64; 3]>> {
        let nearness = self.nearness();
        Ok(self.atmosphere.xyz_weights()?.into_iter().map(|xyz| xyz.map(|w| w * nearness)).collect())
    }

    /// Solar irradiance outside the air [W m-2 nm-1].
    fn sunlight(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        self.atmosphere.solar_irradiance(wavelengths_nm).into_iter().map(|e| e * self.nearness()).collect()
    }

    /// Takes values per unit solar irradiance at the solved wavelengths to absolute values at `wavelengths_nm`.
    fn at_wavelengths(&self, relative: &[f64], wavelengths_nm: &[f64], sunlight: &[f64]) -> Vec<f64> {
        let nodes = &self.atmosphere.profile().wavelengths_nm;
        // Light varies by factors with wavelength: its logarithm is what is smooth.
        let logs: Vec<f64> = relative.iter().map(|v| v.max(1e-30).ln()).collect();
        let spline = CubicSpline::new(nodes, &logs);
        wavelengths_nm
            .iter()
            .zip(sunlight)
            .map(|(&wavelength, sun)| {
                let value = match nodes.iter().position(|&node| node == wavelength) {
                    Some(node) => relative[node],
                    None => spline.value(wavelength).exp(),
                };
                value * sun
            })
            .collect()
    }

    /// Transmittance to the disc where it is seen.
    fn disc_transmittance(&self, field: &LightField) -> Vec<f64> {
        let observer = Observer { sun_zenith: (90.0 - self.sun.apparent_altitude_deg).to_radians(), ..self.observer() };
        field.sun_transmittance(&observer)
    }

    /// Cosine of incidence of the disc on the horizontal plane.
    fn disc_cosine(&self) -> f64 {
        self.sun.apparent_altitude_deg.to_radians().sin().max(0.0)
    }

    fn sun_irradiance_xyz(&self, field: &LightField) -> Result<[f64; 3]> {
        let mut xyz = [0.0; 3];
        for (transmittance, weight) in self.disc_transmittance(field).iter().zip(self.xyz_weights()?) {
            for k in 0..3 {
                xyz[k] += transmittance * weight[k];
            }
        }
        Ok(xyz)
    }

    fn sun_disc(&self, field: &LightField, horizon: f64) -> Result<Vec<Disc>> {
        let horizontal_radius = (self.atmosphere.profile().sun_angular_radius_deg / self.sun.distance_au).to_radians();
        let flattening = self.refraction.flattening(self.sun.altitude_deg, 2.0 * horizontal_radius.to_degrees());
        let vertical_radius = horizontal_radius * flattening;
        let irradiance = self.sun_irradiance_xyz(field)?;
        let hidden = self.sun.apparent_altitude_deg.to_radians() + vertical_radius <= horizon;
        if hidden || irradiance[1] <= 0.0 || horizontal_radius <= 0.0 {
            return Ok(Vec::new());
        }
        let direction = self.sun.apparent_direction();
        let surface = Surface::LimbDarkened(SOLAR_LIMB_DARKENING);
        Ok(vec![Disc { is_sun: true, direction, horizontal_radius, vertical_radius, irradiance, surface }])
    }
}

fn check_directions(directions: &[DVec3]) -> Result<()> {
    match directions.iter().find(|d| !(0.999..=1.001).contains(&d.length())) {
        Some(bad) => {
            let value = format!("[{}, {}, {}]", bad.x, bad.y, bad.z);
            Err(Error::input("directions", value, "unit vectors (east, north, up)"))
        }
        None => Ok(()),
    }
}

/// A look direction relative to the Sun.
struct Look {
    /// Cosine of the angle between them.
    cosine: f64,
    /// Components of the direction to the Sun across the look direction.
    transverse: [f64; 2],
}

/// Refraction in the air of a preset; a profile says nothing of refraction, so its air has none.
fn refraction(atmosphere: &Atmosphere, elevation_m: f64) -> Refraction {
    let Some(air) = atmosphere.parameters().and_then(|parameters| parameters.resolve().ok()) else {
        return Refraction::none();
    };
    let radius_m = 1000.0 * atmosphere.profile().planet_radius_km;
    Refraction::new(
        |altitude_m| molecules::refractivity_in(air.standard_atmosphere, altitude_m, REFRACTION_NM),
        radius_m,
        elevation_m,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::AirParameters;
    use crate::quality::Quality;
    use crate::sky::SkyLight;

    fn sky(atmosphere: &Arc<Atmosphere>, altitude_deg: f64, elevation_m: f64) -> Sky {
        Sky::with_sun(altitude_deg, 200.0, elevation_m, Arc::clone(atmosphere)).unwrap()
    }

    /// XYZ by one gather in just this direction.
    fn directly(sky: &Sky, altitude: f64, azimuth: f64) -> [f64; 3] {
        let field = sky.field(&Progress::silent()).unwrap();
        let from_sun = azimuth - sky.sun.azimuth_deg.to_radians();
        let gathered = field.gather(&sky.observer(), altitude.sin(), &[from_sun]);
        let sun = sky.sun.altitude_deg.to_radians();
        let cosine = altitude.sin() * sun.sin() + altitude.cos() * sun.cos() * from_sun.cos();
        let mut xyz = [0.0; 3];
        for (w, weight) in sky.xyz_weights().unwrap().iter().enumerate() {
            let value = field.radiance(&gathered, 0, w, cosine);
            for k in 0..3 {
                xyz[k] += value * weight[k];
            }
        }
        xyz
    }

    /// Rms and largest relative error of Y of `dome` against gathers in just those directions, and where the largest is.
    fn errors(sky: &Sky, dome: &SkyDome) -> (f64, (f64, f64, f64)) {
        let mut squares = 0.0;
        let mut worst = (0.0_f64, 0.0, 0.0);
        let n = 300;
        for i in 0..n {
            // Spiral over the whole sphere.
            let altitude = (1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(n)).asin();
            let azimuth = 2.399_963 * f64::from(i) % std::f64::consts::TAU;
            let mut seen = [[0.0; 3]];
            dome.radiance_circle(altitude, &[azimuth], &mut seen);
            let expected = directly(sky, altitude, azimuth);
            let error = f64::from(seen[0][1]) / expected[1] - 1.0;
            squares += error * error;
            if error.abs() > worst.0.abs() {
                worst = (error, altitude.to_degrees(), azimuth.to_degrees());
            }
        }
        ((squares / f64::from(n)).sqrt(), worst)
    }

    const SUNS_AND_HEIGHTS: [(f64, f64); 6] = [(60.0, 0.0), (20.0, 0.0), (3.0, 0.0), (-2.0, 0.0), (-6.0, 0.0), (30.0, 10_000.0)];

    #[test]
    fn the_dome_is_what_is_gathered_in_each_direction() {
        let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
        for (sun, elevation) in SUNS_AND_HEIGHTS {
            let sky = sky(&atmosphere, sun, elevation);
            let (rms, worst) = errors(&sky, &sky.light(&Progress::silent()).unwrap());
            println!(
                "Sun {sun}, {elevation} m: rms {:.3} %, worst {:+.2} % at {:.1} {:.1}",
                100.0 * rms,
                100.0 * worst.0,
                worst.1,
                worst.2
            );
            assert!(rms < 0.01 && worst.0.abs() < 0.05, "Sun at {sun}: rms {rms}, worst {worst:?}");
        }
    }

    #[test]
    fn a_tolerance_holds_and_a_looser_one_costs_less() {
        let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
        for (sun, elevation) in SUNS_AND_HEIGHTS {
            let sky = sky(&atmosphere, sun, elevation);
            let mut costs = Vec::new();
            let mut found = Vec::new();
            for tolerance in [0.2, 0.05, 0.01, 0.001] {
                let dome = sky.filtered_light(None, Some(tolerance), &Progress::silent()).unwrap();
                let (rms, worst) = errors(&sky, &dome);
                costs.push(dome.sample_directions().len());
                found.push(rms);
                println!(
                    "Sun {sun}, {elevation} m, tolerance {tolerance}: {} samples, rms {:.4} %, worst {:+.3} % at {:.1} {:.1}",
                    costs[costs.len() - 1],
                    100.0 * rms,
                    100.0 * worst.0,
                    worst.1,
                    worst.2
                );
                assert!(rms < 2.0 * tolerance, "Sun at {sun}: rms {rms}, worst {worst:?}");
            }
            assert!(costs.is_sorted() && costs[0] < costs[3], "{costs:?}");
            assert!(found[3] < 0.6 * found[0], "{found:?}");
        }
        let low = sky(&atmosphere, 10.0, 0.0);
        let refused = low.filtered_light(None, Some(0.0), &Progress::silent()).err().unwrap().to_string();
        assert!(refused.starts_with("tolerance = 0: must be a number from 0.0001 to 0.5"), "{refused}");
    }

    /// Through a filter the light is I + strength (Q cos 2c + U sin 2c) of the Stokes parameters, at every side of the Sun.
    #[test]
    fn a_tolerance_holds_through_a_filter_too() {
        let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
        let sky = sky(&atmosphere, 25.0, 0.0);
        let filter = PolarisingFilter { strength: 0.9, angle_deg: 35.0, held_towards_deg: Some([30.0, 100.0]) };
        let dome = sky.filtered_light(Some(&filter), Some(0.01), &Progress::silent()).unwrap();
        let weights = sky.xyz_weights().unwrap();
        let field = sky.field(&Progress::silent()).unwrap();
        let mut squares = 0.0;
        let n = 150;
        for i in 0..n {
            let altitude = (1.0 - (f64::from(i) + 0.5) / f64::from(n)).asin();
            let azimuth = 2.399_963 * f64::from(i) % std::f64::consts::TAU;
            let direction = DVec3::new(altitude.cos() * azimuth.sin(), altitude.cos() * azimuth.cos(), altitude.sin());
            let [q, u] = filter.weights(altitude, azimuth);
            let rows = sky
                .gather_each(field, &[direction], &Progress::silent(), |gathered, look| {
                    let through = |w: usize| {
                        let stokes = field.stokes(gathered, 0, w, look.transverse, look.cosine);
                        (stokes[0] + q * stokes[1] + u * stokes[2]) * weights[w][1]
                    };
                    (0..gathered.wavelengths).map(through).sum::<f64>()
                })
                .unwrap();
            let mut seen = [[0.0; 3]];
            dome.radiance_circle(altitude, &[azimuth], &mut seen);
            squares += (f64::from(seen[0][1]) / rows[0] - 1.0).powi(2);
        }
        let rms = (squares / f64::from(n)).sqrt();
        println!("through a filter: {} samples, rms {:.4} %", dome.sample_directions().len(), 100.0 * rms);
        assert!(rms < 0.01, "{rms}");
    }

    /// North turns the finished picture where it is shown (a mapping, a transform): it is no part of a probe and cannot cause a solve either.
    #[test]
    fn a_new_time_place_height_or_sun_needs_no_new_solve() {
        let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
        assert!(!atmosphere.is_solved());
        let stages = std::sync::Mutex::new(Vec::new());
        let listen = |stage: &str, _: f64| {
            stages.lock().unwrap().push(stage.to_string());
            true
        };
        let progress = Progress::new(&listen);
        sky(&atmosphere, 30.0, 0.0).light(&progress).unwrap();
        assert!(stages.lock().unwrap().iter().any(|stage| stage == "solve"));
        stages.lock().unwrap().clear();
        sky(&atmosphere, -3.0, 2500.0).light(&progress).unwrap();
        for (latitude, longitude, elevation, text, model) in [
            (55.7, 13.2, 0.0, "2005-06-21T11:00Z", SunModel::Iau),
            (55.7, 13.2, 0.0, "2005-06-21T20:30Z", SunModel::Iau),
            (-33.9, 151.2, 0.0, "2005-06-21T20:30Z", SunModel::Iau),
            (-33.9, 151.2, 8000.0, "2005-06-21T20:30Z", SunModel::Iau),
            (-33.9, 151.2, 8000.0, "2005-06-21T20:30Z", SunModel::Thesis),
        ] {
            let place = Place::new(latitude, longitude, elevation).unwrap();
            let time = Time::parse(text, crate::time::ZoneChoice::Named("UTC")).unwrap();
            let sky = Sky::new(place, time, model, Arc::clone(&atmosphere)).unwrap();
            sky.filtered_light(Some(&PolarisingFilter::default()), Some(0.1), &progress).unwrap();
            sky.illuminance(&progress).unwrap();
        }
        let stages = stages.lock().unwrap();
        assert!(!stages.is_empty() && stages.iter().all(|stage| stage == "gather"), "{stages:?}");
    }

    #[test]
    fn cancelling_leaves_the_air_unsolved_and_usable() {
        let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, false).unwrap());
        let stop = |_: &str, fraction: f64| fraction < 0.2;
        assert!(matches!(atmosphere.solve(&Progress::new(&stop)), Err(Error::Cancelled)));
        assert!(!atmosphere.is_solved());
        assert!(atmosphere.solve(&Progress::silent()).is_ok());
    }

    /// Without air there is only the Sun: its illuminance is that of the solar spectrum.
    #[test]
    fn outside_the_air_the_sun_has_its_whole_illuminance() {
        let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, false).unwrap());
        let high = sky(&atmosphere, 60.0, 60_000.0).illuminance(&Progress::silent()).unwrap();
        // checked against: Darula, Kittler & Gueymard 2005, luminous solar constant 133.334 klx; ozone below 60 km and 380-740 nm take part of a per cent.
        assert!((high.direct_normal_lx / 133_334.0 - 1.0).abs() < 0.005, "{high:?}");
        assert!(high.diffuse_horizontal_lx < 100.0, "{high:?}");
    }

    #[test]
    fn the_air_refracts_as_the_standard_atmosphere() {
        let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, false).unwrap());
        // checked against: an independent ray trace (Auer-Standish integral) of the US Standard Atmosphere 1976, 550 nm, sea level:
        // refraction in arc minutes by apparent altitude in degrees.
        for (apparent_deg, minutes) in [
            (0.0, 33.009),
            (0.5, 27.652),
            (1.0, 23.543),
            (2.0, 17.785),
            (5.0, 9.664),
            (10.0, 5.222),
            (20.0, 2.598),
            (45.0, 0.953),
        ] {
            let seen = sky(&atmosphere, apparent_deg - minutes / 60.0, 0.0).sun.apparent_altitude_deg;
            assert!((seen - apparent_deg).abs() < 0.005 * minutes / 60.0, "{apparent_deg}: {seen}");
        }
    }
}
