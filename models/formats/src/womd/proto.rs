//! The messages of a Scenario record, with the field numbers that Waymo published.
//!
//! All fields are proto2 `optional`: present values (zeros too) are written, and absent ones stay absent.
//! Unknown fields (lidar, camera tokens) are skipped.
#![allow(missing_docs, reason = "names and meaning are those of the published messages")]

use prost::Message;
use scene::Vec2;
use std::collections::BTreeMap;

#[derive(Clone, PartialEq, Message)]
pub struct Scenario {
    #[prost(double, repeated, packed = "false", tag = "1")]
    pub timestamps_seconds: Vec<f64>,
    #[prost(message, repeated, tag = "2")]
    pub tracks: Vec<Track>,
    #[prost(int32, repeated, packed = "false", tag = "4")]
    pub objects_of_interest: Vec<i32>,
    #[prost(string, optional, tag = "5")]
    pub scenario_id: Option<String>,
    #[prost(int32, optional, tag = "6")]
    pub sdc_track_index: Option<i32>,
    #[prost(message, repeated, tag = "7")]
    pub dynamic_map_states: Vec<DynamicMapState>,
    #[prost(message, repeated, tag = "8")]
    pub map_features: Vec<MapFeature>,
    #[prost(int32, optional, tag = "10")]
    pub current_time_index: Option<i32>,
    #[prost(message, repeated, tag = "11")]
    pub tracks_to_predict: Vec<RequiredPrediction>,
}

#[derive(Clone, Copy, PartialEq, Eq, Message)]
pub struct RequiredPrediction {
    #[prost(int32, optional, tag = "1")]
    pub track_index: Option<i32>,
    #[prost(int32, optional, tag = "2")]
    pub difficulty: Option<i32>,
}

#[derive(Clone, PartialEq, Message)]
pub struct Track {
    #[prost(int32, optional, tag = "1")]
    pub id: Option<i32>,
    #[prost(int32, optional, tag = "2")]
    pub object_type: Option<i32>,
    #[prost(message, repeated, tag = "3")]
    pub states: Vec<ObjectState>,
}

#[derive(Clone, Copy, PartialEq, Message)]
pub struct ObjectState {
    #[prost(double, optional, tag = "2")]
    pub center_x: Option<f64>,
    #[prost(double, optional, tag = "3")]
    pub center_y: Option<f64>,
    #[prost(double, optional, tag = "4")]
    pub center_z: Option<f64>,
    #[prost(float, optional, tag = "5")]
    pub length: Option<f32>,
    #[prost(float, optional, tag = "6")]
    pub width: Option<f32>,
    #[prost(float, optional, tag = "7")]
    pub height: Option<f32>,
    #[prost(float, optional, tag = "8")]
    pub heading: Option<f32>,
    #[prost(float, optional, tag = "9")]
    pub velocity_x: Option<f32>,
    #[prost(float, optional, tag = "10")]
    pub velocity_y: Option<f32>,
    #[prost(bool, optional, tag = "11")]
    pub valid: Option<bool>,
}

#[derive(Clone, PartialEq, Message)]
pub struct DynamicMapState {
    #[prost(message, repeated, tag = "1")]
    pub lane_states: Vec<TrafficSignalLaneState>,
}

#[derive(Clone, Copy, PartialEq, Message)]
pub struct TrafficSignalLaneState {
    #[prost(int64, optional, tag = "1")]
    pub lane: Option<i64>,
    #[prost(int32, optional, tag = "2")]
    pub state: Option<i32>,
    #[prost(message, optional, tag = "3")]
    pub stop_point: Option<MapPoint>,
}

#[derive(Clone, Copy, PartialEq, Message)]
pub struct MapPoint {
    #[prost(double, optional, tag = "1")]
    pub x: Option<f64>,
    #[prost(double, optional, tag = "2")]
    pub y: Option<f64>,
    #[prost(double, optional, tag = "3")]
    pub z: Option<f64>,
}

impl MapPoint {
    /// The position in the plane; missing coordinates are zero.
    pub fn plane(&self) -> Vec2 {
        Vec2::new(self.x.unwrap_or(0.0), self.y.unwrap_or(0.0))
    }
}

#[derive(Clone, PartialEq, Message)]
pub struct MapFeature {
    #[prost(int64, optional, tag = "1")]
    pub id: Option<i64>,
    #[prost(oneof = "FeatureData", tags = "3, 4, 5, 7, 8, 9, 10")]
    pub feature_data: Option<FeatureData>,
}

#[derive(Clone, PartialEq, prost::Oneof)]
pub enum FeatureData {
    #[prost(message, tag = "3")]
    Lane(LaneCenter),
    #[prost(message, tag = "4")]
    RoadLine(TypedLine),
    #[prost(message, tag = "5")]
    RoadEdge(TypedLine),
    #[prost(message, tag = "7")]
    StopSign(StopSign),
    #[prost(message, tag = "8")]
    Crosswalk(Polygon),
    #[prost(message, tag = "9")]
    SpeedBump(Polygon),
    #[prost(message, tag = "10")]
    Driveway(Polygon),
}

#[derive(Clone, PartialEq, Message)]
pub struct LaneCenter {
    #[prost(double, optional, tag = "1")]
    pub speed_limit_mph: Option<f64>,
    #[prost(int32, optional, tag = "2")]
    pub lane_type: Option<i32>,
    #[prost(bool, optional, tag = "3")]
    pub interpolating: Option<bool>,
    #[prost(message, repeated, tag = "8")]
    pub polyline: Vec<MapPoint>,
    #[prost(int64, repeated, packed = "true", tag = "9")]
    pub entry_lanes: Vec<i64>,
    #[prost(int64, repeated, packed = "true", tag = "10")]
    pub exit_lanes: Vec<i64>,
    #[prost(message, repeated, tag = "11")]
    pub left_neighbors: Vec<LaneNeighbor>,
    #[prost(message, repeated, tag = "12")]
    pub right_neighbors: Vec<LaneNeighbor>,
    #[prost(message, repeated, tag = "13")]
    pub left_boundaries: Vec<BoundarySegment>,
    #[prost(message, repeated, tag = "14")]
    pub right_boundaries: Vec<BoundarySegment>,
}

