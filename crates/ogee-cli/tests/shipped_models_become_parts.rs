//! Every shipped cage converts to what it is, smooth, without gaps, in a file that the lint finds clean.

mod common;

use common::{Folder, models};

#[test]
fn each_model_is_a_part() {
    let folder = Folder::new();
    for model in models() {
        let name = model.file_stem().unwrap().to_string_lossy().into_owned();
        std::fs::copy(&model, folder.path("cage.obj")).unwrap();
        let text = std::fs::read_to_string(&model).unwrap();
        let is_open =
            text.lines().take_while(|line| line.starts_with('#')).any(|line| line.contains(" open"));

        let part = folder.ogee("convert --json cage.obj -o part.step").expect(0).json();
        assert_eq!(part["closed"], !is_open, "{name}");
        assert_eq!(part["solids"].as_u64().unwrap() > 0, !is_open, "{name}");
        assert_eq!(part["volume"].is_null(), is_open, "{name}");
        let bbox = part["bbox"].as_array().unwrap();
        let size = bbox[1][0].as_f64().unwrap() - bbox[0][0].as_f64().unwrap();
        assert!(part["max_normal_angle_deg"].as_f64().unwrap() <= 1e-6, "{name}");
        assert!(part["max_gap"].as_f64().unwrap() <= 1e-12 * size, "{name}");
        assert!(part["faces_written"].as_u64() <= part["patches"].as_u64(), "{name}");
        assert_eq!(part["file_bytes"].as_u64(), Some(folder.read("part.step").len() as u64), "{name}");

        let check = folder.ogee("check --json part.step").expect(0).json();
        assert_eq!(check["faults"], serde_json::json!([]), "{name}");
        assert_eq!(check["faces"], part["faces_written"], "{name}");
        assert_eq!(check["solids"], part["solids"], "{name}");

        let info = folder.ogee("info --json cage.obj").expect(0).json();
        assert_eq!(info["faces"], part["cage_faces"], "{name}");
        assert_eq!(info["boundary_edges"].as_u64().unwrap() > 0, is_open, "{name}");
    }
}
