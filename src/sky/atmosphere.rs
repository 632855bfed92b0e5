//! One state of the air together with its solved light.

use super::cache::Cache;
use super::light_key;
use super::turn::Turn;
use crate::atmosphere::{AirParameters, OpticalProfile};
use crate::error::{Error, Result};
use crate::light::LightField;
use crate::numerics::CubicSpline;
use crate::progress::Progress;
use crate::quality::Quality;
use crate::spectrum::{Sensor, solar, wavelengths};
use std::sync::OnceLock;

/// The air and the light in it. The light is solved once, when it is first needed, and serves every place, time and height.
pub struct Atmosphere {
    parameters: Option<AirParameters>,
    profile: OpticalProfile,
    quality: Quality,
    polarised: bool,
    /// Whether the wavelengths are not those of the quality.
    chosen_wavelengths: bool,
    cache: Option<Cache>,
    xyz: OnceLock<Sensor>,
    field: OnceLock<LightField>,
    /// Taken while solving, so that two threads that need the light at once solve it once.
    solving: Turn,
}

impl Atmosphere {
    /// The air of `parameters`. With `polarisation` off light is solved as a scalar, which is wrong by several per cent in clean air: only to compare with scalar codes.
    ///
    /// # Errors
    /// [`Error::Input`] that names the first parameter that cannot be used.
    pub fn new(parameters: &AirParameters, quality: Quality, polarisation: bool) -> Result<Self> {
        let profile = parameters.optical_profile(&wavelengths(quality.numbers().wavelengths))?;
        Ok(Self::unsolved(Some(parameters.clone()), profile, quality, polarisation))
    }

    /// The air of `parameters`, whose light is solved at `wavelengths_nm` (ascending, 300 to 1000 nm) instead of those of the quality. A probe or an illuminance needs wavelengths that make a
    /// colour: at least four from 450 nm or less to 650 nm or more.
    ///
    /// # Errors
    /// As [`Self::new`]; [`Error::Input`] for wavelengths that are none, not ascending or out of range.
    pub fn at_wavelengths(
        parameters: &AirParameters,
        wavelengths_nm: &[f64],
        quality: Quality,
        polarisation: bool,
    ) -> Result<Self> {
        check_chosen(wavelengths_nm)?;
        let profile = parameters.optical_profile(wavelengths_nm)?;
        Ok(Self { chosen_wavelengths: true, ..Self::unsolved(Some(parameters.clone()), profile, quality, polarisation) })
    }

    /// The wavelengths given to [`Self::at_wavelengths`]; `None` for those of the quality or of a profile [nm].
    pub fn chosen_wavelengths(&self) -> Option<&[f64]> {
        self.chosen_wavelengths.then_some(self.profile.wavelengths_nm.as_slice())
    }

    /// Air given in full; its light is solved at the wavelengths of the profile.
    ///
    /// # Errors
    /// [`Error::Input`] that names the first array that cannot be used.
    pub fn from_profile(profile: OpticalProfile, quality: Quality, polarisation: bool) -> Result<Self> {
        profile.validate()?;
        Ok(Self::unsolved(None, profile, quality, polarisation))
    }

    fn unsolved(parameters: Option<AirParameters>, profile: OpticalProfile, quality: Quality, polarised: bool) -> Self {
        Self {
            parameters,
            profile,
            quality,
            polarised,
            chosen_wavelengths: false,
            cache: None,
            xyz: OnceLock::new(),
            field: OnceLock::new(),
            solving: Turn::default(),
        }
    }

    /// The same air, whose solved light is looked for in `cache` and kept there; `None`, which is the default, for none. Drafts, which are solved while a slider moves, are
    /// not kept.
    pub fn with_cache(self, cache: Option<Cache>) -> Self {
        Self { cache: cache.filter(|_| self.quality != Quality::Draft), ..self }
    }

    /// Whether solved light is looked for in a cache.
    pub const fn is_cached(&self) -> bool {
        self.cache.is_some()
    }

