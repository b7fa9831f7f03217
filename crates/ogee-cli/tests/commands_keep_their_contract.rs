//! Good paths: each command, each format, the fields of each report, what goes to which stream.

mod common;

use common::{CUBE, Folder, finish};
use serde_json::{Value, json};

fn assert_fields(report: &Value, fields: &str) {
    for field in fields.split_whitespace() {
        assert!(report.get(field).is_some(), "no {field} in {report}");
    }
}

#[test]
fn info_counts() {
    let folder = Folder::with_cube();
    let run = folder.ogee("info cube.obj").expect(0);
    assert_eq!(run.stdout, b"");
    assert_eq!(run.first_line(), "cube.obj");

    let info = folder.ogee("info --json cube.obj").expect(0).json();
    assert_eq!(info["valences"], json!({"3": 8}));
    assert_eq!(info["components"], json!([{"faces": 6, "closed": true, "genus": 0}]));
    assert_eq!(info["creases"], json!({"semi_sharp": 0, "infinite": 0}));
    assert_eq!(info["bbox"], json!([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]]));
    let counts = [("vertices", 8), ("faces", 6), ("edges", 12), ("quads", 6), ("triangles", 0), ("ngons", 0)];
    let more =
        [("boundary_edges", 0), ("boundary_loops", 0), ("extraordinary", 8), ("extraordinary_edges", 12)];
    for (field, count) in counts.into_iter().chain(more).chain([("corners", 0)]) {
        assert_eq!(info[field], count, "{field}");
    }
    assert_eq!((&info["valence2"], &info["defects"]), (&json!([]), &json!([])));
}

#[test]
fn convert_reports_and_names() {
    let folder = Folder::with_cube();
    let fields = "method level cage_faces patches faces_written edges vertices solids shells closed unit volume area \
                  bbox max_normal_angle_deg max_gap max_deviation max_deviation_relative max_curvature_jump max_curvature_jump_absolute \
                  smooth_edges sharp_edges levels caps cap_degree nodes lenses seconds file_bytes peak_bytes memory_stated notes";
    for (output, options) in [
        ("part.step", "--unit in --ap 242 --name Lid --up-axis y"),
        ("part.STP", "--no-pack"),
        ("part.bv", ""),
        ("part.json", "--pack"),
        ("first.step", "--method pccm-first"),
        ("quintic.step", "--method bi5"),
        ("caps.step", "--method g2"),
        ("near.step", "--max-deviation 1e-4"),
        ("deep.step", "--level 3"),
    ] {
        let report = folder.ogee(&format!("convert --json cube.obj -o {output} {options}")).expect(0).json();
        assert_fields(&report, fields);
        assert_fields(&report["seconds"], "read convert write");
        assert_eq!(report["file_bytes"], folder.read(output).len());
        assert_eq!((&report["solids"], &report["closed"]), (&json!(1), &json!(true)));
        if output.to_lowercase().ends_with(".step") {
            folder.ogee(&format!("check {output}")).expect(0);
        }
    }
    let text = String::from_utf8(folder.read("part.step")).unwrap();
    assert!(text.contains("PRODUCT('Lid'") && text.contains("AP242") && text.contains("INCH"), "{text}");
    assert!(String::from_utf8(folder.read("part.STP")).unwrap().contains("PRODUCT('part'"));
    let near = folder.ogee("convert --json cube.obj -o near.step --max-deviation 1e-4").json();
    assert!(near["max_deviation"].as_f64().unwrap() < 1e-4 && near["level"].as_u64().unwrap() > 2);
}

#[test]
fn packing_is_for_step() {
    let folder = Folder::new();
    let text: String = (0..4).flat_map(|j| (0..4).map(move |i| format!("v {i} {j} 0\n"))).collect();
    let face = |i: u32, j: u32| 4 * j + i + 1;
    let faces =
        (0..9).map(|n| face(n % 3, n / 3)).map(|a| format!("f {} {} {} {}\n", a, a + 1, a + 5, a + 4));
    folder.write("grid.obj", text + &faces.collect::<String>());
    for (options, written) in [
        ("-o a.step", 1),
        ("-o a.step --no-pack", 9),
        ("-o a.json", 9),
        ("-o a.json --pack", 1),
        ("-o a.bv", 9),
    ] {
        let report = folder.ogee(&format!("convert --json grid.obj {options}")).expect(0).json();
        assert_eq!(report["faces_written"], written, "{options}");
        assert_eq!((&report["patches"], &report["volume"]), (&json!(9), &Value::Null));
    }
}

