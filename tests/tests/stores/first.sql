-- A store as the first version of the program wrote it: its schema, with neither `application_id` nor anything that
-- came later. Bodies are JSON here; the test compresses them as the program did.

CREATE TABLE maps (
    sha        TEXT PRIMARY KEY,
    bytes      INTEGER NOT NULL,
    polylines  INTEGER NOT NULL,
    points     INTEGER NOT NULL,
    body       BLOB NOT NULL,
    used_at    INTEGER NOT NULL
) STRICT;
CREATE TABLE scenes (
    id         TEXT PRIMARY KEY,
    rev        INTEGER NOT NULL,
    etag       TEXT NOT NULL,
    name       TEXT NOT NULL,
    tags       TEXT NOT NULL,
    parent_id  TEXT,
    map_sha    TEXT NOT NULL REFERENCES maps(sha),
    meta       TEXT NOT NULL,
    body       BLOB NOT NULL,
    created_at TEXT NOT NULL,
    updated_at TEXT NOT NULL
) STRICT;
CREATE INDEX scenes_by_time ON scenes(updated_at);
CREATE INDEX scenes_by_map ON scenes(map_sha);
PRAGMA user_version = 1;

INSERT INTO maps (sha, bytes, polylines, points, body, used_at) VALUES (
    '01826bef224a0bbbbc00032646693408f0606db869397df2f20dde2e15518db7',
    505, 2, 8,
    CAST('{"lanes":[{"id":"1","type":"surface_street","points_m":[[-40.0,0.0],[0.0,0.0],[40.0,0.0],[80.0,0.0]],"width_m":3.5,"left_boundary":[],"right_boundary":[],"speed_limit_mps":null,"predecessors":[],"successors":[],"left_neighbors":[],"right_neighbors":[],"interpolating":false}],"road_lines":[],"road_edges":[],"crosswalks":[{"id":"c","polygon_m":[[30.0,-4.0],[34.0,-4.0],[34.0,4.0],[30.0,4.0]]}],"speed_bumps":[],"driveways":[],"stop_signs":[{"id":"s","position_m":[28.0,-3.0],"lanes":["1"]}],"drivable":[]}' AS BLOB),
    1795260600
);

INSERT INTO maps (sha, bytes, polylines, points, body, used_at) VALUES (
    'c3585b2a9f2b5da8ea059a7e442d4d1184dec45a9ad3956a483bf1fca53cd798',
    651, 2, 8,
    CAST('{"lanes":[{"id":"1","type":"surface_street","points_m":[[-40.0,0.0],[0.0,0.0],[40.0,0.0],[80.0,0.0]],"width_m":3.5,"left_boundary":[],"right_boundary":[],"speed_limit_mps":null,"predecessors":[],"successors":[],"left_neighbors":[],"right_neighbors":[],"interpolating":false},{"id":"2","type":"surface_street","points_m":[[-40.0,3.5],[0.0,3.5],[40.0,3.5],[80.0,3.5]],"width_m":3.5,"left_boundary":[],"right_boundary":[],"speed_limit_mps":null,"predecessors":[],"successors":[],"left_neighbors":[],"right_neighbors":[],"interpolating":false}],"road_lines":[],"road_edges":[],"crosswalks":[],"speed_bumps":[],"driveways":[],"stop_signs":[],"drivable":[]}' AS BLOB),
    1795260600
);

INSERT INTO scenes (id, rev, etag, name, tags, parent_id, map_sha, meta, body, created_at, updated_at) VALUES (
    'first', 1, '"1-7a7aa1c2c63cfe64"', 'two cars', '["first","kept"]', NULL,
    'c3585b2a9f2b5da8ea059a7e442d4d1184dec45a9ad3956a483bf1fca53cd798',
    '{"counts":{"vehicle":2,"pedestrian":0,"cyclist":0,"other":0},"steps":3,"source":"drawn","source_id":null,"licence":"cc0","generated":false}',
    CAST('{"format":"dragtraffic.scene","version":1,"id":"first","name":"two cars","meta":{"source":"drawn","source_id":null,"licence":"cc0","origin":{"x_m":0.0,"y_m":0.0,"z_m":0.0,"rotation_rad":0.0,"crs":null},"parent_id":null,"tags":["first","kept"],"notes":"as it was","created_with":"0.1.0"},"time":{"step_s":0.1,"steps":3,"now_step":0},"map":{"ref":"sha256:c3585b2a9f2b5da8ea059a7e442d4d1184dec45a9ad3956a483bf1fca53cd798"},"signals":[],"agents":[{"id":"0","type":"vehicle","subtype":"car","role":null,"length_m":4.7,"width_m":2.0,"height_m":null,"track":{"first_step":0,"valid":[[0,3]],"x_m":[0.0,1.0,2.0],"y_m":[0.0,0.0,0.0],"z_m":null,"heading_rad":[0.0,0.0,0.0],"vx_mps":[10.0,10.0,10.0],"vy_mps":[0.0,0.0,0.0]},"conditions":{"goal":{"x_m":60.0,"y_m":0.0,"speed_mps":8.0}}},{"id":"1","type":"vehicle","subtype":"car","role":null,"length_m":4.7,"width_m":2.0,"height_m":null,"track":{"first_step":0,"valid":[[0,3]],"x_m":[15.0,16.0,17.0],"y_m":[3.5,3.5,3.5],"z_m":null,"heading_rad":[0.0,0.0,0.0],"vx_mps":[10.0,10.0,10.0],"vy_mps":[0.0,0.0,0.0]},"conditions":{}}],"generated":null}' AS BLOB),
    '2026-11-21T11:30:01.000Z', '2026-11-21T11:31:01.000Z'
);