    /// Solves the multiple scattering, unless that is done. A thread that waits for another's solve can be cancelled as well.
    ///
    /// # Errors
    /// [`Error::Unsolved`] for air too thick for the solver; [`Error::Cancelled`].
    pub fn solve(&self, progress: &Progress) -> Result<()> {
        self.field(progress).map(|_| ())
    }

    /// The solved light.
    pub(super) fn field(&self, progress: &Progress) -> Result<&LightField> {
        if let Some(field) = self.field.get() {
            return Ok(field);
        }
        let _solving = self.solving.take(|| progress.report("solve", 0.0))?;
        if let Some(field) = self.field.get() {
            return Ok(field);
        }
        let field = match &self.cache {
            Some(cache) => self.kept_or_solved(cache, progress)?,
            None => LightField::solve(&self.profile, &self.quality.numbers(), self.polarised, progress)?,
        };
        Ok(self.field.get_or_init(|| field))
    }

    fn kept_or_solved(&self, cache: &Cache, progress: &Progress) -> Result<LightField> {
        let (profile, numbers) = (&self.profile, &self.quality.numbers());
        let key = light_key::of(profile, numbers, self.polarised);
        progress.report("solve", 0.0)?;
        let kept = cache.load(&key);
        if let Some(field) = kept.and_then(|kept| LightField::from_sections(profile, numbers, self.polarised, &kept).ok()) {
            progress.report("solve", 1.0)?;
            return Ok(field);
        }
        let field = LightField::solve(profile, numbers, self.polarised, progress)?;
        cache.store(&key, &field.to_sections());
        Ok(field)
    }

    /// Whether the light has been solved.
    pub fn is_solved(&self) -> bool {
        self.field.get().is_some()
    }

    /// The quality level.
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// Whether light is solved with its polarisation.
    pub fn is_polarised(&self) -> bool {
        self.polarised
    }

    /// Optical properties.
    pub fn profile(&self) -> &OpticalProfile {
        &self.profile
    }

    /// What the air was made from; `None` for air given as a profile.
    pub fn parameters(&self) -> Option<&AirParameters> {
        self.parameters.as_ref()
    }

    /// Weights by wavelength that turn radiance per unit solar irradiance at 1 au into XYZ [W m-2].
    ///
    /// # Errors
    /// [`Error::Input`] if the wavelengths are too few or cover too little of the visible spectrum to make a colour.
    pub(super) fn xyz_weights(&self) -> Result<Vec<[f64; 3]>> {
        let sensor = self.xyz()?;
        if self.parameters.is_some() {
            return Ok(sensor.of(|wavelength| solar::irradiance(wavelength, 1.0)));
        }
        let plain = sensor.of(|_| 1.0);
        Ok(plain.into_iter().zip(&self.profile.solar_irradiance).map(|(xyz, &sun)| xyz.map(|w| w * sun)).collect())
    }

    /// X, Y and Z of light of any source by the solved wavelengths.
    ///
    /// # Errors
    /// As [`Self::xyz_weights`].
    pub(super) fn xyz(&self) -> Result<&Sensor> {
        let nodes = &self.profile.wavelengths_nm;
        let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
        if nodes.len() < 4 || first > 450.0 || last < 650.0 {
            return Err(Error::input(
                "wavelengths_nm",
                format!("{} values from {first} to {last} nm", nodes.len()),
                "at least 4 values that reach from 450 nm or less to 650 nm or more, to make a colour",
            ));
        }
        Ok(self.xyz.get_or_init(|| Sensor::xyz(nodes)))
    }

    /// Spectral values at `wavelengths_nm` of light of any source by the solved wavelengths.
    pub(super) fn bands(&self, wavelengths_nm: &[f64]) -> Vec<Sensor> {
        Sensor::bands(&self.profile.wavelengths_nm, wavelengths_nm)
    }

    /// Solar irradiance at 1 au at any of the wavelengths that the profile covers [W m-2 nm-1].
    pub(super) fn solar_irradiance(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        if self.parameters.is_some() {
            return solar::band_means(wavelengths_nm);
        }
        let spline = CubicSpline::new(&self.profile.wavelengths_nm, &self.profile.solar_irradiance);
        wavelengths_nm.iter().map(|&wavelength| spline.value(wavelength)).collect()
    }

