//! `ogee render`: a PNG of the size asked for and a report, or an error and nothing.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{CUBE, Folder};

/// Width and height of a PNG.
fn size(png: &[u8]) -> [u32; 2] {
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().unwrap()))
}

/// Colour values of a PNG.
fn pixels(png: &[u8]) -> Vec<u8> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    pixels
}

#[test]
fn every_style_is_drawn_and_reported() {
    let folder = Folder::with_cube();
    let styles = [
        "shaded",
        "wireframe",
        "reflection",
        "highlight",
        "isophote",
        "zebra",
        "gauss",
        "mean",
        "k1",
        "k2",
        "greatest",
        "gauss-sign",
        "error",
        "combs",
    ];
    for style in styles {
        let run = folder
            .ogee(&format!("render cube.obj --style {style} --size 48x32 -o a.png --json --device cpu"))
            .expect(0);
        assert_eq!(size(&folder.read("a.png")), [48, 32]);
        let report = run.json();
        assert_eq!(report["style"], style);
        assert_eq!(report["device"], "cpu");
        assert!(report["fragments"].as_u64().unwrap() > 500);
        let is_map = ["gauss", "mean", "k1", "k2", "greatest", "gauss-sign", "error"].contains(&style);
        assert_eq!(report["limit"].is_number(), is_map, "{style}");
        for stage in ["upload", "ids", "position", "colour", "readback"] {
            assert!(report["seconds"][stage].as_f64().unwrap() >= 0.0);
        }
    }
}

#[test]
fn patches_of_a_part_look_like_the_cage_they_came_from() {
    let folder = Folder::with_cube();
    folder.ogee("convert cube.obj -o part.json").expect(0);
    let view = "--eye 4,-5,3 --at 0,0,0 --size 64x64 --style shaded --device cpu";
    folder.ogee(&format!("render cube.obj {view} -o cage.png")).expect(0);
    folder.ogee(&format!("render part.json {view} -o part.png")).expect(0);
    let pixels = ["cage.png", "part.png"].map(|name| pixels(&folder.read(name)));
    let far = pixels[0].iter().zip(&pixels[1]).filter(|&(a, b)| a.abs_diff(*b) > 40).count();
    assert!(far < 60, "{far} colour values differ");
    assert_ne!(pixels[0], pixels[1], "the patches are not quite the limit surface");
}

#[test]
fn a_part_stands_beside_its_cage() {
    let folder = Folder::with_cube();
    folder.ogee("convert cube.obj -o part.json").expect(0);
    folder.ogee("render cube.obj --beside part.json --style mean --size 50x40 -o both.png").expect(0);
    assert_eq!(size(&folder.read("both.png")), [100, 40]);
    let run = folder.ogee("render cube.obj --beside missing.json -o none.png").expect(3);
    assert!(run.first_line().starts_with("missing.json: "), "{}", run.stderr);
}

#[test]
fn light_can_be_a_picture() {
    let folder = Folder::with_cube();
    folder.ogee("render cube.obj --style isophote --size 40x40 -o light.png").expect(0);
    let draw = |light: &str, name: &str| {
        let view = "--style highlight --size 40x40";
        folder.ogee(&format!("render cube.obj {view} --light {light} -o {name}")).expect(0);
        folder.read(name)
    };
    assert_ne!(draw("light.png", "a.png"), draw("lines", "b.png"));
    folder.write("broken.png", b"no picture");
    let run = folder.ogee("render cube.obj --style reflection --light broken.png -o c.png").expect(3);
    assert!(run.first_line().starts_with("broken.png: "), "{}", run.stderr);
}

