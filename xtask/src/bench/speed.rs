//! Times a point: beside the peers, and on one thread and two.

use anyhow::Result;

use super::limit::{Course, FAR_LEVEL, Peers, Places};
use super::peers::{self, Contestant};
use super::report::{Spread, Table, rounds};

/// A task that has a time a point.
struct Race {
    title: String,
    places: Places,
    order: &'static str,
    /// By number.
    courses: &'static [usize],
    peers: Vec<Contestant>,
}

impl Race {
    fn new(
        title: &str,
        places: Places,
        order: &'static str,
        courses: &'static [usize],
        peers: Vec<Contestant>,
    ) -> Race {
        Race { title: format!("{title}, derivatives to order {order}"), places, order, courses, peers }
    }
}

/// One table of times a point and ratios, on one core, of the tasks whose names begin so.
pub(super) fn ratios(peers: &Peers, courses: &[Course], task_name: &str) -> Result<Table> {
    let ours = peers::ours(1)?;
    let mut table =
        Table::new(&["task", "cage", "ogee ns a point", "other", "its ns a point", "other / ogee"]);
    for race in races(peers)?.into_iter().filter(|race| race.title.starts_with(task_name)) {
        for course in race.courses.iter().map(|&number| &courses[number]) {
            let (task, last) = course.task(race.places);
            let all: Vec<&Contestant> = std::iter::once(&ours).chain(&race.peers).collect();
            let answers = rounds(&all, task, &course.file, &[race.order, &last])?;
            let own = answers[0].nanoseconds()?;
            for (peer, answers) in race.peers.iter().zip(&answers[1..]) {
                let its = answers.nanoseconds()?;
                let ratio = its.median / own.median;
                table.row(&[
                    race.title.clone(),
                    course.cage.name.to_owned(),
                    own.to_string(),
                    peer.name.clone(),
                    its.to_string(),
                    format!("{ratio:.2}"),
                ]);
            }
        }
    }
    Ok(table)
}

/// All that can be run with the peers there are.
fn races(peers: &Peers) -> Result<Vec<Race>> {
    let opensubdiv = |name: &str, peer, level| {
        peers.opensubdiv.iter().map(|found| found.contestant(name, peer, level)).collect::<Vec<_>>()
    };
    let on_demand = opensubdiv("Bfr, a surface at a time", "bfr", -1);
    let prepared = opensubdiv("Bfr, all surfaces kept", "bfr-prepared", -1);
    let far = opensubdiv(&format!("Far, isolation {FAR_LEVEL}"), "far", FAR_LEVEL);
    let tables = [prepared, far].concat();
    let blender =
        peers.blender.iter().map(|found| found.contestant("Blender, 4 x 4 quads a face", "blender", -1));
    let (faces, scattered) = ("16 points a face", "scattered");
    let mut races = vec![
        Race::new(faces, Places::Faces, "1", &[0, 1, 2, 3], on_demand.clone()),
        Race::new(faces, Places::Faces, "2", &[0, 1], on_demand.clone()),
        Race::new(faces, Places::Faces, "1", &[0, 1, 3], blender.collect()),
        Race::new(
            scattered,
            Places::Scattered,
            "1",
            &[0, 1, 2, 3],
            [tables.clone(), vec![peers::ours_single()?]].concat(),
        ),
        Race::new(scattered, Places::FewScattered, "1", &[0, 1, 2, 3], on_demand),
        Race::new(scattered, Places::Scattered, "2", &[0, 1], tables),
    ];
    races.retain(|race| !race.peers.is_empty());
    Ok(races)
}

/// One thread and two: times, and whether results are the same.
pub(super) fn threads(courses: &[Course], faults: &mut Vec<String>) -> Result<Table> {
    let ours = [peers::ours(1)?, peers::ours(2)?];
    let columns = ["ogee", "cage", "1 thread, ns a point", "2 threads, ns a point", "gain", "same bits"];
    let mut table = Table::new(&columns);
    for course in courses {
        for (title, places) in [("16 points a face", Places::Faces), ("scattered", Places::Scattered)] {
            let (task, last) = course.task(places);
            for order in ["1", "2"] {
                let answers = rounds(&[&ours[0], &ours[1]], task, &course.file, &[order, &last])?;
                let same = answers[0].checksum().is_some() && answers[0].checksum() == answers[1].checksum();
                let mut row = |title: String, [one, two]: [Spread; 2]| {
                    table.row(&[
                        title,
                        course.cage.name.to_owned(),
                        one.to_string(),
                        two.to_string(),
                        format!("{:.2}", one.median / two.median),
                        if same { "yes" } else { "no" }.to_owned(),
                    ]);
                };
                let title = format!("{title}, derivatives to order {order}");
                row(title.clone(), [answers[0].nanoseconds()?, answers[1].nanoseconds()?]);
                if let Places::Faces = places {
                    let prepared = [answers[0].nanoseconds_prepared()?, answers[1].nanoseconds_prepared()?];
                    row(format!("{title}, without set-up"), prepared);
                }
                if !same {
                    faults.push(format!(
                        "{title}, {}: results depend on the number of threads",
                        course.cage.name
                    ));
                }
            }
        }
    }
    Ok(table)
}
