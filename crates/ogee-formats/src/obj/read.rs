//! Reading OBJ at the speed of memory, every fault with its line.
//!
//! The file is cut into pieces of whole statements. The first pass counts what is in each piece, so that room can be set aside
//! for everything and each piece knows what comes before it. The second one reads all pieces, each into its own room, plain
//! lines quickly and others with care. What is left, tags and statements to be warned about, is read in the order of the file
//! at the end. So neither the number of pieces nor that of threads can be told from the result.

use ogee::{FaceList, FaceVaryingRule, Vec3};

use super::chunks::cut;
use super::elements::{self, Found, Room};
use super::survey::{Counts, survey};
use super::tags;
use crate::builder::{CageBuilder, Texture, too_many_corners};
use crate::cage::CageFile;
use crate::error::{Fault, Faults, ReadError};
use crate::par;
use crate::text::{Tokens, check_begins_as_text, has_zero, shown, without_mark};

/// Statements of free-form curves and surfaces.
const FREE_FORM: [&[u8]; 17] = [
    b"cstype",
    b"deg",
    b"bmat",
    b"step",
    b"curv",
    b"curv2",
    b"surf",
    b"parm",
    b"trim",
    b"hole",
    b"scrv",
    b"sp",
    b"end",
    b"con",
    b"ctech",
    b"stech",
    b"trace_obj",
];

/// How many different unknown statements are warned about.
const MOST_UNKNOWN: usize = 16;

/// Bytes of a piece: what is read and written fits into the cache of a core, and there is work for many of them.
const PIECE: usize = 1 << 18;

/// Reads a cage.
///
/// # Errors
/// If the bytes are no text, or with every fault of the lines.
pub fn read(bytes: &[u8]) -> Result<CageFile, ReadError> {
    read_in_pieces(bytes, PIECE)
}

/// As [`read`], in pieces of so many bytes.
fn read_in_pieces(bytes: &[u8], piece: usize) -> Result<CageFile, ReadError> {
    check_begins_as_text(bytes, "OBJ")?;
    let pieces = cut(without_mark(bytes), piece);
    let counts: Option<Vec<Counts>> = par::map(pieces.clone(), survey).into_iter().collect();
    let mut arrays = Arrays::with_room(counts.ok_or_else(|| has_zero(bytes, "OBJ"))?);
    let tasks: Vec<_> = pieces.into_iter().zip(arrays.rooms()).collect();
    let found = par::map(tasks, |(piece, (before, room))| elements::read(piece, before, room));
    gather(arrays, found)
}

/// Everything there is room for.
struct Arrays {
    /// What is in each piece.
    counts: Vec<Counts>,
    points: Vec<[f64; 3]>,
    texture_coordinates: Vec<[f64; 2]>,
    face_lines: Vec<u32>,
    /// Where each face begins, which is known when all are read; until then, after the first entry, [`Room::ends`].
    starts: Vec<u32>,
    vertices: Vec<u32>,
    texture: Vec<u32>,
}

impl Arrays {
    /// Room for so much. Memory that is cleared by being asked for costs nothing until it is written to, so it is first touched
    /// by the threads that fill it.
    fn with_room(counts: Vec<Counts>) -> Arrays {
        let all = counts.iter().copied().fold(Counts::default(), Counts::and);
        Arrays {
            counts,
            points: vec![[0.0; 3]; all.vertices],
            texture_coordinates: vec![[0.0; 2]; all.texture_coordinates],
            face_lines: vec![0; all.faces],
            starts: vec![0; all.faces + 1],
            vertices: vec![0; all.corners],
            texture: vec![0; all.corners],
        }
    }

    /// For each piece, what comes before it and its own room.
    fn rooms(&mut self) -> Vec<(Counts, Room<'_>)> {
        let mut points = &mut self.points[..];
        let mut texture_coordinates = &mut self.texture_coordinates[..];
        let mut face_lines = &mut self.face_lines[..];
        let mut ends = &mut self.starts[1..];
        let mut vertices = &mut self.vertices[..];
        let mut texture = &mut self.texture[..];
        let mut before = Counts::default();
        let rooms = self.counts.iter().map(|&counts| {
            let room = Room {
                points: take(&mut points, counts.vertices),
                texture_coordinates: take(&mut texture_coordinates, counts.texture_coordinates),
                face_lines: take(&mut face_lines, counts.faces),
                ends: take(&mut ends, counts.faces),
                vertices: take(&mut vertices, counts.corners),
                texture: take(&mut texture, counts.corners),
            };
            let start = before;
            before = before.and(counts);
            (start, room)
        });
        rooms.collect()
    }