#[test]
fn refine_writes_every_format() {
    let folder = Folder::with_cube();
    for format in ["obj", "ply", "off", "stl", "glb", "json"] {
        for options in ["-l 0", "-l 1", "-l 2", "-l 2 --limit", "-l 0 --limit"] {
            let output = format!("out.{format}");
            let report =
                folder.ogee(&format!("refine --json cube.obj {options} -o {output}")).expect(0).json();
            assert_fields(&report, "level vertices faces seconds peak_bytes memory_stated file_bytes notes");
            assert_fields(&report["seconds"], "read refine write");
            let level: u32 = options[3..4].parse().unwrap();
            let faces = 6 * 4usize.pow(level);
            assert_eq!((&report["level"], &report["faces"]), (&json!(level), &json!(faces)));
            assert_eq!(report["vertices"], faces + 2);
            assert!(!folder.read(&output).is_empty());
            if ["obj", "ply", "off", "json"].contains(&format) {
                let again = folder.ogee(&format!("info --json {output}")).expect(0).json();
                assert_eq!(again["faces"], faces);
            }
        }
    }
}

#[test]
fn refine_reaches_the_limit() {
    let folder = Folder::with_cube();
    folder.ogee("refine cube.obj -l 1 --limit -o limit.obj").expect(0);
    let text = String::from_utf8(folder.read("limit.obj")).unwrap();
    assert_eq!(text.lines().filter(|line| line.starts_with("vn ")).count(), 26);
    // The limit of a vertex of the cube: its neighbours on the first level pull it to half its place.
    let corner: Vec<f64> = text.lines().find(|line| line.starts_with("v ")).unwrap()[2..]
        .split(' ')
        .map(|x| x.parse().unwrap())
        .collect();
    assert!(corner.iter().all(|x| (x + 0.5).abs() < 1e-12), "{corner:?}");
}

#[test]
fn texture_coordinates_are_refined_beside_the_points() {
    let folder = Folder::new();
    // Two quads with charts of their own: the shared edge is a seam.
    folder.write(
        "cage.obj",
        "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n\
         vt 0 0\nvt 0.4 0\nvt 0.4 1\nvt 0 1\nvt 0.6 0\nvt 1 0\nvt 1 1\nvt 0.6 1\n\
         f 1/1 2/2 5/3 4/4\nf 2/5 3/6 6/7 5/8\n",
    );
    for (options, format) in [("-l 1", "obj"), ("-l 2 --limit", "obj"), ("-l 3", "json")] {
        folder.ogee(&format!("refine cage.obj {options} -o out.{format}")).expect(0);
        let text = String::from_utf8(folder.read(&format!("out.{format}"))).unwrap();
        if format == "json" {
            let out: Value = serde_json::from_str(&text).unwrap();
            assert_eq!(out["face_uvs"].as_array().unwrap().len(), 2 * 64);
            continue;
        }
        let values: Vec<Vec<f64>> = text
            .lines()
            .filter_map(|line| line.strip_prefix("vt "))
            .map(|line| line.split(' ').map(|x| x.parse().unwrap()).collect())
            .collect();
        let side = if options == "-l 1" { 3 } else { 5 };
        assert_eq!(values.len(), 2 * side * side, "two charts");
        // Corners of charts are held by one face and stay; nothing lies between the charts.
        assert!(values.contains(&vec![0.4, 1.0]) && values.contains(&vec![0.6, 0.0]), "{values:?}");
        assert!(values.iter().all(|uv| uv[0] <= 0.4 || uv[0] >= 0.6));
        let faces = text.lines().filter(|line| line.starts_with("f "));
        assert!(faces.clone().all(|face| face.split(' ').skip(1).all(|corner| corner.contains('/'))));
    }
}

#[test]
fn level_zero_is_the_cage_without_its_holes() {
    let folder = Folder::new();
    folder.write(
        "cage.json",
        r#"{"vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[2,0,0],[2,1,0]],
        "faces": [[0,1,2,3],[1,4,5],[1,5,2]], "holes": [1],
        "uvs": [[0,0],[1,0],[1,1]], "face_uvs": [[0,1,2,0],[0,1,2],[2,1,0]]}"#,
    );
    let report = folder.ogee("refine --json cage.json -l 0 -o out.json").expect(0).json();
    assert_eq!(report["faces"], 2);
    let out: Value = serde_json::from_slice(&folder.read("out.json")).unwrap();
    assert_eq!(out["faces"], json!([[0, 1, 2, 3], [1, 5, 2]]));
    assert_eq!(out["face_uvs"], json!([[0, 1, 2, 0], [2, 1, 0]]));
}

