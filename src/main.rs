//! The command line tool; see [`skyprobe::cli`].

fn main() -> std::process::ExitCode {
    skyprobe::cli::run(std::env::args_os()).into()
}
