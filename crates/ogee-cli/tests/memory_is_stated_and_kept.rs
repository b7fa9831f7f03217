//! Memory is known from counts before it is taken: what is more than allowed is refused, with the level that fits; what is said is kept.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use assert_cmd::Command;
use common::{CUBE, Folder, finish};
use ogee::shapes;
use serde_json::Value;

/// A torus with studs of 2 500 quads.
fn with_torus() -> Folder {
    let folder = Folder::with_cube();
    let mut bytes = Vec::new();
    let torus = shapes::studded_torus(50, 48, 8);
    ogee_formats::obj::write_cage(&torus, "a torus with studs", &mut bytes).unwrap();
    folder.write("torus.obj", bytes);
    folder
}

fn number(report: &Value, field: &str) -> u64 {
    report[field].as_u64().unwrap_or_else(|| panic!("{field} in {report}"))
}

#[test]
fn what_is_stated_is_kept() {
    let folder = with_torus();
    for what in [
        "refine torus.obj -l 1 -o out.obj",
        "refine torus.obj -l 4 -o out.ply",
        "refine torus.obj -l 3 --limit -o out.ply",
        "refine torus.obj -l 5 --stream -o out.ply",
        "convert torus.obj -o out.json",
        "convert torus.obj -o out.bv --level 3",
        "convert torus.obj -o out.step",
        "convert torus.obj -o out.step --no-pack",
    ] {
        let report = folder.ogee(&format!("{what} --json")).expect(0).json();
        let (stated, peak) = (number(&report, "memory_stated"), number(&report, "peak_bytes"));
        assert!(peak <= stated, "{what}: {peak} held, {stated} stated");
        assert!(stated < 3 * peak + (64 << 20), "{what}: {peak} held, {stated} stated");
        // As much as is stated is enough, and so is what is free.
        folder.ogee(&format!("{what} --max-memory {}", stated + stated / 10)).expect(0);
    }
}

#[test]
fn more_than_is_allowed_is_refused_with_the_level_that_fits() {
    let folder = with_torus();
    for (what, level, allowed) in [
        ("refine torus.obj -o out.ply", 7, "200M"),
        ("refine torus.obj -o out.ply --limit", 6, "200MB"),
        ("refine torus.obj -o out.ply --stream", 8, "200M"),
        ("convert torus.obj -o out.json", 4, ""),
        ("convert torus.obj -o out.step", 4, ""),
    ] {
        let mut allowed = allowed.to_owned();
        if allowed.is_empty() {
            // A little less than the level needs.
            let report = folder.ogee(&format!("{what} --json --level {level}")).expect(0).json();
            allowed = (number(&report, "memory_stated") / 10 * 9).to_string();
            let output = what.split(' ').find(|word| word.starts_with("out.")).unwrap();
            std::fs::remove_file(folder.path(output)).unwrap();
        }
        let arguments = |level: u32| format!("{what} --json --level {level} --max-memory {allowed}");
        let run = folder.ogee(&arguments(level)).expect(3);
        let line = run.first_line().to_owned();
        assert!(line.starts_with(&format!("torus.obj: {level} levels would make")), "{line}");
        assert!(line.ends_with("of --max-memory"), "{line}");
        assert_eq!(run.json()["error"]["code"], "too_deep");
        assert_eq!(folder.names(), ["cube.obj", "torus.obj"]);
        let (_, deepest) = line.split_once("at most ").unwrap();
        let deepest: u32 = deepest.split(' ').next().unwrap().parse().unwrap();
        assert!(deepest > 1 && deepest < level, "{line}");
        let report = folder.ogee(&arguments(deepest)).expect(0).json();
        let (stated, peak) = (number(&report, "memory_stated"), number(&report, "peak_bytes"));
        assert!(peak <= stated, "{what} at level {deepest}: {peak} held, {stated} stated");
        let output = what.split(' ').find(|word| word.starts_with("out.")).unwrap();
        std::fs::remove_file(folder.path(output)).unwrap();
    }
}

