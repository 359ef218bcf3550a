//! The tables of a log that a scene needs.

use super::database::{Database, DatabaseRow};
use crate::frame::yaw;
use crate::problem::ReadError;
use crate::projection::UtmZone;
use scene::geometry::rotate;
use scene::{SignalState, Vec2};
use std::collections::HashMap;
use std::ops::Range;

/// A table that every log of this data set has, and no other file.
pub(super) const SWEEPS: &str = "lidar_pc";

/// Pose of a road user or the ego, in metres of the city's zone.
#[derive(Clone, Copy, Debug)]
pub(super) struct LogPose {
    pub at: Vec2,
    pub z_m: f64,
    pub heading_rad: f64,
    /// In the frame of the city.
    pub velocity: Vec2,
}

/// A lidar sweep, with everything that was seen at its time.
pub(super) struct LogSweep {
    /// Microseconds.
    pub time: i64,
    /// Rear axle of the ego.
    pub ego: Option<LogPose>,
}

/// A snippet of a log.
pub(super) struct LogScene {
    pub token: String,
    pub name: String,
    /// Sweeps of it, in their order.
    pub sweeps: Range<usize>,
}

/// A road user.
pub(super) struct LogTrack {
    pub token: String,
    pub category: String,
    /// Length, width and height, metres.
    pub size_m: [Option<f64>; 3],
}

/// A road user at a sweep.
pub(super) struct SeenBox {
    /// Index of the track.
    pub track: usize,
    pub pose: LogPose,
}

/// State of the light of a connector at a sweep.
pub(super) struct SeenLight {
    pub connector: i64,
    pub state: SignalState,
}

/// A kind of situation that begins at a sweep, and the road user that it is about.
pub(super) struct LogTag {
    pub kind: String,
    /// Index of the track.
    pub track: Option<usize>,
}

/// Things with the indices of their sweeps, sorted by these.
pub(super) struct BySweep<T>(Vec<(usize, T)>);

impl<T> BySweep<T> {
    /// Things of equal sweeps keep the order of the file.
    fn of(mut list: Vec<(usize, T)>) -> Self {
        list.sort_by_key(|(sweep, _)| *sweep);
        Self(list)
    }

    /// The things of some sweeps.
    pub fn within(&self, sweeps: &Range<usize>) -> &[(usize, T)] {
        let [from, to] =
            [sweeps.start, sweeps.end].map(|end| self.0.partition_point(|(sweep, _)| *sweep < end));
        self.0.get(from..to).unwrap_or_default()
    }
}

/// A log.
pub(super) struct LogTables {
    /// City, which selects the map.
    pub city: String,
    pub zone: Option<UtmZone>,
    pub scenes: Vec<LogScene>,
    pub sweeps: Vec<LogSweep>,
    pub tracks: Vec<LogTrack>,
    pub boxes: BySweep<SeenBox>,
    pub lights: BySweep<SeenLight>,
    pub tags: BySweep<LogTag>,
}

impl LogTables {
    /// # Errors
    /// Those of [`Database`].
    pub fn read(database: &Database) -> Result<Self, ReadError> {
        let (mut name, mut city) = (String::new(), String::new());
        if database.has("log") {
            database.rows("log", &["logfile", "map_version", "location"], |row| {
                (name, city) = (row.text(0), row.text(1));
                if city.is_empty() {
                    city = row.text(2);
                }
            })?;
        }
        let city = city.trim_end_matches(".gpkg").to_owned();
        let order = SweepOrder::read(database, &name)?;
        let mut log = Self {
            city,
            zone: None,
            sweeps: order.times.iter().map(|time| LogSweep { time: *time, ego: None }).collect(),
            scenes: order.scenes,
            tracks: Vec::new(),
            boxes: BySweep(Vec::new()),
            lights: BySweep(Vec::new()),
            tags: BySweep(Vec::new()),
        };
        log.egos(database, &order.poses)?;
        let tracks = log.tracks(database)?;
        log.seen(database, &order.numbers, &tracks)?;
        Ok(log)
    }

