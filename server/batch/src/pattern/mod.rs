//! Logical scenarios: patterns of the road with road users on them, and the places of maps where they fit.
//!
//! ```
//! use batch::pattern::document::RoadPattern;
//! use batch::pattern::search::PatternSearch;
//! use scene::map::Lane;
//! use scene::routes::LaneGraph;
//! use scene::{LaneMap, Scene, Vec2};
//!
//! let text = "name = 'stopped'\ntitle = 'A car drives towards one that stands.'\n\
//!     road = { feature = 'lane', before_m = 60, turn = 'straight' }\nparameters = { gap_m = { value = 50, range = [5, 60] } }\n\
//!     [[users]]\nid = 'own'\ntype = 'vehicle'\nat_m = '-gap_m'\nspeed_kmh = 50\n\
//!     [[users]]\nid = 'target'\ntype = 'vehicle'\nat_m = 0";
//! let pattern = RoadPattern::parse(text).unwrap();
//! let lane = Lane::street("a", vec![Vec2::new(0.0, 0.0), Vec2::new(200.0, 0.0)]);
//! let scene = Scene::bare("", LaneMap { lanes: vec![lane], ..LaneMap::default() }, Vec::new());
//! let graph = LaneGraph::new(&scene.map);
//! let places = PatternSearch::new(&pattern, &scene, &graph).all();
//! assert_eq!(places[0].id, "a@100.0");
//! let agents = places[0].cast(&pattern, &pattern.standard(), 0).unwrap();
//! assert_eq!(agents[0].track.at(0).unwrap().x_m, 50.0);
//! ```

pub mod choice;
mod crossing;
pub mod document;
pub mod number;
pub mod place;
mod ring;
pub mod search;
pub mod shipped;
#[cfg(test)]
mod tests;
mod way;
