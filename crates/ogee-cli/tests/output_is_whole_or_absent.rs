//! Output that cannot be written: exit code 4, one line, and nothing left behind.

mod common;

use std::fs;

use common::{CUBE, Folder};

#[test]
fn a_folder_that_does_not_exist() {
    let folder = Folder::with_cube();
    let run = folder.ogee("convert --json cube.obj -o nowhere/out.step").expect(4);
    assert_eq!(run.first_line(), "nowhere/out.step: not written: the folder nowhere does not exist");
    assert_eq!(run.json()["error"]["code"], "not_written");
    assert_eq!(folder.names(), ["cube.obj"]);
}

#[test]
fn a_folder_in_the_place_of_the_file() {
    let folder = Folder::with_cube();
    fs::create_dir(folder.path("out.step")).unwrap();
    let run = folder.ogee("convert cube.obj -o out.step").expect(4);
    assert!(run.first_line().starts_with("out.step: not written: "), "{}", run.first_line());
    assert_eq!(folder.names(), ["cube.obj", "out.step"]);
}

/// Nobody may make a file in `/proc`, not even root, for whom folders are never read-only.
#[test]
#[cfg(target_os = "linux")]
fn a_folder_that_takes_no_files() {
    let folder = Folder::with_cube();
    for what in ["convert cube.obj -o /proc/out.step", "refine cube.obj -l 1 -o /proc/out.obj"] {
        let run = folder.ogee(what).expect(4);
        assert!(run.first_line().starts_with("/proc/out."), "{}", run.first_line());
        assert_eq!(run.stderr.lines().count(), 1);
    }
}

#[test]
#[cfg(unix)]
fn a_read_only_folder_and_file() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::with_cube();
    fs::create_dir(folder.path("locked")).unwrap();
    folder.write("locked/old.step", "what was there");
    let set =
        |name: &str, mode| fs::set_permissions(folder.path(name), fs::Permissions::from_mode(mode)).unwrap();
    set("locked/old.step", 0o444);
    set("locked", 0o555);
    if fs::write(folder.path("locked/probe"), "").is_err() {
        folder.ogee("convert cube.obj -o locked/new.step").expect(4);
        folder.ogee("convert cube.obj -o locked/old.step").expect(4);
        assert_eq!(folder.read("locked/old.step"), b"what was there");
    } else {
        eprintln!("skipped: for this user no folder is read-only");
    }
    set("locked", 0o755);
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk() {
    let folder = Folder::with_cube();
    for what in ["convert cube.obj", "refine cube.obj -l 1"] {
        for format in if what.starts_with("convert") { ["step", "bv", "json"] } else { ["obj", "ply", "glb"] }
        {
            let run = folder.ogee(&format!("{what} -o /dev/full --output-format {format}")).expect(4);
            assert_eq!(run.first_line(), "/dev/full: not written: No space left on device");
        }
    }
    use std::os::unix::fs::FileTypeExt;
    assert!(fs::metadata("/dev/full").unwrap().file_type().is_char_device());
    assert_eq!(folder.names(), ["cube.obj"]);
}

#[test]
fn a_file_is_replaced_when_all_is_there() {
    let folder = Folder::with_cube();
    folder.write("out.step", "what was there");
    folder.ogee("convert cube.obj -o out.step").expect(0);
    assert!(folder.read("out.step").starts_with(b"ISO-10303-21;"));
    assert_eq!(folder.names(), ["cube.obj", "out.step"]);
    // The cage itself may be the output.
    folder.ogee("refine cube.obj -l 1 -o cube.obj").expect(0);
    assert_ne!(folder.read("cube.obj"), CUBE.as_bytes());
}

#[test]
#[cfg(unix)]
fn permissions_and_links_stay() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::with_cube();
    let mode = |name: &str| fs::metadata(folder.path(name)).unwrap().permissions().mode() & 0o777;
    folder.write("plain", "");
    folder.ogee("convert cube.obj -o new.step").expect(0);
    assert_eq!(mode("new.step"), mode("plain"), "as any new file");

    fs::set_permissions(folder.path("new.step"), fs::Permissions::from_mode(0o640)).unwrap();
    std::os::unix::fs::symlink("new.step", folder.path("link.step")).unwrap();
    folder.write("new.step", "what was there");
    folder.ogee("convert cube.obj -o link.step").expect(0);
    assert!(fs::symlink_metadata(folder.path("link.step")).unwrap().is_symlink());
    assert!(folder.read("new.step").starts_with(b"ISO-10303-21;"));
    assert_eq!(mode("new.step"), 0o640);
}

#[test]
#[cfg(target_os = "linux")]
fn a_closed_pipe_is_quiet() {
    use std::io::Read;
    use std::process::{Command, Stdio};
    let folder = Folder::with_cube();
    let commands = [
        "refine cube.obj -l 6 -o - --output-format obj",
        "eval cube.obj --uniform 100 -o - --format csv",
        "completions bash",
        "man",
    ];
    for what in commands {
        let mut child = Command::new(env!("CARGO_BIN_EXE_ogee"))
            .args(what.split(' '))
            .current_dir(folder.path(""))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut stdout = child.stdout.take().unwrap();
        if what.starts_with("refine") {
            stdout.read_exact(&mut [0; 10]).unwrap();
        }
        drop(stdout);
        let output = child.wait_with_output().unwrap();
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{what}");
        assert!(output.status.code().is_some(), "{what}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn an_interrupt_leaves_nothing_behind() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};
    let folder = Folder::with_cube();
    let mut child = Command::new(env!("CARGO_BIN_EXE_ogee"))
        .args(["refine", "cube.obj", "-l", "9", "-o", "out.obj"])
        .current_dir(folder.path(""))
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    // Wait until it writes.
    let start = Instant::now();
    while folder.names().len() < 2 && start.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(folder.names()[0].starts_with(".ogee.tmp-"), "{:?}", folder.names());
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(folder.names(), ["cube.obj"]);
}