    /// Closes the gaps between the corners of pieces, which have so many, and tells faces where they begin. True if all corners
    /// can be numbered.
    fn close_gaps(&mut self, corners: &[usize]) -> bool {
        if u32::try_from(corners.iter().sum::<usize>()).is_err() {
            return false;
        }
        let (mut room, mut face, mut filled) = (0, 1, 0);
        for (counts, &corners) in self.counts.iter().zip(corners) {
            if room != filled {
                self.vertices.copy_within(room..room + corners, filled);
                self.texture.copy_within(room..room + corners, filled);
            }
            for end in &mut self.starts[face..face + counts.faces] {
                *end += filled as u32;
            }
            room += counts.corners;
            face += counts.faces;
            filled += corners;
        }
        self.vertices.truncate(filled);
        self.texture.truncate(filled);
        true
    }
}

/// The first `count` entries; the others stay.
fn take<'a, T>(entries: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let (first, rest) = std::mem::take(entries).split_at_mut(count);
    *entries = rest;
    first
}

/// Makes a cage of what was found in each piece.
fn gather(mut arrays: Arrays, found: Vec<Found<'_>>) -> Result<CageFile, ReadError> {
    let mut rest = Rest::default();
    let corners: Vec<usize> = found.iter().map(|found| found.corners).collect();
    let textured: usize = found.iter().map(|found| found.textured).sum();
    let first_untextured = found.iter().find_map(|found| found.first_untextured);
    let mut faults = Vec::new();
    for found in found {
        faults.push(found.faults);
        for (line, statement) in found.others {
            rest.statement(line, Tokens::new(&statement));
        }
    }
    let Rest { mut cage, rule, unknown, .. } = rest;
    faults.push(std::mem::take(&mut cage.faults));
    cage.faults = Faults::merged(faults);
    if !arrays.close_gaps(&corners) {
        return Err(ReadError::single(too_many_corners()));
    }
    let Arrays { points, texture_coordinates, face_lines, starts, vertices, mut texture, .. } = arrays;
    if let (true, Some((line, keyword))) = (face_lines.is_empty(), unknown.first()) {
        // Most likely no OBJ at all.
        let message =
            format!("the file has no faces, and `{}` on line {line} is no statement of OBJ", shown(keyword));
        cage.faults.push(Fault::new("no_faces", message));
    }
    if textured > 0 {
        match first_untextured {
            None => {
                texture.iter_mut().for_each(|number| *number -= 1);
                cage.texture(Texture { values: texture_coordinates, indices: texture, rule });
            }
            Some(line) => {
                let message = "this face has corners without texture coordinate, others have them; \
                               all texture coordinates were passed over";
                cage.warn(line, "partial_texture", message.to_string());
            }
        }
    }
    let faces =
        FaceList::from_arrays(starts, vertices).ok_or_else(|| ReadError::single(too_many_corners()))?;
    // The same memory, read as something else.
    let points = points.into_iter().map(Vec3::from).collect();
    cage.elements(points, faces, face_lines);
    cage.finish()
}

/// What is read of statements that are no elements, in the order of the file.
#[derive(Default)]
struct Rest {
    cage: CageBuilder,
    rule: FaceVaryingRule,
    has_free_form: bool,
    /// The keywords warned about, with the lines where they stood first.
    unknown: Vec<(u32, Vec<u8>)>,
}

impl Rest {
    fn statement(&mut self, line: u32, mut tokens: Tokens<'_>) {
        match tokens.next() {
            None => {}
            Some(b"t") => tags::read(&mut self.cage, &mut self.rule, line, tokens),
            Some(keyword) if FREE_FORM.contains(&keyword) => {
                if !self.has_free_form {
                    let message = "free-form curves and surfaces are not read".to_string();
                    self.cage.warn(line, "free_form", message);
                }
                self.has_free_form = true;
            }
            Some(keyword) => self.unknown_statement(line, keyword),
        }
    }

