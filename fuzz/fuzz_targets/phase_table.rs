//! Tabulated phase functions: what is accepted is finite, not negative, and 1 on average over the sphere.
#![no_main]

use libfuzzer_sys::fuzz_target;
use skyprobe::atmosphere::PhaseTable;

fuzz_target!(|arrays: (bool, Vec<f64>, Vec<f64>)| {
    let (ascending, mut angles, mut values) = arrays;
    angles.truncate(64);
    if ascending && angles.len() >= 2 {
        let last = angles.len() - 1;
        angles.iter_mut().enumerate().for_each(|(index, angle)| *angle = std::f64::consts::PI * index as f64 / last as f64);
        let rows = (values.len() / angles.len()).clamp(1, 4);
        values.resize(rows * angles.len(), 1.0);
    }
    let Ok(table) = PhaseTable::new(&angles, &values) else { return };
    assert!(table.wavelengths() > 0);
    for wavelength in 0..table.wavelengths() {
        for cosine in [-1.0, -0.999, -0.2, 0.0, 0.4, 0.9999, 1.0] {
            let value = table.value(wavelength, cosine);
            assert!(value.is_finite() && value >= 0.0, "{value}");
        }
        for moment in table.legendre_moments(8, wavelength) {
            assert!(moment.is_finite(), "{moment}");
        }
    }
});