#[test]
fn what_makes_no_sense_is_refused_and_nothing_is_written() {
    let folder = Folder::with_cube();
    for (name, unit) in [("tiny.obj", "1e-150"), ("huge.obj", "1e150")] {
        let (points, faces) = CUBE.split_at(CUBE.find('f').unwrap());
        folder.write(name, points.replace('1', unit) + faces);
    }
    let before = folder.names();
    for (arguments, code, says) in [
        ("render cube.obj -o a.jpg", 2, "png"),
        ("render cube.obj -o -", 2, "output-format"),
        ("render cube.obj -o a.png --size 0x10", 2, "size"),
        ("render cube.obj -o a.png --size 16384x16384 --samples 8", 2, "too large"),
        ("render cube.obj -o a.png --style fog", 2, "fog"),
        ("render cube.obj -o a.png --light fog", 2, "lattice"),
        ("render cube.obj -o a.png --sampling polygon", 2, "polygon:LEVEL"),
        ("render cube.obj -o a.png --eye 0,0,0 --at 1,0,0", 3, "inside"),
        ("render cube.obj -o a.png --eye 0,9,0 --at 0,18,0", 3, "no part of the surface"),
        ("render cube.obj -o a.png --style mean --sampling polygon:2", 3, "curvature"),
        ("render cube.obj -o a.png --style reflection --light-plane 5,1e-9", 3, "light plane"),
        ("render tiny.obj -o a.png", 3, "1.68e-150 long; scale it to between 1e-60 and 1e60"),
        ("render huge.obj -o a.png", 3, "long; scale it"),
        ("lines tiny.obj -o a.svg", 3, "scale it"),
        ("inspect huge.obj --html a.html", 3, "scale it"),
        ("render missing.obj -o a.png", 3, "missing.obj"),
        ("render cube.obj -o missing/a.png", 4, "missing"),
    ] {
        let run = folder.ogee(arguments).expect(code);
        assert!(run.stderr.contains(says), "{arguments}: {}", run.stderr);
        assert_eq!(folder.names(), before, "{arguments}");
    }
}

#[test]
fn pictures_are_the_same_on_any_number_of_threads() {
    let folder = Folder::with_cube();
    for threads in [1, 2] {
        folder
            .ogee(&format!(
                "render cube.obj --style zebra --size 90x70 -o {threads}.png --threads {threads} --device cpu"
            ))
            .expect(0);
    }
    assert_eq!(folder.read("1.png"), folder.read("2.png"));
}

#[test]
fn curves_are_drawn_over_any_style_where_they_are_seen() {
    let folder = Folder::with_cube();
    folder.write("belt.obj", "o belt\nl 1 2 4 3 1\n");
    folder.ogee("network cube.obj --curves belt.obj -o belt.json").expect(0);
    let draw = |options: &str| {
        folder.ogee(&format!("render belt.json {options} --size 80x80 -o a.png --device cpu")).expect(0);
        pixels(&folder.read("a.png"))
    };
    // The belt is round and low: within this distance of the axis, seen from below, none of it is.
    for style in ["shaded", "reflection", "mean"] {
        let below = format!("--eye 0,0,-9 --at 0,0,0 --up 0,1,0 --style {style}");
        let (plain, with) = (draw(&below), draw(&format!("{below} --curves")));
        let changed: Vec<usize> =
            (0..80 * 80).filter(|i| plain[4 * i..4 * i + 4] != with[4 * i..4 * i + 4]).collect();
        assert!(changed.len() > 100, "{style}");
        let from_axis = |i: usize| ((i % 80) as f64 - 39.5).hypot((i / 80) as f64 - 39.5);
        let (least, most) = changed
            .iter()
            .fold((80.0_f64, 0.0_f64), |(least, most), &i| (least.min(from_axis(i)), most.max(from_axis(i))));
        assert!(least > 8.0 && most - least < 6.0, "{style}: from {least} to {most} pixels");
        let above = format!("--eye 0,0,9 --at 0,0,0 --up 0,1,0 --style {style}");
        assert_eq!(draw(&above), draw(&format!("{above} --curves")), "the body is before them");
    }
    // Beside, each file has its own; a part has none.
    folder.ogee("convert cube.obj -o part.json").expect(0);
    let beside = "render belt.json --beside part.json --size 40x40 --device cpu";
    folder.ogee(&format!("{beside} -o plain.png")).expect(0);
    folder.ogee(&format!("{beside} --curves -o with.png")).expect(0);
    let [plain, with] = ["plain.png", "with.png"].map(|name| pixels(&folder.read(name)));
    let differ = |column: usize| {
        (0..40).any(|row| {
            let at = 4 * (80 * row + column);
            plain[at..at + 4] != with[at..at + 4]
        })
    };
    assert!((0..40).any(differ) && !(40..80).any(differ));
    folder.write("lost.obj", format!("{CUBE}l 1 2\n").replace("l 1 2", "l 1 99"));
    for (file, says) in
        [("cube.obj", "no curves"), ("part.json", "a part has no curves"), ("lost.obj", "no vertex 98")]
    {
        let run = folder.ogee(&format!("render {file} --curves -o none.png")).expect(3);
        assert!(run.stderr.contains(says), "{file}: {}", run.stderr);
    }
}

