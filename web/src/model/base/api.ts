// Made from assets/openapi.json by `npm run api`; not to be edited. model/document/scene-json.ts and
// net/types.ts name what the editor uses.
export interface paths {
    "/healthz": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The process answers. */
        get: operations["healthz"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/metrics": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Counters in Prometheus' text form. */
        get: operations["metrics"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/readyz": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Checks whether the server accepts work. Experts are loaded, the store reads and writes, the queue has room, and
         *     workers, readers and the data folder respond. For long calls and for background calls, at least one worker is not
         *     blocked by a call that has ended. `failing` lists those of `experts`, `store`, `queue`, `workers`, `readers`,
         *     `long-workers`, `background-workers` and `data` that fail.
         */
        get: operations["readyz"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/export": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Exports a scene given in the body. */
        post: operations["exportUnsaved"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/generate": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * A WebSocket for many generations, one after the other or at the same time, at a third of a browser's cost
         *     for separate requests. Each text message is a request `{"ask": 1, "body": {..}}` with the body of a `POST`
         *     and a number of the client's choice, or a cancellation `{"end": 1}`. Each message of the reply begins with
         *     a line `{"ask": 1, "status": 200}`. The first one also has `retry_after_s` and `scene` (the header
         *     `Dragtraffic-Scene`) where a `POST` would have them, the last one has `"last": true`. After it come lines
         *     as a `POST` streams them as NDJSON, or the problem. A cancelled request also ends with `{"ask": 1, "last":
         *     true}`, and then its number is free. An interrupted reply ends with a second `status` and its problem.
         *     Requests beyond `line_questions` wait until another one ends; while 64 wait, or 1 MB (`line_bytes`), a
         *     further one is refused with 503 `busy`. A message must arrive within `body_read_s`. More than 10 pings a second,
         *     or a message that cannot be read, end the WebSocket with its close code.
         */
        get: operations["openLine"];
        put?: never;
        /**
         * Generates futures. The reply is a stream of events (NDJSON or SSE) or only the last event (JSON), by
         *     Accept. Stores nothing.
         */
        post: operations["generate"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/import": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Stores the scenes of a file, or of the files of a form. Each of several files has its own result, and the
         *     request is refused if none of them can be read.
         */
        post: operations["importScenes"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/info": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Version, weights, limits and formats. */
        get: operations["info"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/jobs/{job}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /** Cancels a generation of the same caller (user, token or address). An id without a running or queued job is no error. */
        delete: operations["cancelJob"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/map": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Draws a map from a template and its parameters: lanes with links, neighbours and boundaries, kerbs, crosswalks,
         *     stop signs, signals over nine seconds. Stores nothing.
         */
        post: operations["makeMap"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/map/templates": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Lists the templates of maps with their parameters. */
        get: operations["listTemplates"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/maps": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Lists the maps of saved scenes. */
        get: operations["listMaps"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/maps/{sha256}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Reads a map. It never changes, so it may be cached for ever. */
        get: operations["readMap"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/place": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Places road users on a map: vehicles on lanes, pedestrians on crosswalks and pavements, cyclists on cycle
         *     lanes or on the right, traffic that enters by the arms at a rate, and parked cars. Boxes are at least 0.1
         *     m apart and all centres lie in the region. Fewer than requested is no error. Stores nothing.
         */
        post: operations["place"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/runs": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Begins a run in a scene, or continues one from a snapshot. The client drives the road users in `egos`; the server
         *     drives all others from step to step, with knowledge of the past and of the plans that egos announce. The run is
         *     kept in memory and deleted after `idle_s` without use.
         */
        post: operations["beginRun"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/runs/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Returns the state of a run: the current states, the remaining steps, the time since its last use. With NDJSON or SSE
         *     in Accept, the reply follows the run: first the run, then each step, until the run is deleted. Reading or following a
         *     run does not count as use and changes nothing.
         */
        get: operations["readRun"];
        put?: never;
        post?: never;
        /** Deletes a run. */
        delete: operations["deleteRun"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/runs/{id}/peek": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Predicts the motion of the others over the next nine seconds if the egos drove these plans. The run does
         *     not change.
         */
        post: operations["peekRun"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/runs/{id}/scene": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Returns the scene of a run as it was when the run began. */
        get: operations["readRunScene"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/runs/{id}/snapshot": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Returns the run as text, from which another run can begin: on this server or another, now or later. It continues
         *     with the same bytes as this one.
         */
        post: operations["saveRun"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/runs/{id}/step": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * A WebSocket for the steps of a run. Messages have the form of those for generations (`GET /v1/generate`), with
         *     the body of a step as `body`. A client waits for the reply to a step before it sends the next one.
         */
        get: operations["openRunLine"];
        put?: never;
        /**
         * Makes a step: the egos take the states of the body, and all others move on and react to them. Steps are numbered
         *     from 1. Repeating the last number returns the same reply, whatever the body, so that a client can recover a lost
         *     reply; any other number than the next one is refused (`step-order`).
         */
        post: operations["stepRun"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/scenes": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Lists scenes without their content: saved ones, demos, and those of the data folder. */
        get: operations["listScenes"];
        put?: never;
        /** Saves a new scene; the id of the document is ignored. The same Idempotency-Key and body give the same reply. */
        post: operations["createScene"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/scenes/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Reads a scene. */
        get: operations["readScene"];
        /** Replaces a scene (If-Match) or makes one under the client's own id (If-None-Match: *). */
        put: operations["replaceScene"];
        post?: never;
        /** Deletes a scene. */
        delete: operations["deleteScene"];
        options?: never;
        head?: never;
        /** Renames or shares a scene, or changes its tags or notes (RFC 7396 merge patch). */
        patch: operations["renameScene"];
        trace?: never;
    };
    "/v1/scenes/{id}/duplicate": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Copies a scene, read-only ones too; `meta.parent_id` names the original. */
        post: operations["duplicateScene"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/scenes/{id}/export": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Exports a scene of this server. */
        get: operations["exportScene"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/scenes/{id}/preview": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Reads the content of a scene's small picture: the scene with simplified lines, and for each road user
         *     present at the first step its first and last state.
         */
        get: operations["previewScene"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/score": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Scores a scene: chosen futures or the given motion, and the log of the rest. */
        post: operations["score"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/v1/search": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Searches a scene for results that satisfy a condition. Each try draws the numbers of the situation, generates once
         *     and is scored; earlier scores determine the numbers of the next tries. The reply is a stream of events (NDJSON or
         *     SSE) or only the last event (JSON), by Accept. Equal requests give equal tries. A search ends after most of
         *     `generate_s` with the tries made so far, or at once when the client disconnects. Stores nothing.
         */
        post: operations["search"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
}
export type webhooks = Record<string, never>;
export interface components {
    schemas: {
        /**
         * AcceptedEvent
         * @description First event: the planned work.
         */
        AcceptedEvent: {
            /**
             * Format: double
             * @description Time since the request was read, milliseconds.
             */
            elapsed_ms: number;
            /**
             * @description Type of the event.
             * @constant
             */
            event: "accepted";
            /** @description Road users that keep their motion. */
            fixed: string[];
            /** @description Id of the job. */
            job: string;
            /**
             * Format: uint
             * @description Number of jobs ahead of this one when it was queued.
             */
            queue_position: number;
            /** @description Road users that may react to them. */
            reacting: string[];
            /** @description Road users that get new futures. */
            regenerated: string[];
            /**
             * Format: uint64
             * @description Revision of the request, if it has one.
             */
            revision?: number;
            /**
             * Format: uint64
             * @description Seed in use.
             */
            seed: number;
            /**
             * Format: uint64
             * @description Increases by one per event; a gap marks events that were dropped for a slow reader.
             */
            seq: number;
            /**
             * Format: uint
             * @description Refinement steps per window.
             */
            steps: number;
            /** @description Warnings so far. */
            warnings: components["schemas"]["Warning"][];
            /**
             * Format: uint
             * @description Number of successive planning windows.
             */
            windows: number;
        };
        /**
         * Agent
         * @description One road user.
         */
        Agent: {
            /**
             * @description Conditions fixed by the user.
             * @default {}
             */
            conditions?: components["schemas"]["Conditions"];
            /**
             * Format: double
             * @description Height, metres.
             * @default null
             */
            height_m?: number | null;
            /** @description Id, unique in the scene, `[A-Za-z0-9_.:-]{1,64}`. */
            id: string;
            /**
             * Format: double
             * @description Length, metres. Default: that of the subtype.
             * @default null
             */
            length_m?: number | null;
            /**
             * @description Role in the source, such as `ego`.
             * @default null
             */
            role?: string | null;
            /**
             * @description Finer type, which sets default size and limits.
             * @default unknown
             * @enum {string}
             */
            subtype?: "car" | "truck" | "bus" | "van" | "motorcycle" | "trailer" | "emergency" | "adult" | "child" | "wheelchair" | "scooter" | "bicycle" | "unknown";
            /**
             * @description Recorded track; empty when absent.
             * @default {
             *       "first_step": 0,
             *       "heading_rad": [],
             *       "valid": null,
             *       "vx_mps": [],
             *       "vy_mps": [],
             *       "x_m": [],
             *       "y_m": [],
             *       "z_m": null
             *     }
             */
            track?: components["schemas"]["Track"];
            /**
             * @description Type, which selects expert and motion model; `other` is shown, but never regenerated.
             * @enum {string}
             */
            type: "vehicle" | "pedestrian" | "cyclist" | "other";
            /**
             * Format: double
             * @description Width, metres. Default: that of the subtype.
             * @default null
             */
            width_m?: number | null;
        };
        /**
         * AgentFutures
         * @description The futures of one road user.
         */
        AgentFutures: {
            /**
             * Format: uint64
             * @description Index into `modes` of the future that is shown and exported.
             */
            chosen: number;
            /** @description In order of decreasing probability. */
            modes: components["schemas"]["Future"][];
            /** @description Why it left its previous motion. */
            reaction?: components["schemas"]["Reaction"] | null;
        };
        /**
         * AgentScore
         * @description Score of one road user.
         */
        AgentScore: {
            /**
             * Format: double
             * @description Mean distance of the chosen future, metres.
             */
            ade_m: number | null;
            /**
             * Format: uint
             * @description Its collisions that are not in the log.
             */
            collisions: number;
            /** @description Step that counted as the end. */
            endpoint: components["schemas"]["Endpoint"];
            /** @description Only when a goal field is fixed. */
            goal_error: components["schemas"]["GoalError"] | null;
            /**
             * Format: double
             * @description Mean absolute heading error of the future that ends closest, radians.
             */
            heading_error_rad: number | null;
            /** @description Generated motion only. */
            kinematic: components["schemas"]["Kinematic"] | null;
            /**
             * Format: double
             * @description Greatest distance of the chosen future, metres (the log ghost's figure).
             */
            max_distance_m: number | null;
            /**
             * Format: double
             * @description Least mean distance of any future, metres.
             */
            min_ade_m: number | null;
            /**
             * Format: double
             * @description As in [`SceneScore`].
             */
            min_distance_m: number | null;
            /**
             * Format: double
             * @description Least distance at the end of any future, metres.
             */
            min_fde_m: number | null;
            /**
             * Format: double
             * @description As in [`SceneScore`].
             */
            min_ttc_s: number | null;
            /**
             * Format: uint
             * @description Its near misses that are not in the log.
             */
            near_misses: number;
            /**
             * Format: double
             * @description Vehicles only.
             */
            offroad_max_m: number | null;
            /**
             * Format: double
             * @description Vehicles only.
             */
            offroad_share: number | null;
            /**
             * Format: uint
             * @description Its overlaps below the threshold of a collision that are not in the log.
             */
            overlaps: number;
            /**
             * Format: double
             * @description As in [`SceneScore`].
             */
            pet_s: number | null;
            /**
             * Format: double
             * @description Mean absolute speed error of the future that ends closest, m/s.
             */
            speed_error_mps: number | null;
            /**
             * Format: double
             * @description Vehicles only.
             */
            wrong_way_share: number | null;
        };
        /**
         * AgentType
         * @description Type of a road user; selects the expert and the motion model.
         *
         *     `vehicle`: Motor vehicles on lanes: cars, trucks, buses, motorcycles.
         *
         *     `pedestrian`: A person on foot.
         *
         *     `cyclist`: A person on a bicycle or kick-scooter.
         *
         *     `other`: Shown, never regenerated.
         * @enum {string}
         */
        AgentType: "vehicle" | "pedestrian" | "cyclist" | "other";
        /**
         * All
         * @description The value `all`.
         *
         *     `all`: All road users.
         * @enum {string}
         */
        All: "all";
        /**
         * Answer
         * @description A judged card.
         */
        Answer: {
            /** @description Features of the card, as in the reply. */
            features: components["schemas"]["Features"];
            /**
             * @description Positions of the card, as in the reply; later rounds have no similar card.
             * @default {}
             */
            places?: {
                [key: string]: number[][];
            };
            /** @description The user's verdict. */
            verdict: components["schemas"]["Verdict"];
            /** @description The reason for the verdict. */
            why?: components["schemas"]["Wish"] | null;
        };
        /**
         * AnswerSample
         * @description One joint scene of the answer. Its score is in `scores`.
         */
        AnswerSample: {
            /** @description Futures by id of the road user. */
            agents: {
                [key: string]: components["schemas"]["Futures"];
            };
            /** @description Empty in the reply; holds the score in a saved scene. */
            score: unknown;
        };
        /**
         * Area
         * @description A crosswalk, speed bump or driveway.
         */
        Area: {
            /** @description Id, unique among areas of the kind. */
            id: string;
            /** @description Open ring. */
            polygon_m: components["schemas"]["Points"];
        };
        /**
         * Arm
         * @description A road that leads to a junction, as seen from the junction.
         */
        Arm: {
            /**
             * Format: double
             * @description Direction from the junction, counter-clockwise from east, degrees.
             * @default 0
             */
            angle_deg: number;
            /**
             * Format: double
             * @description Width of the crosswalk across it, metres; below half a metre there is none.
             * @default 3
             */
            crosswalk_m: number;
            /**
             * Format: double
             * @description Width of the cycle lane on each side, metres; below half a metre there is none.
             * @default 0
             */
            cycle_lane_m: number;
            /**
             * Format: uint8
             * @description Number of inbound lanes, towards the junction.
             * @default 1
             */
            lanes_in: number;
            /**
             * Format: uint8
             * @description Number of outbound lanes, away from the junction.
             * @default 1
             */
            lanes_out: number;
            /**
             * Format: double
             * @description Length from the centre of the junction to the edge of the map, metres; longer where the junction needs
             *     it.
             * @default 90
             */
            length_m: number;
            /**
             * @description With `priority`: its traffic has right of way.
             * @default false
             */
            main: boolean;
            /**
             * Format: double
             * @description Width of the raised median, metres; below half a metre there is none.
             * @default 0
             */
            median_m: number;
            /**
             * Format: double
             * @description Speed limit, km/h.
             * @default 50
             */
            speed_limit_kmh: number;
            /**
             * @description Allowed turns of each inbound lane, in order from the middle of the road to the kerb; null selects the
             *     usual turns.
             * @default null
             */
            turns: components["schemas"]["Turn"][][] | null;
        };
        /**
         * ArmDoc
         * @description An arm: a road that enters the map or the region.
         */
        ArmDoc: {
            /**
             * Format: double
             * @description Driving direction at the entry, radians.
             */
            heading_rad: number;
            /** @description Compass direction that it comes from, with a number if several arms share it: `north-east`, `west-2`. */
            id: string;
            /** @description Its lanes, from right to left. */
            lanes: components["schemas"]["ArmLane"][];
            /**
             * Format: uint
             * @description Vehicles that enter later.
             */
            later: number;
            /**
             * Format: double
             * @description Length from the entry to the end line, metres: the first junction, or where the road ends or joins
             *     another.
             */
            length_m: number;
            /**
             * Format: double
             * @description Capacity of its lanes, vehicles per hour.
             */
            most_per_hour: number;
            /**
             * Format: uint
             * @description Vehicles of its traffic that are present at the start.
             */
            placed: number;
            /**
             * Format: double
             * @description Middle of its lanes at the entry, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Middle of its lanes at the entry, metres.
             */
            y_m: number;
        };
        /**
         * ArmLane
         * @description A lane by which an arm enters the map or the region.
         */
        ArmLane: {
            /** @description Id of the lane. */
            lane: string;
            /**
             * Format: double
             * @description Arc length of the entry, metres.
             */
            s_m: number;
        };
        /**
         * ArmPlace
         * @description Position of an arm, for editing handles.
         */
        ArmPlace: {
            /** @description Point where the arm leaves the map, metres. */
            end_m: number[];
            /** @description End of each inbound lane, metres. */
            ins_m: number[][];
            /** @description Distances from the middle to the kerb of the inbound lanes and to that of the outbound lanes, metres. */
            kerbs_m: number[];
            /** @description Stop position of inbound traffic, in the middle of the arm, metres. */
            mouth_m: number[];
            /** @description Such as `North`. */
            name: string;
            /** @description Start of each outbound lane, metres. */
            outs_m: number[][];
            /** @description Turns of its inbound lanes, from the middle of the road to the kerb, without single connections. */
            turns: components["schemas"]["Turn"][][];
        };
        /**
         * Arrivals
         * @description Traffic that enters by an arm.
         */
        Arrivals: {
            /** @description Id of one of the reply's `arms`. */
            arm: string;
            /**
             * Format: double
             * @description Motor vehicles per hour, all lanes together.
             */
            per_hour: number;
        };
        /**
         * BatchOptions
         * @description Options of every generation.
         */
        BatchOptions: {
            /**
             * Format: double
             * @description Scale of the noise, which makes seeds differ.
             * @default 0.5
             */
            diversity?: number;
            /**
             * Format: double
             * @description Time to generate, seconds.
             * @default 9
             */
            horizon_s?: number;
            /**
             * Format: uint64
             * @description Number of futures planned for each road user.
             * @default 6
             */
            modes?: number;
            /**
             * @description Let the other road users react.
             * @default true
             */
            react?: boolean;
            /**
             * Format: double
             * @description Replan interval, seconds: 3, 6 or 9.
             */
            replan_interval_s?: number | null;
            /**
             * Format: double
             * @description Scene time of the start, seconds.
             * @default 0
             */
            start_s?: number;
            /**
             * Format: uint64
             * @description Refinement steps.
             * @default 5
             */
            steps?: number;
        };
        /**
         * BatchSituation
         * @description One situation.
         */
        BatchSituation: {
            /**
             * @description Road users that get the conditions: ids, `@all`, `@moving`, `@vehicles`, `@pedestrians`, `@cyclists`, `@ego`.
             *     Each is generated in separate units.
             */
            agents?: string[];
            /** @description Goal. */
            goal?: components["schemas"]["GoalRanges"];
            /** @description Length of the road user, metres. */
            length_m?: components["schemas"]["Distribution"] | null;
            /** @description Name in the results: letters, digits, - and _. Default: that of the template or the pattern, or `free`. */
            name?: string | null;
            /** @description Types and sizes of the other road users. */
            others?: components["schemas"]["OtherKinds"];
            /**
             * @description By name: figures of the template, of which absent ones are drawn by the seed; or parameters of the pattern, of
             *     which absent ones have their standard values.
             */
            parameters?: {
                [key: string]: components["schemas"]["Distribution"];
            };
            /**
             * @description Pattern of the road that the maps of the scenes are searched for: a name of `dragtraffic match --list`, a file, or
             *     the pattern itself. Its road users are placed where it fits, and those of the scene are removed.
             */
            pattern?: components["schemas"]["PatternChoice"] | null;
            /** @description Start. */
            start?: components["schemas"]["StartRanges"];
            /**
             * @description Test situation that the scene is searched for. The actor is picked from the scene; the seed decides which.
             * @enum {string|null}
             */
            template?: "brake" | "cut-in" | "late" | null;
            /** @description Type of the road user, in place of its own. */
            type?: components["schemas"]["AgentType"] | null;
            /** @description Width of the road user, metres. */
            width_m?: components["schemas"]["Distribution"] | null;
            /**
             * @description Id of the other road user of the figures under `pair.`. Default: the one that a template or a pattern
             *     affects, else the one with which a collision comes nearest.
             */
            with?: string | null;
        };
        /**
         * Bound
         * @description A bound in force.
         */
        Bound: {
            /**
             * Format: uint64
             * @description Value, in the unit of the bound's name.
             */
            value: number;
            /** @description Description of the bounded quantity. */
            what: string;
        };
        /**
         * Boundary
         * @description A section of a lane's side, with the road line or edge that bounds it.
         */
        Boundary: {
            /**
             * Format: uint32
             * @description First point index.
             */
            from: number;
            /**
             * Format: uint32
             * @description WOMD's boundary type number.
             */
            kind?: number | null;
            /** @description Id of the road line or edge. */
            ref: string;
            /**
             * Format: uint32
             * @description Last point index.
             */
            to: number;
        };
        /**
         * Build
         * @description Build of the program.
         */
        Build: {
            /** @description Cargo profile. */
            profile: string;
            /** @description Target triple. */
            target: string;
        };
        /**
         * ByRoad
         * @description A position on a lane that can be reached instead of the goal.
         */
        ByRoad: {
            /**
             * Format: double
             * @description Distance from the goal, metres.
             */
            distance_m: number;
            /**
             * Format: double
             * @description Heading of the lane, radians.
             */
            heading_rad: number;
            /**
             * Format: double
             * @description Position on the centre line of the lane, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Position on the centre line of the lane, metres.
             */
            y_m: number;
        };
        /**
         * CarPark
         * @description A street with a car park beside it: its entrance is at one end, its exit at the other, with aisles between
         *     them.
         */
        CarPark: {
            /**
             * Format: double
             * @description Width of the aisles, metres.
             * @default 5.5
             */
            aisle_m: number;
            /**
             * Format: uint8
             * @description Number of aisles with bays on both sides.
             * @default 3
             */
            aisles: number;
            /**
             * Format: double
             * @description Length of a bay, metres.
             * @default 5
             */
            bay_length_m: number;
            /**
             * Format: double
             * @description Width of a bay, metres.
             * @default 2.5
             */
            bay_width_m: number;
            /**
             * Format: uint8
             * @description Number of bays along each side of an aisle.
             * @default 12
             */
            bays: number;
            /**
             * Format: double
             * @description Radius of the kerbs at corners, metres.
             * @default 6
             */
            kerb_radius_m: number;
            /**
             * Format: double
             * @description Width of the lanes of the street, metres.
             * @default 3.25
             */
            lane_width_m: number;
            /**
             * Format: double
             * @description Width of the pavements, metres; below half a metre there are none.
             * @default 2.5
             */
            sidewalk_m: number;
            /**
             * Format: double
             * @description Speed limit of the street, km/h.
             * @default 50
             */
            speed_limit_kmh: number;
            /**
             * @description Side of the road on which traffic drives.
             * @default right-hand
             */
            traffic: components["schemas"]["Traffic"];
        };
        /**
         * Change
         * @description A road user that changed its plan because of another.
         */
        Change: {
            /** @description The road user. */
            agent: string;
            /** @description What it does, and its cause. */
            reaction: components["schemas"]["Reaction"];
        };
        /**
         * Check
         * @description A check that passed, or one failure of a check.
         */
        Check: {
            /** @description Place of the failure, metres. */
            at_m: number[] | null;
            /** @description Subject of the check. */
            kind: components["schemas"]["CheckKind"];
            /** @description Lanes concerned. */
            lanes: string[];
            /** @description The finding as data. */
            message: components["schemas"]["Message"];
            /** @description Whether it passed. */
            passed: boolean;
            /** @description The finding in English. */
            text: string;
        };
        /**
         * CheckKind
         * @description Subject of a check.
         *
         *     `lanes-lead`: Every lane has a successor or leaves the map, and can be reached.
         *
         *     `turns`: A bus of 12 m (in a car park: a car) can turn.
         *
         *     `widths`: No lane is too narrow.
         *
         *     `signals-apart`: No two movements with simultaneous green conflict.
         * @enum {string}
         */
        CheckKind: "lanes-lead" | "turns" | "widths" | "signals-apart";
        /**
         * Circle
         * @description A circle.
         */
        Circle: {
            /**
             * Format: double
             * @description Metres.
             */
            radius_m: number;
            /**
             * Format: double
             * @description Centre, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Centre, metres.
             */
            y_m: number;
        };
        /**
         * Collision
         * @description Two road users collide: their boxes overlap by more than the thresholds. One entry per pair.
         */
        Collision: {
            /** @description The road user listed first. */
            a: string;
            /** @description The other. */
            b: string;
            /**
             * Format: double
             * @description Closing speed at the first moment, m/s (relative speed if they already overlap).
             */
            closing_speed_mps: number;
            /** @description Both move as recorded; the event does not count. */
            in_log: boolean;
            /**
             * Format: double
             * @description Greatest intersection over union of the whole encounter, 0 to 1.
             */
            iou: number;
            /**
             * Format: double
             * @description Scene time of the first moment over the threshold, seconds.
             */
            time_s: number;
        };
        /**
         * CompactFuture
         * @description One possible motion as second differences. A column starts with its first value, followed by the first
         *     difference and then by the changes of the difference. Two running sums restore the columns of a scene
         *     document exactly.
         */
        CompactFuture: {
            /**
             * Format: uint32
             * @description Index of the generator's anchor that it follows.
             */
            anchor?: number | null;
            /** @description Faults, the worst first. */
            faults?: components["schemas"]["Fault"][];
            /**
             * Format: uint64
             * @description Scene step of the first value.
             */
            first_step: number;
            /** @description Heading in units of 0.0001 rad. */
            heading_e4rad: number[];
            /** @description What it does. */
            manoeuvre?: components["schemas"]["Manoeuvre"] | null;
            /**
             * Format: double
             * @description Relative weight among the road user's futures; see `calibrated` of the answer.
             */
            probability: number;
            /** @description Relations to other road users. */
            relations?: components["schemas"]["Relation"][];
            /** @description Velocity, mm/s. */
            vx_mmps: number[];
            /** @description Velocity, mm/s. */
            vy_mmps: number[];
            /** @description Box centre, millimetres. */
            x_mm: number[];
            /** @description Box centre, millimetres. */
            y_mm: number[];
        };
        /**
         * CompactFutures
         * @description The futures of one road user, compact.
         */
        CompactFutures: {
            /**
             * Format: uint64
             * @description Index into `compact` of the future that is shown and exported.
             */
            chosen: number;
            /** @description In order of decreasing probability. */
            compact: components["schemas"]["CompactFuture"][];
            /** @description Why it left its previous motion. */
            reaction?: components["schemas"]["Reaction"] | null;
        };
        /**
         * ConditionRange
         * @description Ranges of the sizes and speeds of one agent type; both ends are included.
         */
        ConditionRange: {
            /** @description Metres. */
            length_m: [
                number,
                number
            ];
            /** @description m/s; also the norm of a velocity. */
            speed_mps: [
                number,
                number
            ];
            /** @description Metres. */
            width_m: [
                number,
                number
            ];
        };
        /**
         * ConditionRanges
         * @description Ranges of conditions by type; both ends are included.
         */
        ConditionRanges: {
            cyclist: components["schemas"]["ConditionRange"];
            pedestrian: components["schemas"]["ConditionRange"];
            vehicle: components["schemas"]["ConditionRange"];
        };
        /**
         * Conditions
         * @description Conditions of one road user. A number fixes a field; null or absence leaves it free.
         */
        Conditions: {
            /**
             * @description Frame of the goal; replies are always in `scene`.
             * @enum {string}
             */
            frame?: "scene" | "agent";
            /** @description Goal fields. */
            goal?: components["schemas"]["Goal"] | null;
            /**
             * Format: double
             * @description Length, metres.
             */
            length_m?: number | null;
            /** @description Start fields. */
            start?: components["schemas"]["Start"] | null;
            /**
             * @description Type whose expert is used in place of the expert of the road user's own type.
             * @enum {unknown}
             */
            type?: "vehicle" | "pedestrian" | "cyclist" | null;
            /** @description Via points in the order in which they are passed, always in the frame `scene`. */
            via?: components["schemas"]["Via"][];
            /**
             * Format: double
             * @description Width, metres.
             */
            width_m?: number | null;
        };
        /**
         * Connection
         * @description A path from an inbound lane to an outbound lane, which for a U-turn is of the same arm. Arms count in the order of
         *     the parameters, lanes from the middle of the road to the kerb: from 0 here, from 1 in the ids of lanes that documents
         *     have.
         */
        Connection: {
            /** @description Inbound lane, such as `arm2.in1`: the lane of the second arm next to the middle of the road. */
            from: string;
            /** @description Outbound lane, such as `arm3.out1`. */
            to: string;
        };
        /**
         * Connections
         * @description Paths through a junction that are added to, or removed from, those of its turn lanes.
         */
        Connections: {
            /**
             * @description Added paths.
             * @default []
             */
            added: components["schemas"]["Connection"][];
            /**
             * @description Removed paths.
             * @default []
             */
            removed: components["schemas"]["Connection"][];
        };
        /**
         * Control
         * @description Right of way at a junction.
         *
         *     `signals`: Traffic lights.
         *
         *     `priority`: Stop signs at the arms that are not main.
         *
         *     `equal`: Stop signs at all arms.
         * @enum {string}
         */
        Control: "signals" | "priority" | "equal";
        /**
         * CornerPlace
         * @description A bend of a kerb at a corner.
         */
        CornerPlace: {
            /** @description The arms that it joins. */
            arms: number[];
            /** @description The middle of the bend, metres. */
            at_m: number[];
            /**
             * Format: double
             * @description Its radius, metres: less than requested where arms are too close.
             */
            radius_m: number;
        };
        /**
         * Counts
         * @description Road users by type.
         */
        Counts: {
            /** Format: uint */
            cyclist: number;
            /** Format: uint */
            other: number;
            /** Format: uint */
            pedestrian: number;
            /** Format: uint */
            vehicle: number;
        };
        /**
         * Defaults
         * @description Defaults of a request, shared by the API, the command line and clients.
         */
        Defaults: {
            /**
             * Format: double
             * @description Scale of the draw's noise.
             */
            diversity: number;
            /**
             * Format: double
             * @description Time to generate, seconds.
             */
            horizon_s: number;
            /**
             * Format: uint
             * @description Alternatives kept per road user.
             */
            modes: number;
            /**
             * Format: uint
             * @description Independent joint scenes.
             */
            samples: number;
            /**
             * Format: uint64
             * @description Seed of the random draws; equal seeds give equal answers.
             */
            seed: number;
            /**
             * Format: uint
             * @description Refinement steps.
             */
            steps: number;
        };
        /**
         * Density
         * @description Density: exactly one of `count` and `per_lane_km`.
         */
        Density: {
            /**
             * Format: uint64
             * @description Total number of road users.
             * @default null
             */
            count?: number | null;
            /**
             * Format: double
             * @description Road users per kilometre of lane for motor vehicles in the region, without junctions.
             * @default null
             */
            per_lane_km?: number | null;
        };
        /**
         * Departure
         * @description A road user that left.
         */
        Departure: {
            /** @description The road user. */
            agent: string;
            /** @description Why. */
            reason: components["schemas"]["DepartureWord"];
        };
        /**
         * DepartureWord
         * @description Why a road user left.
         *
         *     `left_the_map`: It left the map.
         *
         *     `arrived`: It reached its goal.
         * @enum {string}
         */
        DepartureWord: "left_the_map" | "arrived";
        /**
         * Distribution
         * @description A number, or the distribution that it is drawn from.
         */
        Distribution: number | {
            /** @description Number of values in a grid, both bounds included. */
            points?: number;
            /** @description Uniform between the least and the greatest value. */
            uniform: number[];
        } | {
            /** @description One of these values; a grid takes all. */
            choice: number[];
        };
        /**
         * DraftEvent
         * @description `initial`: the first guess. `step`: after a refinement step. The futures of a later window begin where it begins.
         */
        DraftEvent: {
            /** @description Futures by road user: only the chosen ones or all, according to `stream_modes`. */
            agents: {
                [key: string]: components["schemas"]["Futures"];
            };
            /**
             * Format: double
             * @description Time since the request was read, milliseconds.
             */
            elapsed_ms: number;
            /**
             * @description Type of the event.
             * @enum {string}
             */
            event: "initial" | "step";
            /** @description Id of the job. */
            job: string;
            /**
             * Format: uint64
             * @description Revision of the request, if it has one.
             */
            revision?: number;
            /**
             * Format: uint
             * @description Joint scene, from 0.
             */
            sample: number;
            /**
             * Format: uint64
             * @description Increases by one per event; a gap marks events that were dropped for a slow reader.
             */
            seq: number;
            /**
             * Format: uint
             * @description Refinement step, from 1; not in `initial`.
             */
            step?: number;
            /**
             * Format: uint
             * @description Refinement steps per window.
             */
            steps: number;
            /**
             * Format: uint
             * @description Planning window, from 0.
             */
            window: number;
        };
        /**
         * Drivable
         * @description A drivable surface.
         */
        Drivable: {
            /**
             * @description Open rings that are not drivable.
             * @default []
             */
            holes_m?: components["schemas"]["Points"][];
            /** @description Id, unique among drivable areas. */
            id: string;
            /** @description Open ring. */
            polygon_m: components["schemas"]["Points"];
        };
        /**
         * DrivingManner
         * @description Acceleration limits of a driving style.
         */
        DrivingManner: {
            /**
             * Format: double
             * @description Greatest acceleration.
             */
            accel_mps2: number;
            /**
             * Format: double
             * @description Greatest braking, positive.
             */
            brake_mps2: number;
            /**
             * Format: double
             * @description Greatest sideways acceleration v^2 k.
             */
            lateral_mps2: number;
        };
        /**
         * DuplicateRequest
         * @description Name of the copy.
         */
        DuplicateRequest: {
            /**
             * @description Name of the copy. Default: the original's, with "copy" after it.
             * @default null
             */
            name?: string | null;
        };
        /**
         * Ego
         * @description State and plan of an ego at the end of a step.
         */
        Ego: {
            /**
             * Format: double
             * @description Radians.
             */
            heading_rad: number;
            /** @description One of the run's egos. */
            id: string;
            /**
             * @description Announced motion: at most 90 states, the first 0.1 s after the step's end. Without a plan, the others expect
             *     it to continue along its lane.
             * @default {
             *       "heading_rad": [],
             *       "vx_mps": [],
             *       "vy_mps": [],
             *       "x_m": [],
             *       "y_m": []
             *     }
             */
            plan?: components["schemas"]["Motion"];
            /**
             * Format: double
             * @description Velocity of the box centre, m/s.
             */
            vx_mps: number;
            /**
             * Format: double
             * @description Velocity of the box centre, m/s.
             */
            vy_mps: number;
            /**
             * Format: double
             * @description Box centre, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Box centre, metres.
             */
            y_m: number;
        };
        /**
         * Encounter
         * @description A pair with a collision, an overlap or a near miss, and its surrogate safety measures.
         */
        Encounter: {
            /** @description The road user listed first. */
            a: string;
            /** @description The other. */
            b: string;
            /**
             * Format: double
             * @description Greatest deceleration to avoid the collision, m/s2.
             */
            drac_mps2: number | null;
            /**
             * Format: double
             * @description Least gap, metres; below zero the boxes overlap.
             */
            gap_m: number | null;
            /**
             * Format: double
             * @description Least headway of the follower, seconds: gap divided by its speed.
             */
            headway_s: number | null;
            /** @description As in the list of its kind. */
            in_log: boolean;
            /** @description Kind of the event. */
            kind: components["schemas"]["EncounterKind"];
            /** @description The worst values of the recording over the scored time; null without a recording of both. */
            log: components["schemas"]["Measures"] | null;
            /**
             * Format: double
             * @description Post-encroachment time of the whole motions, seconds.
             */
            pet_s: number | null;
            /**
             * Format: double
             * @description Scene time of the event, seconds.
             */
            time_s: number;
            /**
             * Format: double
             * @description Least time to collision if both keep speed and turn rate, seconds; zero once their boxes overlap at a step.
             */
            ttc_s: number | null;
            /**
             * Format: double
             * @description Midpoint between the two at that time, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Midpoint between the two at that time, metres.
             */
            y_m: number;
        };
        /**
         * EncounterKind
         * @description Kind of an encounter.
         *
         *     `collision`: In the list of collisions.
         *
         *     `overlap`: In the list of overlaps.
         *
         *     `near_miss`: In the list of near misses.
         * @enum {string}
         */
        EncounterKind: "collision" | "overlap" | "near_miss";
        /**
         * Endpoint
         * @description The step that counts as the end of a future.
         *
         *     `last`: The last one.
         *
         *     `before_last`: The one before: the goal position was given, so the last step carries no information (the paper's
         *     rule).
         * @enum {string}
         */
        Endpoint: "last" | "before_last";
        /**
         * ErrorEvent
         * @description Last event of a call that failed or was cancelled.
         */
        ErrorEvent: {
            /**
             * Format: double
             * @description Time since the request was read, milliseconds.
             */
            elapsed_ms: number;
            /**
             * @description Type of the event.
             * @constant
             */
            event: "error";
            /** @description Id of the job. */
            job: string;
            /** @description The problem, as a refusal before the stream returns it. */
            problem: components["schemas"]["Problem"];
            /**
             * Format: uint64
             * @description Revision of the request, if it has one.
             */
            revision?: number;
            /**
             * Format: uint64
             * @description Increases by one per event; a gap marks events that were dropped for a slow reader.
             */
            seq: number;
        };
        /**
         * Event
         * @description One event of the stream. Exactly one of final, error and superseded ends it.
         */
        Event: components["schemas"]["AcceptedEvent"] | components["schemas"]["DraftEvent"] | components["schemas"]["FinalEvent"] | components["schemas"]["ErrorEvent"] | components["schemas"]["SupersededEvent"] | components["schemas"]["HeartbeatEvent"];
        /**
         * Fault
         * @description A fault of a motion.
         */
        Fault: {
            /** @description The road edge that is driven over, by its id in the map. */
            edge?: string | null;
            /**
             * Format: double
             * @description Extent, in the unit of its kind.
             */
            extent?: number | null;
            /** @description Kind of the fault. */
            kind: components["schemas"]["FaultKind"];
            /**
             * Format: double
             * @description Scene time at which it begins, seconds.
             */
            time_s: number;
            /**
             * Format: double
             * @description Scene time at which it ends, seconds.
             */
            until_s: number;
            /** @description The other road user. */
            with?: string | null;
            /**
             * Format: double
             * @description Box centre where it is worst, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Box centre where it is worst, metres.
             */
            y_m: number;
        };
        /**
         * FaultKind
         * @description Kind of a fault, the worst first.
         *
         *     `collision`: Its box overlaps another's; `extent` is the closing speed, m/s.
         *
         *     `red_light`: A stop line is crossed at red; `extent` is the speed, m/s.
         *
         *     `wrong_way`: Against the direction of every lane there; `extent` is the distance driven, metres.
         *
         *     `over_median`: Over the median between two directions; `extent` is the distance past the edge, metres.
         *
         *     `off_road`: Over a kerb or off the road; `extent` is the distance past the edge, metres.
         *
         *     `off_map`: Beyond the end of the map's roads; `extent` is the distance from the lanes, metres.
         *
         *     `on_carriageway`: On foot along a lane, or across lanes beside a crosswalk; `extent` is the distance walked, metres.
         *
         *     `speeding`: Above the speed limit; `extent` is the excess, m/s.
         *
         *     `harsh_braking`: Hard braking; `extent` is the deceleration, m/s2.
         *
         *     `harsh_steering`: Hard steering; `extent` is the sideways acceleration, m/s2.
         *
         *     `running`: A pedestrian runs; `extent` is the speed, m/s.
         *
         *     `askew`: Ends at an angle to its lane; `extent` is the angle, radians.
         *
         *     `fails_to_yield`: A pedestrian waits at a crosswalk that this one drives over; `extent` is the pedestrian's delay, seconds.
         *
         *     `forces_braking`: Another road user has to brake hard; `extent` is its deceleration, m/s2.
         *
         *     `near_miss`: Near miss with another road user; `extent` is the gap, metres.
         *
         *     `via_missed`: A via point is passed too far away, or not at its time; `extent` is the least distance to it, metres.
         *
         *     `goal_missed`: The goal is not met; `extent` is the remaining distance, metres.
         * @enum {string}
         */
        FaultKind: "collision" | "red_light" | "wrong_way" | "over_median" | "off_road" | "off_map" | "on_carriageway" | "speeding" | "harsh_braking" | "harsh_steering" | "running" | "askew" | "fails_to_yield" | "forces_braking" | "near_miss" | "via_missed" | "goal_missed";
        /**
         * Features
         * @description The traits of a motion of one road user, or of several together.
         */
        Features: {
            /** @description By road user and other: whether it goes first where their paths cross. */
            first?: {
                [key: string]: {
                    [key: string]: boolean;
                };
            };
            /**
             * Format: double
             * @description Mean distance from the recording, metres; for several road users the mean. Absent without a recording.
             */
            from_log_m?: number | null;
            /**
             * Format: double
             * @description Least time between it and another where their paths cross, seconds, at most 5; for several road users
             *     the least.
             */
            gap_s: number;
            /**
             * Format: double
             * @description Greatest change of velocity over half a second, m/s2; for several road users the greatest.
             */
            harshness_mps2: number;
            /** @description Manoeuvre by road user. */
            manoeuvres?: {
                [key: string]: components["schemas"]["Manoeuvre"];
            };
            /**
             * Format: double
             * @description Mean speed, m/s; for several road users the mean.
             */
            pace_mps: number;
            /**
             * Format: double
             * @description Time at standstill, seconds; for several road users the mean.
             */
            standing_s: number;
        };
        /**
         * Feedback
         * @description Rounds of cards: the reply is the next round, chosen from a wide draw by the verdicts on earlier cards. `feedback`
         *     of the reply has the features of each card; the client returns them with its verdict.
         */
        Feedback: {
            /**
             * @description Judged cards in the order of the rounds, without cards that were neither kept nor rejected.
             * @default []
             */
            answers?: components["schemas"]["Answer"][];
            /**
             * @description Traits to ignore, whatever the verdicts are.
             * @default []
             */
            forgotten?: components["schemas"]["Trait"][];
            /**
             * @description Preferences that the user stated.
             * @default []
             */
            wishes?: components["schemas"]["Wish"][];
        };
        /**
         * Field
         * @description A value and its source.
         */
        Field: {
            /** @description Origin. */
            from: components["schemas"]["Source"];
            /**
             * Format: double
             * @description Value, in the unit of the field's name.
             */
            value: number;
        };
        /**
         * FieldProblem
         * @description A fault of a request and its place.
         */
        FieldProblem: {
            /** @description Code for programs. */
            code: string;
            /** @description Value found and value expected, in English. */
            detail: string;
            /**
             * Format: double
             * @description The value found, if it is a number.
             */
            got?: number;
            /**
             * Format: double
             * @description Greatest allowed value, if it is exceeded.
             */
            max?: number;
            /** @description The fault as data; faults outside of bodies and files may have none. */
            message?: components["schemas"]["Message"];
            /**
             * Format: double
             * @description Least allowed value, if it is not reached.
             */
            min?: number;
            /** @description JSON pointer into the body, empty for the whole of it; /query/NAME for a parameter. */
            pointer: string;
        };
        /**
         * FinalEvent
         * @description Last event of a call that succeeded: the answer.
         */
        FinalEvent: {
            /**
             * @description Whether the probabilities of the futures are calibrated. If not, they are relative weights, of which only
             *     the order counts. docs/results.md has their log loss.
             */
            calibrated: boolean;
            /**
             * @description Result code, six characters. It identifies the inputs of the answer: the scene with its conditions and the
             *     futures it keeps, options, seed, weights and version. Identical calls have identical codes.
             */
            code: string;
            /**
             * Format: double
             * @description Time since the request was read, milliseconds.
             */
            elapsed_ms: number;
            /**
             * @description Type of the event.
             * @constant
             */
            event: "final";
            /** @description Of a round: the features of its cards, and the learned wishes. */
            feedback?: components["schemas"]["Round"];
            /**
             * @description The scene's `generated` member without `samples`. To save the answer, insert `samples` (those in
             *     compact form as columns).
             */
            generated: components["schemas"]["GeneratedHead"];
            /** @description Id of the job. */
            job: string;
            /** @description All condition fields as they were used. */
            resolved: {
                [key: string]: components["schemas"]["Resolved"];
            };
            /**
             * Format: uint64
             * @description Revision of the request, if it has one.
             */
            revision?: number;
            /**
             * @description Joint scenes. They include road users outside the call with the future that the scene keeps, unless
             *     `kept_futures` excludes them.
             */
            samples: components["schemas"]["AnswerSample"][];
            /** @description One report per sample, or null without `score`. */
            scores: components["schemas"]["ScoreReply"][] | null;
            /**
             * Format: uint64
             * @description Increases by one per event; a gap marks events that were dropped for a slow reader.
             */
            seq: number;
            /** @description Durations of the stages. */
            timing: components["schemas"]["Timing"];
            /** @description Warnings: unlikely requests that were carried out. */
            warnings: components["schemas"]["Warning"][];
            /**
             * Format: uint
             * @description Number of planning windows. A chosen future covers all of them; its alternatives are those of the
             *     first window and end with the plan of that window.
             */
            windows: number;
        };
        /**
         * FormatInfo
         * @description Description of a format for clients.
         */
        FormatInfo: {
            /** @description Whether it can be written. */
            export: boolean;
            /** @description File extensions, the first one for exports. */
            extensions: string[];
            /** @description Id for `--from`, `--to` and `?format=`. */
            id: string;
            /** @description Whether it can be read. */
            import: boolean;
            /**
             * @description Codes of the losses that a written file may have ([`crate::loss::code`]). Each export reports its
             *     losses.
             */
            loses: string[];
            /** @description Whether one file holds many scenes. */
            many: boolean;
            /** @description Media type of an exported file. */
            media_type: string;
            /** @description Display name. */
            name: string;
            /** @description Description of the content of a file, and of reading and writing it. */
            notes: string;
            /** @description Whether it may come with its road network ([`ImportOptions::net`]). */
            takes_net: boolean;
        };
        /**
         * Future
         * @description One possible motion as columns, one value per step from `first_step`, without gaps. Rounded to 0.001 m,
         *     0.0001 rad and 0.001 m/s.
         */
        Future: {
            /**
             * Format: uint32
             * @description Index of the generator's anchor that it follows. While a goal is dragged, an equal index means the
             *     same plan.
             */
            anchor?: number | null;
            /** @description Faults, the worst first. */
            faults?: components["schemas"]["Fault"][];
            /**
             * Format: uint64
             * @description Scene step of the first value: one after the start.
             */
            first_step: number;
            /** @description Radians. */
            heading_rad: number[];
            /** @description Manoeuvre. */
            manoeuvre?: components["schemas"]["Manoeuvre"] | null;
            /**
             * Format: double
             * @description Probability among the road user's futures.
             */
            probability: number;
            /** @description Relations to other road users. */
            relations?: components["schemas"]["Relation"][];
            /** @description m/s. */
            vx_mps: number[];
            /** @description m/s. */
            vy_mps: number[];
            /** @description Box centre, metres. */
            x_m: number[];
            /** @description Box centre, metres. */
            y_m: number[];
        };
        /**
         * Futures
         * @description The futures of one road user in a reply, in the form that `futures` of the request names.
         */
        Futures: components["schemas"]["AgentFutures"] | components["schemas"]["CompactFutures"];
        /**
         * FuturesForm
         * @description Form of the futures in a reply.
         *
         *     `columns`: As in a scene document.
         *
         *     `compact`: The same numbers in about half the bytes.
         * @enum {string}
         */
        FuturesForm: "columns" | "compact";
        /**
         * GenerateRequest
         * @description Body of a generation. Exactly one of `scene` and `scene_id` is given.
         */
        GenerateRequest: {
            /**
             * @description Road users added for this call.
             * @default []
             */
            add_agents?: components["schemas"]["Agent"][];
            /**
             * @description Road users to regenerate. When absent: those whose `conditions` have a goal or via points, or all when no road
             *     user has any. An empty list needs `react` and regenerates no road user: those of `react` keep their known
             *     motion, and where it ends before the last window (`horizon_s` above 9, or `replan_interval_s`), they plan on
             *     from there. Without such a road user the answer has no futures, and the warning `nothing-generated`.
             */
            agents?: components["schemas"]["Who"];
            /**
             * @description A background call: calls without this flag go first, in the queue and on the cores.
             * @default false
             */
            background?: boolean;
            /**
             * @description With `revision`: a newer revision of this client replaces the running one.
             * @default null
             */
            client?: string | null;
            /**
             * @description Conditions that replace all those of the scene for these road users. Type and size always apply. A start, goal
             *     or via point is refused (`not-asked`) where it would change no motion: the road user is not in `agents`, the
             *     scene keeps no future of it, and its own conditions are others.
             * @default {}
             */
            conditions?: {
                [key: string]: components["schemas"]["Conditions"];
            };
            /**
             * Format: double
             * @description Scale of the noise, which makes seeds differ; 0 gives the most probable answer for every seed.
             * @default 0.5
             */
            diversity?: number;
            /**
             * Format: uint64
             * @description Time from the start of the work before which drafts are left out, `initial` included, milliseconds; 0
             *     leaves out none. `accepted` waits as long for the first draft or the answer: an early answer comes together
             *     with it.
             * @default 0
             */
            draft_delay_ms?: number;
            /**
             * Format: uint64
             * @description Minimum time between two drafts, milliseconds: an earlier `step` event is left out; 0 sends all. A page at
             *     60 frames per second shows at most one draft in 16 ms.
             * @default 0
             */
            draft_interval_ms?: number;
            /**
             * @description With `scene_id`: the call is refused if the scene has changed.
             * @default null
             */
            etag?: string | null;
            /**
             * @description Requests a round of cards, chosen by the verdicts on earlier cards; `{}` requests the first round. For one road
             *     user without reactions each future is a card, else each sample. `modes` is the number of cards; `samples` has
             *     no effect.
             * @default null
             */
            feedback?: components["schemas"]["Feedback"] | null;
            /** @description Form of the futures, in drafts and in `final`. */
            futures?: components["schemas"]["FuturesForm"];
            /**
             * @description With `scene`: the server holds it in memory. Later calls use the name in the reply's header `Dragtraffic-Scene`
             *     as their `scene_id`. The server drops scenes that were not used for a long time (`not-found`).
             * @default false
             */
            hold?: boolean;
            /**
             * Format: double
             * @description Time to generate, seconds. Beyond 9 s it is planned window by window.
             * @default 9
             */
            horizon_s?: number;
            /**
             * @description The client's id of the job, which can cancel it.
             * @default null
             */
            job?: string | null;
            /**
             * @description Use of the futures of earlier calls, for road users that are not generated in this one.
             * @default answered
             */
            kept_futures?: components["schemas"]["KeptFutures"];
            /**
             * Format: uint64
             * @description Futures kept per road user.
             * @default 6
             */
            modes?: number;
            /**
             * @description Road users that continue with the chosen future that the scene keeps for them: it counts as requested, and
             *     other road users react to it.
             * @default []
             */
            pinned?: string[];
            /**
             * @description Road users that may react to them.
             * @default false
             */
            react?: components["schemas"]["Reacting"];
            /**
             * @description Road users removed for this call.
             * @default []
             */
            remove_agents?: string[];
            /**
             * Format: double
             * @description Replan interval, seconds: 3, 6 or 9; null is 9. Each plan starts from the states reached.
             * @default null
             */
            replan_interval_s?: number | null;
            /**
             * Format: uint64
             * @description Increases with each request of `client`.
             * @default null
             */
            revision?: number | null;
            /**
             * Format: uint64
             * @description Joint samples.
             * @default 1
             */
            samples?: number;
            /**
             * @description The scene itself; its map may be `{"ref":"sha256:HEX"}`.
             * @default null
             */
            scene?: components["schemas"]["Scene"] | null;
            /**
             * @description A scene of this server.
             * @default null
             */
            scene_id?: string | null;
            /**
             * @description Whether `final` has scores.
             * @default true
             */
            score?: boolean;
            /**
             * Format: uint64
             * @description Seed of the random draws; equal seeds give equal answers.
             * @default 0
             */
            seed?: number;
            /**
             * @description The futures shown last for these road users during a drag: each is kept unless another is better by the cost of
             *     `switching`.
             */
            shown?: {
                [key: string]: components["schemas"]["Shown"];
            };
            /**
             * Format: double
             * @description Scene time of the start, seconds.
             * @default 0
             */
            start_s?: number;
            /**
             * Format: uint64
             * @description Refinement steps; 0 returns the first draft.
             * @default 5
             */
            steps?: number;
            /**
             * @description Futures in drafts.
             * @default chosen
             */
            stream_modes?: components["schemas"]["StreamModes"];
            /**
             * @description Thresholds of near misses, harsh braking and the like, in `faults` and `scores`; absent ones have their
             *     defaults. They change no motion.
             * @default {
             *       "along_lane_m": 3,
             *       "askew_rad": 0.26,
             *       "closing_speed_mps": 1,
             *       "covered_share": 0.5,
             *       "crosswalk_m": 15,
             *       "follow_brake_mps2": 3.35,
             *       "forced_brake_mps2": 3,
             *       "gap_m": 1,
             *       "goal_heading_rad": 0.02,
             *       "goal_position_m": 0.05,
             *       "goal_speed_mps": 0.05,
             *       "harsh_brake_mps2": 4,
             *       "harsh_lateral_mps2": 4,
             *       "iou": 0,
             *       "moving_mps": 0.5,
             *       "off_map_m": 5,
             *       "offroad_m": 0.1,
             *       "pass_gap_m": 0.4,
             *       "pass_mps": 3,
             *       "right_on_red": true,
             *       "running_mps": 2.5,
             *       "speeding_mps": 1.4,
             *       "speeding_share": 0.1,
             *       "ttc_s": 1.5
             *     }
             */
            thresholds?: components["schemas"]["Thresholds"];
        } & ({
            scene: unknown;
        } | {
            scene_id: unknown;
        });
        /**
         * Generated
         * @description Futures that the generator added to a scene.
         */
        Generated: {
            /**
             * Format: uint64
             * @description Index into `samples`.
             * @default 0
             */
            chosen_sample?: number;
            /** @description RFC 3339 time; absent where equal calls must give equal files. */
            created_at?: string;
            /** @description Hash of the user's part of the scene, from which the futures were generated. */
            input_sha256: string;
            /** @description Licence of the answer if it is stricter than that of the scene: the licence of the weights. */
            licence?: string | null;
            /**
             * @description The request's options as sent.
             * @default null
             */
            request?: unknown;
            /** @description Independent answers. */
            samples: components["schemas"]["Sample"][];
            /**
             * Format: uint64
             * @description Seed that repeats the answer, 0 to 2^53 - 1.
             * @default 0
             */
            seed?: number;
            /**
             * @description Whether the user's part has changed since.
             * @default false
             */
            stale?: boolean;
            /**
             * @description Hash of the weights by expert.
             * @default {}
             */
            weights?: {
                [key: string]: string;
            };
        };
        /**
         * GeneratedHead
         * @description The members of `generated` that do not come from the generator.
         */
        GeneratedHead: {
            /**
             * Format: uint
             * @description Index into `samples`.
             */
            chosen_sample: number;
            /** @description RFC 3339 time. */
            created_at: string;
            /** @description Hash of the user's part of the scene, from which the futures were generated. */
            input_sha256: string;
            /** @description Licence of the answer if it is stricter than that of the scene: the licence of the weights. */
            licence?: string | null;
            /** @description The request's options as sent, without scene and conditions. */
            request: unknown;
            /**
             * Format: uint64
             * @description Seed that repeats the answer.
             */
            seed: number;
            /** @description Whether the user's part has changed since. */
            stale: boolean;
            /** @description Hash of the weights by expert. */
            weights: {
                [key: string]: string;
            };
        };
        /**
         * Goal
         * @description Position and state that a road user should have at `time_s`; absent or null is free.
         */
        Goal: {
            /**
             * Format: double
             * @description Frame `agent`: metres along the start's heading; with `left_m` or not at all.
             */
            ahead_m?: number | null;
            /**
             * Format: double
             * @description Heading, radians, wrapped when read; a request may have at most a full turn either way, 6.2832.
             */
            heading_rad?: number | null;
            /**
             * Format: double
             * @description Frame `agent`: metres to the left of the start's heading; with `ahead_m` or not at all.
             */
            left_m?: number | null;
            /**
             * @description Ids of road edges of the map, such as those of a median, that the road user may drive over, without a fault
             *     and without a detour.
             */
            may_cross?: string[];
            /**
             * @description Road user that the goal is relative to. The relation replaces position, heading and, where none is fixed,
             *     speed; with `after_s` it replaces the time.
             */
            relation?: components["schemas"]["GoalRelation"] | null;
            /**
             * Format: double
             * @description m/s.
             */
            speed_mps?: number | null;
            /**
             * Format: double
             * @description Scene time, seconds; the end of the window when free. Snapped to 0.1.
             */
            time_s?: number | null;
            /**
             * Format: double
             * @description Frame `agent`: radians from the start's heading, wrapped when read; a request may have at most a full
             *     turn either way, 6.2832.
             */
            turn_rad?: number | null;
            /** @description Velocity in place of `speed_mps`; it also fixes a free heading. */
            velocity?: components["schemas"]["Velocity"] | null;
            /**
             * Format: double
             * @description Box centre, metres; with `y_m` or not at all.
             */
            x_m?: number | null;
            /**
             * Format: double
             * @description Box centre, metres; with `x_m` or not at all.
             */
            y_m?: number | null;
        } & (unknown & unknown & unknown & unknown);
        /**
         * GoalError
         * @description Error at the goal time; a member is null where its field was free.
         */
        GoalError: {
            /**
             * Format: double
             * @description Absolute turn from the goal heading, radians.
             */
            heading_rad: number | null;
            /**
             * Format: double
             * @description Distance from the goal, metres.
             */
            position_m: number | null;
            /**
             * Format: double
             * @description Absolute difference from the goal speed, m/s.
             */
            speed_mps: number | null;
        };
        /**
         * GoalRanges
         * @description Fields of a goal; absent ones are free.
         */
        GoalRanges: {
            /** @description Metres along the heading of the start, or of the recorded goal. */
            ahead_m?: components["schemas"]["Distribution"] | null;
            /** @description Heading in the frame of the scene, radians. */
            heading_rad?: components["schemas"]["Distribution"] | null;
            /** @description With `recorded`: seconds after the recorded time; negative is earlier. */
            later_s?: components["schemas"]["Distribution"] | null;
            /** @description Metres to the left of this heading; 0 with `ahead_m` alone. */
            left_m?: components["schemas"]["Distribution"] | null;
            /**
             * @description The goal is the recorded state of the road user at `time_s`; `ahead_m`, `left_m` and `turn_rad` are
             *     relative to it instead of the start. Default: false.
             */
            recorded?: boolean;
            /** @description Road user that the goal is relative to. */
            relation?: components["schemas"]["GoalRelationRanges"] | null;
            /** @description Metres per second. */
            speed_mps?: components["schemas"]["Distribution"] | null;
            /** @description With `recorded`: multiple of the recorded speed, in place of `speed_mps`. */
            speed_times?: components["schemas"]["Distribution"] | null;
            /** @description Scene time, seconds; the end of the horizon when free. */
            time_s?: components["schemas"]["Distribution"] | null;
            /** @description Radians from this heading. */
            turn_rad?: components["schemas"]["Distribution"] | null;
            /** @description Box centre in the frame of the scene, metres; with `y_m`. */
            x_m?: components["schemas"]["Distribution"] | null;
            /** @description Box centre in the frame of the scene, metres; with `x_m`. */
            y_m?: components["schemas"]["Distribution"] | null;
        };
        /**
         * GoalRelation
         * @description A goal relative to another road user: exactly one of `ahead_m`, `behind_m`, `behind_s` and `after_s`. It follows the
         *     motion of the other one: its future of the same call if it is generated too, else the motion that it keeps.
         */
        GoalRelation: {
            /**
             * Format: double
             * @description Seconds from the moment when the other one is nearest to the goal's position until the goal is
             *     reached; negative is before.
             */
            after_s?: number | null;
            /**
             * Format: double
             * @description Gap from the front of the other one to the rear of this road user, along the lanes, metres.
             */
            ahead_m?: number | null;
            /**
             * Format: double
             * @description Gap from the front of this road user to the rear of the other one, along the lanes, metres.
             */
            behind_m?: number | null;
            /**
             * Format: double
             * @description The same gap in seconds at the speed of the goal.
             */
            behind_s?: number | null;
            /**
             * Format: int32
             * @description Number of lanes to the left of the other one's lane, in its direction; negative is to the right. Not with
             *     `after_s`; 0 when free.
             */
            lanes_left?: number | null;
            /**
             * Format: double
             * @description Speed difference to the other one, m/s: positive is slower, negative is faster. Not with `after_s`; 0
             *     when free.
             */
            slower_mps?: number | null;
            /** @description Id of the other road user. Relations form no cycle, and no chain of more than four. */
            to: string;
        } & ({
            ahead_m: number;
        } | {
            behind_m: number;
        } | {
            behind_s: number;
        } | {
            after_s: number;
        });
        /**
         * GoalRelationRanges
         * @description A goal relative to another road user: exactly one of `ahead_m`, `behind_m`, `behind_s` and `after_s`.
         */
        GoalRelationRanges: {
            /**
             * @description Seconds from the moment when the other one is nearest to the goal's position until the goal is
             *     reached.
             */
            after_s?: components["schemas"]["Distribution"] | null;
            /** @description Gap from the front of the other one to the rear of this road user, metres. */
            ahead_m?: components["schemas"]["Distribution"] | null;
            /** @description Gap from the front of this road user to the rear of the other one, metres. */
            behind_m?: components["schemas"]["Distribution"] | null;
            /** @description The same gap in seconds at the speed of the goal. */
            behind_s?: components["schemas"]["Distribution"] | null;
            /** @description Number of lanes to the left of the other one's lane, a whole number; negative is to the right. */
            lanes_left?: components["schemas"]["Distribution"] | null;
            /** @description Speed difference to the other one, m/s: positive is slower, negative is faster. */
            slower_mps?: components["schemas"]["Distribution"] | null;
            /** @description Id of the other road user. */
            to: string;
        };
        /**
         * Health
         * @description Health of the server.
         */
        Health: {
            status: components["schemas"]["HealthStatus"];
        };
        /**
         * HealthStatus
         * @description Health of the server in one word, for its operators.
         *
         *     `ok`: The process answers.
         *
         *     `ready`: It accepts work.
         * @enum {string}
         */
        HealthStatus: "ok" | "ready";
        /**
         * HeartbeatEvent
         * @description Keep-alive between events, only in NDJSON; SSE uses comments.
         */
        HeartbeatEvent: {
            /** @constant */
            event: "heartbeat";
        };
        /**
         * ImportReply
         * @description Result of importing a file.
         */
        ImportReply: {
            /** @description Id of the format. */
            format: string;
            /** @description Scenes in the order of the file. */
            scenes: components["schemas"]["ImportedScene"][];
            /** @description Records that are not scenes. */
            skipped: components["schemas"]["SkippedRecord"][];
        };
        /**
         * ImportWarning
         * @description A change or an omission by a reader that accepted the file.
         */
        ImportWarning: {
            /** @description Kind of the change, a code for programs. */
            code: string;
            /** @description The change in English. */
            detail: string;
            /** @description The change as data. */
            message: components["schemas"]["Message"];
        };
        /**
         * ImportedBody
         * @description Result of importing a file, or of each of several.
         */
        ImportedBody: components["schemas"]["ImportReply"] | components["schemas"]["ImportedFiles"];
        /**
         * ImportedFile
         * @description One of several files, with its result or its problem.
         */
        ImportedFile: {
            /** @description Id of the format. */
            format?: string;
            /** @description Name of the file in the form. */
            name?: string;
            /** @description Problem for which nothing was imported. */
            problem?: components["schemas"]["Problem"];
            /** @description Scenes in the order of the file. */
            scenes?: components["schemas"]["ImportedScene"][];
            /** @description Records that are not scenes. */
            skipped?: components["schemas"]["SkippedRecord"][];
        };
        /**
         * ImportedFiles
         * @description Results of importing several files.
         */
        ImportedFiles: {
            /** @description Results in the order of the form. */
            files: components["schemas"]["ImportedFile"][];
        };
        /**
         * ImportedScene
         * @description One scene of a file.
         */
        ImportedScene: {
            /** @description Road users by type. */
            counts: components["schemas"]["Counts"];
            /** @description As in the ETag header; not in a dry run. */
            etag?: string;
            /** @description Id under which it is stored; not in a dry run. */
            id?: string;
            /** @description Display name. */
            name: string;
            /** @description The scene itself, only in a dry run. */
            scene?: components["schemas"]["Scene"];
            /**
             * Format: uint
             * @description Number of steps of 0.1 s.
             */
            steps: number;
            /** @description Changes and omissions of the reader. */
            warnings: components["schemas"]["ImportWarning"][];
        };
        /**
         * Info
         * @description Description of the server.
         */
        Info: {
            build: components["schemas"]["Build"];
            /** @description Ranges of conditions. */
            condition_ranges: components["schemas"]["ConditionRanges"];
            /** @description Defaults of a generation. */
            defaults: components["schemas"]["Defaults"];
            /** @description Device that computes the networks. */
            device: string;
            /** @description Formats of files. */
            formats: components["schemas"]["FormatInfo"][];
            /** @description Limits of the server and of the scene format, by name. */
            limits: {
                [key: string]: components["schemas"]["Bound"];
            };
            /** @description Motion limits of each kind of road user. */
            motion_limits: components["schemas"]["KindLimits"];
            /** @description Name of the program. */
            name: string;
            /** @description Notices for the operators of the server. */
            notices: string[];
            /** @description Weights of placement; null when road users are placed evenly along lanes. */
            placement: components["schemas"]["PlacementInfo"] | null;
            /** @description Version of the program. */
            version: string;
            /** @description Versions of the interfaces. */
            versions: components["schemas"]["InterfaceVersions"];
            /** @description Experts by name. */
            weights: {
                [key: string]: components["schemas"]["WeightsInfo"];
            };
        };
        /**
         * InterfaceVersions
         * @description Versions of the interfaces: each changes only when older programs or files need a change.
         */
        InterfaceVersions: {
            /**
             * Format: uint64
             * @description The API, the first part of its addresses: `/v1`.
             */
            api: number;
            /**
             * Format: uint64
             * @description The scene document.
             */
            scene: number;
            /**
             * Format: uint64
             * @description The file of saved scenes; absent in a program without one.
             */
            store?: number | null;
        };
        /**
         * Intermediate
         * @description The target of a planning window for a road user whose goal is due after the window's end. It lies on the
         *     way to the goal at constant acceleration, along the lanes where they lead to it, else straight.
         */
        Intermediate: {
            /** Format: double */
            heading_rad: number;
            /** @description Whether the plan reaches it. */
            reached: boolean;
            /** Format: double */
            speed_mps: number;
            /**
             * Format: double
             * @description Scene time of the target, seconds: the end of the window's plan.
             */
            time_s: number;
            /**
             * Format: uint
             * @description Planning window, from 0.
             */
            window: number;
            /** Format: double */
            x_m: number;
            /** Format: double */
            y_m: number;
        };
        /**
         * Junction
         * @description Roads that meet at grade.
         */
        Junction: {
            /**
             * @description 3 to 6 arms, at least 20 degrees apart.
             * @default [
             *       {
             *         "angle_deg": 3,
             *         "crosswalk_m": 3,
             *         "cycle_lane_m": 1.8,
             *         "lanes_in": 2,
             *         "lanes_out": 2,
             *         "length_m": 90,
             *         "main": true,
             *         "median_m": 0,
             *         "speed_limit_kmh": 50,
             *         "turns": null
             *       },
             *       {
             *         "angle_deg": 92,
             *         "crosswalk_m": 3,
             *         "cycle_lane_m": 0,
             *         "lanes_in": 2,
             *         "lanes_out": 1,
             *         "length_m": 90,
             *         "main": false,
             *         "median_m": 0,
             *         "speed_limit_kmh": 50,
             *         "turns": null
             *       },
             *       {
             *         "angle_deg": 182,
             *         "crosswalk_m": 3,
             *         "cycle_lane_m": 1.8,
             *         "lanes_in": 2,
             *         "lanes_out": 2,
             *         "length_m": 90,
             *         "main": true,
             *         "median_m": 0,
             *         "speed_limit_kmh": 50,
             *         "turns": null
             *       },
             *       {
             *         "angle_deg": 272,
             *         "crosswalk_m": 3,
             *         "cycle_lane_m": 0,
             *         "lanes_in": 1,
             *         "lanes_out": 1,
             *         "length_m": 90,
             *         "main": false,
             *         "median_m": 0,
             *         "speed_limit_kmh": 50,
             *         "turns": null
             *       }
             *     ]
             */
            arms: components["schemas"]["Arm"][];
            /** @description Single connections through the junction, in addition to those of the turn lanes. */
            connections?: components["schemas"]["Connections"];
            /**
             * @description Right of way at the junction.
             * @default signals
             */
            control: components["schemas"]["Control"];
            /**
             * Format: double
             * @description Radius of the kerbs at corners, metres; less where arms are too close for it.
             * @default 8
             */
            kerb_radius_m: number;
            /**
             * Format: double
             * @description Width of lanes, metres.
             * @default 3.25
             */
            lane_width_m: number;
            /**
             * @description Signal program, with `signals`.
             * @default {
             *       "all_red_s": 1,
             *       "green_s": 10,
             *       "offset_s": 7,
             *       "turns_across": "permissive",
             *       "yellow_s": 3
             *     }
             */
            program: components["schemas"]["Program"];
            /**
             * Format: double
             * @description Width of the pavements, metres; below half a metre there are none.
             * @default 2.5
             */
            sidewalk_m: number;
            /**
             * @description Side of the road on which traffic drives.
             * @default right-hand
             */
            traffic: components["schemas"]["Traffic"];
        };
        /**
         * JunctionPath
         * @description A drawn path through a junction.
         */
        JunctionPath: {
            /** @description Whether it was added to those of the turn lanes. */
            added: boolean;
            /** @description Inbound lane, such as `arm2.in1`: the lane of the second arm next to the middle of the road. */
            from: string;
            /** @description Id of its lane in the map. */
            lane: string;
            /** @description Outbound lane, such as `arm3.out1`. */
            to: string;
            /** @description The direction, as seen from the entry. */
            turn: components["schemas"]["Turn"];
        };
        /**
         * KeptFutures
         * @description Use of the futures of earlier calls, for road users that are not generated in this one.
         *
         *     `answered`: The plans take them into account, and the answer contains them beside the new ones: its samples are of
         *     the whole scene.
         *
         *     `omitted`: The plans take them into account, and the answer leaves them out, for a client that has them.
         *
         *     `forgotten`: They are removed before planning: their road users follow the recording again.
         * @enum {string}
         */
        KeptFutures: "answered" | "omitted" | "forgotten";
        /**
         * KindLimits
         * @description Motion limits by kind of road user, for the usual size of each kind.
         */
        KindLimits: {
            bus: components["schemas"]["MotionLimits"];
            car: components["schemas"]["MotionLimits"];
            cyclist: components["schemas"]["MotionLimits"];
            motorcycle: components["schemas"]["MotionLimits"];
            other: components["schemas"]["MotionLimits"];
            pedestrian: components["schemas"]["MotionLimits"];
            trailer: components["schemas"]["MotionLimits"];
            truck: components["schemas"]["MotionLimits"];
        };
        /**
         * Kinematic
         * @description Greatest values of a motion.
         */
        Kinematic: {
            /**
             * Format: double
             * @description Greatest acceleration, m/s2.
             */
            accel_mps2: number;
            /**
             * Format: double
             * @description Greatest braking, m/s2, positive.
             */
            brake_mps2: number;
            /**
             * Format: double
             * @description Greatest curvature above 1 m/s, 1/m; none for pedestrians.
             */
            curvature_per_m: number | null;
            /**
             * Format: double
             * @description Greatest jerk along the path, m/s3; none for pedestrians.
             */
            jerk_mps3: number | null;
            /**
             * Format: double
             * @description Greatest sideways acceleration, m/s2.
             */
            lateral_mps2: number;
            /**
             * Format: double
             * @description Greatest speed, m/s.
             */
            speed_mps: number;
            /**
             * Format: uint
             * @description Number of steps with at least one value over its limit ([`KinematicLimits`]).
             */
            violations: number;
            /**
             * Format: double
             * @description Greatest yaw rate, rad/s; none for pedestrians.
             */
            yaw_rate_radps: number | null;
        };
        /**
         * Lane
         * @description One lane.
         */
        Lane: {
            /** @description Id, unique among lanes, `[A-Za-z0-9_.:-]{1,64}`. */
            id: string;
            /**
             * @description Whether it connects two lanes through a junction.
             * @default false
             */
            interpolating?: boolean;
            /**
             * @description Lines on the left.
             * @default []
             */
            left_boundary?: components["schemas"]["Boundary"][];
            /**
             * @description Lanes on the left.
             * @default []
             */
            left_neighbors?: components["schemas"]["Neighbor"][];
            /** @description Centre line in driving direction, at least two points. */
            points_m: components["schemas"]["Points"];
            /**
             * @description Ids of lanes that lead to this one.
             * @default []
             */
            predecessors?: string[];
            /**
             * @description Lines on the right.
             * @default []
             */
            right_boundary?: components["schemas"]["Boundary"][];
            /**
             * @description Lanes on the right.
             * @default []
             */
            right_neighbors?: components["schemas"]["Neighbor"][];
            /**
             * Format: double
             * @description m/s.
             * @default null
             */
            speed_limit_mps?: number | null;
            /**
             * @description Ids of lanes that this one leads to.
             * @default []
             */
            successors?: string[];
            /**
             * @description Kind of lane.
             * @default undefined
             * @enum {string}
             */
            type?: "undefined" | "freeway" | "surface_street" | "bike_lane" | "bus_lane" | "sidewalk" | "parking";
            /**
             * Format: double
             * @description Width, metres; assumed by type when absent.
             * @default null
             */
            width_m?: number | null;
        };
        /**
         * LaneSide
         * @description A lane beside another.
         *
         *     `left`: In the same direction, to the left.
         *
         *     `right`: In the same direction, to the right.
         *
         *     `oncoming`: In the opposite direction.
         * @enum {string}
         */
        LaneSide: "left" | "right" | "oncoming";
        /**
         * Layout
         * @description A template with its parameters.
         */
        Layout: {
            parameters: components["schemas"]["Junction"];
            /** @constant */
            template: "three-arms";
        } | {
            parameters: components["schemas"]["Junction"];
            /** @constant */
            template: "four-arms";
        } | {
            parameters: components["schemas"]["Roundabout"];
            /** @constant */
            template: "roundabout";
        } | {
            parameters: components["schemas"]["Merge"];
            /** @constant */
            template: "merge";
        } | {
            parameters: components["schemas"]["Road"];
            /** @constant */
            template: "straight";
        } | {
            parameters: components["schemas"]["Road"];
            /** @constant */
            template: "curve";
        } | {
            parameters: components["schemas"]["Road"];
            /** @constant */
            template: "school-street";
        } | {
            parameters: components["schemas"]["CarPark"];
            /** @constant */
            template: "car-park";
        };
        /**
         * LearnedWish
         * @description A learned wish with its evidence.
         */
        LearnedWish: {
            /** @description Indices of the answers that contradict it. */
            against: number[];
            /** @description Least and greatest value of the kept cards, in the unit of the trait; absent if none were kept. */
            kept?: [
                number,
                number
            ] | null;
            /** @description Least and greatest value of the rejected cards. */
            rejected?: [
                number,
                number
            ] | null;
            /** @description Whether the user stated it. */
            said: boolean;
            /**
             * Format: double
             * @description Confidence, 0 to 1.
             */
            strength: number;
            /** @description Direction of the wish. */
            wants: components["schemas"]["WishDirection"];
        } & ({
            /** @constant */
            trait: "pace";
        } | {
            /** @constant */
            trait: "gap";
        } | {
            /** @constant */
            trait: "harshness";
        } | {
            /** @constant */
            trait: "standing";
        } | {
            /** @constant */
            trait: "from_log";
        } | {
            /** @constant */
            trait: "first";
            /** @description The one that goes first. */
            who: string;
            /** @description The other. */
            with: string;
        } | {
            /** @description The manoeuvre. */
            manoeuvre: components["schemas"]["Manoeuvre"];
            /** @constant */
            trait: "does";
            /** @description The road user. */
            who: string;
        });
        /**
         * Limiting
         * @description Reason why a goal is unreachable: a motion limit, traffic, or a relation that does not exist.
         *
         *     `acceleration`: Acceleration, m/s2.
         *
         *     `braking`: Deceleration, m/s2.
         *
         *     `speed`: Top speed, m/s.
         *
         *     `lateral`: Sideways acceleration, m/s2.
         *
         *     `curvature`: Curvature, 1/m.
         *
         *     `traffic`: Another road user blocks the path permanently.
         *
         *     `relation`: The goal is relative to a road user or a lane that does not exist there.
         * @enum {string}
         */
        Limiting: "acceleration" | "braking" | "speed" | "lateral" | "curvature" | "traffic" | "relation";
        /**
         * Log
         * @description The value `log`.
         *
         *     `log`: The recording.
         * @enum {string}
         */
        Log: "log";
        /**
         * Manoeuvre
         * @description Manoeuvre of a motion, by its shape and its lanes.
         * @enum {string}
         */
        Manoeuvre: "straight" | "left" | "right" | "turn_round" | "lane_left" | "lane_right" | "stays" | "reverse";
        /**
         * Map
         * @description The map of a scene: lanes, lines, edges, areas and stop signs.
         */
        Map: {
            /**
             * @description Crosswalks.
             * @default []
             */
            crosswalks?: components["schemas"]["Area"][];
            /**
             * @description Drivable surfaces.
             * @default []
             */
            drivable?: components["schemas"]["Drivable"][];
            /**
             * @description Driveways.
             * @default []
             */
            driveways?: components["schemas"]["Area"][];
            /**
             * @description Lanes with their links.
             * @default []
             */
            lanes?: components["schemas"]["Lane"][];
            /**
             * @description Edges of the road surface.
             * @default []
             */
            road_edges?: components["schemas"]["RoadEdge"][];
            /**
             * @description Painted lines.
             * @default []
             */
            road_lines?: components["schemas"]["RoadLine"][];
            /**
             * @description Speed bumps.
             * @default []
             */
            speed_bumps?: components["schemas"]["Area"][];
            /**
             * @description Stop signs.
             * @default []
             */
            stop_signs?: components["schemas"]["StopSign"][];
        };
        /**
         * MapBody
         * @description Body of a new map.
         */
        MapBody: {
            /**
             * @description Name of the scene. Default: that of the template.
             * @default null
             */
            name?: string | null;
            /**
             * @description Parameters that replace those of the template; absent ones stay, and a list replaces a list. `Layout` has their
             *     names and ranges.
             * @default null
             */
            parameters?: {
                [key: string]: unknown;
            } | null;
            /** @description The template. */
            template: components["schemas"]["Template"];
        };
        /**
         * MapField
         * @description A map, or the hash of one.
         */
        MapField: components["schemas"]["MapRef"] | components["schemas"]["Map"];
        /**
         * MapItem
         * @description One map of the store.
         */
        MapItem: {
            /**
             * Format: uint64
             * @description Size of its JSON, bytes.
             */
            bytes: number;
            /**
             * Format: uint64
             * @description Total number of their points.
             */
            points: number;
            /**
             * Format: uint64
             * @description Number of its lines and areas.
             */
            polylines: number;
            /** @description Content hash, 64 hex digits. */
            sha256: string;
        };
        /**
         * MapList
         * @description Maps of the store.
         */
        MapList: {
            maps: components["schemas"]["MapItem"][];
        };
        /**
         * MapRef
         * @description Reference to a map by its content hash.
         */
        MapRef: {
            /** @description `sha256:` and 64 hex digits, see `scene::LaneMap::hash`. */
            ref: string;
        };
        /**
         * MapReply
         * @description A new map.
         */
        MapReply: {
            /** @description Positions of the arms, in the order of the parameters. */
            arms: components["schemas"]["ArmPlace"][];
            /** @description Checks of the map. A failed check is only a notice. */
            checks: components["schemas"]["Check"][];
            /** @description Bends of the kerbs between the arms. */
            corners: components["schemas"]["CornerPlace"][];
            /** @description The template with all its parameters. */
            layout: components["schemas"]["Layout"];
            /** @description A scene with the map and no road users. Its `x_layout` has the template and its parameters. */
            scene: components["schemas"]["Scene"];
            /** @description Paths from lane to lane where roads meet at grade. */
            ways: components["schemas"]["JunctionPath"][];
        };
        /**
         * Measures
         * @description The worst values of one encounter, up to its event; null where a measure does not apply.
         */
        Measures: {
            /**
             * Format: double
             * @description Greatest deceleration to avoid the collision, m/s2.
             */
            drac_mps2: number | null;
            /**
             * Format: double
             * @description Least gap, metres; below zero the boxes overlap.
             */
            gap_m: number | null;
            /**
             * Format: double
             * @description Least headway of the follower, seconds: gap divided by its speed.
             */
            headway_s: number | null;
            /**
             * Format: double
             * @description Post-encroachment time of the whole motions, seconds.
             */
            pet_s: number | null;
            /**
             * Format: double
             * @description Least time to collision if both keep speed and turn rate, seconds; zero once their boxes overlap at a step.
             */
            ttc_s: number | null;
        };
        /**
         * Merge
         * @description A carriageway of one direction with a ramp that joins it, one that leaves it, or both.
         */
        Merge: {
            /**
             * Format: double
             * @description Width of lanes, metres.
             * @default 3.5
             */
            lane_width_m: number;
            /**
             * Format: uint8
             * @description Through lanes.
             * @default 2
             */
            lanes: number;
            /**
             * @description Whether a ramp leaves, upstream of the one that joins.
             * @default false
             */
            off_ramp: boolean;
            /**
             * @description Whether a ramp joins.
             * @default true
             */
            on_ramp: boolean;
            /**
             * Format: double
             * @description Length of the parallel lane for acceleration or deceleration, metres.
             * @default 150
             */
            parallel_m: number;
            /**
             * Format: double
             * @description Angle between ramp and carriageway, degrees.
             * @default 10
             */
            ramp_angle_deg: number;
            /**
             * Format: double
             * @description Speed limit of the ramps, km/h.
             * @default 60
             */
            ramp_speed_limit_kmh: number;
            /**
             * Format: double
             * @description Speed limit, km/h.
             * @default 100
             */
            speed_limit_kmh: number;
            /**
             * @description Side of the road on which traffic drives.
             * @default right-hand
             */
            traffic: components["schemas"]["Traffic"];
        };
        /**
         * Message
         * @description One sentence.
         */
        Message: {
            /** @description Code of the sentence, which never changes. */
            code: string;
            /** @description Values of its placeholders. An absent optional value is left out. */
            values: {
                [key: string]: components["schemas"]["MessageValue"];
            };
        };
        /**
         * MessageValue
         * @description A value in a sentence. Its unit is the suffix of its name (`_m`, `_s`, `_mps`, `_mps2`).
         */
        MessageValue: number | string;
        /**
         * Meta
         * @description Source of the scene, and notes on it.
         */
        Meta: {
            /**
             * @description Version of the program that made it.
             * @default null
             */
            created_with?: string | null;
            /**
             * @description Licence of the content, such as `waymo-nc` or `cc0`.
             * @default null
             */
            licence?: string | null;
            /**
             * @description Free text.
             * @default
             */
            notes?: string;
            /** @description WOMD's objects of interest, by road user id. */
            objects_of_interest?: string[];
            /**
             * @description Frame of the source.
             * @default {
             *       "crs": null,
             *       "rotation_rad": 0,
             *       "x_m": 0,
             *       "y_m": 0,
             *       "z_m": 0
             *     }
             */
            origin?: components["schemas"]["Origin"];
            /**
             * @description Scene that this one is a variant of.
             * @default null
             */
            parent_id?: string | null;
            /**
             * @description Format or tool, such as `womd`, `drawn`, `synthetic`.
             * @default
             */
            source?: string;
            /**
             * @description Id in the source.
             * @default null
             */
            source_id?: string | null;
            /**
             * @description Search terms.
             * @default []
             */
            tags?: string[];
            /** @description The source's times of the steps, seconds, when they are not exactly 0.1 s apart from zero. */
            timestamps_s?: number[] | null;
            /** @description WOMD's tracks to predict: id of the road user, and difficulty. */
            tracks_to_predict?: [
                string,
                number
            ][];
        };
        /**
         * Motion
         * @description States as columns, 0.1 s apart.
         */
        Motion: {
            heading_rad: number[];
            vx_mps: number[];
            vy_mps: number[];
            x_m: number[];
            y_m: number[];
        };
        /**
         * MotionLimits
         * @description Motion limits of one kind of road user; answers never exceed them.
         */
        MotionLimits: {
            /**
             * Format: double
             * @description Greatest acceleration.
             */
            accel_mps2: number;
            /**
             * Format: double
             * @description Greatest braking, positive.
             */
            brake_mps2: number;
            /** @description Limits of a future without time pressure. */
            comfortable: components["schemas"]["DrivingManner"];
            /**
             * Format: double
             * @description Greatest curvature; null for pedestrians, who turn without a bound. Vehicles longer than usual for the
             *     kind turn wider.
             */
            curvature_per_m: number | null;
            /**
             * @description Limits of a future under time pressure. It exceeds them only if a goal or another road user requires
             *     it.
             */
            hurried: components["schemas"]["DrivingManner"];
            /**
             * Format: double
             * @description Greatest sideways acceleration.
             */
            lateral_mps2: number;
            /**
             * Format: double
             * @description Top speed.
             */
            speed_mps: number;
        };
        /**
         * NearMiss
         * @description Two moving road users nearly collide, and their boxes never touch. One entry per pair, at its worst
         *     moment.
         */
        NearMiss: {
            /** @description The road user listed first. */
            a: string;
            /** @description The other. */
            b: string;
            /**
             * Format: double
             * @description Rate at which the gap shrinks at that time, m/s.
             */
            closing_speed_mps: number;
            /**
             * Format: double
             * @description Gap between the boxes at that time, metres.
             */
            distance_m: number;
            /**
             * @description The event is in the log: both move as recorded, or the recording has the same encounter at about the
             *     same time, at least as severe. It does not count.
             */
            in_log: boolean;
            /**
             * Format: double
             * @description Scene time, seconds.
             */
            time_s: number;
            /**
             * Format: double
             * @description Time to collision at that time, at constant velocity, seconds, if there is one.
             */
            ttc_s: number | null;
        };
        /**
         * NearestState
         * @description A pose and speed, scene frame.
         */
        NearestState: {
            /** Format: double */
            heading_rad: number;
            /** Format: double */
            speed_mps: number;
            /** Format: double */
            x_m: number;
            /** Format: double */
            y_m: number;
        };
        /**
         * Neighbor
         * @description A lane beside this one.
         */
        Neighbor: {
            /** @description Lines between the two, over the other lane's indices. */
            boundaries?: components["schemas"]["Boundary"][];
            /** @description Id of the other lane. */
            lane: string;
            /** @description First and last point index on the other lane. */
            other: number[];
            /** @description First and last point index on this lane. */
            self: number[];
        };
        /**
         * Origin
         * @description Position of the scene in its source's frame: `source = rotate(scene, rotation_rad) + (x, y, z)`.
         */
        Origin: {
            /** @default null */
            crs?: string | null;
            /**
             * Format: double
             * @default 0
             */
            rotation_rad?: number;
            /**
             * Format: double
             * @default 0
             */
            x_m?: number;
            /**
             * Format: double
             * @default 0
             */
            y_m?: number;
            /**
             * Format: double
             * @default 0
             */
            z_m?: number;
        };
        /**
         * OtherKinds
         * @description Type and size of the road users other than the one with the conditions.
         */
        OtherKinds: {
            /** @description Road users: ids, `@all`, `@moving`, `@vehicles`, `@pedestrians`, `@cyclists`, `@ego`. */
            agents?: string[];
            /** @description Length of each, metres. */
            length_m?: components["schemas"]["Distribution"] | null;
            /** @description Type, in place of their own. */
            type?: components["schemas"]["AgentType"] | null;
            /** @description Width of each, metres. */
            width_m?: components["schemas"]["Distribution"] | null;
        };
        /**
         * OtherSide
         * @description Direction from which another way comes.
         *
         *     `left`: From the left.
         *
         *     `right`: From the right.
         *
         *     `oncoming`: Towards the subject, before it turns.
         * @enum {string}
         */
        OtherSide: "left" | "right" | "oncoming";
        /**
         * Overlap
         * @description The boxes of two road users overlap by less than the thresholds of a collision. One entry per pair.
         */
        Overlap: {
            /** @description The road user listed first. */
            a: string;
            /** @description The other. */
            b: string;
            /**
             * Format: double
             * @description Greatest depth, metres: the least gap of the pair, with the opposite sign.
             */
            depth_m: number;
            /**
             * @description The event is in the log: both move as recorded, or the recording has an overlap as deep. It does not
             *     count.
             */
            in_log: boolean;
            /**
             * Format: double
             * @description Scene time of the first step at which they overlap, seconds.
             */
            time_s: number;
        };
        /**
         * PairChoice
         * @description The pairs to score.
         *
         *     `all`: Every pair.
         *
         *     `regenerated`: Pairs with at least one generated road user.
         * @enum {string}
         */
        PairChoice: "all" | "regenerated";
        /**
         * Parked
         * @description Cars parked at kerbs and in car parks: exactly one of `per_100m` and `share`.
         */
        Parked: {
            /**
             * Format: double
             * @description Cars per 100 m of kerb with room; the same share of the bays in car parks is occupied.
             * @default null
             */
            per_100m?: number | null;
            /**
             * Format: double
             * @description Share of the parking places that are occupied.
             * @default null
             */
            share?: number | null;
        };
        /** PatternChoice */
        PatternChoice: ("ALKS-cut-in" | "ALKS-cut-out" | "ALKS-deceleration" | "CBDA" | "CBFA" | "CBLA" | "CBNA" | "CBNAO" | "CBTA" | "CCCscp" | "CCFhol" | "CCFhos" | "CCFtap" | "CCRb" | "CCRm" | "CCRs" | "CPFA" | "CPLA" | "CPNA" | "CPNCO" | "CPTA" | "crosswalk-after-bend" | "merge" | "roundabout-entry") | string | components["schemas"]["RoadPattern"];
        /**
         * PatternGoal
         * @description The goal of a road user. Its position follows from `at_m`, from `relation`, or from the mean of both
         *     speeds over the time.
         */
        PatternGoal: {
            /** @description Metres along the way from the place. */
            at_m?: (number | string) | null;
            /** @description Constant braking from the speed of the start to that of the goal, in place of a time, m/s2. */
            braking_mps2?: (number | string) | null;
            /** @description Metres to the left of the way. Default: as at the start on the same way, else 0. */
            left_m?: (number | string) | null;
            /** @description Position relative to another road user and its motion in the result. */
            relation?: components["schemas"]["PatternRelation"] | null;
            /** @description Speed, km/h. Default: that of the start. */
            speed_kmh?: (number | string) | null;
            /** @description Seconds after the start. */
            time_s?: (number | string) | null;
            /** @description Way of the goal. Default: that of the start. */
            way?: components["schemas"]["PatternWay"] | null;
        };
        /**
         * PatternParameter
         * @description A number that may be varied.
         */
        PatternParameter: {
            /** @description Description. */
            note?: string | null;
            /** @description Least and greatest value. */
            range: [
                number,
                number
            ];
            /**
             * Format: double
             * @description Standard value.
             */
            value: number;
        };
        /**
         * PatternRelation
         * @description A goal relative to another road user: exactly one of `ahead_m`, `behind_m` and `behind_s`.
         */
        PatternRelation: {
            /** @description Gap from the front of the other one to the rear of this road user, metres. */
            ahead_m?: (number | string) | null;
            /** @description Gap from the front of this road user to the rear of the other one, metres. */
            behind_m?: (number | string) | null;
            /** @description The same gap in seconds at the speed of the goal. */
            behind_s?: (number | string) | null;
            /**
             * Format: int32
             * @description Number of lanes to the left of the other one's lane; negative is to the right.
             * @default 0
             */
            lanes_left?: number;
            /** @description Its id. */
            to: string;
        };
        /**
         * PatternUser
         * @description A road user of a pattern.
         */
        PatternUser: {
            /** @description Id of an earlier road user of the list ahead of which this one starts, with `gap_m`. */
            ahead_of?: string | null;
            /** @description Start along the way, metres from the place; negative is before it. */
            at_m?: (number | string) | null;
            /** @description Start along the way, seconds from the place at its speed; negative is before it. */
            at_s?: (number | string) | null;
            /** @description Gap along the way between the two boxes, metres, with `ahead_of`. */
            gap_m?: (number | string) | null;
            /** @description Exact goal. Default: free. */
            goal?: components["schemas"]["PatternGoal"] | null;
            /** @description Letters, digits, - and _. */
            id: string;
            /** @description Metres to the left of the way. */
            left_m?: (number | string) | null;
            /** @description Length of its box, metres. Default: that of the type. */
            length_m?: (number | string) | null;
            /** @description Speed at the start, km/h. */
            speed_kmh?: (number | string) | null;
            /** @description Finer type, such as `child` or `truck`. */
            subtype?: string | null;
            /** @description Type. */
            type: components["schemas"]["AgentType"];
            /** @description Via points on its way, metres from the place, at any time; at most 4. */
            via_m?: (number | string)[];
            /**
             * @description The way on which it starts.
             * @default own
             */
            way?: components["schemas"]["PatternWay"];
            /** @description Width of its box, metres. Default: that of the type. */
            width_m?: (number | string) | null;
        };
        /**
         * PatternWay
         * @description A way at the place, along which road users are placed. All ways have the place at 0 m.
         *
         *     `own`: The way of the subject.
         *
         *     `against`: The way of the subject, in the opposite direction.
         *
         *     `other`: The lane that is crossed or joined.
         *
         *     `left`: The lane to the left, in the same direction.
         *
         *     `right`: The lane to the right, in the same direction.
         *
         *     `oncoming`: The lane in the opposite direction.
         *
         *     `from-left`: Across the way of the subject, from the left; along the crosswalk if there is one.
         *
         *     `from-right`: Across the way of the subject, from the right; along the crosswalk if there is one.
         * @enum {string}
         */
        PatternWay: "own" | "against" | "other" | "left" | "right" | "oncoming" | "from-left" | "from-right";
        /**
         * PeekBody
         * @description Body of a peek into the future of a run.
         */
        PeekBody: {
            /**
             * @description Motion by ego, the first state 0.1 s after the present; at most 90 states. An ego that is left out follows its
             *     announced plan.
             * @default {}
             */
            plans?: {
                [key: string]: components["schemas"]["Motion"];
            };
        };
        /**
         * PeekReply
         * @description Predicted motion of the other road users.
         */
        PeekReply: {
            /** @description Changes of plan with their causes. */
            changes: components["schemas"]["Change"][];
            /** @description The first collision of each ego with each other road user. */
            faults: components["schemas"]["RunFault"][];
            /** @description Motion of the others over nine seconds by id, the first state 0.1 s after the present. */
            futures: {
                [key: string]: components["schemas"]["Motion"];
            };
            /**
             * Format: double
             * @description Scene time of the present, seconds.
             */
            time_s: number;
        };
        /**
         * PlaceBody
         * @description Body of a placement. Exactly one of `scene` and `scene_id` is given.
         */
        PlaceBody: {
            /**
             * @description Traffic by arm, until the end of the scene. It is the only source of vehicles on the lanes of these
             *     arms.
             */
            arrivals?: components["schemas"]["Arrivals"][];
            /** @description Density. Absent or null: 12 per kilometre, or 0 with `arrivals` or `parked`. */
            density?: components["schemas"]["Density"] | null;
            /**
             * @description With `scene_id`: the call is refused if the scene has changed.
             * @default null
             */
            etag?: string | null;
            /**
             * @description Road users of the scene to keep; null keeps all. The others count as removed.
             * @default null
             */
            keep?: string[] | null;
            /**
             * Format: double
             * @description Minimum gap along the lane between moving vehicles, metres. All other gaps are at least 0.1 m.
             * @default 2
             */
            min_gap_m?: number;
            /** @description Parked cars, in addition to `density`. */
            parked?: components["schemas"]["Parked"] | null;
            /** @description Region; null is the whole map. It may reach 50 m beyond the map's box. */
            region?: components["schemas"]["Region"] | null;
            /**
             * @description The scene itself; its map may be `{"ref":"sha256:HEX"}`.
             * @default null
             */
            scene?: components["schemas"]["Scene"] | null;
            /**
             * @description A scene of this server.
             * @default null
             */
            scene_id?: string | null;
            /**
             * Format: uint64
             * @description Seed of the random draws; equal seeds give equal answers.
             * @default 0
             */
            seed?: number;
            /**
             * @description Speeds of moving motor vehicles; null draws the speeds typical of each road. Vehicles at rest, as in a
             *     queue, stay at rest.
             */
            speeds?: components["schemas"]["Speeds"] | null;
            /**
             * Format: double
             * @description Scene time at which they start, seconds.
             * @default 0
             */
            start_s?: number;
            /**
             * @description Shares of `vehicle`, `pedestrian` and `cyclist`, which sum to 1.
             * @default null
             */
            types?: {
                [key: string]: number;
            } | null;
        } & ({
            scene: unknown;
        } | {
            scene_id: unknown;
        });
        /**
         * PlaceReply
         * @description Result of a placement.
         */
        PlaceReply: {
            /**
             * @description New road users: one state at `start_s`, the same as a fixed start, goals free. One that enters by an arm
             *     later has a track from the map's edge on, which it keeps until it reacts; a parked one has a standing track.
             */
            agents: components["schemas"]["Agent"][];
            /** @description Arms: where roads enter the map or the region, with the traffic placed on each. */
            arms: components["schemas"]["ArmDoc"][];
            /** @description `model`, or `lane-sampler` if the weights folder has no placement weights. */
            method: components["schemas"]["PlacementMethod"];
            /**
             * Format: uint
             * @description Parking places at kerbs and in car parks; null without `parked`.
             */
            parking_places: number | null;
            /** @description Reason for `unplaced`, in one sentence; null if all were placed. */
            reason: string | null;
            /**
             * Format: uint
             * @description Number of requested road users without a place.
             */
            unplaced: number;
        };
        /**
         * PlacementInfo
         * @description Description of the placement weights.
         */
        PlacementInfo: {
            licence: string;
            /** Format: uint */
            numbers: number;
            sha256: string;
            trained_on: string;
        };
        /**
         * PlacementMethod
         * @description Method of placement.
         *
         *     `model`: Learned rates and distributions.
         *
         *     `lane-sampler`: Evenly along lanes, at the speed limit: without weights, and as a baseline.
         * @enum {string}
         */
        PlacementMethod: "model" | "lane-sampler";
        /**
         * Point
         * @description [x, y] or [x, y, z], metres in the scene frame.
         */
        Point: [
            number,
            number
        ];
        /**
         * Points
         * @description A line or open ring; all its points have two or all have three numbers.
         */
        Points: components["schemas"]["Point"][] | unknown | unknown;
        /**
         * Problem
         * @description RFC 9457 problem. Programs switch on `code`, which never changes.
         */
        Problem: {
            /** @description Road user for which an expert failed. */
            agent?: string;
            /**
             * Format: uint64
             * @description The newer revision that replaced this one.
             */
            by_revision?: number;
            /**
             * @description Code for programs.
             * @enum {string}
             */
            code: "malformed-json" | "malformed-file" | "bad-header" | "bad-host" | "unauthorized" | "forbidden" | "bad-origin" | "cross-site" | "read-only" | "not-found" | "method-not-allowed" | "not-acceptable" | "head-timeout" | "body-timeout" | "exists" | "superseded" | "stale-revision" | "cancelled" | "step-order" | "too-many-runs" | "too-many-requests" | "stale-etag" | "body-too-large" | "decoded-too-large" | "expansion-too-high" | "uri-too-long" | "unsupported-media-type" | "host-not-allowed" | "invalid-field" | "out-of-range" | "half-position" | "start-missing" | "unknown-agent" | "not-asked" | "unknown-map" | "too-many-agents" | "map-too-large" | "map-too-complex" | "reply-too-large" | "too-much-work" | "unsupported-version" | "format-unknown" | "cannot-represent" | "pickle-refused" | "licence-refused" | "idempotency-key-reused" | "upgrade-required" | "precondition-required" | "headers-too-large" | "internal" | "non-finite-output" | "busy" | "not-ready" | "store-unavailable" | "shutting-down" | "generate-timeout" | "store-full";
            /**
             * Format: uint
             * @description Column of the fault in bytes, from 1.
             */
            column?: number;
            /** @description Explanation of this occurrence. */
            detail: string;
            /** @description All faults found in the body or the query. */
            errors?: components["schemas"]["FieldProblem"][];
            /** @description ETag of the stored scene. */
            etag?: string;
            /** @description Components that are not ready. */
            failing?: string[];
            /**
             * Format: uint64
             * @description The highest revision that the client has sent.
             */
            highest_revision?: number;
            /** @description Requested address. */
            instance?: string;
            /**
             * Format: uint64
             * @description The limit that caused the refusal.
             */
            limit?: number;
            /**
             * Format: uint
             * @description Line of the fault, from 1.
             */
            line?: number;
            /** @description `detail` as data. */
            message?: components["schemas"]["Message"];
            /**
             * Format: uint64
             * @description Offset in the decoded file, bytes.
             */
            offset?: number;
            /** @description Fault that the reader of a file found there. */
            reason?: string;
            /** @description Id of the request, as in X-Request-Id and in the server's log. */
            request_id?: string;
            /**
             * Format: uint64
             * @description The same time in milliseconds, more precise.
             */
            retry_after_ms?: number;
            /**
             * Format: uint64
             * @description Time to wait before the next attempt, seconds, as in Retry-After.
             */
            retry_after_s?: number;
            /**
             * Format: uint16
             * @description HTTP status.
             */
            status: number;
            /**
             * Format: uint
             * @description Refinement step at which an expert failed; 0 is the initial draft.
             */
            step?: number;
            /** @description Short title, the same for each occurrence. */
            title: string;
            /** @description Page about the code, relative to this server. */
            type: string;
            /** @description Time at which the scene was stored, RFC 3339. */
            updated_at?: string;
        };
        /**
         * Program
         * @description Signal program of a junction, whose phases repeat in a cycle.
         */
        Program: {
            /**
             * Format: double
             * @description All-red time before the next green, seconds.
             * @default 1
             */
            all_red_s: number;
            /**
             * Format: double
             * @description Green of each phase, seconds.
             * @default 10
             */
            green_s: number;
            /**
             * Format: double
             * @description Time for which the first green has been on at the start of the scene, seconds.
             * @default 7
             */
            offset_s: number;
            /**
             * @description Phases of turns across oncoming traffic.
             * @default permissive
             */
            turns_across: components["schemas"]["TurnAcross"];
            /**
             * Format: double
             * @description Yellow after each green, seconds.
             * @default 3
             */
            yellow_s: number;
        };
        /**
         * Reach
         * @description Whether a goal is met. `unreachable` has the nearest state and what the goal would require.
         */
        Reach: {
            /**
             * Format: double
             * @description Radians.
             */
            heading_rad: number;
            /**
             * Format: double
             * @description Distance to the goal position, metres.
             */
            position_m: number;
            /**
             * Format: double
             * @description m/s.
             */
            speed_mps: number;
            /** @constant */
            status: "reached";
        } | {
            /** @description Limit that prevents it. */
            limiting: components["schemas"]["Limiting"];
            /** @description The reason as data. */
            message: components["schemas"]["Message"];
            /** @description Nearest state that can be reached at the goal time. */
            nearest: components["schemas"]["NearestState"];
            /**
             * Format: double
             * @description Amount that the goal would require, in the unit of the limit, where a formula gives it.
             */
            needs: number | null;
            /** @constant */
            status: "unreachable";
            /** @description The road user in the way, if there is one. */
            with?: string | null;
            /** @description The reason in English. */
            words: string;
        };
        /**
         * Reacting
         * @description Road users that may react: true for all nearby, or ids.
         */
        Reacting: boolean | string[];
        /**
         * Reaction
         * @description Why a road user left its previous motion.
         */
        Reaction: {
            /** @description The road user with which its previous motion conflicts. */
            cause: string;
            /**
             * Format: double
             * @description Delay relative to its previous motion, seconds; negative is earlier.
             */
            delay_s: number;
            /** @description Kind of the reaction. */
            kind: components["schemas"]["ReactionKind"];
            /**
             * Format: double
             * @description Speed at that time, m/s.
             */
            speed_mps: number;
            /**
             * Format: double
             * @description Scene time at which it waits or is slowest, seconds.
             */
            time_s: number;
            /**
             * Format: double
             * @description Position at that time, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Position at that time, metres.
             */
            y_m: number;
        };
        /**
         * ReactionKind
         * @description Kind of a reaction to another road user.
         *
         *     `waits`: Comes to rest.
         *
         *     `slows`: Slows down.
         *
         *     `speeds_up`: Speeds up.
         *
         *     `keeps_clear`: Takes another path.
         *
         *     `stays_out`: Was due to enter later, and does not enter because its place is occupied.
         * @enum {string}
         */
        ReactionKind: "waits" | "slows" | "speeds_up" | "keeps_clear" | "stays_out";
        /**
         * RedLight
         * @description A stop line is crossed while its signal says stop.
         */
        RedLight: {
            /** @description The road user. */
            agent: string;
            /**
             * @description The event is in the log: the motion is the recorded one, or the recording has the same event at about
             *     the same time, at least as severe.
             */
            in_log: boolean;
            /** @description Lane of the red signal. */
            lane: string;
            /**
             * Format: double
             * @description Speed at that time, m/s.
             */
            speed_mps: number;
            /**
             * Format: double
             * @description Scene time at which the front crosses, seconds.
             */
            time_s: number;
        };
        /**
         * Reference
         * @description Motion with which trajectories are compared.
         */
        Reference: components["schemas"]["Log"] | {
            [key: string]: components["schemas"]["Trajectory"];
        };
        /**
         * Region
         * @description Region for box centres: exactly one of `circle` and `polygon_m`.
         */
        Region: {
            /** @description Circle. */
            circle?: components["schemas"]["Circle"] | null;
            /**
             * @description Open ring of corners, metres; even-odd rule.
             * @default null
             */
            polygon_m?: number[][] | null;
        };
        /**
         * Relation
         * @description Relation of a motion to that of another road user.
         */
        Relation: {
            /**
             * Format: double
             * @description Time between the two at that place, seconds.
             */
            gap_s?: number | null;
            /** @description Kind of the relation. */
            kind: components["schemas"]["RelationKind"];
            /**
             * Format: double
             * @description Scene time at which this one is at the place, seconds.
             */
            time_s: number;
            /** @description The other road user. */
            with: string;
            /**
             * Format: double
             * @description Position at that time, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Position at that time, metres.
             */
            y_m: number;
        };
        /**
         * RelationKind
         * @description Kind of a relation between two motions.
         *
         *     `before`: Their paths cross, and this one passes first.
         *
         *     `after`: Their paths cross, and this one passes second.
         *
         *     `follows`: Behind the other on the same path.
         *
         *     `gives_way_to`: Slows down or waits where their paths cross, so that the other goes first.
         * @enum {string}
         */
        RelationKind: "before" | "after" | "follows" | "gives_way_to";
        /**
         * Resolved
         * @description All condition fields of one road user as they were used.
         */
        Resolved: {
            /**
             * @description If its shown future leaves the road or drives against the traffic: the place nearest to the goal that can be
             *     reached along the road in the same time.
             */
            by_road?: components["schemas"]["ByRoad"] | null;
            /** @description Its goal. */
            goal: components["schemas"]["ResolvedGoal"];
            /** @description Targets of the windows whose plan ends before the goal is due. */
            intermediate?: components["schemas"]["Intermediate"][];
            /** @description Length, metres. */
            length_m: components["schemas"]["Field"];
            /** @description Whether the goal is met. */
            reach: components["schemas"]["Reach"];
            /** @description Its start. */
            start: components["schemas"]["ResolvedStart"];
            /** @description Type whose expert was used. */
            type: components["schemas"]["AgentType"];
            /** @description How its shown future passes each via point, in order. */
            via?: components["schemas"]["ResolvedVia"][];
            /** @description Width, metres. */
            width_m: components["schemas"]["Field"];
        };
        /**
         * ResolvedGoal
         * @description The goal of a road user as it was used, in the scene frame.
         */
        ResolvedGoal: {
            heading_rad: components["schemas"]["Field"];
            speed_mps: components["schemas"]["Field"];
            /** @description Scene time at which it is due. */
            time_s: components["schemas"]["Field"];
            x_m: components["schemas"]["Field"];
            y_m: components["schemas"]["Field"];
        };
        /**
         * ResolvedStart
         * @description The start of a road user as it was used.
         */
        ResolvedStart: {
            heading_rad: components["schemas"]["Field"];
            speed_mps: components["schemas"]["Field"];
            x_m: components["schemas"]["Field"];
            y_m: components["schemas"]["Field"];
        };
        /**
         * ResolvedVia
         * @description How a future passes a via point.
         */
        ResolvedVia: {
            /**
             * Format: double
             * @description Least distance of the future from it, metres.
             */
            distance_m: number;
            /** @description Whether it is passed within its tolerance, and at its time if that is fixed. */
            passed: boolean;
            /**
             * Format: double
             * @description Scene time at the least distance, seconds.
             */
            time_s: number;
            /**
             * Format: double
             * @description Tolerance of the condition, metres.
             */
            tolerance_m: number;
            /**
             * Format: double
             * @description Its position, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Its position, metres.
             */
            y_m: number;
        };
        /**
         * Road
         * @description One road, straight or bent.
         */
        Road: {
            /**
             * Format: double
             * @description Change of direction, degrees, positive to the left; 0 is straight.
             * @default 0
             */
            bend_deg: number;
            /**
             * Format: double
             * @description Width of the crosswalk half way along the road, metres; below half a metre there is none.
             * @default 0
             */
            crosswalk_m: number;
            /**
             * Format: double
             * @description Width of the cycle lane on each side, metres; below half a metre there is none.
             * @default 0
             */
            cycle_lane_m: number;
            /**
             * Format: double
             * @description Width of lanes, metres.
             * @default 3.25
             */
            lane_width_m: number;
            /**
             * Format: uint8
             * @description Lanes in the opposite direction.
             * @default 2
             */
            lanes_backward: number;
            /**
             * Format: uint8
             * @description Lanes in the forward direction, which is east at the start of the road.
             * @default 2
             */
            lanes_forward: number;
            /**
             * Format: double
             * @description Length, metres; more where the bend needs it.
             * @default 200
             */
            length_m: number;
            /**
             * Format: double
             * @description Width of the raised median, metres; below half a metre there is none.
             * @default 0
             */
            median_m: number;
            /**
             * Format: double
             * @description Width of the parking strip on each side, metres; below half a metre there is none.
             * @default 0
             */
            parking_m: number;
            /**
             * Format: double
             * @description Radius of the bend in the middle of the road, metres; more where the road is too wide for it.
             * @default 60
             */
            radius_m: number;
            /**
             * Format: double
             * @description Width of the pavements, metres; below half a metre there are none.
             * @default 2.5
             */
            sidewalk_m: number;
            /**
             * @description Whether speed bumps lie before and after the crosswalk.
             * @default false
             */
            speed_bumps: boolean;
            /**
             * Format: double
             * @description Speed limit, km/h.
             * @default 50
             */
            speed_limit_kmh: number;
            /**
             * @description Side of the road on which traffic drives.
             * @default right-hand
             */
            traffic: components["schemas"]["Traffic"];
        };
        /**
         * RoadEdge
         * @description An edge of the road surface.
         */
        RoadEdge: {
            /** @description Id, unique among road edges. */
            id: string;
            /** @description Points in order. */
            points_m: components["schemas"]["Points"];
            /**
             * @description WOMD's name in snake case, or `sidewalk`.
             * @default unknown
             * @enum {string}
             */
            type?: "unknown" | "boundary" | "median" | "sidewalk";
        };
        /**
         * RoadFeature
         * @description Feature at the place.
         *
         *     `lane`: A lane for motor vehicles outside of junctions.
         *
         *     `crosswalk`: A crosswalk across the way of the subject.
         *
         *     `crossing`: The way of the subject crosses another lane for motor vehicles.
         *
         *     `merge`: The way of the subject joins another lane.
         *
         *     `roundabout-entry`: The way of the subject joins a roundabout.
         * @enum {string}
         */
        RoadFeature: "lane" | "crosswalk" | "crossing" | "merge" | "roundabout-entry";
        /**
         * RoadLine
         * @description A painted line.
         */
        RoadLine: {
            /** @description Id, unique among road lines. */
            id: string;
            /** @description Points in order. */
            points_m: components["schemas"]["Points"];
            /**
             * @description WOMD's name in snake case.
             * @default unknown
             * @enum {string}
             */
            type?: "unknown" | "broken_single_white" | "solid_single_white" | "solid_double_white" | "broken_single_yellow" | "broken_double_yellow" | "solid_single_yellow" | "solid_double_yellow" | "passing_double_yellow";
        };
        /**
         * RoadNeeds
         * @description Requirements on the road.
         */
        RoadNeeds: {
            /**
             * Format: double
             * @description Way of the subject after the place, metres. Most: 400.
             * @default 0
             */
            after_m?: number;
            /**
             * Format: double
             * @description Way of the subject before the place, metres. Most: 400.
             * @default 0
             */
            before_m?: number;
            /** @description The way of the subject bends within 60 m before the place, or stays straight there. Default: either. */
            bend?: boolean | null;
            /** @description Feature at the place. */
            feature: components["schemas"]["RoadFeature"];
            /** @description Direction from which the other way comes, as seen by the subject. */
            from?: components["schemas"]["OtherSide"] | null;
            /** @description Least and greatest speed limit of the lane, km/h. Default: any. */
            limit_kmh?: [
                number,
                number
            ] | null;
            /** @description A lane beside the place. */
            neighbor?: components["schemas"]["LaneSide"] | null;
            /** @description A signal controls the way of the subject, or none does. Default: either. */
            signal?: boolean | null;
            /**
             * @description Turn of the subject's way: from 25 m before the place to 5 m after it; for the feature `lane` over the
             *     whole way.
             */
            turn?: components["schemas"]["RoadTurn"] | null;
        };
        /**
         * RoadPattern
         * @description A situation on any map: requirements on the road, and the road users there.
         */
        RoadPattern: {
            /** @description Short name: letters, digits, - and _. */
            name: string;
            /** @description Numbers that may be varied, by name. */
            parameters?: {
                [key: string]: components["schemas"]["PatternParameter"];
            };
            /** @description The road. */
            road: components["schemas"]["RoadNeeds"];
            /** @description Source of the parameters. */
            source?: string | null;
            /** @description One sentence. */
            title: string;
            /** @description Road users. The first one is the subject: its goal may stay free. */
            users: components["schemas"]["PatternUser"][];
        };
        /**
         * RoadTurn
         * @description Turn of a way.
         *
         *     `straight`: By less than 20 degrees.
         *
         *     `left`: To the left by more than 35 degrees.
         *
         *     `right`: To the right by more than 35 degrees.
         * @enum {string}
         */
        RoadTurn: "straight" | "left" | "right";
        /**
         * Round
         * @description A round of cards.
         */
        Round: {
            /** @description One per future of the requested road user, or one per sample, the most preferred first. */
            cards: components["schemas"]["RoundCard"][];
            /** @description Wishes on which the answers agree, with the most certain first. */
            wishes: components["schemas"]["LearnedWish"][];
        };
        /**
         * RoundCard
         * @description A candidate on a card.
         */
        RoundCard: {
            /** @description Features of the card; the client returns them with the verdict. */
            features: components["schemas"]["Features"];
            /**
             * Format: double
             * @description Share of the learned wishes that it fulfils; absent if none is known.
             */
            match?: number | null;
            /** @description Box centres at every half second, by road user; the client returns them with the verdict. */
            places: {
                [key: string]: number[][];
            };
        };
        /**
         * Roundabout
         * @description Roads that meet at a ring.
         */
        Roundabout: {
            /**
             * @description 3 to 6 arms, at least 20 degrees apart.
             * @default [
             *       {
             *         "angle_deg": 0,
             *         "crosswalk_m": 3,
             *         "cycle_lane_m": 0,
             *         "lanes_in": 1,
             *         "lanes_out": 1,
             *         "length_m": 90,
             *         "main": false,
             *         "median_m": 2,
             *         "speed_limit_kmh": 50,
             *         "turns": null
             *       },
             *       {
             *         "angle_deg": 90,
             *         "crosswalk_m": 3,
             *         "cycle_lane_m": 0,
             *         "lanes_in": 1,
             *         "lanes_out": 1,
             *         "length_m": 90,
             *         "main": false,
             *         "median_m": 2,
             *         "speed_limit_kmh": 50,
             *         "turns": null
             *       },
             *       {
             *         "angle_deg": 180,
             *         "crosswalk_m": 3,
             *         "cycle_lane_m": 0,
             *         "lanes_in": 1,
             *         "lanes_out": 1,
             *         "length_m": 90,
             *         "main": false,
             *         "median_m": 2,
             *         "speed_limit_kmh": 50,
             *         "turns": null
             *       },
             *       {
             *         "angle_deg": 270,
             *         "crosswalk_m": 3,
             *         "cycle_lane_m": 0,
             *         "lanes_in": 1,
             *         "lanes_out": 1,
             *         "length_m": 90,
             *         "main": false,
             *         "median_m": 2,
             *         "speed_limit_kmh": 50,
             *         "turns": null
             *       }
             *     ]
             */
            arms: components["schemas"]["Arm"][];
            /**
             * Format: double
             * @description Radius of the island in the middle, metres; more where the arms need it.
             * @default 12
             */
            island_radius_m: number;
            /**
             * Format: double
             * @description Radius of the kerbs at corners, metres; less where arms are too close for it.
             * @default 12
             */
            kerb_radius_m: number;
            /**
             * Format: double
             * @description Width of lanes, metres.
             * @default 3.25
             */
            lane_width_m: number;
            /**
             * Format: double
             * @description Width of the lanes of the ring, metres.
             * @default 5
             */
            ring_lane_width_m: number;
            /**
             * Format: uint8
             * @description Number of lanes of the ring.
             * @default 1
             */
            ring_lanes: number;
            /**
             * Format: double
             * @description Speed limit of the ring, km/h.
             * @default 30
             */
            ring_speed_limit_kmh: number;
            /**
             * Format: double
             * @description Width of the pavements, metres; below half a metre there are none.
             * @default 2.5
             */
            sidewalk_m: number;
            /**
             * @description Side of the road on which traffic drives.
             * @default right-hand
             */
            traffic: components["schemas"]["Traffic"];
        };
        /**
         * RunBody
         * @description Body that begins a run. Exactly one of `scene` and `scene_id` is given. With `snapshot` the egos and all settings are
         *     those of the snapshot.
         */
        RunBody: {
            /**
             * @description Road users that the caller drives, by id; none by default.
             * @default null
             */
            egos?: string[] | null;
            /**
             * @description With `scene_id`: the call is refused if the scene has changed.
             * @default null
             */
            etag?: string | null;
            /**
             * Format: double
             * @description Replan interval of the other road users, seconds; 1 by default.
             * @default null
             */
            plan_interval_s?: number | null;
            /**
             * @description The scene itself; its map may be `{"ref":"sha256:HEX"}`.
             * @default null
             */
            scene?: components["schemas"]["Scene"] | null;
            /**
             * @description A scene of this server.
             * @default null
             */
            scene_id?: string | null;
            /**
             * Format: uint64
             * @description Seed, which repeats the run; 0 by default.
             * @default null
             */
            seed?: number | null;
            /**
             * @description A snapshot of a run in this scene, base64, from which the run continues.
             * @default null
             */
            snapshot?: string | null;
            /**
             * Format: double
             * @description Scene time at which the run begins, seconds; 0 by default.
             * @default null
             */
            start_s?: number | null;
            /**
             * Format: double
             * @description Length of a step, seconds, in whole milliseconds; 0.1 by default.
             * @default null
             */
            step_s?: number | null;
            /**
             * Format: uint64
             * @description Refinement steps of each plan; 1 by default.
             * @default null
             */
            steps?: number | null;
        } & ({
            scene: unknown;
        } | {
            scene_id: unknown;
        });
        /**
         * RunEvent
         * @description An event of a followed run: first the run, then each step, last `end` when the server deletes the run.
         */
        RunEvent: {
            /** @constant */
            event: "run";
            /** @description The run. */
            run: components["schemas"]["RunReply"];
        } | {
            /** @constant */
            event: "step";
            /** @description The reply to the step. */
            step: components["schemas"]["StepReply"];
        } | {
            /** @constant */
            event: "heartbeat";
        } | {
            /** @constant */
            event: "end";
        };
        /**
         * RunFault
         * @description A fault and its road user.
         */
        RunFault: {
            /** @description The road user with the fault; in a collision, the one that drove into the other. */
            agent: string;
            /** @description The fault, with its time and position. */
            fault: components["schemas"]["Fault"];
        };
        /**
         * RunReply
         * @description A run that has begun.
         */
        RunReply: {
            /** @description Road users that the caller drives. */
            egos: string[];
            /**
             * Format: uint64
             * @description Time without a request after which the server deletes the run, seconds.
             */
            idle_s: number;
            /**
             * Format: double
             * @description Replan interval of the other road users, seconds.
             */
            plan_interval_s: number;
            /** @description Current states, in the form of a step. */
            present: components["schemas"]["StepReply"];
            /** @description Id of the run. */
            run: string;
            /**
             * Format: uint64
             * @description Seed, which repeats the run.
             */
            seed: number;
            /**
             * Format: double
             * @description Length of a step, seconds.
             */
            step_s: number;
            /**
             * Format: uint64
             * @description Number of remaining steps.
             */
            steps_left: number;
            /**
             * Format: uint64
             * @description Time since the last request that used the run, seconds. Reading its state does not count.
             */
            unused_s: number;
        };
        /**
         * Sample
         * @description One coherent answer for all regenerated road users.
         */
        Sample: {
            /** @description Futures by id of the road user. */
            agents: {
                [key: string]: components["schemas"]["AgentFutures"];
            };
            /**
             * @description Score as the API gave it.
             * @default null
             */
            score?: unknown;
        };
        /**
         * SamplingMethod
         * @description Method by which the numbers of a situation are chosen.
         *
         *     `grid`: Every combination of the values.
         *
         *     `random`: Independent draws.
         *
         *     `latin-hypercube`: Each range has as many strata of equal width as there are draws, and one draw in each.
         *
         *     `sobol`: Scrambled Sobol points, which spread evenly over all ranges at once; best with a power of two of draws.
         *
         *     `search`: Search for results that satisfy `where`: CMA-ES over the ranges, separately for each seed.
         * @enum {string}
         */
        SamplingMethod: "grid" | "random" | "latin-hypercube" | "sobol" | "search";
        /**
         * Saved
         * @description Result of a change.
         */
        Saved: {
            /** @description As in the ETag header. */
            etag: string;
            /** @description Id of the scene. */
            id: string;
        };
        /**
         * Scene
         * @description A scene document, version 1.
         */
        Scene: {
            /**
             * @description Road users.
             * @default []
             */
            agents?: components["schemas"]["Agent"][];
            /**
             * @description `dragtraffic.scene`.
             * @constant
             */
            format: "dragtraffic.scene";
            /**
             * @description Futures added by the generator.
             * @default null
             */
            generated?: components["schemas"]["Generated"] | null;
            /**
             * @description Set by the server.
             * @default null
             */
            id?: string | null;
            /** @description Map, or its hash. */
            map: components["schemas"]["MapField"];
            /**
             * @description Source and notes.
             * @default {
             *       "created_with": null,
             *       "licence": null,
             *       "notes": "",
             *       "origin": {
             *         "crs": null,
             *         "rotation_rad": 0,
             *         "x_m": 0,
             *         "y_m": 0,
             *         "z_m": 0
             *       },
             *       "parent_id": null,
             *       "source": "",
             *       "source_id": null,
             *       "tags": []
             *     }
             */
            meta?: components["schemas"]["Meta"];
            /**
             * @description Display name.
             * @default
             */
            name?: string;
            /**
             * @description Traffic signals.
             * @default []
             */
            signals?: components["schemas"]["Signal"][];
            /** @description Steps. */
            time: components["schemas"]["Time"];
            /**
             * Format: uint64
             * @description 1.
             * @constant
             */
            version: 1;
        } & {
            [key: string]: unknown;
        };
        /**
         * SceneItem
         * @description A scene in a list.
         */
        SceneItem: {
            /**
             * Format: uint64
             * @description Size in the store, bytes.
             */
            bytes: number;
            /** @description Road users by type. */
            counts: components["schemas"]["Counts"];
            /** @description RFC 3339. */
            created_at: string;
            /** @description With quotes, as in the ETag header. */
            etag: string;
            /** @description Whether it has generated futures. */
            generated: boolean;
            /** @description Id of the scene. */
            id: string;
            /** @description Licence of the content. */
            licence: string | null;
            /** @description Content hash of the map, 64 hex digits. */
            map_sha256: string;
            /** @description Display name. */
            name: string;
            /** @description Owner of the scene, on a server whose scenes have owners. */
            owner?: string | null;
            /** @description Scene of which it is a variant. */
            parent_id: string | null;
            /** @description Whether it is read-only, as demo scenes and those of the data folder are; duplicate one to change it. */
            readonly: boolean;
            /** @description Rights of other users on it. */
            shared?: components["schemas"]["SceneShare"] | null;
            /** @description Source: format or tool. */
            source: string;
            /** @description Id in the source. */
            source_id: string | null;
            /**
             * Format: uint
             * @description Number of steps of 0.1 s.
             */
            steps: number;
            /** @description Search terms. */
            tags: string[];
            /** @description RFC 3339. */
            updated_at: string;
        };
        /**
         * SceneList
         * @description A page of scenes.
         */
        SceneList: {
            /** @description Send as `after` for the next page; null on the last. */
            next: string | null;
            scenes: components["schemas"]["SceneItem"][];
        };
        /**
         * ScenePatch
         * @description Merge patch of a scene's metadata.
         */
        ScenePatch: {
            /**
             * @description New name; null empties it.
             * @default null
             */
            name?: string | null;
            /**
             * @description New notes; null empties them.
             * @default null
             */
            notes?: string | null;
            /**
             * @description Rights of other users on the scene, where scenes have owners; only its owner sets them.
             * @default null
             */
            shared?: components["schemas"]["SceneShare"] | null;
            /**
             * @description New tags; null removes all.
             * @default null
             */
            tags?: string[] | null;
        };
        /**
         * SceneScore
         * @description Score of the scene. Shares are 0 to 1 and `None` where no road user qualifies.
         *
         *     Lists include events of the log, marked `in_log`. These events do not count in `collision_rate` and in the
         *     counts of road users. Distances, times and the other shares cover all motion, including recorded motion.
         */
        SceneScore: {
            /**
             * Format: double
             * @description Mean distance of the chosen future, metres.
             */
            ade_m: number | null;
            /** @description Vehicles that end at an angle to their lane; `worst` in radians. */
            askew: components["schemas"]["Stretch"][];
            /** @description The map has no drivable areas, and some lane widths were assumed by type. */
            assumed_width: boolean;
            /**
             * Format: double
             * @description Share of road users in any collision that is not in the log.
             */
            collision_rate: number;
            /**
             * Format: double
             * @description Share of road users in any collision, including those in the log (the paper's scenario collision
             *     rate).
             */
            collision_rate_with_log: number;
            /** @description By time, then by pair. */
            collisions: components["schemas"]["Collision"][];
            /** @description The pairs of the three lists with their measures. By time, then by pair. */
            encounters: components["schemas"]["Encounter"][];
            /** @description Step that counted as the end. */
            endpoint: components["schemas"]["Endpoint"];
            /** @description Means over the road users with fixed goal fields. */
            goal_error: components["schemas"]["GoalError"] | null;
            /**
             * Format: double
             * @description Share of road users with fixed goal fields that meet them all.
             */
            goals_reached: number | null;
            /** @description Braking harder than the threshold; `worst` in m/s2. */
            harsh_braking: components["schemas"]["Stretch"][];
            /** @description Steering harder than the threshold; `worst` is the sideways acceleration, m/s2. */
            harsh_steering: components["schemas"]["Stretch"][];
            /**
             * Format: double
             * @description Mean absolute heading error of the future that ends closest, radians.
             */
            heading_error_rad: number | null;
            /** @description Turns over a limit of lateral acceleration, yaw rate or curvature (generated motion only). */
            implausible_turns: components["schemas"]["Stretch"][];
            /** @description Greatest values of all generated road users, and their violations together. */
            kinematic: components["schemas"]["Kinematic"] | null;
            /**
             * Format: double
             * @description Greatest distance of the chosen future, metres (the log ghost's figure).
             */
            max_distance_m: number | null;
            /**
             * Format: double
             * @description Least mean distance of any future, metres.
             */
            min_ade_m: number | null;
            /**
             * Format: double
             * @description Least gap of any pair that is not parked, metres; below zero it is the depth of a collision or an
             *     overlap. Contact between pedestrians who walk together does not count.
             */
            min_distance_m: number | null;
            /**
             * Format: double
             * @description Least distance at the end of any future, metres.
             */
            min_fde_m: number | null;
            /** @description The pair with `min_ttc_s`. */
            min_ttc_pair: string[] | null;
            /**
             * Format: double
             * @description Least time to collision of any pair at constant velocity, seconds; none within the look-ahead.
             */
            min_ttc_s: number | null;
            /** @description By time, then by pair. */
            near_misses: components["schemas"]["NearMiss"][];
            /** @description Vehicles beyond the end of the map's roads; `worst` in metres from the lanes. */
            off_map: components["schemas"]["Stretch"][];
            /** @description Vehicles off the road, except those over a median. */
            off_road: components["schemas"]["Stretch"][];
            /**
             * Format: double
             * @description Greatest distance of a vehicle's corner from the road, metres.
             */
            offroad_max_m: number | null;
            /**
             * Format: double
             * @description Share of vehicle steps with a corner off the road.
             */
            offroad_share: number | null;
            /** @description Pedestrians along a lane, or across lanes beside a crosswalk; `worst` in metres walked. */
            on_carriageway: components["schemas"]["Stretch"][];
            /** @description Vehicles over the median between two directions. */
            over_median: components["schemas"]["Stretch"][];
            /**
             * Format: double
             * @description Share of road users with any overlap of boxes, however small.
             */
            overlap_rate: number;
            /** @description By time, then by pair. */
            overlaps: components["schemas"]["Overlap"][];
            /**
             * Format: double
             * @description Least post-encroachment time of crossing paths, seconds.
             */
            pet_s: number | null;
            /** @description Stop lines crossed at red. */
            red_lights: components["schemas"]["RedLight"][];
            /** @description Pedestrians that run; `worst` in m/s. */
            running: components["schemas"]["Stretch"][];
            /**
             * Format: double
             * @description Mean absolute speed error of the future that ends closest, m/s.
             */
            speed_error_mps: number | null;
            /** @description Vehicles above the speed limit; `worst` is the excess, m/s. */
            speeding: components["schemas"]["Stretch"][];
            /** @description Vehicles against the traffic. */
            wrong_way: components["schemas"]["Stretch"][];
            /**
             * Format: double
             * @description Share of moving vehicle steps against the direction of every lane there.
             */
            wrong_way_share: number | null;
        };
        /**
         * SceneShare
         * @description Rights of other users than the owner on a scene.
         *
         *     `nobody`: No rights: the scene is not found.
         *
         *     `read`: Read it, generate in it and copy it.
         *
         *     `edit`: Also change it; only its owner deletes it.
         * @enum {string}
         */
        SceneShare: "nobody" | "read" | "edit";
        /**
         * ScoreReply
         * @description Reply to a score request.
         */
        ScoreReply: {
            /** @description Scores of the road users by id. */
            agents: {
                [key: string]: components["schemas"]["AgentScore"];
            };
            /** @description The scene as a whole. */
            scene: components["schemas"]["SceneScore"];
            /** @description The thresholds that were used. */
            thresholds: components["schemas"]["Thresholds"];
        };
        /**
         * ScoreRequest
         * @description Body of a score. Exactly one of `scene` and `scene_id` is given.
         */
        ScoreRequest: {
            /**
             * @description With `scene_id`: the call is refused if the scene has changed.
             * @default null
             */
            etag?: string | null;
            /**
             * @description `all` or `regenerated`.
             * @default all
             */
            pairs?: components["schemas"]["PairChoice"];
            /** @description Reference; the log by default. */
            reference?: components["schemas"]["Reference"] | null;
            /**
             * @description The scene itself.
             * @default null
             */
            scene?: components["schemas"]["Scene"] | null;
            /**
             * @description A scene of this server.
             * @default null
             */
            scene_id?: string | null;
            /**
             * @description Thresholds; absent ones have their defaults.
             * @default {
             *       "along_lane_m": 3,
             *       "askew_rad": 0.26,
             *       "closing_speed_mps": 1,
             *       "covered_share": 0.5,
             *       "crosswalk_m": 15,
             *       "follow_brake_mps2": 3.35,
             *       "forced_brake_mps2": 3,
             *       "gap_m": 1,
             *       "goal_heading_rad": 0.02,
             *       "goal_position_m": 0.05,
             *       "goal_speed_mps": 0.05,
             *       "harsh_brake_mps2": 4,
             *       "harsh_lateral_mps2": 4,
             *       "iou": 0,
             *       "moving_mps": 0.5,
             *       "off_map_m": 5,
             *       "offroad_m": 0.1,
             *       "pass_gap_m": 0.4,
             *       "pass_mps": 3,
             *       "right_on_red": true,
             *       "running_mps": 2.5,
             *       "speeding_mps": 1.4,
             *       "speeding_share": 0.1,
             *       "ttc_s": 1.5
             *     }
             */
            thresholds?: components["schemas"]["Thresholds"];
            /** @description Motion to score, by road user; the others are scored with their chosen future, else with the log. */
            trajectories?: {
                [key: string]: components["schemas"]["Trajectory"];
            };
        } & ({
            scene: unknown;
        } | {
            scene_id: unknown;
        });
        /**
         * SearchAcceptedEvent
         * @description First event: the extent of the search.
         */
        SearchAcceptedEvent: {
            /**
             * Format: double
             * @description Time since the request was read, milliseconds.
             */
            elapsed_ms: number;
            /**
             * @description Type of the event.
             * @constant
             */
            event: "accepted";
            /** @description Id of the job. */
            job: string;
            /**
             * Format: uint
             * @description Number of jobs ahead of this one when it was queued.
             */
            queue_position: number;
            /**
             * Format: uint64
             * @description Revision of the request, if it has one.
             */
            revision?: number;
            /**
             * Format: uint64
             * @description Increases by one per event; a gap marks events that were dropped for a slow reader.
             */
            seq: number;
            /**
             * Format: uint64
             * @description Maximum number of tries.
             */
            tries: number;
            /** @description Paths of the numbers that are varied. */
            varied: string[];
        };
        /**
         * SearchBody
         * @description Body of a search. Exactly one of `scene` and `scene_id` is given.
         */
        SearchBody: {
            /**
             * @description With `scene_id`: the call is refused if the scene has changed.
             * @default null
             */
            etag?: string | null;
            /**
             * Format: uint64
             * @description Number of tries that satisfy the condition at which the search ends. Default: all tries are made.
             * @default null
             */
            found?: number | null;
            /**
             * @description Options of every generation.
             * @default {
             *       "diversity": 0.5,
             *       "horizon_s": 9,
             *       "modes": 6,
             *       "react": true,
             *       "start_s": 0,
             *       "steps": 5
             *     }
             */
            generate?: components["schemas"]["BatchOptions"];
            /**
             * @description The client's id of the job, which can cancel it.
             * @default null
             */
            job?: string | null;
            /**
             * @description How the numbers of the next tries are chosen.
             * @default search
             */
            method?: components["schemas"]["SamplingMethod"];
            /**
             * @description The scene itself; its map may be `{"ref":"sha256:HEX"}`.
             * @default null
             */
            scene?: components["schemas"]["Scene"] | null;
            /**
             * @description A scene of this server.
             * @default null
             */
            scene_id?: string | null;
            /**
             * Format: uint64
             * @description Seed of these choices.
             * @default 0
             */
            seed?: number;
            /**
             * @description Seeds of the generations: a count from 0 on, or a list.
             * @default 1
             */
            seeds?: number | number[];
            /**
             * @description The varied situation: a template with ranges of its figures, or conditions with ranges. A condition for
             *     several road users is searched for each of them.
             * @default {}
             */
            situation?: components["schemas"]["BatchSituation"];
            /**
             * Format: uint64
             * @description Number of tries per road user and seed; at most 1000 in total.
             * @default 100
             */
            tries?: number;
            /**
             * @description Condition on the figures of the score, such as `actor.min_ttc_s < 1.5 && collisions == 0`.
             * @default
             */
            where?: string;
        } & ({
            scene: unknown;
        } | {
            scene_id: unknown;
        });
        /**
         * SearchEnd
         * @description Why a search ended.
         *
         *     `found`: The requested number of tries satisfies the condition.
         *
         *     `tries`: All tries are made.
         *
         *     `time`: The time limit of a call is reached; the reply has the tries so far.
         * @enum {string}
         */
        SearchEnd: "found" | "tries" | "time";
        /**
         * SearchEvent
         * @description One event of a search. Exactly one of final and error ends it.
         */
        SearchEvent: components["schemas"]["SearchAcceptedEvent"] | components["schemas"]["SearchTriedEvent"] | components["schemas"]["SearchFinalEvent"] | components["schemas"]["ErrorEvent"] | components["schemas"]["HeartbeatEvent"];
        /**
         * SearchFinalEvent
         * @description Last event of a search that was not cancelled: all tries.
         */
        SearchFinalEvent: {
            /**
             * Format: double
             * @description Time since the request was read, milliseconds.
             */
            elapsed_ms: number;
            /** @description Why the search ended. */
            ended: components["schemas"]["SearchEnd"];
            /**
             * @description Type of the event.
             * @constant
             */
            event: "final";
            /** @description Numbers of the tries that satisfy the condition, in their order. */
            found: number[];
            /** @description Id of the job. */
            job: string;
            /**
             * Format: uint64
             * @description Number of the try that is nearest to the condition; null without a result.
             */
            nearest: number | null;
            /**
             * Format: uint64
             * @description Revision of the request, if it has one.
             */
            revision?: number;
            /**
             * Format: uint64
             * @description Increases by one per event; a gap marks events that were dropped for a slow reader.
             */
            seq: number;
            /** @description All tries. */
            tries: components["schemas"]["SearchTry"][];
        };
        /**
         * SearchTriedEvent
         * @description A try.
         */
        SearchTriedEvent: {
            /** @description Result code, six characters. */
            code?: string;
            /** @description Drawn numbers by path, such as `goal.speed_mps`. */
            drawn: {
                [key: string]: number;
            };
            /**
             * Format: double
             * @description Time since the request was read, milliseconds.
             */
            elapsed_ms: number;
            /**
             * @description Type of the event.
             * @constant
             */
            event: "try";
            /** @description Figures of the score by name. */
            figures: {
                [key: string]: number;
            };
            /**
             * Format: uint
             * @description Tries so far that satisfy the condition.
             */
            found: number;
            /** @description Whether the goal of the actor is met: met, missed, none. */
            goal?: string;
            /** @description Id of the job. */
            job: string;
            /**
             * Format: double
             * @description Distance from the condition, 0 if it holds; absent without a result.
             */
            miss?: number;
            /**
             * Format: uint64
             * @description Number of the try, from 0.
             */
            number: number;
            /** @description The road user that the situation affects. */
            other?: string;
            /** @description Its outcome. */
            outcome: components["schemas"]["UnitOutcome"];
            /** @description Code of the problem, if there is no result. */
            problem?: string;
            /** @description The body of a `POST /v1/generate` that gives the same result, without its scene; absent without a result. */
            request?: components["schemas"]["TryRequest"];
            /**
             * Format: uint64
             * @description Revision of the request, if it has one.
             */
            revision?: number;
            /**
             * Format: uint64
             * @description Increases by one per event; a gap marks events that were dropped for a slow reader.
             */
            seq: number;
            /** @description Behaviour of the actor of a template, in one sentence. */
            what?: string;
        };
        /**
         * SearchTry
         * @description One try.
         */
        SearchTry: {
            /** @description Result code, six characters. */
            code?: string;
            /** @description Drawn numbers by path, such as `goal.speed_mps`. */
            drawn: {
                [key: string]: number;
            };
            /** @description Figures of the score by name. */
            figures: {
                [key: string]: number;
            };
            /** @description Whether the goal of the actor is met: met, missed, none. */
            goal?: string;
            /**
             * Format: double
             * @description Distance from the condition, 0 if it holds; absent without a result.
             */
            miss?: number;
            /**
             * Format: uint64
             * @description Number of the try, from 0.
             */
            number: number;
            /** @description The road user that the situation affects. */
            other?: string;
            /** @description Its outcome. */
            outcome: components["schemas"]["UnitOutcome"];
            /** @description Code of the problem, if there is no result. */
            problem?: string;
            /** @description The body of a `POST /v1/generate` that gives the same result, without its scene; absent without a result. */
            request?: components["schemas"]["TryRequest"];
            /** @description Behaviour of the actor of a template, in one sentence. */
            what?: string;
        };
        /**
         * Shown
         * @description The future that was shown last.
         */
        Shown: {
            /**
             * Format: uint32
             * @description Its `anchor`.
             * @default null
             */
            anchor?: number | null;
            /** @description Box centres at every half second after the start, metres; at most 18 are used. */
            x_m: number[];
            /** @description Box centres, metres; as many as `x_m`. */
            y_m: number[];
        };
        /**
         * Signal
         * @description The signal of one lane over the scene.
         */
        Signal: {
            /** @description Id of the lane that obeys it. */
            lane: string;
            /** @description Run-length encoded states, in order of their first steps. */
            states: components["schemas"]["SignalRun"][];
            /**
             * @description Stop position.
             * @default null
             */
            stop_m?: components["schemas"]["Point"] | null;
        };
        /**
         * SignalRun
         * @description [first step, state]
         */
        SignalRun: [
            number,
            "unknown" | "arrow_stop" | "arrow_caution" | "arrow_go" | "stop" | "caution" | "go" | "flashing_stop" | "flashing_caution"
        ];
        /**
         * SkippedRecord
         * @description A record of a file that is not a scene.
         */
        SkippedRecord: {
            /**
             * Format: uint
             * @description Position in the file, from 0.
             */
            index: number;
            /** @description Why. */
            problem: components["schemas"]["Problem"];
        };
        /**
         * SnapshotReply
         * @description A run as text, without its scene.
         */
        SnapshotReply: {
            /**
             * Format: uint
             * @description Bytes of the snapshot.
             */
            bytes: number;
            /**
             * Format: uint64
             * @description Number of steps that the run has made.
             */
            number: number;
            /** @description The snapshot, base64, for `snapshot` of a new run. */
            snapshot: string;
        };
        /**
         * Source
         * @description Source of the value of a field.
         *
         *     `user`: Fixed by the user.
         *
         *     `log`: From the recording.
         *
         *     `default`: The kind's default.
         *
         *     `model`: Chosen by the generator.
         *
         *     `relation`: From the motion of the road user that the goal is relative to.
         * @enum {string}
         */
        Source: "user" | "log" | "default" | "model" | "relation";
        /**
         * Speeds
         * @description Range of start speeds of moving motor vehicles.
         */
        Speeds: {
            /**
             * Format: double
             * @description m/s; not less than `min_mps`.
             */
            max_mps: number;
            /**
             * Format: double
             * @description m/s.
             */
            min_mps: number;
        };
        /**
         * Start
         * @description Start of a road user; absent or null is free.
         */
        Start: {
            /**
             * Format: double
             * @description Heading, radians, wrapped when read; a request may have at most a full turn either way, 6.2832.
             */
            heading_rad?: number | null;
            /**
             * Format: double
             * @description m/s.
             */
            speed_mps?: number | null;
            /** @description Velocity in place of `speed_mps`; it also fixes a free heading. */
            velocity?: components["schemas"]["Velocity"] | null;
            /**
             * Format: double
             * @description Box centre, metres; with `y_m` or not at all.
             */
            x_m?: number | null;
            /**
             * Format: double
             * @description Box centre, metres; with `x_m` or not at all.
             */
            y_m?: number | null;
        } & (unknown & unknown);
        /**
         * StartRanges
         * @description Fields of a start; absent ones are those of the scene: from its conditions, else from the recording.
         */
        StartRanges: {
            /** @description Metres from the start in the scene, along the lane that it is on, else along its heading. */
            ahead_m?: components["schemas"]["Distribution"] | null;
            /** @description Heading in the frame of the scene, radians. */
            heading_rad?: components["schemas"]["Distribution"] | null;
            /** @description Metres to the left. */
            left_m?: components["schemas"]["Distribution"] | null;
            /** @description Metres per second. */
            speed_mps?: components["schemas"]["Distribution"] | null;
            /** @description Multiple of the speed in the scene, in place of `speed_mps`. */
            speed_times?: components["schemas"]["Distribution"] | null;
            /** @description Radians from the heading of that start. */
            turn_rad?: components["schemas"]["Distribution"] | null;
            /** @description Box centre in the frame of the scene, metres; with `y_m`. */
            x_m?: components["schemas"]["Distribution"] | null;
            /** @description Box centre in the frame of the scene, metres; with `x_m`. */
            y_m?: components["schemas"]["Distribution"] | null;
        };
        /**
         * State
         * @description Position, heading and velocity of a road user at one moment, scene frame.
         */
        State: {
            /** Format: double */
            heading_rad: number;
            /** Format: double */
            vx_mps: number;
            /** Format: double */
            vy_mps: number;
            /** Format: double */
            x_m: number;
            /** Format: double */
            y_m: number;
        };
        /**
         * StepBody
         * @description Body of a step.
         */
        StepBody: {
            /** @description States of all egos at the end of the step. */
            egos?: components["schemas"]["Ego"][];
            /**
             * Format: uint64
             * @description Number of the step: one more than the last. Repeating the last number returns the same reply.
             */
            number: number;
        };
        /**
         * StepReply
         * @description Result of a step.
         */
        StepReply: {
            /** @description Changes of plan with their causes. */
            changes: components["schemas"]["Change"][];
            /** @description Ids of the road users that entered. */
            entered: string[];
            /** @description Collisions and vehicles off the road that began in this step. */
            faults: components["schemas"]["RunFault"][];
            /** @description Road users that left. */
            left: components["schemas"]["Departure"][];
            /**
             * Format: uint64
             * @description Number of the step; 0 for the start.
             */
            number: number;
            /** @description States of all present road users by id, egos included. */
            states: {
                [key: string]: components["schemas"]["State"];
            };
            /**
             * Format: double
             * @description Scene time at its end, seconds.
             */
            time_s: number;
        };
        /**
         * StopSign
         * @description A stop sign.
         */
        StopSign: {
            /** @description Id, unique among stop signs. */
            id: string;
            /**
             * @description Ids of lanes that obey it.
             * @default []
             */
            lanes?: string[];
            /** @description Position of the sign. */
            position_m: components["schemas"]["Point"];
        };
        /**
         * StreamModes
         * @description Futures in drafts.
         *
         *     `chosen`: The chosen future of each road user.
         *
         *     `all`: All alternatives.
         * @enum {string}
         */
        StreamModes: "chosen" | "all";
        /**
         * Stretch
         * @description An event of one road user over a time interval.
         */
        Stretch: {
            /** @description The road user. */
            agent: string;
            /** @description Off the road and over a median: the road edge that is driven over, by its id in the map. */
            edge: string | null;
            /**
             * @description The event is in the log: the motion is the recorded one, or the recording has the same event at about
             *     the same time, at least as severe.
             */
            in_log: boolean;
            /**
             * Format: double
             * @description Scene time of the first step, seconds.
             */
            time_s: number;
            /**
             * Format: double
             * @description Scene time of the last step, seconds.
             */
            until_s: number;
            /**
             * Format: double
             * @description Greatest value, in the unit of its list: metres off the road, off the map, driven against the traffic or walked
             *     on the carriageway; m/s2 of braking or sideways acceleration; share of the limit for turns; m/s above the speed
             *     limit or of running; radians askew.
             */
            worst: number | null;
            /**
             * Format: double
             * @description Box centre where it is worst, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Box centre where it is worst, metres.
             */
            y_m: number;
        };
        /**
         * SupersededEvent
         * @description Last event of a call that a newer revision of its client replaced.
         */
        SupersededEvent: {
            /**
             * Format: uint64
             * @description The newer revision.
             */
            by_revision: number;
            /**
             * Format: double
             * @description Time since the request was read, milliseconds.
             */
            elapsed_ms: number;
            /**
             * @description Type of the event.
             * @constant
             */
            event: "superseded";
            /** @description Id of the job. */
            job: string;
            /**
             * Format: uint64
             * @description Revision of the request, if it has one.
             */
            revision?: number;
            /**
             * Format: uint64
             * @description Increases by one per event; a gap marks events that were dropped for a slow reader.
             */
            seq: number;
        };
        /**
         * Template
         * @description A layout by name, to start from.
         * @enum {string}
         */
        Template: "three-arms" | "four-arms" | "roundabout" | "merge" | "straight" | "curve" | "school-street" | "car-park";
        /**
         * TemplateItem
         * @description A template and its own parameters.
         */
        TemplateItem: {
            /** @description The template with all its parameters. */
            layout: components["schemas"]["Layout"];
            /** @description Display name. */
            title: string;
        };
        /**
         * TemplateList
         * @description All templates.
         */
        TemplateList: {
            templates: components["schemas"]["TemplateItem"][];
        };
        /**
         * Thresholds
         * @description Thresholds of events. Ones absent in a document have their defaults.
         */
        Thresholds: {
            /**
             * Format: double
             * @description Walking farther than this along a lane is walking on the carriageway, metres.
             * @default 3
             */
            along_lane_m?: number;
            /**
             * Format: double
             * @description A vehicle is askew if it ends at more than this angle to every lane, radians.
             * @default 0.26
             */
            askew_rad?: number;
            /**
             * Format: double
             * @description Near miss: only when the gap shrinks faster than this, m/s.
             * @default 1
             */
            closing_speed_mps?: number;
            /**
             * Format: double
             * @description Boxes also collide when more than this share of the smaller one is covered: a child under a bus has a
             *     tiny intersection over union. A value above 1 disables the rule (the paper's form).
             * @default 0.5
             */
            covered_share?: number;
            /**
             * Format: double
             * @description Crossing beside a crosswalk, within this distance of it, is walking on the carriageway, metres.
             * @default 15
             */
            crosswalk_m?: number;
            /**
             * Format: double
             * @description Near miss of a follower: only if it must brake harder than this to avoid the collision, m/s2 (DRAC,
             *     3.35 in Archer 2005).
             * @default 3.35
             */
            follow_brake_mps2?: number;
            /**
             * Format: double
             * @description A road user that gives way is forced to brake if it brakes harder than this, m/s2.
             * @default 3
             */
            forced_brake_mps2?: number;
            /**
             * Format: double
             * @description Near miss: gap below this, metres.
             * @default 1
             */
            gap_m?: number;
            /**
             * Format: double
             * @description Goal heading met within this, radians.
             * @default 0.02
             */
            goal_heading_rad?: number;
            /**
             * Format: double
             * @description Goal position met within this, metres.
             * @default 0.05
             */
            goal_position_m?: number;
            /**
             * Format: double
             * @description Goal speed met within this, m/s.
             * @default 0.05
             */
            goal_speed_mps?: number;
            /**
             * Format: double
             * @description Braking above this is harsh, m/s2.
             * @default 4
             */
            harsh_brake_mps2?: number;
            /**
             * Format: double
             * @description Sideways acceleration above this is harsh, m/s2.
             * @default 4
             */
            harsh_lateral_mps2?: number;
            /**
             * Format: double
             * @description Boxes collide when their intersection over union is above this (the paper's collision rate: 0.02).
             * @default 0
             */
            iou?: number;
            /**
             * Format: double
             * @description Below this speed, a road user stands, m/s.
             * @default 0.5
             */
            moving_mps?: number;
            /**
             * Format: double
             * @description Off the map: no lane and no road edge within this distance, metres.
             * @default 5
             */
            off_map_m?: number;
            /**
             * Format: double
             * @description A vehicle is off the road if a corner is farther outside than this, metres.
             * @default 0.1
             */
            offroad_m?: number;
            /**
             * Format: double
             * @description Near miss of two that pass each other at more than `pass_mps`: gap below this, metres.
             * @default 0.4
             */
            pass_gap_m?: number;
            /**
             * Format: double
             * @description Near miss of two that pass each other: only when their relative speed is above this, m/s.
             * @default 3
             */
            pass_mps?: number;
            /**
             * @description Turning right at red after a stop is allowed.
             * @default true
             */
            right_on_red?: boolean;
            /**
             * Format: double
             * @description A pedestrian faster than this runs, m/s.
             * @default 2.5
             */
            running_mps?: number;
            /**
             * Format: double
             * @description Speeding: see `speeding_share`, m/s.
             * @default 1.4
             */
            speeding_mps?: number;
            /**
             * Format: double
             * @description Speeding: above the lane's limit by more than this share of it and `speeding_mps` together.
             * @default 0.1
             */
            speeding_share?: number;
            /**
             * Format: double
             * @description Near miss: time to collision below this, seconds. The search ends at [`LOOK_AHEAD_S`].
             * @default 1.5
             */
            ttc_s?: number;
        };
        /**
         * Time
         * @description Steps of the scene.
         */
        Time: {
            /**
             * Format: uint64
             * @description The source's "current" step.
             * @default 0
             */
            now_step?: number;
            /**
             * Format: double
             * @description Always 0.1.
             * @default 0.1
             * @constant
             */
            step_s?: 0.1;
            /**
             * Format: uint64
             * @description Number of steps of the scene.
             */
            steps: number;
        };
        /**
         * Timing
         * @description Durations of the stages, milliseconds.
         */
        Timing: {
            /**
             * Format: double
             * @description Joint choice of modes.
             */
            choice_ms: number;
            /**
             * Format: double
             * @description Encoding of the map and the road users.
             */
            encode_ms: number;
            /**
             * Format: double
             * @description Initial draft.
             */
            initial_ms: number;
            /**
             * Format: double
             * @description Wait for a worker.
             */
            queue_ms: number;
            /**
             * Format: double
             * @description Scores.
             */
            score_ms: number;
            /** @description Each refinement step. */
            step_ms: number[];
        };
        /**
         * Track
         * @description Recorded states as columns, one value per step from `first_step`.
         */
        Track: {
            /**
             * Format: uint64
             * @description Scene step of the first value.
             */
            first_step: number;
            /** @description Radians. */
            heading_rad: number[];
            /**
             * @description Half-open ranges of scene steps at which the road user was seen; all when absent. Values
             *     outside them are written as 0 and ignored.
             * @default null
             */
            valid?: number[][] | null;
            /** @description m/s. */
            vx_mps: number[];
            /** @description m/s. */
            vy_mps: number[];
            /** @description Box centre, metres. */
            x_m: number[];
            /** @description Box centre, metres. */
            y_m: number[];
            /**
             * @description Box centre's height, metres.
             * @default null
             */
            z_m?: number[] | null;
        };
        /**
         * Traffic
         * @description Side of the road on which traffic drives.
         * @enum {string}
         */
        Traffic: "right-hand" | "left-hand";
        /**
         * Trait
         * @description A property of a motion that a user can name and want changed.
         */
        Trait: {
            /** @constant */
            trait: "pace";
        } | {
            /** @constant */
            trait: "gap";
        } | {
            /** @constant */
            trait: "harshness";
        } | {
            /** @constant */
            trait: "standing";
        } | {
            /** @constant */
            trait: "from_log";
        } | {
            /** @constant */
            trait: "first";
            /** @description The one that goes first. */
            who: string;
            /** @description The other. */
            with: string;
        } | {
            /** @description The manoeuvre. */
            manoeuvre: components["schemas"]["Manoeuvre"];
            /** @constant */
            trait: "does";
            /** @description The road user. */
            who: string;
        };
        /**
         * Trajectory
         * @description Motion of one road user as columns, one value per step from `first_step`.
         */
        Trajectory: {
            /**
             * Format: uint64
             * @description Scene step of the first value.
             */
            first_step: number;
            heading_rad: number[];
            vx_mps: number[];
            vy_mps: number[];
            x_m: number[];
            y_m: number[];
        };
        /**
         * TryRequest
         * @description A generation that reproduces the result of a try.
         */
        TryRequest: {
            /** @description Road users to generate; absent for all. */
            agents?: string[];
            /** @description Conditions by road user. */
            conditions: {
                [key: string]: components["schemas"]["Conditions"];
            };
            /**
             * Format: double
             * @description Scale of the noise, which makes seeds differ.
             * @default 0.5
             */
            diversity: number;
            /**
             * Format: double
             * @description Time to generate, seconds.
             * @default 9
             */
            horizon_s: number;
            /**
             * Format: uint64
             * @description Number of futures planned for each road user.
             * @default 6
             */
            modes: number;
            /**
             * @description Let the other road users react.
             * @default true
             */
            react: boolean;
            /**
             * Format: double
             * @description Replan interval, seconds: 3, 6 or 9.
             */
            replan_interval_s?: number;
            /**
             * Format: uint64
             * @description Seed of the random draws.
             */
            seed: number;
            /**
             * Format: double
             * @description Scene time of the start, seconds.
             * @default 0
             */
            start_s: number;
            /**
             * Format: uint64
             * @description Refinement steps.
             * @default 5
             */
            steps: number;
        };
        /**
         * Turn
         * @description A direction out of a junction, as seen from the entry.
         * @enum {string}
         */
        Turn: "left" | "straight" | "right";
        /**
         * TurnAcross
         * @description Left turns (right turns in left-hand traffic) while oncoming traffic has green.
         *
         *     `permissive`: They have green at the same time and give way.
         *
         *     `protected`: They have a separate phase.
         * @enum {string}
         */
        TurnAcross: "permissive" | "protected";
        /**
         * UnitOutcome
         * @description Outcome of a unit.
         *
         *     `kept`: Its result satisfies the condition, or there is none.
         *
         *     `left-out`: Its result does not satisfy the condition.
         *
         *     `nobody-fits`: No road user of the scene fits the situation.
         *
         *     `failed`: It has no result; the row has the problem.
         * @enum {string}
         */
        UnitOutcome: "kept" | "left-out" | "nobody-fits" | "failed";
        /**
         * Velocity
         * @description A velocity in place of a speed: `x_mps` and `y_mps`, or, in a goal of frame `agent`,
         *     `ahead_mps` and `left_mps`.
         */
        Velocity: {
            /**
             * Format: double
             * @description m/s along the start's heading.
             */
            ahead_mps?: number | null;
            /**
             * Format: double
             * @description m/s to the left of the start's heading.
             */
            left_mps?: number | null;
            /**
             * Format: double
             * @description m/s east.
             */
            x_mps?: number | null;
            /**
             * Format: double
             * @description m/s north.
             */
            y_mps?: number | null;
        } & (unknown & unknown & unknown & unknown);
        /**
         * Verdict
         * @description The user's verdict on a card.
         *
         *     `keep`: The card is kept.
         *
         *     `reject`: The card is rejected.
         * @enum {string}
         */
        Verdict: "keep" | "reject";
        /**
         * Via
         * @description A via point of a road user.
         */
        Via: {
            /**
             * Format: double
             * @description Scene time at which it is passed, seconds, with a tolerance of half a second; any time if free. Later than
             *     those before it and no later than the goal. Snapped to 0.1.
             */
            time_s?: number | null;
            /**
             * Format: double
             * @description Greatest distance at which it counts as passed, metres; 1 when absent.
             */
            tolerance_m?: number | null;
            /**
             * Format: double
             * @description Box centre, metres, scene frame.
             */
            x_m: number;
            /**
             * Format: double
             * @description Box centre, metres, scene frame.
             */
            y_m: number;
        };
        /**
         * Warning
         * @description A warning: an unlikely request that was carried out.
         */
        Warning: {
            /** @description The road user concerned. */
            agent: string | null;
            /** @description Code for programs. */
            code: components["schemas"]["WarningCode"];
            /** @description The warning in English. */
            detail: string;
            /** @description The warning as data. */
            message: components["schemas"]["Message"];
        };
        /**
         * WarningCode
         * @description Kind of a warning.
         *
         *     `goal-unreachable`: No future within the limits meets the goal.
         *
         *     `goal-off-road`: No lane is near the goal.
         *
         *     `start-off-road`: No lane is near the start.
         *
         *     `start-overlaps`: The start overlaps another road user.
         *
         *     `extrapolated`: A recording was extrapolated beyond its end.
         *
         *     `via-missed`: The shown future misses a via point.
         *
         *     `nothing-generated`: No road user was requested, and none has to continue beyond its known motion.
         * @enum {string}
         */
        WarningCode: "goal-unreachable" | "goal-off-road" | "start-off-road" | "start-overlaps" | "extrapolated" | "via-missed" | "nothing-generated";
        /**
         * WeightsInfo
         * @description Description of the weights of an expert.
         */
        WeightsInfo: {
            /** Format: double */
            horizon_s: number;
            licence: string;
            /** Format: uint */
            modes: number;
            name: string;
            /** Format: uint */
            parameters: number;
            sha256: string;
            trained_on: string;
            /** @description Whether the weights are random, for tests. */
            untrained: boolean;
        };
        /**
         * Who
         * @description `"all"` or a list of ids.
         */
        Who: components["schemas"]["All"] | string[];
        /**
         * Wish
         * @description A wish: a trait and a direction.
         */
        Wish: {
            /** @description Direction of the wish. */
            wants: components["schemas"]["WishDirection"];
        } & ({
            /** @constant */
            trait: "pace";
        } | {
            /** @constant */
            trait: "gap";
        } | {
            /** @constant */
            trait: "harshness";
        } | {
            /** @constant */
            trait: "standing";
        } | {
            /** @constant */
            trait: "from_log";
        } | {
            /** @constant */
            trait: "first";
            /** @description The one that goes first. */
            who: string;
            /** @description The other. */
            with: string;
        } | {
            /** @description The manoeuvre. */
            manoeuvre: components["schemas"]["Manoeuvre"];
            /** @constant */
            trait: "does";
            /** @description The road user. */
            who: string;
        });
        /**
         * WishDirection
         * @description Direction of a wish.
         *
         *     `more`: More of it; for an order or a manoeuvre: yes.
         *
         *     `less`: Less of it; for an order or a manoeuvre: no.
         * @enum {string}
         */
        WishDirection: "more" | "less";
    };
    responses: never;
    parameters: never;
    requestBodies: never;
    headers: never;
    pathItems: never;
}
export type $defs = Record<string, never>;
export interface operations {
    healthz: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description the process answers */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Health"];
                };
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy";
                    };
                };
            };
        };
    };
    metrics: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Prometheus text */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/plain": string;
                };
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy";
                    };
                };
            };
        };
    };
    readyz: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description ready for work */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Health"];
                };
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, not-ready */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "not-ready";
                    };
                };
            };
        };
    };
    exportUnsaved: {
        parameters: {
            query?: {
                /** @description Id of the format. */
                format?: string;
                /** @description Sample of the generated futures; the chosen one when absent. */
                sample?: number;
                /** @description `chosen` futures, or only the `log`. */
                mode?: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Scene"];
                "application/vnd.dragtraffic.scene+json": components["schemas"]["Scene"];
            };
        };
        responses: {
            /** @description the file */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/geo+json": string;
                    "application/json": string;
                    "application/octet-stream": string;
                    "application/vnd.apache.parquet": string;
                    "application/vnd.dragtraffic.scene+json": components["schemas"]["Scene"];
                    "application/xml": string;
                    "application/zip": string;
                    "text/csv": string;
                    "text/html": string;
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, half-position, start-missing, unknown-map, unknown-agent, too-many-agents, map-too-large, map-too-complex, unsupported-version, format-unknown, cannot-represent, reply-too-large */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "start-missing" | "unknown-map" | "unknown-agent" | "too-many-agents" | "map-too-large" | "map-too-complex" | "unsupported-version" | "format-unknown" | "cannot-represent" | "reply-too-large";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    openLine: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description the connection is a WebSocket now */
            101: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description upgrade-required */
            426: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "upgrade-required";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy";
                    };
                };
            };
        };
    };
    generate: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example {
                 *       "agents": [
                 *         "5"
                 *       ],
                 *       "conditions": {
                 *         "5": {
                 *           "goal": {
                 *             "speed_mps": 6,
                 *             "x_m": 14,
                 *             "y_m": 0.4
                 *           }
                 *         }
                 *       },
                 *       "scene_id": "demo-crossing",
                 *       "seed": 7
                 *     }
                 */
                "application/json": components["schemas"]["GenerateRequest"];
            };
        };
        responses: {
            /** @description the answer */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["FinalEvent"];
                    "application/x-ndjson": components["schemas"]["Event"];
                    "text/event-stream": components["schemas"]["Event"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description not-acceptable */
            406: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-acceptable";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled, exists, superseded, stale-revision */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled" | "exists" | "superseded" | "stale-revision";
                    };
                };
            };
            /** @description stale-etag */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "stale-etag";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, half-position, start-missing, unknown-map, unknown-agent, too-many-agents, map-too-large, map-too-complex, unsupported-version, not-asked, reply-too-large, too-much-work */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "start-missing" | "unknown-map" | "unknown-agent" | "too-many-agents" | "map-too-large" | "map-too-complex" | "unsupported-version" | "not-asked" | "reply-too-large" | "too-much-work";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal, non-finite-output */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal" | "non-finite-output";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    importScenes: {
        parameters: {
            query?: {
                /** @description Id of the format; recognised from the content if absent or `auto`. */
                format?: string;
                /** @description Records to take, such as `0..9` (both ends), or one number. */
                index?: string;
                /**
                 * @description Part of a map to read: `X,Y,RADIUS` keeps the content within RADIUS metres (10 to 5000) of a position in the
                 *     coordinates of the file (longitude, latitude if it has degrees).
                 */
                around?: string;
                /** @description Return the scenes and store nothing. */
                dry_run?: boolean;
                /** @description Name of the file, a label only. */
                name?: string;
            };
            header?: {
                "Idempotency-Key"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/octet-stream": string;
                "multipart/form-data": {
                    /** Format: binary */
                    columns?: string;
                    file: string[];
                    /** Format: binary */
                    net?: string;
                };
            };
        };
        responses: {
            /** @description dry run */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ImportedBody"];
                };
            };
            /** @description stored */
            201: {
                headers: {
                    /** @description address of the first stored scene */
                    Location?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ImportedBody"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, half-position, start-missing, unknown-map, unknown-agent, too-many-agents, map-too-large, map-too-complex, unsupported-version, format-unknown, cannot-represent, pickle-refused, licence-refused, idempotency-key-reused */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "start-missing" | "unknown-map" | "unknown-agent" | "too-many-agents" | "map-too-large" | "map-too-complex" | "unsupported-version" | "format-unknown" | "cannot-represent" | "pickle-refused" | "licence-refused" | "idempotency-key-reused";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
            /** @description store-full */
            507: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "store-full";
                    };
                };
            };
        };
    };
    info: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description the server */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Info"];
                };
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy";
                    };
                };
            };
        };
    };
    cancelJob: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                job: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description no longer running */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy";
                    };
                };
            };
        };
    };
    makeMap: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example {
                 *       "parameters": {
                 *         "control": "equal",
                 *         "kerb_radius_m": 6
                 *       },
                 *       "template": "four-arms"
                 *     }
                 */
                "application/json": components["schemas"]["MapBody"];
            };
        };
        responses: {
            /** @description the map */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["MapReply"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    listTemplates: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description all templates */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TemplateList"];
                };
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy";
                    };
                };
            };
        };
    };
    listMaps: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description all maps */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["MapList"];
                };
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable";
                    };
                };
            };
        };
    };
    readMap: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                sha256: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description the map */
            200: {
                headers: {
                    /** @description hash of the map */
                    ETag?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Map"];
                };
            };
            /** @description not changed */
            304: {
                headers: {
                    /** @description hash of the map */
                    ETag?: string;
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    place: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example {
                 *       "density": {
                 *         "count": 20
                 *       },
                 *       "keep": [],
                 *       "region": {
                 *         "circle": {
                 *           "radius_m": 60,
                 *           "x_m": 0,
                 *           "y_m": 0
                 *         }
                 *       },
                 *       "scene_id": "demo-crossing",
                 *       "seed": 7,
                 *       "types": {
                 *         "cyclist": 0.1,
                 *         "pedestrian": 0.2,
                 *         "vehicle": 0.7
                 *       }
                 *     }
                 */
                "application/json": components["schemas"]["PlaceBody"];
            };
        };
        responses: {
            /** @description result of the placement */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PlaceReply"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description stale-etag */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "stale-etag";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, half-position, start-missing, unknown-map, unknown-agent, too-many-agents, map-too-large, map-too-complex, unsupported-version */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "start-missing" | "unknown-map" | "unknown-agent" | "too-many-agents" | "map-too-large" | "map-too-complex" | "unsupported-version";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    beginRun: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example {
                 *       "egos": [
                 *         "5"
                 *       ],
                 *       "scene_id": "demo-crossing",
                 *       "seed": 7
                 *     }
                 */
                "application/json": components["schemas"]["RunBody"];
            };
        };
        responses: {
            /** @description the run */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunReply"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description stale-etag */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "stale-etag";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, half-position, start-missing, unknown-map, unknown-agent, too-many-agents, map-too-large, map-too-complex, unsupported-version */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "start-missing" | "unknown-map" | "unknown-agent" | "too-many-agents" | "map-too-large" | "map-too-complex" | "unsupported-version";
                    };
                };
            };
            /** @description too-many-requests, too-many-runs */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests" | "too-many-runs";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal, non-finite-output */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal" | "non-finite-output";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    readRun: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description the run */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunReply"];
                    "application/x-ndjson": components["schemas"]["RunEvent"];
                    "text/event-stream": components["schemas"]["RunEvent"];
                };
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description not-acceptable */
            406: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-acceptable";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    deleteRun: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description forgotten */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy";
                    };
                };
            };
        };
    };
    peekRun: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example {
                 *       "plans": {}
                 *     }
                 */
                "application/json": components["schemas"]["PeekBody"];
            };
        };
        responses: {
            /** @description predicted motion */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PeekReply"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, unknown-agent */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "unknown-agent";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal, non-finite-output */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal" | "non-finite-output";
                    };
                };
            };
            /** @description busy, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    readRunScene: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description the scene */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Scene"];
                };
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    saveRun: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description the run */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SnapshotReply"];
                };
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    openRunLine: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description the connection is a WebSocket now */
            101: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description upgrade-required */
            426: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "upgrade-required";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy";
                    };
                };
            };
        };
    };
    stepRun: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example {
                 *       "egos": [
                 *         {
                 *           "heading_rad": 1.57,
                 *           "id": "5",
                 *           "vx_mps": 0,
                 *           "vy_mps": 8,
                 *           "x_m": 1.8,
                 *           "y_m": -20
                 *         }
                 *       ],
                 *       "number": 1
                 *     }
                 */
                "application/json": components["schemas"]["StepBody"];
            };
        };
        responses: {
            /** @description result of the step */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["StepReply"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled, step-order */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled" | "step-order";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, unknown-agent */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "unknown-agent";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal, non-finite-output */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal" | "non-finite-output";
                    };
                };
            };
            /** @description busy, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    listScenes: {
        parameters: {
            query?: {
                /** @description Maximum number of scenes per page, 1 to 200. */
                limit?: number;
                /** @description `next` of the previous page. */
                after?: string;
                /** @description Text in the name, case ignored. */
                q?: string;
                /** @description One tag. */
                tag?: string;
                /** @description Scene that the listed ones are variants of. */
                parent?: string;
                /** @description `updated` or `name`, with `-` before it for descending order. */
                sort?: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description a page */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SceneList"];
                };
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable";
                    };
                };
            };
        };
    };
    createScene: {
        parameters: {
            query?: never;
            header?: {
                "Idempotency-Key"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Scene"];
                "application/vnd.dragtraffic.scene+json": components["schemas"]["Scene"];
            };
        };
        responses: {
            /** @description stored */
            201: {
                headers: {
                    /** @description version of the scene */
                    ETag?: string;
                    /** @description address of the scene */
                    Location?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Saved"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled, exists */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled" | "exists";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, half-position, start-missing, unknown-map, unknown-agent, too-many-agents, map-too-large, map-too-complex, unsupported-version, idempotency-key-reused */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "start-missing" | "unknown-map" | "unknown-agent" | "too-many-agents" | "map-too-large" | "map-too-complex" | "unsupported-version" | "idempotency-key-reused";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
            /** @description store-full */
            507: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "store-full";
                    };
                };
            };
        };
    };
    readScene: {
        parameters: {
            query?: {
                /** @description The whole map or only its hash: `inline` or `ref`. */
                map?: ("inline" | "ref") & Record<string, never>;
            };
            header?: never;
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description the scene */
            200: {
                headers: {
                    /** @description version of the scene */
                    ETag?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/vnd.dragtraffic.scene+json": components["schemas"]["Scene"];
                };
            };
            /** @description not changed */
            304: {
                headers: {
                    /** @description version of the scene */
                    ETag?: string;
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    replaceScene: {
        parameters: {
            query?: never;
            header?: {
                "If-Match"?: string | null;
                "If-None-Match"?: string | null;
            };
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Scene"];
                "application/vnd.dragtraffic.scene+json": components["schemas"]["Scene"];
            };
        };
        responses: {
            /** @description replaced */
            200: {
                headers: {
                    /** @description version of the scene */
                    ETag?: string;
                    /** @description address of the scene */
                    Location?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Saved"];
                };
            };
            /** @description created */
            201: {
                headers: {
                    /** @description version of the scene */
                    ETag?: string;
                    /** @description address of the scene */
                    Location?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Saved"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin, read-only */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin" | "read-only";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description stale-etag */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "stale-etag";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, half-position, start-missing, unknown-map, unknown-agent, too-many-agents, map-too-large, map-too-complex, unsupported-version */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "start-missing" | "unknown-map" | "unknown-agent" | "too-many-agents" | "map-too-large" | "map-too-complex" | "unsupported-version";
                    };
                };
            };
            /** @description precondition-required */
            428: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "precondition-required";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
            /** @description store-full */
            507: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "store-full";
                    };
                };
            };
        };
    };
    deleteScene: {
        parameters: {
            query?: never;
            header: {
                "If-Match": string;
            };
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description deleted */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin, read-only */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin" | "read-only";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description stale-etag */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "stale-etag";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description precondition-required */
            428: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "precondition-required";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable";
                    };
                };
            };
            /** @description store-full */
            507: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "store-full";
                    };
                };
            };
        };
    };
    renameScene: {
        parameters: {
            query?: never;
            header: {
                "If-Match": string;
            };
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example {
                 *       "name": "left turn, late"
                 *     }
                 */
                "application/merge-patch+json": components["schemas"]["ScenePatch"];
            };
        };
        responses: {
            /** @description changed */
            200: {
                headers: {
                    /** @description version of the scene */
                    ETag?: string;
                    /** @description address of the scene */
                    Location?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Saved"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin, read-only */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin" | "read-only";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description stale-etag */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "stale-etag";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, half-position, start-missing, unknown-map, unknown-agent, too-many-agents, map-too-large, map-too-complex, unsupported-version */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "start-missing" | "unknown-map" | "unknown-agent" | "too-many-agents" | "map-too-large" | "map-too-complex" | "unsupported-version";
                    };
                };
            };
            /** @description precondition-required */
            428: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "precondition-required";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
            /** @description store-full */
            507: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "store-full";
                    };
                };
            };
        };
    };
    duplicateScene: {
        parameters: {
            query?: never;
            header?: {
                "Idempotency-Key"?: string | null;
            };
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody?: {
            content: {
                /**
                 * @example {
                 *       "name": "left turn, later"
                 *     }
                 */
                "application/json": components["schemas"]["DuplicateRequest"];
            };
        };
        responses: {
            /** @description stored */
            201: {
                headers: {
                    /** @description version of the scene */
                    ETag?: string;
                    /** @description address of the scene */
                    Location?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Saved"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, idempotency-key-reused */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "idempotency-key-reused";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
            /** @description store-full */
            507: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "store-full";
                    };
                };
            };
        };
    };
    exportScene: {
        parameters: {
            query?: {
                /** @description Id of the format. */
                format?: string;
                /** @description Sample of the generated futures; the chosen one when absent. */
                sample?: number;
                /** @description `chosen` futures, or only the `log`. */
                mode?: string;
            };
            header?: never;
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description the file */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/geo+json": string;
                    "application/json": string;
                    "application/octet-stream": string;
                    "application/vnd.apache.parquet": string;
                    "application/vnd.dragtraffic.scene+json": components["schemas"]["Scene"];
                    "application/xml": string;
                    "application/zip": string;
                    "text/csv": string;
                    "text/html": string;
                };
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, format-unknown, cannot-represent, reply-too-large */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "format-unknown" | "cannot-represent" | "reply-too-large";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    previewScene: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description the scene, reduced */
            200: {
                headers: {
                    /** @description version of the scene */
                    ETag?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/vnd.dragtraffic.scene+json": components["schemas"]["Scene"];
                };
            };
            /** @description not changed */
            304: {
                headers: {
                    /** @description version of the scene */
                    ETag?: string;
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description bad-header, bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    score: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example {
                 *       "scene_id": "demo-crossing"
                 *     }
                 */
                "application/json": components["schemas"]["ScoreRequest"];
            };
        };
        responses: {
            /** @description the score */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ScoreReply"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled";
                    };
                };
            };
            /** @description stale-etag */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "stale-etag";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, half-position, start-missing, unknown-map, unknown-agent, too-many-agents, map-too-large, map-too-complex, unsupported-version */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "start-missing" | "unknown-map" | "unknown-agent" | "too-many-agents" | "map-too-large" | "map-too-complex" | "unsupported-version";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
    search: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example {
                 *       "found": 3,
                 *       "scene_id": "demo-crossing",
                 *       "situation": {
                 *         "parameters": {
                 *           "gap_m": {
                 *             "uniform": [
                 *               2,
                 *               8
                 *             ]
                 *           }
                 *         },
                 *         "template": "cut-in"
                 *       },
                 *       "tries": 20,
                 *       "where": "actor.min_ttc_s < 1.5 && collisions == 0"
                 *     }
                 */
                "application/json": components["schemas"]["SearchBody"];
            };
        };
        responses: {
            /** @description the tries */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SearchFinalEvent"];
                    "application/x-ndjson": components["schemas"]["SearchEvent"];
                    "text/event-stream": components["schemas"]["SearchEvent"];
                };
            };
            /** @description bad-header, bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-header" | "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unauthorized";
                    };
                };
            };
            /** @description forbidden, cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "forbidden" | "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description not-found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-found";
                    };
                };
            };
            /** @description not-acceptable */
            406: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-acceptable";
                    };
                };
            };
            /** @description head-timeout, body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "head-timeout" | "body-timeout";
                    };
                };
            };
            /** @description cancelled, exists */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cancelled" | "exists";
                    };
                };
            };
            /** @description stale-etag */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "stale-etag";
                    };
                };
            };
            /** @description body-too-large, decoded-too-large, expansion-too-high */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-too-large" | "decoded-too-large" | "expansion-too-high";
                    };
                };
            };
            /** @description uri-too-long */
            414: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "uri-too-long";
                    };
                };
            };
            /** @description unsupported-media-type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "unsupported-media-type";
                    };
                };
            };
            /** @description host-not-allowed */
            421: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "host-not-allowed";
                    };
                };
            };
            /** @description invalid-field, out-of-range, half-position, start-missing, unknown-map, unknown-agent, too-many-agents, map-too-large, map-too-complex, unsupported-version */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "start-missing" | "unknown-map" | "unknown-agent" | "too-many-agents" | "map-too-large" | "map-too-complex" | "unsupported-version";
                    };
                };
            };
            /** @description too-many-requests */
            429: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "too-many-requests";
                    };
                };
            };
            /** @description headers-too-large */
            431: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "headers-too-large";
                    };
                };
            };
            /** @description internal */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "internal";
                    };
                };
            };
            /** @description busy, store-unavailable, shutting-down */
            503: {
                headers: {
                    /** @description seconds until another attempt */
                    "Retry-After"?: number;
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "busy" | "store-unavailable" | "shutting-down";
                    };
                };
            };
            /** @description generate-timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "generate-timeout";
                    };
                };
            };
        };
    };
}
