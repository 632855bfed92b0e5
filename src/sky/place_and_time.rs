//! The sky over a place at a time.

use super::SkyLight;
use super::atmosphere::Atmosphere;
use super::disc::{Disc, SOLAR_LIMB_DARKENING, Surface};
use super::dome::{Gathering, SkyDome};
use super::eclipse::{self, EclipsedDome, Gain, eclipse};
use super::filter::PolarisingFilter;
use super::irradiance::{Illuminance, Irradiance, diffuse_horizontal, horizontal_irradiance};
use super::layers::{Layer, Layers, Part};
use super::model::{LightOptions, check_tolerance};
use super::night::{NightOptions, moon, moonlight_weights};
use crate::atmosphere::molecules;
use crate::celestial::{MoonDisc, SolarEclipse};
use crate::ephemeris::{Bodies, Body, MoonModel, Place, Refraction, SunModel, bodies, horizontal_from_direction, sun_at};
use crate::error::{Error, Result, check_range};
use crate::light::{Gathered, LightField, Observer, transverse};
use crate::progress::Progress;
use crate::spectrum::{ColorSpace, CubicSpline};
use crate::time::Time;
use crate::units::{LUMINOUS_EFFICACY, Scale};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;
use std::sync::{Arc, OnceLock};

/// Wavelength for which refraction is traced: near the peak of daylight vision [nm].
const REFRACTION_NM: f64 = 550.0;

/// Altitude of the Moon below which its light in the air is left out [degrees].
const DARK_DEG: f64 = -18.0;

/// The sky over an observer with the Sun at one position. Cheap to make: the light is solved by its [`Atmosphere`], once.
///
/// Light travels straight in the air; refraction moves and flattens the disc of the Sun where it is drawn, and with it its air mass.
pub struct Sky {
    place: Option<Place>,
    time: Option<Time>,
    elevation_m: f64,
    sun: Body,
    /// Everything in the sky of a place and a time.
    bodies: Option<Bodies>,
    eclipse: Option<SolarEclipse>,
    /// Made when it is first needed.
    moon: OnceLock<MoonDisc>,
    night: NightOptions,
    refraction: Refraction,
    atmosphere: Arc<Atmosphere>,
}

impl Sky {
    /// The sky over `place` at `time`, with Sun, Moon, planets and stars.
    ///
    /// # Errors
    /// [`Error::Data`] if the geometry of an eclipse is out of its range, which no place on the Earth can see.
    pub fn new(place: Place, time: Time, sun_model: SunModel, atmosphere: Arc<Atmosphere>) -> Result<Self> {
        let refraction = refraction(&atmosphere, place.elevation_m);
        // The thesis's Moon has no parallax: it goes with the thesis's Sun only.
        let moon_model = if sun_model == SunModel::Thesis { MoonModel::Thesis } else { MoonModel::Elp };
        let bodies = bodies(&place, &time, sun_model, moon_model, &refraction);
        let eclipse = eclipse(&bodies)?;
        Ok(Self {
            elevation_m: place.elevation_m,
            place: Some(place),
            time: Some(time),
            sun: bodies.sun.clone(),
            bodies: Some(bodies),
            eclipse,
            moon: OnceLock::new(),
            night: NightOptions::default(),
            refraction,
            atmosphere,
        })
    }

    /// A sky with the Sun put at an airless altitude and an azimuth [degrees], at 1 au, for an observer at `elevation_m` [m].
    ///
    /// # Errors
    /// [`Error::Input`] for an altitude outside -90 to 90, an azimuth outside -360 to 360, an elevation outside -500 to 60000 m.
    pub fn with_sun(altitude_deg: f64, azimuth_deg: f64, elevation_m: f64, atmosphere: Arc<Atmosphere>) -> Result<Self> {
        check_range("elevation_m", elevation_m, -500.0, 60_000.0, "m")?;
        let refraction = refraction(&atmosphere, elevation_m);
        let sun = sun_at(altitude_deg, azimuth_deg, &refraction)?;
        Ok(Self {
            place: None,
            time: None,
            elevation_m,
            sun,
            bodies: None,
            eclipse: None,
            moon: OnceLock::new(),
            night: NightOptions::default(),
            refraction,
            atmosphere,
        })
    }

