//! Every limit of the server as data: defaults, `--limit NAME=N`, and the table in `/v1/info`.

use super::memory::OWN_BYTES;
use api::limits::{Bound, CallLimits, MODES, SAMPLES};
use scene::geometry::crowding;
use std::collections::BTreeMap;

macro_rules! limits {
    ($($field:ident = $default:expr, $what:literal;)*) => {
        /// Bounds that the server keeps. All are whole numbers in the unit of their name.
        #[derive(Clone, Debug, PartialEq, Eq)]
        pub struct Limits { $(#[doc = $what] pub $field: u64,)* }

        impl Default for Limits {
            fn default() -> Self { Self { $($field: $default,)* } }
        }

        impl Limits {
            /// Name, value and meaning of each limit.
            pub fn table(&self) -> Vec<(&'static str, u64, &'static str)> {
                vec![$((stringify!($field), self.$field, $what),)*]
            }

            fn slot(&mut self, name: &str) -> Option<&mut u64> {
                match name { $(stringify!($field) => Some(&mut self.$field),)* _ => None }
            }
        }
    };
}

limits! {
    json_encoded_bytes = 16 << 20, "JSON body as it arrives";
    json_decoded_bytes = 64 << 20, "JSON body after Content-Encoding is undone";
    import_encoded_bytes = 256 << 20, "uploaded file as it arrives";
    import_decoded_bytes = 256 << 20, "uploaded file after Content-Encoding is undone";
    memory_bytes = 1_536 << 20, "memory of the server (--memory): 256 MiB for the program itself, the rest for bodies, WebSocket messages, imports, exports, long replies, runs, open scenes and maps; what does not fit is refused";
    body_bytes = 512 << 20, "all bodies that are in memory: uploads as they arrived, others after Content-Encoding is undone too, long replies of imports";
    uploads = 4, "files that are uploaded or imported at the same time; one party has at most half of them";
    imports = 2, "files that are imported at the same time; one place is reserved for small ones";
    expansion_ratio = 100, "decoded to encoded size, beyond the first MiB";
    header_bytes = 16 << 10, "names and values of all header fields";
    header_fields = 64, "header fields of a request";
    uri_bytes = 8 << 10, "path and query of a request";
    regenerated_agents = CallLimits::default().regenerated_agents, "road users regenerated or reacting in one call";
    reply_points = CallLimits::default().reply_points, "samples x modes x road users x steps of a reply";
    work_s = 10, "expected work of a generation, in seconds of a core";
    import_scenes = 200, "scenes taken from one upload";
    import_files = 32, "files in one form";
    running = 0, "calls worked on at the same time, and as many long ones beside them; 0 means half the cores, 1 to 8";
    queue = 16, "calls that wait, and as many long ones beside them; in a full queue the newest call of the party with most of them is refused";
    generate_s = 60, "wall time of a generation and of other work";
    stream_s = 120, "wall time of a reply, waiting included";
    stalled_s = 15, "time that a reader may leave an event unread";
    buffered_events = 8, "events kept for a slow reader before steps are dropped";
    heartbeat_s = 10, "time between keep-alive messages of a stream";
    header_read_s = 10, "time for a request's head, and between requests of a connection";
    body_read_s = 30, "time for a JSON body, and for a message of a WebSocket";
    import_read_s = 120, "time for an upload";
    body_grace_s = 5, "time before a body must come at least at `body_rate`";
    body_rate = 10_000, "bytes a second, on average, that a body must come at";
    line_bytes = 1 << 20, "one message of a WebSocket";
    line_questions = 8, "requests of a WebSocket that are worked on at the same time; the next ones wait";
    connections = 256, "open connections, within the descriptors of the process; a refused one makes room first, then the longest idle one, of parties with over a quarter before others";
    party_rate = 5_000, "requests of one party a second, on average; 0 is no bound";
    party_burst = 20_000, "requests of one party at once, ahead of its rate";
    clients = 1_024, "clients whose revisions are remembered";
    client_idle_s = 600, "time after which a client is forgotten";
    stored_scenes = 10_000, "scenes in the store";
    user_scenes = 2_000, "scenes of one user, where scenes have owners (--owners)";
    user_bytes = 1 << 30, "scenes of one user as they are stored, without maps";
    store_bytes = 4 << 30, "size of the store's file";
    scene_keep_days = 0, "days after its last change at which a scene is deleted; 0 means never";
    map_keep_s = 86_400, "time that an unused map is kept";
    cached_map_bytes = 128 << 20, "memory of maps that are kept";
    cached_scene_bytes = 128 << 20, "memory of open scenes: saved and held ones, and as much for demos and the data folder; the party with most of them makes room";
    runs = 64, "runs that clients step; one party has at most half of them";
    run_bytes = 256 << 20, "memory of runs and their scenes";
    run_idle_s = 600, "time after which a run that is not used is forgotten";
    shutdown_s = 10, "time that running work gets when the server stops";
}

/// Limits that must not be zero, because nothing could be answered.
const NEVER_ZERO: [&str; 7] =
    ["connections", "imports", "header_bytes", "header_fields", "uri_bytes", "body_rate", "body_bytes"];

/// Least memory of a server: the program, plus one request of the usual size.
const LEAST_MEMORY_BYTES: u64 = OWN_BYTES + (128 << 20);

/// Limits that are part of the scene format (`scene::Scene::checked`) and cannot be changed.
fn fixed() -> [(&'static str, u64, &'static str); 16] {
    [
        ("json_depth", 128, "nesting of a JSON document"),
        ("agents", scene::MAX_AGENTS as u64, "road users in a scene"),
        ("scene_steps", scene::MAX_STEPS as u64, "steps in a scene"),
        ("map_polylines", scene::MAX_POLYLINES as u64, "lines and areas of a map"),
        ("map_points", scene::MAX_MAP_POINTS as u64, "points of a map"),
        ("polyline_points", scene::MAX_POLYLINE_POINTS as u64, "points of one line"),
        ("area_corners", scene::MAX_AREA_CORNERS as u64, "corners of all areas of a map"),
        ("lane_links", scene::MAX_LANE_LINKS as u64, "lanes in one list of a lane or a stop sign"),
        (
            "map_links",
            scene::MAX_MAP_LINKS as u64,
            "links of a map: to other lanes, to lines beside them, of stop signs",
        ),
        ("cell_pieces", crowding::MAX_CELL_PIECES, "straight pieces of lines in one square of 8 m"),
        (
            "cell_pairs",
            crowding::MAX_CELL_PAIRS,
            "pairs of straight pieces in the same square of 8 m, over a map",
        ),
        (
            "map_cells",
            crowding::MAX_CELLS as u64,
            "squares of 8 m that pieces pass through, counted for each piece",
        ),
        ("signals", scene::MAX_SIGNALS as u64, "signals in a scene"),
        ("coordinate_m", scene::MAX_COORDINATE_M as u64, "distance from the origin"),
        ("samples", SAMPLES, "joint scenes per call"),
        ("modes", MODES, "alternatives kept per road user"),
    ]
}

impl Limits {
    /// Applies one `NAME=N`.
    ///
    /// # Errors
    /// A sentence about an invalid name or number.
    pub fn set(&mut self, assignment: &str) -> Result<(), String> {
        let (name, number) =
            assignment.split_once('=').ok_or_else(|| format!("\"{assignment}\": NAME=N expected"))?;
        let number =
            number.parse().map_err(|_| format!("\"{number}\" is not a whole number for limit {name}"))?;
        let slot = self.slot(name).ok_or_else(|| {
            let names: Vec<_> = Self::default().table().iter().map(|row| row.0).collect();
            format!("no limit is named \"{name}\"; there are {}", names.join(", "))
        })?;
        if name == "memory_bytes" && number < LEAST_MEMORY_BYTES {
            return Err(format!("limit {name}: {LEAST_MEMORY_BYTES} or more expected"));
        }
        if number == 0 && NEVER_ZERO.contains(&name) {
            return Err(format!("limit {name}: 1 or more expected"));
        }
        *slot = number;
        Ok(())
    }

    /// Budget of requests and cached data, bytes.
    pub fn budget_bytes(&self) -> u64 {
        self.memory_bytes.saturating_sub(OWN_BYTES)
    }

    /// The limits of one call.
    pub fn of_a_call(&self) -> CallLimits {
        CallLimits {
            regenerated_agents: self.regenerated_agents,
            reply_points: self.reply_points,
            work_s: self.work_s,
        }
    }

    /// Generations that may run at the same time.
    pub fn workers(&self) -> usize {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        match self.running {
            0 => (cores / 2).clamp(1, 8),
            n => n.min(64) as usize,
        }
    }

    /// Additional threads for reading and writing documents, which never wait for generations.
    pub fn readers(&self) -> usize {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        cores.saturating_sub(self.workers()).clamp(1, 4)
    }

    /// All limits for `/v1/info`.
    pub fn bounds(&self) -> BTreeMap<&'static str, Bound> {
        let rows = self.table().into_iter().chain(fixed());
        let in_force = |name, number| if name == "running" { self.workers() as u64 } else { number };
        rows.map(|(name, number, what)| (name, Bound { value: in_force(name, number), what })).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Limits;

    #[test]
    fn a_limit_is_set_by_name() {
        let mut limits = Limits::default();
        assert!(limits.set("queue=3").is_ok());
        assert_eq!(limits.queue, 3);
        assert!(limits.set("queue").is_err());
        assert!(limits.set("queue=-1").is_err());
        assert!(limits.set("connections=0").unwrap_err().contains("1 or more"));
        assert!(limits.set("memory_bytes=1000").unwrap_err().contains("402653184 or more"));
        assert!(limits.set("tail=1").unwrap_err().contains("queue"));
    }
}
