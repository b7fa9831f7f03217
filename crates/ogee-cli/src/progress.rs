//! A spinner on a terminal, once work has taken half a second.

use std::io::IsTerminal;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use indicatif::ProgressBar;

/// How long nothing is shown.
const PATIENCE: Duration = Duration::from_millis(500);

/// Says what is being done. Nothing is left on the screen when it is dropped.
pub(crate) struct Progress {
    running: Option<(Sender<&'static str>, JoinHandle<()>)>,
}

impl Progress {
    /// Starts waiting; shows nothing ever if not `wanted` or where there is no terminal.
    pub(crate) fn start(wanted: bool) -> Progress {
        if !wanted || !std::io::stderr().is_terminal() {
            return Progress { running: None };
        }
        let (sender, receiver) = channel();
        Progress { running: Some((sender, std::thread::spawn(move || show(&receiver)))) }
    }

    /// Names the step that begins.
    pub(crate) fn step(&self, name: &'static str) {
        if let Some((sender, _)) = &self.running {
            // Without a listener there is nobody to tell.
            let _ = sender.send(name);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((sender, thread)) = self.running.take() {
            drop(sender);
            let _ = thread.join();
        }
    }
}

fn show(steps: &Receiver<&'static str>) {
    let start = Instant::now();
    let mut step = "";
    loop {
        match steps.recv_timeout(PATIENCE.saturating_sub(start.elapsed())) {
            Ok(name) => step = name,
            Err(RecvTimeoutError::Disconnected) => return,
            Err(RecvTimeoutError::Timeout) => break,
        }
    }
    let spinner = ProgressBar::new_spinner().with_message(step);
    spinner.enable_steady_tick(Duration::from_millis(100));
    for name in steps {
        spinner.set_message(name);
    }
    spinner.finish_and_clear();
}