#[test]
fn a_stream_gives_the_same_bytes_in_less_memory() {
    let folder = with_torus();
    for format in ["obj", "ply", "off"] {
        for level in 0..=3 {
            let what = format!("refine torus.obj -l {level} -o");
            let whole = folder.ogee(&format!("{what} whole.{format} --json")).expect(0).json();
            let streamed = folder.ogee(&format!("{what} out.{format} --json --stream")).expect(0).json();
            assert!(folder.read(&format!("out.{format}")) == folder.read(&format!("whole.{format}")));
            for field in ["level", "vertices", "faces", "file_bytes", "notes"] {
                assert_eq!(streamed[field], whole[field], "{field}");
            }
        }
    }
    let peak = |options: &str| {
        number(
            &folder.ogee(&format!("refine torus.obj -l 6 -o out.ply --json {options}")).expect(0).json(),
            "peak_bytes",
        )
    };
    let (whole, streamed) = (peak(""), peak("--stream"));
    assert!(2 * streamed < whole, "{streamed} held, {whole} without --stream");
    // On stdout the name of the mesh is all that could differ, and does not.
    folder.ogee("refine torus.obj -l 2 -o whole.obj").expect(0);
    let stdout = folder.ogee("refine torus.obj -l 2 --stream -o - --output-format obj").expect(0).stdout;
    assert!(stdout == folder.read("whole.obj"));
}

#[test]
fn what_cannot_be_streamed_is_a_usage_error() {
    let folder = with_torus();
    folder.write(
        "uv.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n",
    );
    for (arguments, why) in [
        ("torus.obj -l 1 --limit -o out.obj", "--limit"),
        ("torus.obj -l 1 -o out.stl", "obj, ply and off, not stl"),
        ("torus.obj -l 1 -o out.glb", "not glb"),
        ("torus.obj -l 1 -o out.json", "not json"),
        ("uv.obj -l 1 -o out.obj", "texture"),
    ] {
        let run = folder.ogee(&format!("refine --stream {arguments}")).expect(2);
        assert!(run.stderr.contains(why), "{}", run.stderr);
        assert_eq!(folder.names().len(), 3);
    }
    folder.ogee("refine --stream uv.obj -l 1 -o out.ply").expect(0);
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_leaves_no_half_file() {
    let folder = with_torus();
    for format in ["obj", "ply", "off"] {
        let run =
            folder.ogee(&format!("refine torus.obj -l 4 --stream -o /dev/full --output-format {format}"));
        assert_eq!(run.expect(4).first_line(), "/dev/full: not written: No space left on device");
    }
    // A file that may not grow so far is a disk that fills half-way.
    folder.write("old.ply", "what was there");
    for output in ["old.ply", "new.ply"] {
        let mut command = Command::new("sh");
        command.arg("-c").arg(format!(
            "trap '' XFSZ; ulimit -f 2000; exec \"$0\" refine torus.obj -l 4 --stream -o {output}"
        ));
        command.arg(env!("CARGO_BIN_EXE_ogee")).current_dir(folder.path(""));
        let run = finish(command);
        assert_eq!(run.code, 4, "{}", run.stderr);
        assert!(run.first_line().starts_with(&format!("{output}: not written: ")), "{}", run.first_line());
    }
    assert_eq!(folder.read("old.ply"), b"what was there");
    assert_eq!(folder.names(), ["cube.obj", "old.ply", "torus.obj"]);
}

#[test]
fn where_no_level_fits_the_bytes_are_said() {
    let folder = with_torus();
    let run = folder.ogee("convert torus.obj -o out.json --json --max-memory 20M").expect(3);
    assert!(run.first_line().contains("more than the"), "{}", run.first_line());
    assert_eq!(run.json()["error"]["code"], "too_deep");
    assert_eq!(folder.names(), ["cube.obj", "torus.obj"]);
}

#[test]
fn memory_without_a_number_is_a_usage_error() {
    let folder = Folder::new();
    folder.write("cube.obj", CUBE);
    for amount in ["much", "-1", "0", "4X"] {
        let run = folder.ogee(&format!("refine cube.obj -l 1 -o out.obj --max-memory={amount}")).expect(2);
        assert!(run.stderr.contains("a number of bytes is wanted"), "{}", run.stderr);
    }
}
