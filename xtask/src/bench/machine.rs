//! What a table says above itself: the machine, the compiler and the day.

use std::process::Command;

use anyhow::Result;

/// One line.
pub(crate) fn description() -> Result<String> {
    let processors = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = processors.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let model = model.map_or("unknown processor", |(_, model)| model);
    let cores = std::thread::available_parallelism()?;
    let compiler = answer(&std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into()), "--version");
    Ok(format!("{}, {cores} cores of {model}, {compiler}.", answer("date", "+%Y-%m-%d")))
}

fn answer(program: &str, argument: &str) -> String {
    Command::new(program)
        .arg(argument)
        .output()
        .map_or_else(|_| "unknown".into(), |output| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