    fn unknown_statement(&mut self, line: u32, keyword: &[u8]) {
        let is_known = self.unknown.iter().any(|(_, known)| known == keyword);
        if !is_known && self.unknown.len() < MOST_UNKNOWN {
            let message = format!("`{}` is no statement of OBJ and was passed over", shown(keyword));
            self.cage.warn(line, "unknown_statement", message);
            self.unknown.push((line, keyword.to_vec()));
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::simple;
    use super::*;

    /// Everything that is read, or every fault.
    fn all(read: Result<CageFile, ReadError>) -> String {
        // Not-a-number is no number's equal, and zero is that of its negative: texts differ where bits do.
        format!("{read:?}")
    }

    fn assert_alike(bytes: &[u8], piece: usize) {
        let (quick, simple) = (all(read_in_pieces(bytes, piece)), all(simple::read(bytes)));
        assert!(quick == simple, "{piece}: {}\n{quick}\n{simple}", String::from_utf8_lossy(bytes));
    }

    /// What stands in files of all kinds of programs, and what went wrong in them.
    const SNIPPETS: [&str; 64] = [
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "v 1.5 -2e-3 +0\nv .5 5. 1E2\nv 0.1 0.10000000000000001 123456789012345678901234567890\n",
        "v 4.9e-324 1.7976931348623157e308 2.2250738585072011e-308\n",
        "v 1 2 3 1.0\nv 1 2 3 0.1 0.2 0.3\nv 1 2 3 0.5 \\\n 4\nv 1 2 3 # a\nv 1 2 3 four\n",
        "v 1 2\n",
        "v\n",
        "v 1 2 # 3\n",
        "v 1 2,5 3\n",
        "v 0x1 2 3\n",
        "v nan 0 0\n",
        "v 0 -inf 0\nv 0 Infinity 0\nv 0 1e999 0\n",
        "v 1 2 1_000\nv 1 2 3e\nv . 0 0\nv + - 0\nv 1e+ 0 0\nv 1 2 --3\nv 1d5 0 0\n",
        "v 1 2 caf\u{e9}\n",
        "v\t1\t2\t3\n  v 1 2 3\nv\u{b}1\u{c}2 3\n",
        "v 1 2 3 \nv 1 2 3\t\nv  1   2  3\n",
        "v 1 2 3\r\nv 1 2 3\rv 1 2 3\n\r",
        "v 1 \\\n2 \\ \r\n 3\n",
        "v 1 2 3\\\n4\n",
        "# a comment\n#\n  # another \\\nv 1 2 3\n",
        "vt 0 0\nvt 1 0 0\nvt 0.5\n",
        "vt\nvt nan\nvt 1 x\nvt 0 inf\n",
        "vt 0.25 0.75 \\\n 1\n",
        "vn 0 0 1\nvn\nvp 1\n",
        "f 1 2 3\nf 1/1 2/2 3/1\n",
        "f 1/1 2/2 3/1\n",
        "f 1/1/1 2/2/1 3/1/1\n",
        "f 1//1 2//1 3//1\n",
        "f 1/ 2/ 3/\nf 1// 2// 3//\nf 1/1/ 2/2/ 3/1/\n",
        "f -3 -2 -1\n",
        "f -3/-1 -2/-1 -1/-1\n",
        "f -1 -2 1\n",
        "f 1 2 3 \nf\t3\t2\t1\n f 1 2 3\nf  1  2  3\n",
        "f 1 2 \\\n  3\nf 3 \\ \n 2 \\\r\n 1\n",
        "f 1 2 3 \\\n",
        "f 1 2 3 # 4\nf 1 2 # 3\n",
        "fo 1 2 3\n",
        "f 1 2\n",
        "f\n",
        "f 1 2 1\n",
        "f 1 2 3 4 5 6 7 8 9 10 1\n",
        "f 1 2 3 4 5 6 7 8 9 10 11 12\n",
        "f 1 2 100\n",
        "f 1 2 0\n",
        "f 1 2 -400\n",
        "f 1 2 99999999999\nf 1 2 4294967296\nf 1 2 4294967297\n",
        "f 1 2 1234567890123456789\nf 1 2 +3\nf 1 2 0000000000003\n",
        "f 1 2 x\nf 1 2 3/1/1/1\nf 1 2 3/a\nf 1 2 3//a\nf 1 2 3.0\nf 1 2 /\n",
        "f 1/0 2 3\n",
        "f 1/-9 2/1 3/1\n",
        "f 1/4294967296 2/4294967297 3/99999999999\n",
        "f 1/7 2/8 3/9\n",
        "l 1 2 3\np 1\nl\n",
        "g a b\no name\ns off\nusemtl red\nmtllib a.mtl\n",
        "cstype bspline\ndeg 3 3\nsurf 0 1 0 1 1 2 3\nend\n",
        "zz 1\nzz 2\nv# 1\nf# 1\nV 1 2 3\n",
        "a\nb\nc\nd\ne\nf1\ng1\nh\ni\nj\nk\nl1\nm\nn\no1\np1\nq\nr\n",
        "t crease 2/1/0 0 1 2.5\nt corner 1/1/0 2 inf\nt hole 1/0/0 0\n",
        "t crease 2/1/0 0 \\\n 1 2.5\nt interpolateboundary 1/0/0 2\n",
        "t facevaryinginterpolateboundary 1/0/0 5\nt creasemethod 0/0/1 chaikin\n",
        "t crease 2/1/0 0 77 1\nt hole 1/0/0 99\nt\nt sparkle\nt vertexedit 1/0/0 1\n",
        "t crease 2/1/0 0 1\nt corner 1/1/0 0 nan\n",
        "\n\n\r\n\r\r \t\n\u{1a}",
        "\\\n\\\n\nv 1 2 3\n",
        "\\",
    ];

    fn file() -> impl Strategy<Value = Vec<u8>> {
        let snippet = prop::sample::select(&SNIPPETS[..]);
        let start = prop::sample::select(
            &["", "\u{feff}", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nf 1 2 3\n"][..],
        );
        let end = prop::sample::select(&["", "f 1 2 3", "v 1 2 3 \\", "\0", "\u{1a}"][..]);
        let returns = prop::sample::select(&["\n", "\n", "\r\n", "\r"][..]);
        (start, prop::collection::vec(snippet, 0..12), end, returns).prop_map(
            |(start, parts, end, returns)| {
                [start, &parts.concat().replace('\n', returns), end].concat().into_bytes()
            },
        )
    }

    /// Vertices, texture coordinates and faces without faults, in any order and any manner.
    fn sound_file() -> impl Strategy<Value = Vec<u8>> {
        let vertex =
            (any::<f32>(), -1e3..1e3f64, prop::sample::select(&["", " ", " 1", "\t# 2", " 0.1 0.2 0.3"][..]))
                .prop_map(|(x, y, rest)| {
                    let x = if x.is_finite() { x } else { 0.0 };
                    format!("v {x:e} {y:.6} {y}{rest}")
                });
        let texture = (0.0..1.0f64, 0..1000u32).prop_map(|(u, v)| format!("vt {u} 0.{v}"));
        let distinct = prop::sample::subsequence((1..=12).collect::<Vec<u32>>(), 3..=12);
        let face = (distinct, 0..6u32).prop_map(|(corners, manner)| {
            let corner = |v: &u32| match manner {
                0 | 1 => format!(" {v}"),
                2 => format!(" {v}/{}", v % 3 + 1),
                3 => format!(" {v}//{v}"),
                4 => format!("  {v}/1/{v} "),
                _ => format!(" \\\n-{v}"),
            };
            format!("f{}", corners.iter().map(corner).collect::<String>())
        });
        let other =
            prop::sample::select(&["vn 0 0 1", "# a", "", "g b", "t corner 1/1/0 1 2", "usemtl c", "zz"][..]);
        let line = prop_oneof![4 => vertex, 1 => texture, 4 => face, 1 => other.prop_map(str::to_string)];
        (prop::collection::vec(line, 0..60), prop::sample::select(&["\n", "\r\n"][..])).prop_map(
            |(lines, end)| {
                let start = "v 0 0 1\n".repeat(12) + "vt 0 0\nvt 1 0\nvt 1 1\n";
                (start + &lines.join("\n") + "\n").replace('\n', end).into_bytes()
            },
        )
    }

    #[test]
    fn every_snippet_is_read_as_before() {
        for start in ["", SNIPPETS[0], "v 1 0 0\nv 2 0 0\nv 0 1 0\nvt 0 0\nvt 1 1\n"] {
            for snippet in SNIPPETS {
                for piece in [1, 10, 1 << 20] {
                    assert_alike(format!("{start}{snippet}").as_bytes(), piece);
                    assert_alike(format!("{start}{snippet}{}", SNIPPETS[0]).as_bytes(), piece);
                    assert_alike(format!("{start}{}", snippet.trim_end()).as_bytes(), piece);
                }
            }
        }
    }

    #[test]
    fn more_faults_and_warnings_than_are_kept() {
        for line in
            ["f 1 2\n", "v 1\n", "vt\n", "t\n", "t sparkle\n", "v 1\nt\n", "f 1 2 9\n", "t\nf 1 2 7000\n"]
        {
            let text = format!("{}{}", SNIPPETS[0], line.repeat(1500));
            for piece in [100, 5000, 1 << 20] {
                assert_alike(text.as_bytes(), piece);
            }
        }
    }

    #[test]
    fn shipped_cages_are_read_as_before() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models");
        let mut count = 0;
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "obj") {
                let bytes = std::fs::read(&path).unwrap();
                for piece in [64, 1000, PIECE] {
                    assert_alike(&bytes, piece);
                }
                count += 1;
            }
        }
        assert!(count > 10);
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

        #[test]
        fn files_of_snippets_cut_anywhere(file in file(), piece in 0..200usize) {
            assert_alike(&file, piece);
        }

        #[test]
        fn sound_files_cut_anywhere(file in sound_file(), piece in 0..400usize) {
            assert_alike(&file, piece);
        }
    }
}