#[test]
fn data_goes_to_stdout_and_figures_to_stderr() {
    let folder = Folder::with_cube();
    let run = folder.ogee("convert cube.obj -o - --output-format step").expect(0);
    assert!(run.stdout.starts_with(b"ISO-10303-21;") && run.stdout.ends_with(b"END-ISO-10303-21;\n"));
    assert!(run.first_line().starts_with("cube.obj -> stdout"));
    assert!(String::from_utf8(run.stdout).unwrap().contains("FILE_NAME('cube.step'"));
    let run = folder.ogee("convert -q cube.obj -o part.step").expect(0);
    assert_eq!((run.stdout.len(), run.stderr.as_str()), (0, ""));
    let brief = folder.ogee("convert cube.obj -o part.step").stderr.lines().count();
    assert!(folder.ogee("convert -v cube.obj -o part.step").stderr.lines().count() > brief);
    let run = folder.ogee("refine cube.obj -l 1 -o - --output-format off").expect(0);
    assert!(run.stdout.starts_with(b"OFF"));
}

#[test]
fn a_cage_may_come_from_stdin() {
    let folder = Folder::new();
    let mut command = folder.command("convert - --input-format obj -o part.step --json");
    command.write_stdin(CUBE);
    assert_eq!(finish(command).expect(0).json()["cage_faces"], 6);
    let mut command = folder.command("info - --input-format obj");
    command.write_stdin(CUBE.replace("f 1 5 7 3", "f 1 5 7 99"));
    assert_eq!(finish(command).expect(3).first_line(), "stdin:13: face 4 uses vertex 98, the file has 8");
    folder.ogee("info -").expect(2);
}

#[test]
fn the_scheme_can_be_overruled() {
    let folder = Folder::new();
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    folder.write("square.obj", square);
    let area = |options: &str| {
        let report = folder.ogee(&format!("convert --json square.obj -o a.step {options}")).expect(0).json();
        report["area"].as_f64().unwrap()
    };
    assert!((area("") - 1.0).abs() < 1e-9);
    assert!(area("--boundary edge-only") < 0.9);
    let run = folder.ogee("convert --json square.obj -o b.step --boundary none").expect(3);
    assert_eq!(run.json()["error"]["code"], "no_surface");
    let info = folder.ogee("info --json square.obj --boundary none --creasing chaikin").json();
    assert_eq!((&info["boundary"], &info["creasing"]), (&json!("none"), &json!("chaikin")));
}

#[test]
fn check_finds_what_is_broken() {
    let folder = Folder::with_cube();
    folder.ogee("convert cube.obj -o part.step").expect(0);
    let clean = folder.ogee("check --json part.step").expect(0).json();
    assert_eq!((&clean["faults"], &clean["solids"], &clean["faces"]), (&json!([]), &json!(1), &json!(6)));
    assert!(clean["volume"].as_f64().unwrap() > 0.0);

    let text = String::from_utf8(folder.read("part.step")).unwrap();
    folder.write("cut.step", &text[..text.len() / 2]);
    folder.write("turned.step", text.replacen(".T.);", ".F.);", 1));
    folder.write("none.step", CUBE);
    for name in ["cut.step", "turned.step", "none.step"] {
        let run = folder.ogee(&format!("check --json {name}")).expect(1);
        let report = run.json();
        let faults = report["faults"].as_array().unwrap();
        assert_fields(&faults[0], "code message where");
        let lines = run.stderr.lines().filter(|line| line.starts_with(&format!("{name}:"))).count();
        assert_eq!(lines, faults.len(), "{}", run.stderr);
    }
}