#[derive(Clone, PartialEq, Message)]
pub struct LaneNeighbor {
    #[prost(int64, optional, tag = "1")]
    pub feature_id: Option<i64>,
    #[prost(int32, optional, tag = "2")]
    pub self_start_index: Option<i32>,
    #[prost(int32, optional, tag = "3")]
    pub self_end_index: Option<i32>,
    #[prost(int32, optional, tag = "4")]
    pub neighbor_start_index: Option<i32>,
    #[prost(int32, optional, tag = "5")]
    pub neighbor_end_index: Option<i32>,
    #[prost(message, repeated, tag = "6")]
    pub boundaries: Vec<BoundarySegment>,
}

#[derive(Clone, Copy, PartialEq, Eq, Message)]
pub struct BoundarySegment {
    #[prost(int32, optional, tag = "1")]
    pub lane_start_index: Option<i32>,
    #[prost(int32, optional, tag = "2")]
    pub lane_end_index: Option<i32>,
    #[prost(int64, optional, tag = "3")]
    pub boundary_feature_id: Option<i64>,
    #[prost(int32, optional, tag = "4")]
    pub boundary_type: Option<i32>,
}

/// `RoadLine` and `RoadEdge`: the same fields with other words for the type.
#[derive(Clone, PartialEq, Message)]
pub struct TypedLine {
    #[prost(int32, optional, tag = "1")]
    pub line_type: Option<i32>,
    #[prost(message, repeated, tag = "2")]
    pub polyline: Vec<MapPoint>,
}

#[derive(Clone, PartialEq, Message)]
pub struct StopSign {
    #[prost(int64, repeated, packed = "false", tag = "1")]
    pub lane: Vec<i64>,
    #[prost(message, optional, tag = "2")]
    pub position: Option<MapPoint>,
}

/// `Crosswalk`, `SpeedBump` and `Driveway`.
#[derive(Clone, PartialEq, Message)]
pub struct Polygon {
    #[prost(message, repeated, tag = "1")]
    pub polygon: Vec<MapPoint>,
}

/// `tf.train.Example`: values by name.
#[derive(Clone, PartialEq, Message)]
pub struct Example {
    #[prost(message, optional, tag = "1")]
    pub features: Option<Features>,
}

#[derive(Clone, PartialEq, Message)]
pub struct Features {
    /// Sorted by name, so that equal scenes give equal bytes.
    #[prost(btree_map = "string, message", tag = "1")]
    pub feature: BTreeMap<String, Feature>,
}

#[derive(Clone, PartialEq, Message)]
pub struct Feature {
    #[prost(oneof = "FeatureKind", tags = "1, 2, 3")]
    pub kind: Option<FeatureKind>,
}

#[derive(Clone, PartialEq, prost::Oneof)]
pub enum FeatureKind {
    #[prost(message, tag = "1")]
    Bytes(BytesList),
    #[prost(message, tag = "2")]
    Float(FloatList),
    #[prost(message, tag = "3")]
    Int64(Int64List),
}

#[derive(Clone, PartialEq, Eq, Message)]
pub struct BytesList {
    #[prost(bytes = "vec", repeated, tag = "1")]
    pub value: Vec<Vec<u8>>,
}

#[derive(Clone, PartialEq, Message)]
pub struct FloatList {
    #[prost(float, repeated, packed = "true", tag = "1")]
    pub value: Vec<f32>,
}

#[derive(Clone, PartialEq, Eq, Message)]
pub struct Int64List {
    #[prost(int64, repeated, packed = "true", tag = "1")]
    pub value: Vec<i64>,
}

#[derive(Clone, PartialEq, Message)]
pub struct SimAgentsChallengeSubmission {
    #[prost(message, repeated, tag = "1")]
    pub scenario_rollouts: Vec<ScenarioRollouts>,
    #[prost(int32, optional, tag = "2")]
    pub submission_type: Option<i32>,
    #[prost(string, optional, tag = "4")]
    pub unique_method_name: Option<String>,
    #[prost(bool, optional, tag = "9")]
    pub uses_lidar_data: Option<bool>,
    #[prost(bool, optional, tag = "10")]
    pub uses_camera_data: Option<bool>,
}

#[derive(Clone, PartialEq, Message)]
pub struct ScenarioRollouts {
    #[prost(string, optional, tag = "1")]
    pub scenario_id: Option<String>,
    #[prost(message, repeated, tag = "2")]
    pub joint_scenes: Vec<JointScene>,
}

#[derive(Clone, PartialEq, Message)]
pub struct JointScene {
    #[prost(message, repeated, tag = "1")]
    pub simulated_trajectories: Vec<SimulatedTrajectory>,
}

#[derive(Clone, PartialEq, Message)]
pub struct SimulatedTrajectory {
    #[prost(float, repeated, packed = "true", tag = "2")]
    pub center_x: Vec<f32>,
    #[prost(float, repeated, packed = "true", tag = "3")]
    pub center_y: Vec<f32>,
    #[prost(float, repeated, packed = "true", tag = "4")]
    pub center_z: Vec<f32>,
    #[prost(float, repeated, packed = "true", tag = "5")]
    pub heading: Vec<f32>,
    #[prost(int32, optional, tag = "6")]
    pub object_id: Option<i32>,
}