INSERT INTO scenes (id, rev, etag, name, tags, parent_id, map_sha, meta, body, created_at, updated_at) VALUES (
    'second', 3, '"3-f319b8b0081597f7"', 'two cars copy', '["first","kept"]', 'first',
    'c3585b2a9f2b5da8ea059a7e442d4d1184dec45a9ad3956a483bf1fca53cd798',
    '{"counts":{"vehicle":2,"pedestrian":0,"cyclist":0,"other":0},"steps":3,"source":"drawn","source_id":null,"licence":"cc0","generated":true}',
    CAST('{"format":"dragtraffic.scene","version":1,"id":"second","name":"two cars copy","meta":{"source":"drawn","source_id":null,"licence":"cc0","origin":{"x_m":0.0,"y_m":0.0,"z_m":0.0,"rotation_rad":0.0,"crs":null},"parent_id":"first","tags":["first","kept"],"notes":"as it was","created_with":"0.1.0"},"time":{"step_s":0.1,"steps":3,"now_step":0},"map":{"ref":"sha256:c3585b2a9f2b5da8ea059a7e442d4d1184dec45a9ad3956a483bf1fca53cd798"},"signals":[],"agents":[{"id":"0","type":"vehicle","subtype":"car","role":null,"length_m":4.7,"width_m":2.0,"height_m":null,"track":{"first_step":0,"valid":[[0,3]],"x_m":[0.0,1.0,2.0],"y_m":[0.0,0.0,0.0],"z_m":null,"heading_rad":[0.0,0.0,0.0],"vx_mps":[10.0,10.0,10.0],"vy_mps":[0.0,0.0,0.0]},"conditions":{"goal":{"x_m":60.0,"y_m":0.0,"speed_mps":8.0}}},{"id":"1","type":"vehicle","subtype":"car","role":null,"length_m":4.7,"width_m":2.0,"height_m":null,"track":{"first_step":0,"valid":[[0,3]],"x_m":[15.0,16.0,17.0],"y_m":[3.5,3.5,3.5],"z_m":null,"heading_rad":[0.0,0.0,0.0],"vx_mps":[10.0,10.0,10.0],"vy_mps":[0.0,0.0,0.0]},"conditions":{}}],"generated":{"input_sha256":"b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1b1","stale":true,"weights":{"vehicle":"c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2c2"},"seed":7,"request":{"agents":["0"],"seed":7},"created_at":"2026-11-21T11:30:00.000Z","chosen_sample":0,"samples":[{"agents":{"0":{"chosen":0,"modes":[{"probability":1.0,"first_step":1,"x_m":[1.02,2.08,3.18,4.32,5.5,6.72,7.98,9.28,10.62,12.0],"y_m":[0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0],"heading_rad":[0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0],"vx_mps":[10.4,10.8,11.2,11.6,12.0,12.4,12.8,13.2,13.6,14.0],"vy_mps":[0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0]}]}},"score":null}]}}' AS BLOB),
    '2026-11-21T11:30:03.000Z', '2026-11-21T11:31:03.000Z'
);

INSERT INTO scenes (id, rev, etag, name, tags, parent_id, map_sha, meta, body, created_at, updated_at) VALUES (
    'third', 1, '"1-710d5bbbcc3a3e37"', 'at the crosswalk', '[]', NULL,
    '01826bef224a0bbbbc00032646693408f0606db869397df2f20dde2e15518db7',
    '{"counts":{"vehicle":1,"pedestrian":1,"cyclist":0,"other":0},"steps":3,"source":"drawn","source_id":null,"licence":null,"generated":false}',
    CAST('{"format":"dragtraffic.scene","version":1,"id":"third","name":"at the crosswalk","meta":{"source":"drawn","source_id":null,"licence":null,"origin":{"x_m":0.0,"y_m":0.0,"z_m":0.0,"rotation_rad":0.0,"crs":null},"parent_id":null,"tags":[],"notes":"","created_with":"0.1.0"},"time":{"step_s":0.1,"steps":3,"now_step":0},"map":{"ref":"sha256:01826bef224a0bbbbc00032646693408f0606db869397df2f20dde2e15518db7"},"signals":[],"agents":[{"id":"0","type":"vehicle","subtype":"car","role":null,"length_m":4.7,"width_m":2.0,"height_m":null,"track":{"first_step":0,"valid":[[0,3]],"x_m":[0.0,1.0,2.0],"y_m":[0.0,0.0,0.0],"z_m":null,"heading_rad":[0.0,0.0,0.0],"vx_mps":[10.0,10.0,10.0],"vy_mps":[0.0,0.0,0.0]},"conditions":{}},{"id":"7","type":"pedestrian","subtype":"unknown","role":null,"length_m":0.6,"width_m":0.6,"height_m":null,"track":{"first_step":0,"valid":[[0,3]],"x_m":[32.0,32.0,32.0],"y_m":[-5.0,-4.86,-4.72],"z_m":null,"heading_rad":[1.5,1.5,1.5],"vx_mps":[0.0,0.0,0.0],"vy_mps":[1.4,1.4,1.4]},"conditions":{}}],"generated":null}' AS BLOB),
    '2026-11-21T11:30:01.000Z', '2026-11-21T11:31:01.000Z'
);
