//! Where Moon, Sun, Earth and observer stand: all that the Moon's appearance depends on.

use super::moon_irradiance::MoonPhase;
use super::{angle, check_unit_vector};
use crate::ephemeris::MOON_RADIUS_KM;
use crate::error::{Error, Result, check_range};
use crate::units::ASTRONOMICAL_UNIT_KM;
use glam::{DMat3, DVec3};

/// Geometry of one look at the Moon. All vectors in one frame (such as east, north, up), whichever it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoonView {
    /// Unit vector from the observer to the Moon's centre.
    pub direction: DVec3,
    /// Distance from the observer to the Moon's centre [km].
    pub distance_km: f64,
    /// Unit vector from the Moon's centre to the Sun's.
    pub sun_direction: DVec3,
    /// Distance from the Moon's centre to the Sun's [au].
    pub sun_distance_au: f64,
    /// Unit vector from the Moon's centre to the Earth's.
    pub earth_direction: DVec3,
    /// Distance from the Moon's centre to the Earth's [km].
    pub earth_distance_km: f64,
    /// Rotation from the body-fixed frame (x to longitude 0 on the equator, y to 90 degrees east, z north) to that of the vectors.
    pub body_to_frame: DMat3,
}

impl MoonView {
    /// Checks lengths and distances: distances 20 000 to 1 000 000 km, Sun 0.5 to 2 au, unit vectors and rotation within 1e-6.
    pub fn validate(&self) -> Result<()> {
        check_range("distance_km", self.distance_km, 20_000.0, 1e6, "km")?;
        check_range("earth_distance_km", self.earth_distance_km, 20_000.0, 1e6, "km")?;
        check_range("sun_distance_au", self.sun_distance_au, 0.5, 2.0, "au")?;
        check_unit_vector("direction", self.direction)?;
        check_unit_vector("sun_direction", self.sun_direction)?;
        check_unit_vector("earth_direction", self.earth_direction)?;
        let matrix = self.body_to_frame;
        let departure =
            (matrix * matrix.transpose() - DMat3::IDENTITY).to_cols_array().into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        if !(departure < 1e-6 && matrix.determinant() > 0.0) {
            return Err(Error::input("body_to_frame", format!("{matrix}"), "a rotation matrix"));
        }
        Ok(())
    }

    /// A view from the Earth's centre for a phase angle, without libration: the Moon towards +y, north up (+z), lit from +x while it waxes
    /// (positive `phase_deg`) and from -x while it wanes. For pictures and tests.
    pub fn schematic(phase_deg: f64) -> Self {
        let phase = phase_deg.to_radians();
        let distance_km = super::moon_irradiance::STANDARD_DISTANCE_KM;
        Self {
            direction: DVec3::Y,
            distance_km,
            sun_direction: DVec3::new(phase.sin(), -phase.cos(), 0.0),
            sun_distance_au: 1.0,
            earth_direction: DVec3::NEG_Y,
            earth_distance_km: distance_km,
            body_to_frame: DMat3::from_cols(DVec3::NEG_Y, DVec3::X, DVec3::Z),
        }
    }

    /// Angular radius of the disc [radians].
    pub fn angular_radius(&self) -> f64 {
        (MOON_RADIUS_KM / self.distance_km).asin()
    }

    /// Solid angle of the disc [sr].
    pub fn solid_angle(&self) -> f64 {
        std::f64::consts::TAU * 2.0 * (0.5 * self.angular_radius()).sin().powi(2)
    }

    /// Angle at the Moon's centre between Sun and observer [radians].
    pub fn phase_angle(&self) -> f64 {
        angle(self.sun_direction, -self.direction)
    }

    /// Angle at the Moon's centre between Earth's centre and observer, up to 0.017 [radians].
    pub fn parallax_angle(&self) -> f64 {
        angle(self.earth_direction, -self.direction)
    }

    /// Angle at the Moon's centre between Sun and Earth: the Earth's phase angle is its supplement [radians].
    pub fn earth_sun_angle(&self) -> f64 {
        angle(self.sun_direction, self.earth_direction)
    }

    /// What the ROLO model asks for.
    pub fn phase(&self) -> MoonPhase {
        let to_body = self.body_to_frame.transpose();
        let (sun, observer) = (to_body * self.sun_direction, to_body * -self.direction);
        MoonPhase {
            phase_angle_deg: self.phase_angle().to_degrees(),
            sun_longitude_deg: sun.y.atan2(sun.x).to_degrees(),
            observer_latitude_deg: observer.z.clamp(-1.0, 1.0).asin().to_degrees(),
            observer_longitude_deg: observer.y.atan2(observer.x).to_degrees(),
        }
    }