    /// The same sky with another night.
    ///
    /// # Errors
    /// [`Error::Input`] as [`NightOptions::validate`].
    pub fn with_night(self, night: NightOptions) -> Result<Self> {
        night.validate()?;
        Ok(Self { night, ..self })
    }

    /// What of the night is shown.
    pub fn night(&self) -> &NightOptions {
        &self.night
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

    /// Everything that is placed in the sky, the Sun first, then Moon and planets from the Sun outwards, above and below the horizon; of a Sun that was put, that Sun alone.
    pub fn bodies(&self) -> Vec<Body> {
        self.bodies.as_ref().map_or_else(|| vec![self.sun.clone()], |bodies| bodies.all().cloned().collect())
    }

    /// Moon, planets and the observer among them, if the sky has a place and a time.
    pub fn bodies_of_place(&self) -> Option<&Bodies> {
        self.bodies.as_ref()
    }

    /// How the Moon stands before the Sun, if it does.
    pub fn solar_eclipse(&self) -> Option<&SolarEclipse> {
        self.eclipse.as_ref()
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
        let sunlight = self.sunlight_in_the_air(wavelengths_nm);
        let rows = self.gather_each(field, directions, progress, |gathered, look| {
            let relative: Vec<f64> = (0..gathered.wavelengths).map(|w| field.radiance(gathered, 0, w, look.cosine)).collect();
            self.at_wavelengths(&relative, wavelengths_nm, &sunlight).iter().map(|value| value * look.gain).collect::<Vec<_>>()
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
        let sunlight = self.sunlight_in_the_air(wavelengths_nm);
        let nodes = &self.atmosphere.profile().wavelengths_nm;
        let rows: Vec<Vec<f64>> = self.gather_each(field, directions, progress, |gathered, look| {
            let stokes: Vec<[f64; 3]> =
                (0..gathered.wavelengths).map(|w| field.stokes(gathered, 0, w, look.transverse, look.cosine)).collect();
            let radiance = self.at_wavelengths(&stokes.iter().map(|s| s[0]).collect::<Vec<_>>(), wavelengths_nm, &sunlight);
            // The degree of polarisation is what is smooth over wavelength and may be negative.
            let [q, u] = [1, 2].map(|k| {
                CubicSpline::new(nodes, &stokes.iter().map(|s| if s[0] > 0.0 { s[k] / s[0] } else { 0.0 }).collect::<Vec<_>>())
            });
            let at = |(&wavelength, i): (&f64, f64)| {
                [i, i * q.value(wavelength), i * u.value(wavelength)].map(|value| value * look.gain)
            };
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
        let gain = self.eclipse_gain(field, progress)?;
        let parts = progress.parts("gather", directions.len());
        directions
            .par_iter()
            .map(|direction| {
                let direction = direction.normalize();
                let mu = direction.z.clamp(-1.0, 1.0);
                // Counterclockwise from the Sun, against the compass.
                let azimuth = (self.sun.azimuth_deg - horizontal_from_direction(direction).1).to_radians();
                let look = Look {
                    cosine: direction.dot(sun),
                    transverse: transverse(mu, azimuth, observer.sun_zenith),
                    gain: gain.as_ref().map_or(1.0, |gain| gain.at(mu.asin())),
                };
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
        let diffuse = self.diffuse_horizontal(field, progress)?;
        let in_the_air = self.sunlight_in_the_air(wavelengths_nm);
        Ok(Irradiance {
            direct_horizontal: direct_normal.iter().map(|e| e * self.disc_cosine()).collect(),
            direct_normal,
            diffuse_horizontal: self.at_wavelengths(&diffuse, wavelengths_nm, &in_the_air),
        })
    }

    /// Illuminance by the Sun, by the Moon and by the sky with all that shines in it.
    ///
    /// # Errors
    /// [`Error::Input`] if the wavelengths of the air make no colour; [`Error::Cancelled`].
    pub fn illuminance(&self, progress: &Progress) -> Result<Illuminance> {
        let (weights, sky_weights) = (self.xyz_weights()?, self.sky_weights()?);
        let field = self.field(progress)?;
        let luminous = |values: &[f64], weights: &[[f64; 3]]| {
            LUMINOUS_EFFICACY * values.iter().zip(weights).map(|(v, w)| v * w[1]).sum::<f64>()
        };
        let direct_normal_lx = luminous(&self.disc_transmittance(field), &weights);
        let direct_horizontal_lx = direct_normal_lx * self.disc_cosine();
        let by_sunlight = luminous(&self.diffuse_horizontal(field, progress)?, &sky_weights);
        let night = self.night_light(field, &LightOptions::default(), progress)?;
        let moons = night.only(Layer::Moon).discs();
        // A sum of nothing would be -0.
        let by_the_moon = |cosine: fn(&Disc) -> f64| {
            moons.iter().fold(0.0, |sum, disc| sum + LUMINOUS_EFFICACY * disc.irradiance[1] * cosine(disc))
        };
        let moon_normal_lx = by_the_moon(|_| 1.0);
        let moon_horizontal_lx = by_the_moon(|disc| disc.direction.z.max(0.0));
        let diffuse_horizontal_lx = by_sunlight + LUMINOUS_EFFICACY * horizontal_irradiance(&night)[1];
        Ok(Illuminance {
            direct_normal_lx,
            direct_horizontal_lx,
            moon_normal_lx,
            moon_horizontal_lx,
            diffuse_horizontal_lx,
            global_horizontal_lx: direct_horizontal_lx + moon_horizontal_lx + diffuse_horizontal_lx,
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
        let field = self.field(progress)?;
        let discs = self.sun_discs(field, self.horizon())?;
        self.dome(field, &self.sun, self.sky_weights()?, (filter, tolerance), discs, progress)
    }

    /// The dome lit by `body` whose irradiance outside the air makes `weights`.
    fn dome(
        &self,
        field: &LightField,
        body: &Body,
        weights: Vec<[f64; 3]>,
        (filter, tolerance): (Option<&PolarisingFilter>, Option<f64>),
        discs: Vec<Disc>,
        progress: &Progress,
    ) -> Result<SkyDome> {
        let what = Gathering {
            field,
            numbers: &self.atmosphere.quality().numbers(),
            filter: filter.copied(),
            tolerance,
            weights,
            observer: self.observer_under(body),
            horizon: self.horizon(),
            sun: (body.altitude_deg.to_radians(), body.azimuth_deg.to_radians()),
        };
        SkyDome::gather(&what, discs, progress)
    }

    /// All light around the observer, in layers, by the solved light transport.
    pub(super) fn scattered_light(&self, options: &LightOptions, progress: &Progress) -> Result<Layers> {
        let field = self.field(progress)?;
        let mut layers = self.night_light(field, options, progress)?;
        let scale = |layer: Layer| options.layers.of(layer);
        let dome = self.filtered_light(options.polarising_filter.as_ref(), options.tolerance, progress)?;
        layers.add(Layer::Sun, scale(Layer::Sun), Part { discs: dome.discs(), ..Default::default() });
        let smooth: Box<dyn SkyLight + Send> = match self.eclipse_gain(field, progress)? {
            Some(gain) => Box::new(EclipsedDome { dome, gain }),
            None => Box::new(dome),
        };
        layers.add(Layer::Sky, scale(Layer::Sky), Part { smooth: vec![smooth], ..Default::default() });
        Ok(layers)
    }

    /// The lights of the night and moonlight in the air, in layers.
    fn night_light(&self, field: &LightField, options: &LightOptions, progress: &Progress) -> Result<Layers> {
        let mut layers = Layers::new(self.horizon());
        self.add_night(field, &self.night, &options.layers, &mut layers, progress)?;
        if let Some(bodies) = &self.bodies
            && self.is_night(&self.night)
            && bodies.moon.body.altitude_deg > DARK_DEG
            && options.layers.of(Layer::Sky) > 0.0
        {
            let weights = moonlight_weights(self.moon(bodies)?, self.atmosphere.weights());
            let through = (options.polarising_filter.as_ref(), options.tolerance);
            let dome = self.dome(field, &bodies.moon.body, weights, through, Vec::new(), progress)?;
            layers.add(Layer::Sky, options.layers.of(Layer::Sky), Part { smooth: vec![Box::new(dome)], ..Default::default() });
        }
        Ok(layers)
    }

    /// Irradiance of the horizontal plane by the sky per unit of what [`eclipse::sky_share`] leaves of sunlight, by wavelength.
    fn diffuse_horizontal(&self, field: &LightField, progress: &Progress) -> Result<Vec<f64>> {
        let uncovered = self.uncovered_at(&[eclipse::MIDDLE_NM])[0];
        diffuse_horizontal(field, &self.observer(), |altitude| eclipse::gain_of_sky(uncovered, altitude), progress)
    }

    /// What an eclipse of the Sun, if there is one, does to sky and ground beside dimming them alike.
    fn eclipse_gain(&self, field: &LightField, progress: &Progress) -> Result<Option<Gain>> {
        let Some(eclipse) = &self.eclipse else { return Ok(None) };
        let off_middle = |wavelength: f64| (wavelength - eclipse::MIDDLE_NM).abs();
        let nodes = self.atmosphere.profile().wavelengths_nm.iter().enumerate();
        let middle = nodes.min_by(|a, b| off_middle(*a.1).total_cmp(&off_middle(*b.1))).map_or(0, |(node, _)| node);
        let share = eclipse::sky_share(eclipse.visible_fraction(eclipse::MIDDLE_NM));
        let sky = diffuse_horizontal(field, &self.observer(), |_| 1.0, progress)?[middle];
        let sky_left = self.diffuse_horizontal(field, progress)?[middle] * share;
        let sun = self.transmittance_towards(field, self.sun.apparent_altitude_deg.to_radians())[middle] * self.disc_cosine();
        let to_ground = |altitude: f64| field.ray_transmittance(self.altitude_km(), altitude.sin())[middle];
        Ok(Some(Gain::new(eclipse, self.horizon(), (sun, sky, sky_left), to_ground)))
    }

    /// The Moon outside the air.
    pub(super) fn moon(&self, bodies: &Bodies) -> Result<&MoonDisc> {
        if let Some(moon) = self.moon.get() {
            return Ok(moon);
        }
        let moon = moon(bodies)?;
        Ok(self.moon.get_or_init(|| moon))
    }

    fn field(&self, progress: &Progress) -> Result<&LightField> {
        self.atmosphere.field(progress)
    }

    fn observer(&self) -> Observer {
        self.observer_under(&self.sun)
    }

    fn observer_under(&self, body: &Body) -> Observer {
        Observer { altitude_km: self.altitude_km(), sun_zenith: (90.0 - body.altitude_deg).to_radians() }
    }

    /// Depressions below sea level lie on the ground of the model.
    pub(super) fn altitude_km(&self) -> f64 {
        (self.elevation_m / 1000.0).max(0.0)
    }

    /// What refraction does.
    pub(super) fn refraction(&self) -> &Refraction {
        &self.refraction
    }

    /// Transmittance of the air towards a body at an apparent altitude [radians], by wavelength, as a mean over a disc of the Sun's size.
    pub(super) fn transmittance_towards(&self, field: &LightField, altitude: f64) -> Vec<f64> {
        field.sun_transmittance(&Observer { altitude_km: self.altitude_km(), sun_zenith: FRAC_PI_2 - altitude })
    }

    /// Geometric altitude of the horizon [radians].
    pub(super) fn horizon(&self) -> f64 {
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

    /// The same for what lights the sky: less during an eclipse.
    fn sky_weights(&self) -> Result<Vec<[f64; 3]>> {
        let share = |(xyz, uncovered): ([f64; 3], f64)| xyz.map(|w| w * eclipse::sky_share(uncovered));
        Ok(self.xyz_weights()?.into_iter().zip(self.uncovered()).map(share).collect())
    }

    /// Part of the Sun's light that the Moon does not cover, at the solved wavelengths.
    fn uncovered(&self) -> Vec<f64> {
        self.uncovered_at(&self.atmosphere.profile().wavelengths_nm)
    }

    fn uncovered_at(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        self.eclipse.as_ref().map_or_else(|| vec![1.0; wavelengths_nm.len()], |eclipse| eclipse.visible_fractions(wavelengths_nm))
    }

    /// Solar irradiance outside the air that lights the sky: less during an eclipse [W m-2 nm-1].
    fn sunlight_in_the_air(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        let shares = self.uncovered_at(wavelengths_nm).into_iter().map(eclipse::sky_share);
        self.sunlight(wavelengths_nm).into_iter().zip(shares).map(|(sunlight, share)| sunlight * share).collect()
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
        let transmittance = self.transmittance_towards(field, self.sun.apparent_altitude_deg.to_radians());
        transmittance.iter().zip(self.uncovered()).map(|(transmittance, uncovered)| transmittance * uncovered).collect()
    }

    /// Cosine of incidence of the disc on the horizontal plane.
    fn disc_cosine(&self) -> f64 {
        self.sun.apparent_altitude_deg.to_radians().sin().max(0.0)
    }

    fn sun_irradiance_xyz(&self, field: &LightField) -> Result<[f64; 3]> {
        Ok(sum_of_products(&self.disc_transmittance(field), &self.xyz_weights()?))
    }

    /// The same without an eclipse.
    fn whole_sun_irradiance_xyz(&self, field: &LightField) -> Result<[f64; 3]> {
        let transmittance = self.transmittance_towards(field, self.sun.apparent_altitude_deg.to_radians());
        Ok(sum_of_products(&transmittance, &self.xyz_weights()?))
    }

    fn sun_discs(&self, field: &LightField, horizon: f64) -> Result<Vec<Disc>> {
        let horizontal_radius = (self.atmosphere.profile().sun_angular_radius_deg / self.sun.distance_au).to_radians();
        let flattening = self.refraction.flattening(self.sun.altitude_deg, 2.0 * horizontal_radius.to_degrees());
        let vertical_radius = horizontal_radius * flattening;
        let irradiance = self.sun_irradiance_xyz(field)?;
        let whole = self.whole_sun_irradiance_xyz(field)?;
        let hidden = self.sun.apparent_altitude_deg.to_radians() + vertical_radius <= horizon;
        if hidden || whole[1] <= 0.0 || horizontal_radius <= 0.0 {
            return Ok(Vec::new());
        }
        let direction = self.sun.apparent_direction();
        let surface = Surface::LimbDarkened(SOLAR_LIMB_DARKENING);
        let disc = Disc { is_sun: true, direction, horizontal_radius, vertical_radius, irradiance, surface };
        Ok(match self.eclipse {
            None => vec![disc],
            Some(eclipse) => eclipse::discs(eclipse, &Disc { irradiance: whole, ..disc }, irradiance),
        })
    }
}

fn sum_of_products(values: &[f64], weights: &[[f64; 3]]) -> [f64; 3] {
    let mut xyz = [0.0; 3];
    for (value, weight) in values.iter().zip(weights) {
        for k in 0..3 {
            xyz[k] += value * weight[k];
        }
    }
    xyz
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
    /// Factor on the sky's light during an eclipse of the Sun.
    gain: f64,
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
mod tests;