    /// Checks that `wavelengths_nm` lie within those of the profile.
    pub(super) fn check_wavelengths(&self, wavelengths_nm: &[f64]) -> Result<()> {
        let nodes = &self.profile.wavelengths_nm;
        for &wavelength in wavelengths_nm {
            crate::error::check_range("wavelengths_nm", wavelength, nodes[0], nodes[nodes.len() - 1], "nm")?;
        }
        Ok(())
    }
}

/// Checks wavelengths at which the air of parameters is to be solved [nm].
pub(crate) fn check_chosen(wavelengths_nm: &[f64]) -> Result<()> {
    if wavelengths_nm.is_empty() {
        return Err(Error::input("wavelengths_nm", "nothing", "left out, or at least one wavelength"));
    }
    for &wavelength in wavelengths_nm {
        crate::error::check_range("wavelengths_nm", wavelength, 300.0, 1000.0, "nm")?;
    }
    match wavelengths_nm.windows(2).find(|pair| pair[0] >= pair[1]) {
        Some([_, later]) => Err(Error::input("wavelengths_nm", later, "larger than the wavelength before it")),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::Observer;
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

    fn air(aod550: f64, polarisation: bool, cache: &Cache) -> Atmosphere {
        let parameters = AirParameters { aod550: Some(aod550), ..Default::default() };
        Atmosphere::new(&parameters, Quality::Standard, polarisation).unwrap().with_cache(Some(cache.clone()))
    }

    /// How often the progress of a solve is reported: twice when nothing is solved.
    fn reports(air: &Atmosphere) -> usize {
        let count = AtomicUsize::new(0);
        let listen = |stage: &str, _: f64| {
            assert_eq!(stage, "solve");
            count.fetch_add(1, Ordering::Relaxed);
            true
        };
        air.solve(&Progress::new(&listen)).unwrap();
        count.into_inner()
    }

    #[test]
    fn kept_light_is_the_solved_light_bit_by_bit_and_of_this_air_only() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::new(folder.path(), 1 << 30);
        let solved = air(0.1, true, &cache);
        assert!(reports(&solved) > 2);
        let kept = air(0.1, true, &cache);
        assert_eq!(reports(&kept), 2);
        let seen = |air: &Atmosphere| {
            let field = air.field(&Progress::silent()).unwrap();
            let observer = Observer { altitude_km: 1.2, sun_zenith: 1.4 };
            let gathered = field.gather(&observer, 0.1, &[0.0, 0.7, 3.0]);
            let radiances = (0..3).flat_map(|a| (0..gathered.wavelengths).map(move |w| (a, w)));
            let radiances: Vec<_> = radiances.map(|(a, w)| field.stokes(&gathered, a, w, [0.3, 0.2], 0.4)).collect();
            (radiances, field.sun_transmittance(&observer))
        };
        assert!(seen(&solved) == seen(&kept));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn the_air_can_be_solved_at_chosen_wavelengths() {
        let clear = AirParameters::default();
        let at = |wavelengths: &[f64]| Atmosphere::at_wavelengths(&clear, wavelengths, Quality::Draft, true);
        let (some, usual) = (at(&[360.0, 380.0, 1000.0]).unwrap(), Atmosphere::new(&clear, Quality::Draft, true).unwrap());
        let zenith = |air: &Atmosphere, wavelength: usize| {
            let field = air.field(&Progress::silent()).unwrap();
            let observer = Observer { altitude_km: 0.0, sun_zenith: 1.0 };
            field.radiance(&field.gather(&observer, 1.0, &[0.0]), 0, wavelength, 1_f64.cos())
        };
        // Both know 380 nm, and differ only in the width of the band over which ozone is averaged.
        assert_eq!(usual.profile().wavelengths_nm[0], 380.0);
        assert!((zenith(&some, 1) / zenith(&usual, 0) - 1.0).abs() < 1e-3);
        let [near, far] = [0, 2].map(|w| zenith(&some, w) / zenith(&some, 1));
        assert!((near - 1.0).abs() < 0.2 && far < 0.3, "{near} {far}");
        assert!(some.xyz_weights().is_err() && usual.chosen_wavelengths().is_none());
        for (wrong, start) in [
            (&[][..], "wavelengths_nm = nothing"),
            (&[299.0], "wavelengths_nm = 299: must be a number from 300 to 1000 nm"),
            (&[f64::NAN], "wavelengths_nm = NaN"),
            (&[500.0, 500.0], "wavelengths_nm = 500: must be larger"),
        ] {
            let message = at(wrong).err().unwrap().to_string();
            assert!(message.starts_with(start), "{message}");
        }
    }

    #[test]
    fn who_waits_for_another_threads_solve_can_be_cancelled() {
        let air = Atmosphere::new(&AirParameters::default(), Quality::Draft, false).unwrap();
        let (inside, outside) = (AtomicBool::new(false), AtomicBool::new(false));
        // The first solve does not go on until the second has been cancelled.
        let hold = |_: &str, _: f64| {
            inside.store(true, Ordering::SeqCst);
            while !outside.load(Ordering::SeqCst) {
                std::thread::yield_now();
            }
            true
        };
        let stop = |_: &str, _: f64| false;
        std::thread::scope(|scope| {
            let first = scope.spawn(|| air.solve(&Progress::new(&hold)));
            while !inside.load(Ordering::SeqCst) {
                std::thread::yield_now();
            }
            assert!(matches!(air.solve(&Progress::new(&stop)), Err(Error::Cancelled)));
            assert!(!air.is_solved());
            outside.store(true, Ordering::SeqCst);
            first.join().unwrap().unwrap();
        });
        // Who comes later gets what the first found.
        assert!(air.is_solved() && air.solve(&Progress::new(&stop)).is_ok());
    }

    #[test]
    fn a_cancelled_or_failed_solve_lets_the_next_thread_solve() {
        let air = Atmosphere::new(&AirParameters::default(), Quality::Draft, false).unwrap();
        let stop = |_: &str, _: f64| false;
        assert!(matches!(air.solve(&Progress::new(&stop)), Err(Error::Cancelled)));
        assert!(reports(&air) > 2);
    }

    #[test]
    fn kept_nonsense_is_not_believed() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::new(folder.path(), 1 << 30);
        let solved = air(0.1, false, &cache);
        solved.solve(&Progress::silent()).unwrap();
        let sound = solved.field(&Progress::silent()).unwrap().to_sections();
        let key = light_key::of(solved.profile(), &solved.quality().numbers(), false);
        type Harm = fn(&mut Vec<Vec<f32>>);
        let harms: [Harm; 6] = [
            |sections| sections[0][5] = f32::NAN,
            |sections| sections[1][0] = f32::INFINITY,
            |sections| sections[2].iter_mut().for_each(|value| *value = f32::NAN),
            |sections| sections[3][3] = f32::NEG_INFINITY,
            |sections| sections[0].iter_mut().for_each(|value| *value *= 100.0),
            |sections| sections.iter_mut().for_each(|section| section.fill(0.0)),
        ];
        for (k, harm) in harms.into_iter().enumerate() {
            let mut sections = sound.clone();
            harm(&mut sections);
            cache.store(&key, &sections);
            let again = air(0.1, false, &cache);
            assert!(reports(&again) > 2, "harm {k} was believed");
            assert!(again.field(&Progress::silent()).unwrap().to_sections() == sound);
        }
        assert_eq!(reports(&air(0.1, false, &cache)), 2);
    }

    #[test]
    fn a_damaged_file_is_solved_again_and_drafts_are_not_kept() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::new(folder.path(), 1 << 30);
        air(0.2, false, &cache).solve(&Progress::silent()).unwrap();
        let file = std::fs::read_dir(folder.path()).unwrap().next().unwrap().unwrap().path();
        let sound = std::fs::read(&file).unwrap();
        std::fs::write(&file, &sound[..sound.len() / 2]).unwrap();
        assert!(reports(&air(0.2, false, &cache)) > 2);
        assert_eq!(std::fs::read(&file).unwrap(), sound);
        let draft = Atmosphere::new(&AirParameters::default(), Quality::Draft, false).unwrap();
        draft.with_cache(Some(cache)).solve(&Progress::silent()).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
