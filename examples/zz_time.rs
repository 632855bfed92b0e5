use skyprobe::atmosphere::AirParameters;
use skyprobe::light::LightField;
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use skyprobe::spectrum::wavelengths;
fn main() {
    let q: Quality = std::env::args().nth(1).unwrap_or("high".into()).parse().unwrap();
    let n = q.numbers();
    let profile = AirParameters::default().optical_profile(&wavelengths(n.wavelengths)).unwrap();
    let pol = std::env::args().nth(2).is_none();
    for _ in 0..2 {
        let start = std::time::Instant::now();
        let f = move |s: &str, x: f64| { if std::env::var("V").is_ok() { eprintln!("{s} {x:.3} {:.3}", start.elapsed().as_secs_f64()); } true };
        LightField::solve(&profile, &n, pol, &Progress::new(&f)).unwrap();
        println!("{:.3} s", start.elapsed().as_secs_f64());
    }
}