    fn egos(&mut self, database: &Database, poses: &HashMap<Vec<u8>, Vec<usize>>) -> Result<(), ReadError> {
        let columns = ["token", "x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "epsg"];
        database.rows("ego_pose", &columns, |row| {
            self.zone = self.zone.or_else(|| UtmZone::of_epsg(row.whole(10)?.try_into().ok()?));
            for sweep in poses.get(row.bytes(0)).into_iter().flatten() {
                let heading_rad = yaw([4, 5, 6, 7].map(|column| row.number(column)));
                let pose = LogPose {
                    at: Vec2::new(row.number(1), row.number(2)),
                    z_m: row.number(3),
                    heading_rad,
                    // The file has the ego's velocity in its own frame.
                    velocity: rotate(Vec2::new(row.number(8), row.number(9)), heading_rad),
                };
                if let Some(sweep) = self.sweeps.get_mut(*sweep) {
                    sweep.ego = Some(pose);
                }
            }
        })
    }

    /// Reads the tracks, and numbers them by their tokens.
    fn tracks(&mut self, database: &Database) -> Result<HashMap<Vec<u8>, usize>, ReadError> {
        let mut categories = HashMap::new();
        database.rows("category", &["token", "name"], |row| {
            categories.insert(row.bytes(0).to_vec(), row.text(1));
        })?;
        let mut numbers = HashMap::new();
        database.rows("track", &["token", "category_token", "length", "width", "height"], |row| {
            numbers.insert(row.bytes(0).to_vec(), self.tracks.len());
            self.tracks.push(LogTrack {
                token: hex(row.bytes(0)),
                category: categories.get(row.bytes(1)).cloned().unwrap_or_default(),
                size_m: [2, 3, 4].map(|column| row.positive(column)),
            });
        })?;
        Ok(numbers)
    }

    /// Reads what was seen at the sweeps.
    fn seen(
        &mut self,
        database: &Database,
        sweeps: &HashMap<Vec<u8>, usize>,
        tracks: &HashMap<Vec<u8>, usize>,
    ) -> Result<(), ReadError> {
        let sweep = |row: &DatabaseRow<'_>| sweeps.get(row.bytes(0)).copied();
        let track = |row: &DatabaseRow<'_>, column: usize| tracks.get(row.bytes(column)).copied();
        let mut boxes = Vec::new();
        let columns =
            ["lidar_pc_token", "track_token", "x", "y", "z", "yaw", "vx", "vy", "length", "width", "height"];
        database.rows("lidar_box", &columns, |row| {
            let (Some(sweep), Some(track)) = (sweep(row), track(row, 1)) else { return };
            let pose = LogPose {
                at: Vec2::new(row.number(2), row.number(3)),
                z_m: row.number(4),
                heading_rad: row.number(5),
                velocity: Vec2::new(row.number(6), row.number(7)),
            };
            if let Some(known) = self.tracks.get_mut(track) {
                let sides = known.size_m.iter_mut().zip([8, 9, 10]);
                sides.for_each(|(side, column)| *side = side.or_else(|| row.positive(column)));
            }
            boxes.push((sweep, SeenBox { track, pose }));
        })?;
        self.boxes = BySweep::of(boxes);
        let mut lights = Vec::new();
        if database.has("traffic_light_status") {
            let columns = ["lidar_pc_token", "lane_connector_id", "status"];
            database.rows("traffic_light_status", &columns, |row| {
                let state = match row.bytes(2).to_ascii_lowercase().as_slice() {
                    b"green" => SignalState::Go,
                    b"yellow" => SignalState::Caution,
                    b"red" => SignalState::Stop,
                    _ => SignalState::Unknown,
                };
                if let (Some(sweep), Some(connector)) = (sweep(row), row.whole(1)) {
                    lights.push((sweep, SeenLight { connector, state }));
                }
            })?;
        }
        self.lights = BySweep::of(lights);
        let mut tags = Vec::new();
        if database.has("scenario_tag") {
            database.rows("scenario_tag", &["lidar_pc_token", "type", "agent_track_token"], |row| {
                if let Some(sweep) = sweep(row) {
                    tags.push((sweep, LogTag { kind: row.text(1), track: track(row, 2) }));
                }
            })?;
        }
        self.tags = BySweep::of(tags);
        Ok(())
    }
}

/// Sweeps in the order of their scenes and times.
struct SweepOrder {
    times: Vec<i64>,
    scenes: Vec<LogScene>,
    /// Index of a sweep by its token.
    numbers: HashMap<Vec<u8>, usize>,
    /// Sweeps of an ego pose.
    poses: HashMap<Vec<u8>, Vec<usize>>,
}

impl SweepOrder {
    /// `log` names the scene of sweeps that have none.
    fn read(database: &Database, log: &str) -> Result<Self, ReadError> {
        struct SweepRow {
            scene: usize,
            time: i64,
            token: Vec<u8>,
            pose: Vec<u8>,
        }
        let mut names = HashMap::new();
        if database.has("scene") {
            database.rows("scene", &["token", "name"], |row| {
                names.insert(row.bytes(0).to_vec(), row.text(1));
            })?;
        }
        let (mut rows, mut tokens) = (Vec::new(), HashMap::new());
        database.rows(SWEEPS, &["token", "scene_token", "ego_pose_token", "timestamp"], |row| {
            let Some(time) = row.whole(3) else { return };
            let count = tokens.len();
            let scene = *tokens.entry(row.bytes(1).to_vec()).or_insert(count);
            rows.push(SweepRow { scene, time, token: row.bytes(0).to_vec(), pose: row.bytes(2).to_vec() });
        })?;
        // Scenes in the order of their beginnings.
        let mut begins = vec![i64::MAX; tokens.len()];
        rows.iter().for_each(|row| begins[row.scene] = begins[row.scene].min(row.time));
        rows.sort_by(|a, b| {
            let of = |row: &SweepRow| (begins[row.scene], row.scene, row.time);
            of(a).cmp(&of(b)).then_with(|| a.token.cmp(&b.token))
        });
        let tokens: HashMap<usize, Vec<u8>> =
            tokens.into_iter().map(|(token, scene)| (scene, token)).collect();
        let mut order =
            Self { times: Vec::new(), scenes: Vec::new(), numbers: HashMap::new(), poses: HashMap::new() };
        let mut last = None;
        for (number, row) in rows.into_iter().enumerate() {
            if last != Some(row.scene) {
                last = Some(row.scene);
                let token = tokens.get(&row.scene).map_or(&[][..], Vec::as_slice);
                let name = names.get(token).map_or("", String::as_str);
                let name =
                    [log, name].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ");
                order.scenes.push(LogScene { token: hex(token), name, sweeps: number..number });
            }
            if let Some(scene) = order.scenes.last_mut() {
                scene.sweeps.end = number + 1;
            }
            order.times.push(row.time);
            order.poses.entry(row.pose).or_default().push(number);
            order.numbers.insert(row.token, number);
        }
        Ok(order)
    }
}

/// A token in the form of the data set's own tools.
fn hex(token: &[u8]) -> String {
    token.iter().map(|byte| format!("{byte:02x}")).collect()
}
