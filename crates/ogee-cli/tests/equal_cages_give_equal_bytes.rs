//! The same bytes again, on any number of threads.

mod common;

use common::{Folder, finish, models};

#[test]
fn two_runs_and_any_number_of_threads() {
    let folder = Folder::new();
    let hand = models().into_iter().find(|path| path.ends_with("hand.obj")).unwrap();
    std::fs::copy(hand, folder.path("hand.obj")).unwrap();
    let outputs = [
        "convert hand.obj -o out.step",
        "convert hand.obj -o out.json",
        "refine hand.obj -l 3 --limit -o out.ply",
    ];
    for what in outputs {
        let name = what.split(' ').find(|word| word.starts_with("out.")).unwrap();
        let bytes = ["", "", "--threads 1", "--threads 2"].map(|threads| {
            folder.ogee(&format!("{what} {threads}")).expect(0);
            folder.read(name)
        });
        assert!(bytes.iter().all(|other| *other == bytes[0]), "{what}");
        let stdout = what.replace(name, &format!("- --output-format {}", &name[4..]));
        // The header of a STEP file has its name.
        if name != "out.step" {
            assert!(folder.ogee(&stdout).expect(0).stdout == bytes[0], "{stdout}");
        }
    }
}

#[test]
fn the_time_is_that_of_the_environment() {
    let folder = Folder::with_cube();
    let mut command = folder.command("convert cube.obj -o part.step");
    command.env("SOURCE_DATE_EPOCH", "951827696");
    finish(command).expect(0);
    let text = String::from_utf8(folder.read("part.step")).unwrap();
    assert!(text.contains("FILE_NAME('part.step','2000-02-29T12:34:56',"));
    folder.ogee("convert cube.obj -o part.step").expect(0);
    assert!(String::from_utf8(folder.read("part.step")).unwrap().contains("'1970-01-01T00:00:00'"));
    let mut command = folder.command("convert cube.obj -o new.step");
    command.env("SOURCE_DATE_EPOCH", "yesterday");
    finish(command).expect(2);
}