#[test]
fn mistakes_in_typing_are_usage_errors() {
    let folder = Folder::with_cube();
    for (arguments, said) in [
        ("", "Usage"),
        ("wibble", "unrecognized subcommand"),
        ("convert cube.obj", "--output"),
        ("convert cube.obj -o -", "--output-format"),
        ("convert cube.obj -o part", "--output-format"),
        ("convert cube.obj -o part.xyz", "unknown format"),
        ("convert cube.obj -o - --output-format step --json", "both want stdout"),
        ("convert cube.obj -o a.step --max-deviation -1", "max-deviation"),
        ("convert cube.obj -o a.step --max-deviation nan", "positive length"),
        ("convert cube.obj -o a.step --unit foot", "known are mm, cm, m, in"),
        ("convert cube.obj -o a.step --method g3", "known are pccm, pccm-first, bi5, g2"),
        ("convert cube.obj -o a.step --method g2 --level 7", "6 is the most"),
        ("convert cube.obj -o a.step --threads 0", "--threads"),
        ("convert cube.obj -o a.step -q -v", "cannot be used with"),
        ("convert cube.xyz -o a.step", "--input-format"),
        ("refine cube.obj -l -1 -o a.obj", "-1"),
        ("refine cube.obj -o a.obj", "--level"),
        ("completions tcsh", "tcsh"),
        ("completions bash --json", "no --json"),
    ] {
        let run = folder.ogee(arguments).expect(2);
        assert!(run.stderr.contains(said), "{arguments}: {}", run.stderr);
        assert_eq!(folder.names(), ["cube.obj"]);
    }
    let error = folder.ogee("convert cube.obj --json").expect(2).json()["error"].clone();
    assert_eq!(error["code"], "usage");
    assert!(error["message"].as_str().unwrap().contains("--output"), "{error}");
}

#[test]
fn what_this_build_does_not_have_is_said() {
    let folder = Folder::with_cube();
    for arguments in [
        "convert cube.obj -o a.step --iges 186",
        "convert cube.obj -o a.iges",
        "convert cube.obj -o a.IGS",
        "convert cube.obj -o a.obj",
        "convert cube.obj -o a --output-format iges",
        "convert cube.usda -o a.step",
        "refine cube.obj -l 1 -o a.3mf",
        "refine cube.obj -l 1 -o a.usda",
        #[cfg(not(feature = "gpu"))]
        "render cube.obj -o a.png --device gpu",
        "batch plan",
        "view",
    ] {
        let run = folder.ogee(&format!("{arguments} --json")).expect(2);
        assert!(run.first_line().contains("this build does not have"), "{arguments}: {}", run.stderr);
        let message = run.json()["error"]["message"].clone();
        assert!(message.as_str().unwrap().contains("this build does not have"), "{message}");
        assert_eq!(folder.names(), ["cube.obj"]);
    }
}

#[test]
fn help_begins_with_three_examples() {
    let folder = Folder::new();
    let run = folder.ogee("--help").expect(0);
    let help = String::from_utf8(run.stdout).unwrap();
    assert!(help.lines().nth(1).unwrap().trim_start().starts_with("ogee convert cage.obj -o part.step"));
    assert_eq!(help.lines().filter(|line| line.starts_with("  ogee ")).count(), 3);
    let version = folder.ogee("--version").expect(0).stdout;
    assert_eq!(String::from_utf8(version).unwrap().trim(), concat!("ogee ", env!("CARGO_PKG_VERSION")));
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = folder.ogee(&format!("completions {shell}")).expect(0).stdout;
        assert!(String::from_utf8(script).unwrap().contains("max-deviation"), "{shell}");
    }
    let manual = String::from_utf8(folder.ogee("man").expect(0).stdout).unwrap();
    assert!(manual.contains(".TH ogee 1") && manual.contains(".TH ogee-convert 1"), "{manual}");
}

#[test]
fn colours_are_for_those_who_ask() {
    let folder = Folder::with_cube();
    assert!(!folder.ogee("info cube.obj").stderr.contains('\x1b'));
    assert!(folder.ogee("info cube.obj --color always").stderr.contains('\x1b'));
    assert!(!folder.ogee("wibble --color never").stderr.contains('\x1b'));
    assert!(folder.ogee("--color=always wibble").stderr.contains('\x1b'));
}

#[test]
fn a_part_too_small_for_kernels_is_told() {
    let folder = Folder::new();
    folder.write("cube.obj", CUBE);
    let notes = |file: &str, unit: &str| {
        let report =
            folder.ogee(&format!("convert --json {file} -o part.step --unit {unit}")).expect(0).json();
        report["notes"].as_array().unwrap().iter().map(|note| note["code"].to_string()).collect::<Vec<_>>()
    };
    assert!(!notes("cube.obj", "mm").contains(&"\"tiny\"".to_owned()));
    let points = (0..8).map(|i| {
        let at = |bit: u32| if i >> bit & 1 == 1 { "1e-9" } else { "-1e-9" };
        format!("v {} {} {}\n", at(0), at(1), at(2))
    });
    let faces = CUBE.lines().filter(|line| line.starts_with('f')).map(|line| format!("{line}\n"));
    folder.write("tiny.obj", points.chain(faces).collect::<String>());
    assert!(notes("tiny.obj", "mm").contains(&"\"tiny\"".to_owned()));
}
