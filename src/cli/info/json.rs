//! The report as JSON, for programs.

use super::{Day, KINDS, Light, Report, is_up, named, zone_source};
use crate::ephemeris::{Body, EarthShadow, MoonState, SolarEclipse};
use crate::time::Time;
use serde_json::{Value, json};

impl Report<'_> {
    pub(super) fn as_json(&self) -> Value {
        let sky = self.sky;
        let sun = sky.sun();
        let mut report = json!({
            "sun": {
                "altitude_deg": sun.altitude_deg,
                "azimuth_deg": sun.azimuth_deg,
                "apparent_altitude_deg": sun.apparent_altitude_deg,
                "distance_au": sun.distance_au,
                "angular_diameter_deg": sun.angular_diameter_deg,
            },
            "elevation_m": sky.elevation_m(),
        });
        if let (Some(place), Some(time)) = (sky.place(), sky.time()) {
            report["place"] = json!({"latitude": place.latitude_deg, "longitude": place.longitude_deg});
            if let Some(label) = &self.config.place_label {
                report["place"]["label"] = json!(label);
            }
            report["time"] = json!(time.to_string());
            report["time_notice"] = json!(time.notice());
            report["zone"] = json!(time.zone_name());
            report["zone_source"] = json!(zone_source(self.config, time));
        }
        if let (Some(day), Some(bodies)) = (&self.day, sky.bodies_of_place()) {
            let times = named(&day.sun).into_iter().map(|(name, time)| (name.replace(' ', "_"), text(time)));
            report["events"] = Value::Object(times.collect());
            report["noon_altitude_deg"] = json!(day.sun.noon_altitude_deg);
            report["bodies"] = bodies.all().map(body).collect();
            report["moon"] = moon(&bodies.moon, day);
            report["solar_eclipse"] = bodies.solar_eclipse().as_ref().map_or(Value::Null, solar_eclipse);
            report["lunar_eclipse"] = bodies.lunar_eclipse().as_ref().map_or(Value::Null, lunar_eclipse);
        }
        if let Some(light) = &self.light {
            let Light { illuminance: lx, irradiance_w_m2, from_nm, to_nm } = light;
            report["illuminance_lx"] = json!({
                "global_horizontal": lx.global_horizontal_lx,
                "direct_normal": lx.direct_normal_lx,
                "direct_horizontal": lx.direct_horizontal_lx,
                "moon_normal": lx.moon_normal_lx,
                "moon_horizontal": lx.moon_horizontal_lx,
                "diffuse_horizontal": lx.diffuse_horizontal_lx,
            });
            let mut sunlight = json!({"global_horizontal": irradiance_w_m2[1] + irradiance_w_m2[2]});
            KINDS.iter().zip(irradiance_w_m2).for_each(|(kind, value)| sunlight[*kind] = json!(value));
            report["irradiance_w_m2"] = sunlight;
            report["irradiance_range_nm"] = json!([from_nm, to_nm]);
        }
        report
    }
}

fn text(time: Option<&Time>) -> Value {
    json!(time.map(Time::to_string))
}

fn body(body: &Body) -> Value {
    json!({
        "name": body.name,
        "above_horizon": is_up(body),
        "altitude_deg": body.altitude_deg,
        "azimuth_deg": body.azimuth_deg,
        "apparent_altitude_deg": body.apparent_altitude_deg,
        "distance_au": body.distance_au,
        "angular_diameter_deg": body.angular_diameter_deg,
        "magnitude": body.magnitude,
        "phase_angle_deg": body.phase_angle_deg,
        "illuminated_fraction": body.illuminated_fraction,
    })
}

fn moon(moon: &MoonState, day: &Day) -> Value {
    json!({
        "phase": day.phase(),
        "illuminated_fraction": moon.illumination.illuminated_fraction,
        "distance_km": moon.distance_km(),
        "elongation_deg": moon.illumination.elongation_deg,
        "sub_observer_deg": [moon.sub_observer.longitude_deg, moon.sub_observer.latitude_deg],
        "sub_solar_deg": [moon.sub_solar.longitude_deg, moon.sub_solar.latitude_deg],
        "bright_limb_position_angle_deg": moon.illumination.bright_limb_position_angle_deg,
        "bright_limb_from_zenith_deg": moon.illumination.bright_limb_from_zenith_deg,
        "axis_position_angle_deg": moon.axis_position_angle_deg,
        "axis_from_zenith_deg": moon.axis_from_zenith_deg,
        "rise": text(day.moon.rise.as_ref()),
        "transit": text(day.moon.transit.as_ref()),
        "transit_altitude_deg": day.moon.transit_altitude_deg,
        "set": text(day.moon.set.as_ref()),
        "up_at_midnight": day.moon.up_at_midnight,
        "next_phases": day.phases.iter().map(|(phase, time)| json!({"phase": phase.name(), "time": time.to_string()})).collect::<Value>(),
    })
}

fn solar_eclipse(eclipse: &SolarEclipse) -> Value {
    json!({
        "kind": eclipse.kind(),
        "magnitude": eclipse.magnitude,
        "obscuration": eclipse.obscuration,
        "separation_deg": eclipse.separation_deg,
        "moon_position_angle_deg": eclipse.moon_position_angle_deg,
        "moon_from_zenith_deg": eclipse.moon_from_zenith_deg,
    })
}

fn lunar_eclipse(shadow: &EarthShadow) -> Value {
    json!({
        "kind": shadow.kind(),
        "umbral_magnitude": shadow.umbral_magnitude,
        "penumbral_magnitude": shadow.penumbral_magnitude,
        "umbra_radius_deg": shadow.umbra_radius_deg,
        "penumbra_radius_deg": shadow.penumbra_radius_deg,
        "moon_axis_angle_deg": shadow.moon_axis_angle_deg,
        "axis_from_zenith_deg": shadow.axis_from_zenith_deg,
    })
}
