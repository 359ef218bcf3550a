//! Messages of AlpaSim's `TrafficService`, with the names and numbers of its fields.

use prost::Message;

/// An empty message.
#[derive(Clone, PartialEq, Message)]
pub struct Nothing {}

/// A vector, metres.
#[derive(Clone, Copy, PartialEq, Message)]
pub struct PoseVector {
    #[prost(float, tag = "1")]
    pub x: f32,
    #[prost(float, tag = "2")]
    pub y: f32,
    #[prost(float, tag = "3")]
    pub z: f32,
}

/// A rotation.
#[derive(Clone, Copy, PartialEq, Message)]
pub struct PoseQuaternion {
    #[prost(float, tag = "1")]
    pub w: f32,
    #[prost(float, tag = "2")]
    pub x: f32,
    #[prost(float, tag = "3")]
    pub y: f32,
    #[prost(float, tag = "4")]
    pub z: f32,
}

/// Centre and orientation of a box.
#[derive(Clone, Copy, PartialEq, Message)]
pub struct BoxPose {
    #[prost(message, optional, tag = "1")]
    pub vec: Option<PoseVector>,
    #[prost(message, optional, tag = "2")]
    pub quat: Option<PoseQuaternion>,
}

/// A pose at a time, microseconds.
#[derive(Clone, Copy, PartialEq, Message)]
pub struct TimedPose {
    #[prost(message, optional, tag = "1")]
    pub pose: Option<BoxPose>,
    #[prost(fixed64, tag = "2")]
    pub timestamp_us: u64,
}

/// Poses with rising times.
#[derive(Clone, PartialEq, Message)]
pub struct PoseTrajectory {
    #[prost(message, repeated, tag = "1")]
    pub poses: Vec<TimedPose>,
}

/// Extent of a box, metres.
#[derive(Clone, Copy, PartialEq, Message)]
pub struct BoxExtent {
    #[prost(float, tag = "1")]
    pub size_x: f32,
    #[prost(float, tag = "2")]
    pub size_y: f32,
    #[prost(float, tag = "3")]
    pub size_z: f32,
}

/// A road user with its recording.
#[derive(Clone, PartialEq, Message)]
pub struct LoggedObject {
    #[prost(message, optional, tag = "1")]
    pub aabb: Option<BoxExtent>,
    #[prost(message, optional, tag = "2")]
    pub trajectory: Option<PoseTrajectory>,
    #[prost(string, tag = "3")]
    pub object_id: String,
    #[prost(bool, tag = "4")]
    pub is_static: bool,
    #[prost(string, tag = "5")]
    pub label_class: String,
}

/// Motion of a road user.
#[derive(Clone, PartialEq, Message)]
pub struct ObjectMotion {
    #[prost(string, tag = "1")]
    pub object_id: String,
    #[prost(message, optional, tag = "2")]
    pub trajectory: Option<PoseTrajectory>,
}

/// Begins a session: its road users, and the time from which the service drives them.
#[derive(Clone, PartialEq, Message)]
pub struct SessionBegin {
    #[prost(string, tag = "1")]
    pub session_uuid: String,
    #[prost(string, tag = "2")]
    pub scene_id: String,
    #[prost(fixed64, tag = "3")]
    pub random_seed: u64,
    #[prost(message, repeated, tag = "4")]
    pub logged_object_trajectories: Vec<LoggedObject>,
    #[prost(fixed64, tag = "5")]
    pub handover_time_us: u64,
}

/// Ends a session.
#[derive(Clone, PartialEq, Message)]
pub struct SessionEnd {
    #[prost(string, tag = "1")]
    pub session_uuid: String,
}

/// Asks for the positions of all road users at a time, with the motion of those that the caller drives.
#[derive(Clone, PartialEq, Message)]
pub struct TrafficQuery {
    #[prost(string, tag = "1")]
    pub session_uuid: String,
    #[prost(fixed64, tag = "2")]
    pub time_query_us: u64,
    #[prost(message, repeated, tag = "3")]
    pub object_trajectory_updates: Vec<ObjectMotion>,
}

/// Positions of the road users that the service drives.
#[derive(Clone, PartialEq, Message)]
pub struct TrafficAnswer {
    #[prost(message, repeated, tag = "1")]
    pub object_trajectory_updates: Vec<ObjectMotion>,
}

/// Version of an interface.
#[derive(Clone, Copy, PartialEq, Message)]
pub struct InterfaceVersion {
    #[prost(uint32, tag = "1")]
    pub major: u32,
    #[prost(uint32, tag = "2")]
    pub minor: u32,
    #[prost(uint32, tag = "3")]
    pub patch: u32,
}

/// Version of the service.
#[derive(Clone, PartialEq, Message)]
pub struct ServiceVersion {
    #[prost(string, tag = "1")]
    pub version_id: String,
    #[prost(string, tag = "2")]
    pub git_hash: String,
    #[prost(message, optional, tag = "3")]
    pub grpc_api_version: Option<InterfaceVersion>,
}

/// What the service is, and how much history it needs.
#[derive(Clone, PartialEq, Message)]
pub struct ServiceMetadata {
    #[prost(message, optional, tag = "1")]
    pub version_id: Option<ServiceVersion>,
    #[prost(fixed64, tag = "2")]
    pub minimum_history_length_us: u64,
}

/// Scenes whose maps are known.
#[derive(Clone, PartialEq, Message)]
pub struct SceneNames {
    #[prost(string, repeated, tag = "1")]
    pub scene_ids: Vec<String>,
}