#[cfg(feature = "gpu")]
#[test]
fn graphics_processors_draw_what_the_processor_draws() {
    let folder = Folder::with_cube();
    let view = "--style reflection --lines 8 --size 90x80 --json";
    let run = folder.ogee(&format!("render cube.obj {view} --device gpu -o gpu.png"));
    if run.code != 0 {
        let error = run.json()["error"]["code"].clone();
        assert_eq!(error, "no_adapter");
        assert!(std::env::var_os("OGEE_REQUIRE_GPU").is_none(), "an adapter is required");
        eprintln!("skipped: no adapter");
        return;
    }
    let report = run.json();
    assert_eq!(report["device"], "gpu");
    assert!(report["adapter"].is_string());
    folder.ogee(&format!("render cube.obj {view} --device cpu -o cpu.png")).expect(0);
    let [gpu, cpu] = ["gpu.png", "cpu.png"].map(|name| pixels(&folder.read(name)));
    let far = gpu.iter().zip(&cpu).filter(|&(a, b)| a.abs_diff(*b) > 24).count();
    assert!(far < 30, "{far} colour values differ");
    folder.ogee("convert cube.obj -o part.json").expect(0);
    let run = folder.ogee("render part.json --device gpu -o part.png").expect(3);
    assert!(run.stderr.contains("--device cpu"), "{}", run.stderr);
}

#[test]
fn caps_are_drawn_where_lenses_were() {
    let folder = Folder::with_wing();
    // The tip, from outside.
    let view = "--eye 3,-4,-9 --at 0.4,0,-4.6 --size 64x64 --style shaded";
    let draw = |arguments: &str| {
        let report = folder.ogee(&format!("render {arguments} {view} -o a.png --json")).expect(0).json();
        assert_eq!(report["device"], "cpu");
        (pixels(&folder.read("a.png")), report["notes"].as_array().unwrap().clone())
    };
    let far = |a: &[u8], b: &[u8]| a.iter().zip(b).filter(|&(a, b)| a.abs_diff(*b) > 40).count();
    let (plain, _) = draw("wing.obj --device cpu");
    for lens in ["c2", "polar", "merge"] {
        let (treated, notes) = draw(&format!("wing.obj --lens {lens} --device cpu"));
        assert!(notes.iter().any(|note| note["code"] == "lenses_treated"), "{notes:?}");
        folder.ogee(&format!("convert wing.obj --lens {lens} -o part.json")).expect(0);
        let (part, _) = draw("part.json --device cpu");
        let (gap, change) = (far(&treated, &part), far(&treated, &plain));
        assert!(gap < 60, "{lens}: {gap} colour values differ from those of the part");
        assert!(change > 200, "{lens}: {change} colour values differ from those of the surface as it is");
    }
    #[cfg(feature = "gpu")]
    {
        let (_, notes) = draw("wing.obj --lens polar --device gpu");
        let is_said =
            |note: &serde_json::Value| note["message"].as_str().unwrap().contains("the caps of --lens");
        assert!(notes.iter().any(is_said), "{notes:?}");
    }
    let run = folder.ogee("render part.json --lens c2 -o b.png").expect(2);
    assert!(run.first_line().contains("--lens is for cages"), "{}", run.stderr);
}