    /// Unit vector from the Moon's centre to the surface point seen in `direction` (unit vector), or `None` beside the disc.
    pub fn surface_normal(&self, direction: DVec3) -> Option<DVec3> {
        let along = direction.dot(self.direction);
        if along <= 0.0 {
            return None;
        }
        // Offsets from the centre, so that nothing cancels for a disc of 0.0045 radians.
        let across = (direction - along * self.direction) * self.distance_km;
        let offset = self.distance_km * along * direction - self.distance_km * self.direction;
        let depth = MOON_RADIUS_KM * MOON_RADIUS_KM - across.length_squared();
        (depth >= 0.0).then(|| ((offset - depth.sqrt() * direction) / MOON_RADIUS_KM).normalize())
    }

    /// Angular distance from the axis of the Earth's shadow, as [`super::ShadowedSunlight`] counts it, of a surface point [radians]; `None`
    /// if the point is not behind the Earth.
    pub fn shadow_angle(&self, normal: DVec3) -> Option<f64> {
        let sun = self.sun_direction * (self.sun_distance_au * ASTRONOMICAL_UNIT_KM);
        let earth = self.earth_direction * self.earth_distance_km;
        let axis = (earth - sun).normalize();
        let point = normal * MOON_RADIUS_KM - earth;
        let along = point.dot(axis);
        if along <= 0.0 {
            return None;
        }
        let across = (point - along * axis).length();
        Some((across / along).atan() - (across / (along + (earth - sun).length())).atan())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_waxing_moon_is_lit_on_the_side_of_mare_crisium() {
        let view = MoonView::schematic(60.0);
        view.validate().unwrap();
        let phase = view.phase();
        assert!((phase.phase_angle_deg - 60.0).abs() < 1e-9 && (phase.sun_longitude_deg - 60.0).abs() < 1e-9);
        // The observer looks towards +y with +z up: his right is +x.
        let crisium = view.body_to_frame * super::super::moon_map::body_fixed(59.0, 17.0);
        assert!(crisium.x > 0.0 && crisium.z > 0.0 && crisium.dot(view.sun_direction) > 0.9);
    }

    #[test]
    fn rays_meet_the_sphere() {
        let view = MoonView::schematic(10.0);
        let centre = view.surface_normal(view.direction).unwrap();
        assert!(centre.distance(-view.direction) < 1e-12);
        let radius = view.angular_radius();
        for share in [0.3_f64, 0.9, 0.999] {
            let at = share * radius;
            let direction = DVec3::new(at.sin(), at.cos(), 0.0);
            let normal = view.surface_normal(direction).unwrap();
            // The point lies on the ray.
            let point = view.direction * view.distance_km + normal * MOON_RADIUS_KM;
            assert!(point.normalize().distance(direction) < 1e-9, "{share}");
        }
        assert!(view.surface_normal(DVec3::new((1.001 * radius).sin(), (1.001 * radius).cos(), 0.0)).is_none());
        assert!(view.surface_normal(-view.direction).is_none());
        // Solid angle of the paper.
        assert!((view.solid_angle() / 6.4177e-5 - 1.0).abs() < 1e-4);
    }

    #[test]
    fn the_shadow_axis_goes_through_the_full_moon() {
        let view = MoonView::schematic(0.0);
        assert!(view.shadow_angle(-view.direction).unwrap() < 1e-9);
        let limb = view.shadow_angle(DVec3::X).unwrap();
        assert!((limb / (MOON_RADIUS_KM / view.earth_distance_km) - 1.0).abs() < 0.004);
        assert!(MoonView::schematic(180.0).shadow_angle(DVec3::Y).is_none());
    }

    #[test]
    fn bad_geometry_is_named() {
        let bad = MoonView { distance_km: 5.0, ..MoonView::schematic(0.0) };
        assert!(bad.validate().unwrap_err().to_string().starts_with("distance_km = 5"));
        let bad = MoonView { sun_direction: DVec3::NAN, ..MoonView::schematic(0.0) };
        assert!(bad.validate().unwrap_err().to_string().starts_with("sun_direction"));
        let bad = MoonView { body_to_frame: DMat3::ZERO, ..MoonView::schematic(0.0) };
        assert!(bad.validate().unwrap_err().to_string().starts_with("body_to_frame"));
    }
}
