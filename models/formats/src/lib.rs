//! Reads files as scenes, and writes scenes as files.
//!
//! [`native`] is the program's own JSON; [`womd`] is the Waymo Open Motion Dataset's Scenario record;
//! [`sumo`] reads networks and recordings of the traffic simulator; [`opendrive`] and [`lanelet2`] read maps;
//! `commonroad`, `scenarionet` and `gpudrive` are formats of planners and simulators; [`av2`] reads Argoverse
//! 2; [`table`] is motion for notebooks, as CSV and Parquet.
//!
//! No format depends on another. Readers are bounded in time and memory, never follow references, never
//! panic, and report the place of a fault.
//!
//! ```
//! use formats::{ExportOptions, ImportOptions, registry};
//! use scene::{Agent, AgentType, LaneMap, Scene, State, Subtype};
//!
//! let standing = vec![Some(State::default()); 91];
//! let car = Agent::bare("7", AgentType::Vehicle, Subtype::Car, standing);
//! let scene = Scene::bare("one car", LaneMap::default(), vec![car]);
//!
//! let womd = registry::by_id("womd").unwrap();
//! let file = womd.export(&[&scene], &ExportOptions::default())?;
//! println!("lost: {}", registry::loss_header(&file.losses));
//!
//! // The content identifies the format.
//! let scenes = registry::import(&file.bytes, "a file", "auto", &ImportOptions::default())?;
//! let (again, _warnings) = scenes[0].as_ref().unwrap();
//! assert_eq!(again.agents[0].track.states.len(), 91);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod around;
pub mod av2;
mod bounds;
pub mod checks;
pub mod columnar;
mod commonroad;
mod cut;
mod describe;
mod driving_side;
mod encoding;
pub mod files;
pub mod folder;
pub mod format;
pub mod foxglove;
mod frame;
pub mod geojson;
mod gpudrive;
mod headings;
pub mod html;
pub mod identities;
mod joints;
pub mod kinds;
pub mod lanelet2;
mod lights;
pub mod limits;
mod lists;
pub mod loss;
mod map_file;
mod markup;
pub mod native;
pub mod netconvert;
mod numbers;
// SQLite is written in C, which cannot be built for the browser.
#[cfg(not(target_family = "wasm"))]
mod nuplan;
mod nuscenes;
pub mod opendrive;
mod openscenario;
mod osm;
mod osm_items;
mod pack;
pub mod polyline;
pub mod problem;
mod projection;
mod recording;
pub mod refusals;
pub mod registry;
mod repairs;
mod scenarionet;
pub mod sentences;
mod settle;
mod sides;
pub mod source;
pub mod sumo;
mod surface;
pub mod table;
mod tree;
mod underlay;
mod units;
mod unpack;
mod unwritten;
pub mod womd;
mod written;
mod xml;

pub use format::{
    COLUMNS_POINTER, ExportOptions, Exported, ExportedMotion, FolderFiles, Format, ImportOptions,
    NET_POINTER, Scenes,
};
pub use loss::Loss;
pub use pack::unzipped;
pub use problem::{FieldProblem, ImportWarning, Imported, ReadError, RefusalKind, never_null, pointer_token};
pub use source::Source;
pub use written::is_too_long;
