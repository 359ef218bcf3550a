//! Plans of many generations, as values: varied numbers, the resulting units of work with their names, and
//! their chunks and shards. Also the events in results and their coverage, patterns of the road, and events
//! in recordings. This crate opens no files.
//!
//! ```
//! use batch::plan::BatchPlan;
//!
//! let plan = BatchPlan::parse("scenes = ['logs/']\nsituations = [{ template = 'brake' }]\nseeds = 4").unwrap();
//! assert_eq!(plan.seeds.list(), [0, 1, 2, 3]);
//!
//! let wrong = BatchPlan::parse("scenes = ['logs/']\nseed = 4").unwrap_err();
//! assert!(wrong[0].to_string().contains("did you mean seeds?"), "{}", wrong[0]);
//! ```

pub mod case;
pub mod catalogue;
pub mod chunk;
pub mod coverage;
pub mod distribution;
pub mod draws;
pub mod engine;
pub mod fault;
pub mod figures;
pub mod index;
mod latin_hypercube;
pub mod map;
pub mod mine;
pub mod names;
mod order;
pub mod pattern;
pub mod plan;
pub mod recorded;
pub mod row;
pub mod sampling;
pub mod search;
pub mod shard;
pub mod situation;
mod sobol;
pub mod unit;
pub mod who;
