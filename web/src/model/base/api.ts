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
         * Experts are warm, the store reads and writes, the queue has room, workers, readers and the data folder answer, and
         *     a worker is free of calls that have ended, for long calls and for those in the background. `failing` lists those of
         *     `experts`, `store`, `queue`, `workers`, `readers`, `long-workers`, `background-workers` and `data` that fail.
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
        /** Cancels a generation; an id that is not under way is nothing to do. */
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
         *     stop signs, lights over nine seconds. Stores nothing.
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
        /** Reads a map. It never changes, so it may be kept for ever. */
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
         * Places road users on a map: vehicles on lanes and parked at kerbs, people on crosswalks and pavements,
         *     cyclists on bike lanes or on the right; traffic at a rate from the arms, and parked cars. Boxes keep 0.1 m
         *     apart and all centres lie in the region. Fewer than requested is no error. Stores nothing.
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
         * Begins a run in a scene, or takes one up from a snapshot. The client drives the road users in `egos`; the server
         *     drives all others from step to step. They know what has happened and what egos announce. The run is kept in memory
         *     and forgotten when it is not used for `idle_s`.
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
         * Says how a run is: who is where, how long it may go on, when it was used. By Accept, NDJSON or SSE follow it: the run
         *     first, then each step as it is made, until the run is forgotten. Looking at a run and following it are no use of it,
         *     and change nothing.
         */
        get: operations["readRun"];
        put?: never;
        post?: never;
        /** Forgets a run. */
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
        /** Says what the others would do over the next nine seconds if egos drove these plans. The run does not change. */
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
        /** Gives the scene of a run as it was when the run began. */
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
         * Gives the run as a text that begins another one: in this server or another, now or later. It goes on with the same
         *     bytes as this one.
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
         * A WebSocket for the steps of a run: messages are those of the line for generations, each `body` that of a step. A
         *     client waits for the reply to a step before it sends the next one.
         */
        get: operations["openRunLine"];
        put?: never;
        /**
         * Makes a step: the egos are where the body says, all others go on, and answer to what they see then. Steps are
         *     numbered from 1 on. The last number again gives the same reply again, whatever its body, so that a lost reply can be
         *     asked for; any other number than the next one is refused (`step-order`).
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
         *     and is scored; the numbers of the next tries follow from how near the tries before came. The reply is a stream of
         *     events (NDJSON or SSE) or only the last event (JSON), by Accept. Equal requests give equal tries. A search ends
         *     after most of `generate_s` with the tries that it has made; a client that leaves ends it at once. Stores nothing.
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
         * @description First event: what will be done.
         */
        AcceptedEvent: {
            /**
             * Format: double
             * @description Since the request was read, milliseconds.
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
             * @description Jobs before this one when it was queued.
             */
            queue_position: number;
            /** @description Road users that answer to them. */
            reacting: string[];
            /** @description Road users that get new futures. */
            regenerated: string[];
            /**
             * Format: uint64
             * @description Revision of the request, when it had one.
             */
            revision?: number;
            /**
             * Format: uint64
             * @description The seed in use.
             */
            seed: number;
            /**
             * Format: uint64
             * @description Rises by one an event; a gap shows events that were dropped for a slow reader.
             */
            seq: number;
            /**
             * Format: uint
             * @description Refinement steps of a window.
             */
            steps: number;
            /** @description Unlikely things known by now. */
            warnings: components["schemas"]["Warning"][];
            /**
             * Format: uint
             * @description Planning windows, one after the other.
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
             * @description Metres.
             * @default null
             */
            height_m?: number | null;
            /** @description Unique in the scene, `[A-Za-z0-9_.:-]{1,64}`. */
            id: string;
            /**
             * Format: double
             * @description Metres; the subtype's when absent.
             * @default null
             */
            length_m?: number | null;
            /**
             * @description Role in the source, such as `ego`.
             * @default null
             */
            role?: string | null;
            /**
             * @description Sets default size and limits.
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
             * @description Selects expert and motion model; `other` is shown, never regenerated.
             * @enum {string}
             */
            type: "vehicle" | "pedestrian" | "cyclist" | "other";
            /**
             * Format: double
             * @description Metres; the subtype's when absent.
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
             * @description Index into `modes` of the one that is shown and exported.
             */
            chosen: number;
            /** @description By falling probability. */
            modes: components["schemas"]["Future"][];
            /** @description Why it gave up the motion that it had. */
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
             * @description Collisions it is part of and the log does not show.
             */
            collisions: number;
            /** @description Which step counted as the end. */
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
             * @description Near misses it is part of and the log does not show.
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
             * @description Overlaps below the threshold of a collision that it is part of and the log does not show.
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
         *     `vehicle`: Anything with an engine on a lane: cars, trucks, buses, motorcycles.
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
         * @description The word `all`.
         *
         *     `all`: Everyone.
         * @enum {string}
         */
        All: "all";
        /**
         * Answer
         * @description A judged card.
         */
        Answer: {
            /** @description Features of the card, as the reply had them. */
            features: components["schemas"]["Features"];
            /**
             * @description Places of the card, as the reply had them: later rounds have no similar card.
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
         * @description One joint scene of the answer. Its score stands in `scores`.
         */
        AnswerSample: {
            /** @description Road user's id to its futures. */
            agents: {
                [key: string]: components["schemas"]["Futures"];
            };
            /** @description Empty here; a place for the score when it is saved. */
            score: unknown;
        };
        /**
         * Area
         * @description A crosswalk, speed bump or driveway.
         */
        Area: {
            /** @description Unique among areas of the kind. */
            id: string;
            /** @description Open ring. */
            polygon_m: components["schemas"]["Points"];
        };
        /**
         * Arm
         * @description A road that leads to a junction, seen from the junction.
         */
        Arm: {
            /**
             * Format: double
             * @description Where it leads, counter-clockwise from east, degrees.
             * @default 0
             */
            angle_deg: number;
            /**
             * Format: double
             * @description Width of the crosswalk over it, metres; less than half a metre is none.
             * @default 3
             */
            crosswalk_m: number;
            /**
             * Format: double
             * @description Width of a cycle lane on both sides, metres; less than half a metre is none.
             * @default 0
             */
            cycle_lane_m: number;
            /**
             * Format: uint8
             * @description Lanes towards the junction.
             * @default 1
             */
            lanes_in: number;
            /**
             * Format: uint8
             * @description Lanes away from it.
             * @default 1
             */
            lanes_out: number;
            /**
             * Format: double
             * @description From the middle of the junction to the rim of the map, metres; longer where the junction needs it.
             * @default 90
             */
            length_m: number;
            /**
             * @description With `priority`: its traffic goes first.
             * @default false
             */
            main: boolean;
            /**
             * Format: double
             * @description Width of a raised strip between the directions, metres; less than half a metre is none.
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
             * @description Where each lane towards the junction leads, from the left one (right-hand traffic; from the right one
             *     in left-hand traffic) to the kerb; null is the usual.
             * @default null
             */
            turns: components["schemas"]["Turn"][][] | null;
        };
        /**
         * ArmDoc
         * @description Where a road comes in.
         */
        ArmDoc: {
            /**
             * Format: double
             * @description Direction in which it leads, radians.
             */
            heading_rad: number;
            /** @description The compass point that it comes from, with a number where several do: `north-east`, `west-2`. */
            id: string;
            /** @description From right to left. */
            lanes: components["schemas"]["ArmLane"][];
            /**
             * Format: uint
             * @description Those that come in later.
             */
            later: number;
            /**
             * Format: double
             * @description To its line, metres: the first junction, or where the road ends or joins another.
             */
            length_m: number;
            /**
             * Format: double
             * @description Most vehicles an hour that its lanes take.
             */
            most_per_hour: number;
            /**
             * Format: uint
             * @description Vehicles of its traffic that are there at the start.
             */
            placed: number;
            /**
             * Format: double
             * @description Middle of its lanes there, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description The same, metres.
             */
            y_m: number;
        };
        /**
         * ArmLane
         * @description A lane by which an arm leads in.
         */
        ArmLane: {
            /** @description Id of the lane. */
            lane: string;
            /**
             * Format: double
             * @description Arc length at which it comes in, metres.
             */
            s_m: number;
        };
        /**
         * ArmPlace
         * @description Position of an arm, for editing handles.
         */
        ArmPlace: {
            /** @description Where the arm leaves the map, metres. */
            end_m: number[];
            /** @description Where each of its lanes in ends, metres. */
            ins_m: number[][];
            /** @description From the middle to the kerb beside the lanes in and beside the lanes out, metres. */
            kerbs_m: number[];
            /** @description Where traffic towards the junction stops, in the middle of the arm, metres. */
            mouth_m: number[];
            /** @description Such as `North`. */
            name: string;
            /** @description Where each of its lanes out begins, metres. */
            outs_m: number[][];
            /** @description Where its turn lanes lead, from the middle of the road to the kerb; single connections apart. */
            turns: components["schemas"]["Turn"][][];
        };
        /**
         * Arrivals
         * @description Traffic that comes in by an arm.
         */
        Arrivals: {
            /** @description Id of one of the reply's `arms`. */
            arm: string;
            /**
             * Format: double
             * @description Motor vehicles an hour, all lanes together.
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
             * @description Futures that are planned for each road user.
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
             *     Each is generated in units of its own.
             */
            agents?: string[];
            /** @description Goal. */
            goal?: components["schemas"]["GoalRanges"];
            /** @description Length of the road user, metres. */
            length_m?: components["schemas"]["Distribution"] | null;
            /** @description Name in the results: letters, digits, - and _. Default: that of the template or the pattern, or `free`. */
            name?: string | null;
            /** @description What the road users beside it are. */
            others?: components["schemas"]["OtherKinds"];
            /**
             * @description Figures of the template by name, those absent are drawn by the seed; or parameters of the pattern, those absent
             *     have their standard values.
             */
            parameters?: {
                [key: string]: components["schemas"]["Distribution"];
            };
            /**
             * @description Pattern of the road that the maps of the scenes are searched for: a name of `dragtraffic match --list`, a file, or
             *     the pattern itself. Its road users are put at each place where it fits; those of the scene are left out.
             */
            pattern?: components["schemas"]["PatternChoice"] | null;
            /** @description Start. */
            start?: components["schemas"]["StartRanges"];
            /**
             * @description Test situation that the scene is searched for. The actor is picked from the scene; the seed decides which.
             * @enum {string|null}
             */
            template?: "brake" | "cut-in" | "late" | null;
            /** @description Type that the road user has in place of its own. */
            type?: components["schemas"]["AgentType"] | null;
            /** @description Width of the road user, metres. */
            width_m?: components["schemas"]["Distribution"] | null;
            /**
             * @description Id of the road user that the figures under `pair.` are about. Default: the one that a template or a pattern
             *     affects, else the one with whom it comes nearest to a collision.
             */
            with?: string | null;
        };
        /**
         * Bound
         * @description One bound as it is in force.
         */
        Bound: {
            /**
             * Format: uint64
             * @description In the unit of the bound's name.
             */
            value: number;
            /** @description What it bounds. */
            what: string;
        };
        /**
         * Boundary
         * @description A stretch of a lane's side and the line or edge that bounds it.
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
         * @description What the program was built for.
         */
        Build: {
            /** @description Cargo profile. */
            profile: string;
            /** @description Target triple. */
            target: string;
        };
        /**
         * ByRoad
         * @description A place on a lane that can be had instead of a goal.
         */
        ByRoad: {
            /**
             * Format: double
             * @description From the goal, metres.
             */
            distance_m: number;
            /**
             * Format: double
             * @description Of the lane, radians.
             */
            heading_rad: number;
            /**
             * Format: double
             * @description On the lane's middle, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description On the lane's middle, metres.
             */
            y_m: number;
        };
        /**
         * CarPark
         * @description A street with a car park beside it: in at one end, along aisles, out at the other.
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
             * @description Aisles with bays on both sides.
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
             * @description Bays along each side of an aisle.
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
             * @description Width of the pavements, metres; less than half a metre is none.
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
             * @description Side of the road that traffic keeps to.
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
            /** @description What it does, and because of whom. */
            reaction: components["schemas"]["Reaction"];
        };
        /**
         * Check
         * @description One check, or one failure of it.
         */
        Check: {
            /** @description Where it fails, metres. */
            at_m: number[] | null;
            /** @description What it is about. */
            kind: components["schemas"]["CheckKind"];
            /** @description Lanes it is about. */
            lanes: string[];
            /** @description The finding as data. */
            message: components["schemas"]["Message"];
            /** @description All is well. */
            passed: boolean;
            /** @description The finding in English. */
            text: string;
        };
        /**
         * CheckKind
         * @description Subject of a check.
         *
         *     `lanes-lead`: Every lane leads somewhere.
         *
         *     `turns`: A bus of 12 m (in a car park: a car) can turn.
         *
         *     `widths`: No lane is too narrow.
         *
         *     `signals-apart`: No two movements with green at the same time conflict.
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
         * @description Two road users collide: their boxes overlap by more than the thresholds say. One entry a pair.
         */
        Collision: {
            /** @description The one listed first. */
            a: string;
            /** @description The other. */
            b: string;
            /**
             * Format: double
             * @description Speed at which the two closed in at the first moment, m/s (their relative speed when they
             *     already overlap).
             */
            closing_speed_mps: number;
            /** @description Both move as recorded. It does not count. */
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
         * @description One possible motion. The first number of a column is its value at the first step, the second how much the
         *     next value is greater, and each further one by how much that changes: with two running sums the columns of a
         *     scene document come out, to the last digit.
         */
        CompactFuture: {
            /**
             * Format: uint32
             * @description Which of the generator's anchors it follows.
             */
            anchor?: number | null;
            /** @description What is wrong with it, the worst first. */
            faults?: components["schemas"]["Fault"][];
            /**
             * Format: uint64
             * @description Scene step of the first value.
             */
            first_step: number;
            /** @description Ten-thousandths of a radian. */
            heading_e4rad: number[];
            /** @description What it does. */
            manoeuvre?: components["schemas"]["Manoeuvre"] | null;
            /**
             * Format: double
             * @description Relative weight among the road user's futures; see `calibrated` of the answer.
             */
            probability: number;
            /** @description How it stands to others. */
            relations?: components["schemas"]["Relation"][];
            /** @description Millimetres a second. */
            vx_mmps: number[];
            /** @description Millimetres a second. */
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
             * @description Index into `compact` of the one that is shown and exported.
             */
            chosen: number;
            /** @description By falling probability. */
            compact: components["schemas"]["CompactFuture"][];
            /** @description Why it gave up the motion that it had. */
            reaction?: components["schemas"]["Reaction"] | null;
        };
        /**
         * ConditionRange
         * @description Allowed sizes and speeds of one agent type; both ends are allowed.
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
         * @description What conditions may ask for, by type; both ends are allowed.
         */
        ConditionRanges: {
            cyclist: components["schemas"]["ConditionRange"];
            pedestrian: components["schemas"]["ConditionRange"];
            vehicle: components["schemas"]["ConditionRange"];
        };
        /**
         * Conditions
         * @description All that a user fixes about one road user. A number fixes a field, null or absence frees it.
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
             * @description Metres.
             */
            length_m?: number | null;
            /** @description Start fields. */
            start?: components["schemas"]["Start"] | null;
            /**
             * @description Expert to use in place of the road user's own type's.
             * @enum {unknown}
             */
            type?: "vehicle" | "pedestrian" | "cyclist" | null;
            /** @description Places that it passes on its way, in this order; always in the frame `scene`. */
            via?: components["schemas"]["Via"][];
            /**
             * Format: double
             * @description Metres.
             */
            width_m?: number | null;
        };
        /**
         * Connection
         * @description A way from a lane of an arm to a lane of an arm: the same one to turn back. All are counted from 0, arms in the order
         *     of the parameters and lanes from the middle of the road to the kerb; written as ids of lanes, which count from 1.
         */
        Connection: {
            /** @description A lane towards the junction, such as `arm2.in1`: of the second arm the one next to the middle of the road. */
            from: string;
            /** @description A lane away from it, such as `arm3.out1`. */
            to: string;
        };
        /**
         * Connections
         * @description What a junction has and has not beside the ways that its turn lanes make.
         */
        Connections: {
            /**
             * @description Ways that there are in any case.
             * @default []
             */
            added: components["schemas"]["Connection"][];
            /**
             * @description Ways that there are not.
             * @default []
             */
            removed: components["schemas"]["Connection"][];
        };
        /**
         * Control
         * @description Priority where roads meet.
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
         * @description Where a kerb bends.
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
             * @description Seconds to generate.
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
             * @description Repeats the answer.
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
         * @description How many: exactly one of the two.
         */
        Density: {
            /**
             * Format: uint64
             * @description Road users in all.
             * @default null
             */
            count?: number | null;
            /**
             * Format: double
             * @description Road users for each kilometre of lane for motor vehicles in the region, junctions left out.
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
         *     `left_the_map`: The roads of the map end there.
         *
         *     `arrived`: It is where its goal is.
         * @enum {string}
         */
        DepartureWord: "left_the_map" | "arrived";
        /**
         * Distribution
         * @description A number, or where it is drawn from.
         */
        Distribution: number | {
            /** @description Values in a grid, both bounds among them. */
            points?: number;
            /** @description Even between the least and the greatest value. */
            uniform: number[];
        } | {
            /** @description One of these; a grid takes all. */
            choice: number[];
        };
        /**
         * DraftEvent
         * @description `initial`: the first guess. `step`: after a refinement step. The futures of a later window begin where it begins.
         */
        DraftEvent: {
            /** @description Futures by road user; only the chosen ones, or all by `stream_modes`. */
            agents: {
                [key: string]: components["schemas"]["Futures"];
            };
            /**
             * Format: double
             * @description Since the request was read, milliseconds.
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
             * @description Revision of the request, when it had one.
             */
            revision?: number;
            /**
             * Format: uint
             * @description Joint scene, from 0.
             */
            sample: number;
            /**
             * Format: uint64
             * @description Rises by one an event; a gap shows events that were dropped for a slow reader.
             */
            seq: number;
            /**
             * Format: uint
             * @description Refinement step, from 1; not in `initial`.
             */
            step?: number;
            /**
             * Format: uint
             * @description Refinement steps of a window.
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
         * @description A surface that may be driven on.
         */
        Drivable: {
            /**
             * @description Open rings that are not drivable.
             * @default []
             */
            holes_m?: components["schemas"]["Points"][];
            /** @description Unique among drivable areas. */
            id: string;
            /** @description Open ring. */
            polygon_m: components["schemas"]["Points"];
        };
        /**
         * DrivingManner
         * @description Accelerations of a manner of moving.
         */
        DrivingManner: {
            /**
             * Format: double
             * @description Greatest speeding up.
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
             * @description The original's with "copy" after it when absent.
             * @default null
             */
            name?: string | null;
        };
        /**
         * Ego
         * @description An ego at the end of a step.
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
             * @description Where it says that it goes: at most 90 states, the first 0.1 s after the step's end. Without a plan the others
             *     expect it to go on along its lane.
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
             * @description Of the box centre, m/s.
             */
            vx_mps: number;
            /**
             * Format: double
             * @description Of the box centre, m/s.
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
            /** @description The one listed first. */
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
             * @description Least time gap of the one that follows the other: gap over its speed, seconds.
             */
            headway_s: number | null;
            /** @description As in the list. */
            in_log: boolean;
            /** @description The list that it is in. */
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
             * @description Between the two at that time, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Between the two at that time, metres.
             */
            y_m: number;
        };
        /**
         * EncounterKind
         * @description What a pair comes to.
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
         * @description Which step counts as the end of a future.
         *
         *     `last`: The last one.
         *
         *     `before_last`: The one before: the goal position was given, so the last says nothing (the paper's rule).
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
             * @description Since the request was read, milliseconds.
             */
            elapsed_ms: number;
            /**
             * @description Type of the event.
             * @constant
             */
            event: "error";
            /** @description Id of the job. */
            job: string;
            /** @description Problem that a refusal before the stream would have returned. */
            problem: components["schemas"]["Problem"];
            /**
             * Format: uint64
             * @description Revision of the request, when it had one.
             */
            revision?: number;
            /**
             * Format: uint64
             * @description Rises by one an event; a gap shows events that were dropped for a slow reader.
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
         * @description One thing that is wrong with a motion.
         */
        Fault: {
            /** @description The road edge that is driven over, by its id in the map. */
            edge?: string | null;
            /**
             * Format: double
             * @description How bad, in the unit of its kind.
             */
            extent?: number | null;
            /** @description What. */
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
         *     `collision`: Its box meets another's; `extent` is the closing speed, m/s.
         *
         *     `red_light`: A stop line is crossed at red; `extent` is the speed, m/s.
         *
         *     `wrong_way`: Against the direction of every lane there; `extent` is how far, metres.
         *
         *     `over_median`: Over what divides two roads; `extent` is how far past the edge, metres.
         *
         *     `off_road`: Over a kerb or away from the road; `extent` is how far past the edge, metres.
         *
         *     `off_map`: Where the roads of the map have ended; `extent` is how far from the lanes, metres.
         *
         *     `on_carriageway`: On foot along a lane, or across lanes beside a crosswalk; `extent` is how far, metres.
         *
         *     `speeding`: Above the speed limit; `extent` is by how much, m/s.
         *
         *     `harsh_braking`: Braking; `extent` in m/s2.
         *
         *     `harsh_steering`: Turning; `extent` is the acceleration sideways, m/s2.
         *
         *     `running`: A pedestrian runs; `extent` is the speed, m/s.
         *
         *     `askew`: Ends at an angle to its lane; `extent` in radians.
         *
         *     `fails_to_yield`: A pedestrian waits at a crosswalk that this one drives over; `extent` is the pedestrian's delay, seconds.
         *
         *     `forces_braking`: Another has to brake hard; `extent` is that braking, m/s2.
         *
         *     `near_miss`: Another is met all but; `extent` is the gap, metres.
         *
         *     `via_missed`: A via point is passed too far away, or not at its time; `extent` is how far it is at the nearest, metres.
         *
         *     `goal_missed`: The goal is not met; `extent` is what is left, metres.
         * @enum {string}
         */
        FaultKind: "collision" | "red_light" | "wrong_way" | "over_median" | "off_road" | "off_map" | "on_carriageway" | "speeding" | "harsh_braking" | "harsh_steering" | "running" | "askew" | "fails_to_yield" | "forces_braking" | "near_miss" | "via_missed" | "goal_missed";
        /**
         * Features
         * @description A motion of one road user, or of several together, in such terms.
         */
        Features: {
            /** @description By road user and other: it goes first where their ways cross. */
            first?: {
                [key: string]: {
                    [key: string]: boolean;
                };
            };
            /**
             * Format: double
             * @description Mean distance from the recording, metres; of several their mean. Absent where nothing was recorded.
             */
            from_log_m?: number | null;
            /**
             * Format: double
             * @description Least time between it and another where their ways cross, at most 5 s; of several the least.
             */
            gap_s: number;
            /**
             * Format: double
             * @description Greatest change of velocity over half a second, m/s2; of several the greatest.
             */
            harshness_mps2: number;
            /** @description By road user: what it drives. */
            manoeuvres?: {
                [key: string]: components["schemas"]["Manoeuvre"];
            };
            /**
             * Format: double
             * @description Mean speed, m/s; of several their mean.
             */
            pace_mps: number;
            /**
             * Format: double
             * @description Time that it stands, seconds; of several their mean.
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
             * @description Judged cards, the first round's first, without cards that were neither kept nor rejected.
             * @default []
             */
            answers?: components["schemas"]["Answer"][];
            /**
             * @description Traits to ignore, whatever the verdicts show.
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
         * @description A value and where it came from.
         */
        Field: {
            /** @description Origin. */
            from: components["schemas"]["Source"];
            /**
             * Format: double
             * @description In the unit of the field's name.
             */
            value: number;
        };
        /**
         * FieldProblem
         * @description One fault and its place.
         */
        FieldProblem: {
            /** @description A word that programs can switch on. */
            code: string;
            /** @description Value found and value expected, in English. */
            detail: string;
            /**
             * Format: double
             * @description The value found, where it is a number.
             */
            got?: number;
            /**
             * Format: double
             * @description Greatest value allowed, where that is the fault.
             */
            max?: number;
            /** @description The fault as data; faults outside of bodies and files may have none. */
            message?: components["schemas"]["Message"];
            /**
             * Format: double
             * @description Least value allowed, where that is the fault.
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
             * @description Are the probabilities of the futures calibrated? If false, they are relative weights: their order counts.
             *     docs/results.md has their log loss.
             */
            calibrated: boolean;
            /**
             * @description Six characters that name what the answer follows from: the scene with its conditions and the futures it keeps,
             *     options, seed, weights and version. Identical calls have identical codes.
             */
            code: string;
            /**
             * Format: double
             * @description Since the request was read, milliseconds.
             */
            elapsed_ms: number;
            /**
             * @description Type of the event.
             * @constant
             */
            event: "final";
            /** @description Of a round: what its cards are like, and what was learned. */
            feedback?: components["schemas"]["Round"];
            /**
             * @description The scene's `generated` member, all but `samples`: put `samples` in and save (those in
             *     compact form as columns).
             */
            generated: components["schemas"]["GeneratedHead"];
            /** @description Id of the job. */
            job: string;
            /** @description Every condition field as it was used. */
            resolved: {
                [key: string]: components["schemas"]["Resolved"];
            };
            /**
             * Format: uint64
             * @description Revision of the request, when it had one.
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
             * @description Rises by one an event; a gap shows events that were dropped for a slow reader.
             */
            seq: number;
            /** @description Where the time went. */
            timing: components["schemas"]["Timing"];
            /** @description Unlikely things that were done anyway. */
            warnings: components["schemas"]["Warning"][];
            /**
             * Format: uint
             * @description Planning windows that were run. A chosen future runs through all of them; its alternatives are those
             *     of the first and end with its plan.
             */
            windows: number;
        };
        /**
         * FormatInfo
         * @description Description of a format for clients.
         */
        FormatInfo: {
            /** @description Can be written. */
            export: boolean;
            /** @description Ends of file names, the first one for exports. */
            extensions: string[];
            /** @description Word for `--from`, `--to` and `?format=`. */
            id: string;
            /** @description Can be read. */
            import: boolean;
            /**
             * @description Codes of the losses that a written file may have ([`crate::loss::code`]). Each export reports the
             *     losses it had.
             */
            loses: string[];
            /** @description Holds many scenes in one file. */
            many: boolean;
            /** @description Media type of an exported file. */
            media_type: string;
            /** @description For people. */
            name: string;
            /** @description Content of a file, and how it is read and written. */
            notes: string;
            /** @description May come with the network it belongs to ([`ImportOptions::net`]). */
            takes_net: boolean;
        };
        /**
         * Future
         * @description One possible motion as columns, one value a step from `first_step`, without gaps. Rounded to
         *     0.001 m, 0.0001 rad and 0.001 m/s.
         */
        Future: {
            /**
             * Format: uint32
             * @description Which of the generator's anchors it follows: the same number while a goal is dragged is the same
             *     idea.
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
             * @description Share of belief among the road user's futures.
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
         * @description How the futures of a reply are written.
         *
         *     `columns`: As a scene document has them.
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
             * @description Replace the scene's own conditions of these road users, whole. Type and size always count. A start, goal or via
             *     point is refused (`not-asked`) where it would change no motion: the road user is not in `agents`, the scene
             *     keeps no future of it, and its own conditions are others.
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
             * @description Drafts that stand sooner than this after the work began are left out, `initial` too, in milliseconds; 0
             *     leaves out none. An answer that is there as soon as that needs no drafts before it, and comes together with
             *     `accepted`, which waits for it so long.
             * @default 0
             */
            draft_delay_ms?: number;
            /**
             * Format: uint64
             * @description `step` events that come sooner than this after the draft sent before are left out, in milliseconds; 0 sends
             *     all. A page that draws sixty pictures a second has no use for more than one in 16 ms.
             * @default 0
             */
            draft_interval_ms?: number;
            /**
             * @description With `scene_id`: refuse when the scene has changed.
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
            /** @description How futures are written, in drafts and in `final`. */
            futures?: components["schemas"]["FuturesForm"];
            /**
             * @description With `scene`: the server holds it in memory. Later calls use the name in the reply's header `Dragtraffic-Scene`
             *     as their `scene_id`. The server drops scenes that were not used for a long time (`not-found`).
             * @default false
             */
            hold?: boolean;
            /**
             * Format: double
             * @description Time to generate, seconds. Beyond 9 s it is planned window after window.
             * @default 9
             */
            horizon_s?: number;
            /**
             * @description The client's id of the job, to cancel it by.
             * @default null
             */
            job?: string | null;
            /**
             * @description What becomes of the futures of earlier calls, of road users that are not generated in this one.
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
             * @description Rises with each request of `client`.
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
             * @description Put scores into `final`.
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
             * @description What drafts carry.
             * @default chosen
             */
            stream_modes?: components["schemas"]["StreamModes"];
            /**
             * @description Numbers that decide what counts as a near miss, harsh braking and the like, in `faults` and `scores`; those
             *     absent have their defaults. They change no motion.
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
            /** @description RFC 3339 time; absent where equal calls are to give equal files. */
            created_at?: string;
            /** @description Hash of the user's part that these futures answer. */
            input_sha256: string;
            /** @description Licence of the answer where it is stricter than the scene's own: that of the weights. */
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
             * @description The user's part has changed since.
             * @default false
             */
            stale?: boolean;
            /**
             * @description Expert's name to the hash of its weights.
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
            /** @description Hash of the user's part that the futures answer. */
            input_sha256: string;
            /** @description Licence of the answer where it is stricter than the scene's own: that of the weights. */
            licence?: string | null;
            /** @description The request's options as sent, without scene and conditions. */
            request: unknown;
            /**
             * Format: uint64
             * @description Seed that repeats the answer.
             */
            seed: number;
            /** @description The user's part has changed since. */
            stale: boolean;
            /** @description Expert's name to the hash of its weights. */
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
             * @description Radians, then wrapped; a request takes at most a turn either way, 6.2832.
             */
            heading_rad?: number | null;
            /**
             * Format: double
             * @description Frame `agent`: metres to the left of the start's heading; with `ahead_m` or not at all.
             */
            left_m?: number | null;
            /**
             * @description Ids of road edges of the map, such as those of a median, that the road user may drive over: no fault, and no
             *     reason to go another way.
             */
            may_cross?: string[];
            /**
             * @description What the goal is relative to. It replaces place, heading and, where none is fixed, speed; with `after_s` it
             *     replaces the time.
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
             * @description Frame `agent`: radians from the start's heading, then wrapped; a request takes at most a turn either way, 6.2832.
             */
            turn_rad?: number | null;
            /** @description In place of `speed_mps`; fixes a free heading too. */
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
         * @description Fields of a goal; those absent are free.
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
             * @description The goal is where the recording has the road user at `time_s`, with its heading and speed there; `ahead_m`,
             *     `left_m` and `turn_rad` are from there, in place of the start. Default: false.
             */
            recorded?: boolean;
            /** @description What the goal is relative to. */
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
             * @description The goal's own place is reached so many seconds after the other one was nearest to it; negative is before.
             */
            after_s?: number | null;
            /**
             * Format: double
             * @description Gap from the front of the other one to the own rear, along the lanes, metres.
             */
            ahead_m?: number | null;
            /**
             * Format: double
             * @description Gap from the own front to the rear of the other one, along the lanes, metres.
             */
            behind_m?: number | null;
            /**
             * Format: double
             * @description The same gap in seconds at the speed of the goal.
             */
            behind_s?: number | null;
            /**
             * Format: int32
             * @description Lanes to the left of the other one's lane in its direction; negative is to the right. Not with `after_s`; 0 when
             *     free.
             */
            lanes_left?: number | null;
            /**
             * Format: double
             * @description How much slower than the other one, m/s; negative is faster. Not with `after_s`; 0 when free.
             */
            slower_mps?: number | null;
            /** @description Id of the other road user. Relations form no ring, and no row of more than four. */
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
            /** @description The goal's own place is reached so many seconds after the other one was nearest to it. */
            after_s?: components["schemas"]["Distribution"] | null;
            /** @description Gap from the front of the other one to the own rear, metres. */
            ahead_m?: components["schemas"]["Distribution"] | null;
            /** @description Gap from the own front to the rear of the other one, metres. */
            behind_m?: components["schemas"]["Distribution"] | null;
            /** @description The same gap in seconds at the speed of the goal. */
            behind_s?: components["schemas"]["Distribution"] | null;
            /** @description Lanes to the left of the other one's, in whole numbers; negative is to the right. */
            lanes_left?: components["schemas"]["Distribution"] | null;
            /** @description How much slower than the other one, m/s; negative is faster. */
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
         * @description Health of the server in a word, for its operators.
         *
         *     `ok`: The process answers.
         *
         *     `ready`: It takes work.
         * @enum {string}
         */
        HealthStatus: "ok" | "ready";
        /**
         * HeartbeatEvent
         * @description A sign of life between events, only in NDJSON: SSE has comments for it.
         */
        HeartbeatEvent: {
            /** @constant */
            event: "heartbeat";
        };
        /**
         * ImportReply
         * @description Result of a file.
         */
        ImportReply: {
            /** @description A name of the formats table. */
            format: string;
            /** @description Scenes in the order of the file. */
            scenes: components["schemas"]["ImportedScene"][];
            /** @description Records that are no scenes. */
            skipped: components["schemas"]["SkippedRecord"][];
        };
        /**
         * ImportWarning
         * @description Something a reader changed or left out without refusing.
         */
        ImportWarning: {
            /** @description The kind of change; programs switch on it. */
            code: string;
            /** @description The change in English. */
            detail: string;
            /** @description The change as data. */
            message: components["schemas"]["Message"];
        };
        /**
         * ImportedBody
         * @description Result of a file, or of each of several.
         */
        ImportedBody: components["schemas"]["ImportReply"] | components["schemas"]["ImportedFiles"];
        /**
         * ImportedFile
         * @description One of several files: what it gave, or why it gave nothing.
         */
        ImportedFile: {
            /** @description A name of the formats table. */
            format?: string;
            /** @description Name of the file, as the form gave it. */
            name?: string;
            /** @description Why nothing of it was taken. */
            problem?: components["schemas"]["Problem"];
            /** @description Scenes in the order of the file. */
            scenes?: components["schemas"]["ImportedScene"][];
            /** @description Records that are no scenes. */
            skipped?: components["schemas"]["SkippedRecord"][];
        };
        /**
         * ImportedFiles
         * @description Results of several files.
         */
        ImportedFiles: {
            /** @description In the order of the form. */
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
            /** @description Id it was stored under; not in a dry run. */
            id?: string;
            /** @description For people. */
            name: string;
            /** @description The scene itself, only in a dry run. */
            scene?: components["schemas"]["Scene"];
            /**
             * Format: uint
             * @description Steps of 0.1 s.
             */
            steps: number;
            /** @description Changes and omissions of the reader. */
            warnings: components["schemas"]["ImportWarning"][];
        };
        /**
         * Info
         * @description What this server is and can do.
         */
        Info: {
            build: components["schemas"]["Build"];
            /** @description What conditions may ask for. */
            condition_ranges: components["schemas"]["ConditionRanges"];
            /** @description What a generation has when the request does not say. */
            defaults: components["schemas"]["Defaults"];
            /** @description What computes the networks. */
            device: string;
            /** @description Formats of files. */
            formats: components["schemas"]["FormatInfo"][];
            /** @description Bounds of the server by name, and those of the scene format. */
            limits: {
                [key: string]: components["schemas"]["Bound"];
            };
            /** @description What each kind of road user can do. */
            motion_limits: components["schemas"]["KindLimits"];
            /** @description Name of the program. */
            name: string;
            /** @description Sentences for people who run the server. */
            notices: string[];
            /** @description Weights of placement; null when road users are placed evenly along lanes. */
            placement: components["schemas"]["PlacementInfo"] | null;
            /** @description Version of the program. */
            version: string;
            /** @description Experts by name. */
            weights: {
                [key: string]: components["schemas"]["WeightsInfo"];
            };
        };
        /**
         * Intermediate
         * @description The state to which a window sends a road user whose goal is due after the window's end. It lies on the way
         *     to the goal at constant acceleration, along the lanes where they lead to it, else straight.
         */
        Intermediate: {
            /** Format: double */
            heading_rad: number;
            /** @description The plan met it. */
            reached: boolean;
            /** Format: double */
            speed_mps: number;
            /**
             * Format: double
             * @description Scene time at which the state was to be reached, seconds: the end of the window's plan.
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
             * @description 3 to 6 of them, at least 20 degrees apart.
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
             * @description Priority at the junction.
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
             * @description Lights, with `signals`.
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
             * @description Width of the pavements, metres; less than half a metre is none.
             * @default 2.5
             */
            sidewalk_m: number;
            /**
             * @description Side of the road that traffic keeps to.
             * @default right-hand
             */
            traffic: components["schemas"]["Traffic"];
        };
        /**
         * JunctionPath
         * @description A way through a junction that is drawn.
         */
        JunctionPath: {
            /** @description It is there because it was added. */
            added: boolean;
            /** @description A lane towards the junction, such as `arm2.in1`: of the second arm the one next to the middle of the road. */
            from: string;
            /** @description Id of its lane in the map. */
            lane: string;
            /** @description A lane away from it, such as `arm3.out1`. */
            to: string;
            /** @description The direction, as seen from the entry. */
            turn: components["schemas"]["Turn"];
        };
        /**
         * KeptFutures
         * @description What becomes of the futures of earlier calls, of road users that are not generated in this one.
         *
         *     `answered`: They are planned around and answered beside the new ones: the samples are the whole scene's.
         *
         *     `omitted`: They are planned around and not answered, for a client that has them itself.
         *
         *     `forgotten`: They are dropped before planning: their road users follow the recording again.
         * @enum {string}
         */
        KeptFutures: "answered" | "omitted" | "forgotten";
        /**
         * KindLimits
         * @description Motion limits by kind of road user, each of the kind's usual size.
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
             * @description Greatest speeding up, m/s2.
             */
            accel_mps2: number;
            /**
             * Format: double
             * @description Greatest braking, m/s2, positive.
             */
            brake_mps2: number;
            /**
             * Format: double
             * @description Greatest curvature above 1 m/s, 1/m; none for walkers.
             */
            curvature_per_m: number | null;
            /**
             * Format: double
             * @description Greatest jerk along the way, m/s3; none for walkers.
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
             * @description Steps with at least one value over its limit ([`KinematicLimits`]).
             */
            violations: number;
            /**
             * Format: double
             * @description Greatest turning, rad/s; none for walkers.
             */
            yaw_rate_radps: number | null;
        };
        /**
         * Lane
         * @description One lane.
         */
        Lane: {
            /** @description Unique among lanes, `[A-Za-z0-9_.:-]{1,64}`. */
            id: string;
            /**
             * @description Leads through a junction between two lanes.
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
             * @description Ids of lanes that lead here.
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
             * @description Metres; assumed by type when absent.
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
         * @description A wish with what it rests on.
         */
        LearnedWish: {
            /** @description Positions of the answers that contradict it. */
            against: number[];
            /** @description Least and most among the kept ones, in the unit of the trait; none were kept: absent. */
            kept?: [
                number,
                number
            ] | null;
            /** @description Least and most among the rejected ones. */
            rejected?: [
                number,
                number
            ] | null;
            /** @description It was said outright. */
            said: boolean;
            /**
             * Format: double
             * @description How sure it is, 0 to 1.
             */
            strength: number;
            /** @description Which way. */
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
         * @description The limit of motion that binds.
         *
         *     `acceleration`: Speeding up, m/s2.
         *
         *     `braking`: Slowing down, m/s2.
         *
         *     `speed`: Top speed, m/s.
         *
         *     `lateral`: Sideways acceleration, m/s2.
         *
         *     `curvature`: Tightness of a turn, 1/m.
         *
         *     `traffic`: Another agent is in the way and stays there.
         *
         *     `relation`: The goal is relative to an agent or a lane that is not there.
         * @enum {string}
         */
        Limiting: "acceleration" | "braking" | "speed" | "lateral" | "curvature" | "traffic" | "relation";
        /**
         * Log
         * @description The word `log`.
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
         * @description Everything that does not move.
         */
        Map: {
            /**
             * @description Crosswalks.
             * @default []
             */
            crosswalks?: components["schemas"]["Area"][];
            /**
             * @description Surfaces that may be driven on.
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
             * @description Ends of the road's surface.
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
             * @description Name of the scene; that of the template when left out.
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
             * @description Size of its JSON.
             */
            bytes: number;
            /**
             * Format: uint64
             * @description Points of them all.
             */
            points: number;
            /**
             * Format: uint64
             * @description Lines and areas.
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
         * @description Names a map by its content.
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
            /** @description Where the arms lie, in the order of the parameters. */
            arms: components["schemas"]["ArmPlace"][];
            /** @description What was looked at. A check that failed forbids nothing. */
            checks: components["schemas"]["Check"][];
            /** @description Where kerbs bend between them. */
            corners: components["schemas"]["CornerPlace"][];
            /** @description The template with all its parameters. */
            layout: components["schemas"]["Layout"];
            /** @description A scene with the map and no road users. Its `x_layout` has the template and its parameters. */
            scene: components["schemas"]["Scene"];
            /** @description Ways from lane to lane where roads meet at grade. */
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
             * @description Least time gap of the one that follows the other: gap over its speed, seconds.
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
             * @description Lanes that go through.
             * @default 2
             */
            lanes: number;
            /**
             * @description A ramp leaves, before the other one joins.
             * @default false
             */
            off_ramp: boolean;
            /**
             * @description A ramp joins.
             * @default true
             */
            on_ramp: boolean;
            /**
             * Format: double
             * @description Length beside the through lanes on which to speed up or slow down, metres.
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
             * @description Side of the road that traffic keeps to.
             * @default right-hand
             */
            traffic: components["schemas"]["Traffic"];
        };
        /**
         * Message
         * @description One sentence.
         */
        Message: {
            /** @description Names the sentence; it never changes. */
            code: string;
            /** @description What fills its placeholders. An optional value that is absent is left out. */
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
            /** @description WOMD's objects of interest, by road user's id. */
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
             * @description Words to find it by.
             * @default []
             */
            tags?: string[];
            /** @description The source's times of the steps, seconds, when they are not exactly 0.1 s apart from zero. */
            timestamps_s?: number[] | null;
            /** @description WOMD's tracks to predict: road user's id and difficulty. */
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
         * @description What one kind of road user can do; answers never go beyond it.
         */
        MotionLimits: {
            /**
             * Format: double
             * @description Greatest speeding up.
             */
            accel_mps2: number;
            /**
             * Format: double
             * @description Greatest braking, positive.
             */
            brake_mps2: number;
            /** @description What a future does where there is time. */
            comfortable: components["schemas"]["DrivingManner"];
            /**
             * Format: double
             * @description Greatest curvature; null on foot, where turning has no bound. Vehicles longer than the kind's
             *     usual ones turn wider.
             */
            curvature_per_m: number | null;
            /** @description What a future does where time presses. It does more only where a goal or another road user forces it. */
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
         * @description Two moving road users nearly collide, their boxes apart all the time. One entry a pair, at its worst moment.
         */
        NearMiss: {
            /** @description The one listed first. */
            a: string;
            /** @description The other. */
            b: string;
            /**
             * Format: double
             * @description Rate at which the gap shrank then, m/s.
             */
            closing_speed_mps: number;
            /**
             * Format: double
             * @description Gap between the boxes then, metres.
             */
            distance_m: number;
            /**
             * @description The log itself shows it: both move as recorded, or the recording has the same meeting at about
             *     the same time, no less hard. It does not count.
             */
            in_log: boolean;
            /**
             * Format: double
             * @description Scene time, seconds.
             */
            time_s: number;
            /**
             * Format: double
             * @description Time to collision at constant velocity then, seconds, if there is one.
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
         * @description Kind and size of the road users that are there beside the one with the conditions.
         */
        OtherKinds: {
            /** @description Who: ids, `@all`, `@moving`, `@vehicles`, `@pedestrians`, `@cyclists`, `@ego`. */
            agents?: string[];
            /** @description Length of each, metres. */
            length_m?: components["schemas"]["Distribution"] | null;
            /** @description Type in place of their own. */
            type?: components["schemas"]["AgentType"] | null;
            /** @description Width of each, metres. */
            width_m?: components["schemas"]["Distribution"] | null;
        };
        /**
         * OtherSide
         * @description Where another way comes from.
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
         * @description The boxes of two road users overlap by less than a collision takes. One entry a pair.
         */
        Overlap: {
            /** @description The one listed first. */
            a: string;
            /** @description The other. */
            b: string;
            /**
             * Format: double
             * @description Greatest depth, metres: the least gap of the pair is this below zero.
             */
            depth_m: number;
            /**
             * @description The log itself shows it: both move as recorded, or the recording has an overlap as deep. It does not
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
         * @description Which pairs are scored.
         *
         *     `all`: Every pair.
         *
         *     `regenerated`: Pairs with at least one generated road user.
         * @enum {string}
         */
        PairChoice: "all" | "regenerated";
        /**
         * Parked
         * @description Cars parked along kerbs and in lots: exactly one of the two.
         */
        Parked: {
            /**
             * Format: double
             * @description Cars on each 100 m of kerb that has room; of the bays in lots as large a share.
             * @default null
             */
            per_100m?: number | null;
            /**
             * Format: double
             * @description Share of the places that are taken.
             * @default null
             */
            share?: number | null;
        };
        /** PatternChoice */
        PatternChoice: ("ALKS-cut-in" | "ALKS-cut-out" | "ALKS-deceleration" | "CBDA" | "CBFA" | "CBLA" | "CBNA" | "CBNAO" | "CBTA" | "CCCscp" | "CCFhol" | "CCFhos" | "CCFtap" | "CCRb" | "CCRm" | "CCRs" | "CPFA" | "CPLA" | "CPNA" | "CPNCO" | "CPTA" | "crosswalk-after-bend" | "merge" | "roundabout-entry") | string | components["schemas"]["RoadPattern"];
        /**
         * PatternGoal
         * @description The goal of a road user. Its place follows from `at_m`, from `relation`, or from the mean of both speeds over the time.
         */
        PatternGoal: {
            /** @description Metres along the way from the place. */
            at_m?: (number | string) | null;
            /** @description In place of a time: constant braking from the speed of the start to that of the goal, m/s2. */
            braking_mps2?: (number | string) | null;
            /** @description Metres to the left of the way. Default: as at the start on the same way, else 0. */
            left_m?: (number | string) | null;
            /** @description Place relative to another road user as it moves in the result. */
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
            /** @description What it is. */
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
            /** @description Gap from the front of the other one to the own rear, metres. */
            ahead_m?: (number | string) | null;
            /** @description Gap from the own front to the rear of the other one, metres. */
            behind_m?: (number | string) | null;
            /** @description The same gap in seconds at the speed of the goal. */
            behind_s?: (number | string) | null;
            /**
             * Format: int32
             * @description Lanes to the left of the other one's; negative is to the right.
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
            /** @description Start ahead of an earlier road user of the list: its id, with `gap_m`. */
            ahead_of?: string | null;
            /** @description Start along the way, metres from the place; negative is before it. */
            at_m?: (number | string) | null;
            /** @description Start along the way in seconds from the place at the own speed; negative is before it. */
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
            /** @description Places of the own way that it passes, metres from the place, at any time; 4 at most. */
            via_m?: (number | string)[];
            /**
             * @description The way that it starts on.
             * @default own
             */
            way?: components["schemas"]["PatternWay"];
            /** @description Width of its box, metres. Default: that of the type. */
            width_m?: (number | string) | null;
        };
        /**
         * PatternWay
         * @description A way of the place, along which road users are put. All ways have the place at 0 m.
         *
         *     `own`: That of the subject.
         *
         *     `against`: That of the subject, in the opposite direction.
         *
         *     `other`: The lane that is crossed or joined.
         *
         *     `left`: The lane to the left, in the same direction.
         *
         *     `right`: The lane to the right, in the same direction.
         *
         *     `oncoming`: The lane in the opposite direction.
         *
         *     `from-left`: Across the own way, from the left: along the crosswalk where one is there.
         *
         *     `from-right`: Across the own way, from the right: along the crosswalk where one is there.
         * @enum {string}
         */
        PatternWay: "own" | "against" | "other" | "left" | "right" | "oncoming" | "from-left" | "from-right";
        /**
         * PeekBody
         * @description Body of a peek.
         */
        PeekBody: {
            /**
             * @description Motion by ego, the first state 0.1 s after the present; at most 90 states. An ego that is left out does what it
             *     has announced.
             * @default {}
             */
            plans?: {
                [key: string]: components["schemas"]["Motion"];
            };
        };
        /**
         * PeekReply
         * @description What the others would do.
         */
        PeekReply: {
            /** @description Who would change its plan because of whom. */
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
            /** @description Traffic by arm, until the end of the scene. Vehicles on the lanes of these arms come only from here. */
            arrivals?: components["schemas"]["Arrivals"][];
            /** @description Density; absent or null is 12 per kilometre, or 0 with `arrivals` or `parked`. */
            density?: components["schemas"]["Density"] | null;
            /**
             * @description With `scene_id`: refuse when the scene has changed.
             * @default null
             */
            etag?: string | null;
            /**
             * @description Road users of the scene that stay; null keeps all. The others are taken to be gone.
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
            /** @description Where; null is the whole map. It may reach 50 m beyond the map's box. */
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
             * @description The same seed gives the same answer.
             * @default 0
             */
            seed?: number;
            /** @description Speeds of moving motor vehicles; null draws them by the road. Vehicles at rest, as in a queue, stay at rest. */
            speeds?: components["schemas"]["Speeds"] | null;
            /**
             * Format: double
             * @description Scene time at which they start, seconds.
             * @default 0
             */
            start_s?: number;
            /**
             * @description Share of `vehicle`, `pedestrian` and `cyclist`; sums to 1.
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
         * @description What was placed.
         */
        PlaceReply: {
            /**
             * @description New road users: one state at `start_s`, the same as a fixed start, goals free. One that enters by an arm
             *     later has a track from the map's edge on, which it keeps until it reacts; a parked one has a standing track.
             */
            agents: components["schemas"]["Agent"][];
            /** @description Arms: where roads enter the map or the region, with the traffic placed on each. */
            arms: components["schemas"]["ArmDoc"][];
            /** @description `model`, or `lane-sampler` where the weights folder has no placement weights. */
            method: components["schemas"]["PlacementMethod"];
            /**
             * Format: uint
             * @description Places at kerbs and in lots; null without `parked`.
             */
            parking_places: number | null;
            /** @description Why, in one sentence; null when all were placed. */
            reason: string | null;
            /**
             * Format: uint
             * @description Number of requested road users without a place.
             */
            unplaced: number;
        };
        /**
         * PlacementInfo
         * @description Facts about placement weights.
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
         * @description How road users are placed.
         *
         *     `model`: By learned rates and distributions.
         *
         *     `lane-sampler`: Even along lanes, at the speed limit: where there are no weights, and to compare with.
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
         * @description RFC 9457 problem. Switch on `code`, which never changes.
         */
        Problem: {
            /** @description Road user that an expert failed for. */
            agent?: string;
            /**
             * Format: uint64
             * @description The revision that took over.
             */
            by_revision?: number;
            /**
             * @description The word to switch on.
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
            /** @description All faults that were found in the body or the query. */
            errors?: components["schemas"]["FieldProblem"][];
            /** @description ETag of the scene as it is stored now. */
            etag?: string;
            /** @description What is not ready. */
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
             * @description The bound that was met.
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
             * @description Byte of the decoded file.
             */
            offset?: number;
            /** @description What the reader of a file found there. */
            reason?: string;
            /** @description Id of the request, as in X-Request-Id and in the server's log. */
            request_id?: string;
            /**
             * Format: uint64
             * @description The same in milliseconds, more precise.
             */
            retry_after_ms?: number;
            /**
             * Format: uint64
             * @description Seconds after which to ask again, as in Retry-After.
             */
            retry_after_s?: number;
            /**
             * Format: uint16
             * @description HTTP status.
             */
            status: number;
            /**
             * Format: uint
             * @description Refinement step at which an expert failed; 0 is the first guess.
             */
            step?: number;
            /** @description A few words for people, the same for each occurrence. */
            title: string;
            /** @description Page about the code, relative to this server. */
            type: string;
            /** @description When the scene was stored, RFC 3339. */
            updated_at?: string;
        };
        /**
         * Program
         * @description The lights of a junction: its phases follow one another without end.
         */
        Program: {
            /**
             * Format: double
             * @description Red for all before the next green, seconds.
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
             * @description How long the first green has been on when the scene begins, seconds.
             * @default 7
             */
            offset_s: number;
            /**
             * @description Turns across oncoming traffic.
             * @default permissive
             */
            turns_across: components["schemas"]["TurnAcross"];
            /**
             * Format: double
             * @description Yellow after it, seconds.
             * @default 3
             */
            yellow_s: number;
        };
        /**
         * Reach
         * @description Whether a goal was met, and what would have been needed: `unreachable` gives the nearest state and
         *     what it would take.
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
            /** @description Limit that binds. */
            limiting: components["schemas"]["Limiting"];
            /** @description The reason as data. */
            message: components["schemas"]["Message"];
            /** @description State at the goal time that comes nearest. */
            nearest: components["schemas"]["NearestState"];
            /**
             * Format: double
             * @description Amount that the goal would take, in that limit's unit, where a formula gives it.
             */
            needs: number | null;
            /** @constant */
            status: "unreachable";
            /** @description The agent in the way, if there is one. */
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
         * @description Why a road user gave up the motion that it had.
         */
        Reaction: {
            /** @description The road user that its own motion would have met. */
            cause: string;
            /**
             * Format: double
             * @description Delay against its own motion, seconds; negative for earlier.
             */
            delay_s: number;
            /** @description Kind of the reaction. */
            kind: components["schemas"]["ReactionKind"];
            /**
             * Format: double
             * @description Speed then, m/s.
             */
            speed_mps: number;
            /**
             * Format: double
             * @description Scene time at which it waits or is slowest, seconds.
             */
            time_s: number;
            /**
             * Format: double
             * @description Where then, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Where then, metres.
             */
            y_m: number;
        };
        /**
         * ReactionKind
         * @description How a road user reacts to another.
         *
         *     `waits`: Comes to rest.
         *
         *     `slows`: Is slower.
         *
         *     `speeds_up`: Is faster.
         *
         *     `keeps_clear`: Takes another line.
         *
         *     `stays_out`: Comes in later than the others, and does not come in: its place is taken then.
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
             * @description The log itself shows it: the motion is the recorded one, or the recording has the same at about
             *     the same time, no less bad.
             */
            in_log: boolean;
            /** @description Lane of the red signal. */
            lane: string;
            /**
             * Format: double
             * @description Speed then, m/s.
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
         * @description What trajectories are compared with.
         */
        Reference: components["schemas"]["Log"] | {
            [key: string]: components["schemas"]["Trajectory"];
        };
        /**
         * Region
         * @description Where centres may lie: exactly one of the two.
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
         * @description A motion and another's.
         */
        Relation: {
            /**
             * Format: double
             * @description Time between the two at that place, seconds.
             */
            gap_s?: number | null;
            /** @description Which. */
            kind: components["schemas"]["RelationKind"];
            /**
             * Format: double
             * @description Scene time at which this one is there, seconds.
             */
            time_s: number;
            /** @description The other road user. */
            with: string;
            /**
             * Format: double
             * @description Where, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Where, metres.
             */
            y_m: number;
        };
        /**
         * RelationKind
         * @description Relation of a motion to another's.
         *
         *     `before`: Their paths cross, and this one is there first.
         *
         *     `after`: Their paths cross, and this one is there second.
         *
         *     `follows`: Behind the other on the same way.
         *
         *     `gives_way_to`: Slows down or waits where their paths cross, so that the other goes first.
         * @enum {string}
         */
        RelationKind: "before" | "after" | "follows" | "gives_way_to";
        /**
         * Resolved
         * @description Every condition field of one road user as it was used.
         */
        Resolved: {
            /**
             * @description Where its shown future leaves the road or drives against the traffic: the nearest place to the goal that the
             *     road leads to in the same time.
             */
            by_road?: components["schemas"]["ByRoad"] | null;
            /** @description Where it goes. */
            goal: components["schemas"]["ResolvedGoal"];
            /** @description One entry for each window that ended its plan before the goal was due. */
            intermediate?: components["schemas"]["Intermediate"][];
            /** @description Along the heading. */
            length_m: components["schemas"]["Field"];
            /** @description Verdict on the goal. */
            reach: components["schemas"]["Reach"];
            /** @description Where it begins. */
            start: components["schemas"]["ResolvedStart"];
            /** @description Expert that ran. */
            type: components["schemas"]["AgentType"];
            /** @description How its shown future passes each via point, in their order. */
            via?: components["schemas"]["ResolvedVia"][];
            /** @description Across the heading. */
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
             * @description How near the future comes, metres.
             */
            distance_m: number;
            /** @description It is passed within its tolerance, and at its time where that is fixed. */
            passed: boolean;
            /**
             * Format: double
             * @description Scene time then, seconds.
             */
            time_s: number;
            /**
             * Format: double
             * @description Tolerance of the condition, metres.
             */
            tolerance_m: number;
            /**
             * Format: double
             * @description Where it lies, metres.
             */
            x_m: number;
            /**
             * Format: double
             * @description Where it lies, metres.
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
             * @description Width of a crosswalk half way, metres; less than half a metre is none.
             * @default 0
             */
            crosswalk_m: number;
            /**
             * Format: double
             * @description Width of a cycle lane on both sides, metres; less than half a metre is none.
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
             * @description Lanes the other way.
             * @default 2
             */
            lanes_backward: number;
            /**
             * Format: uint8
             * @description Lanes eastwards, where the road begins.
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
             * @description Width of a raised strip between the directions, metres; less than half a metre is none.
             * @default 0
             */
            median_m: number;
            /**
             * Format: double
             * @description Width of a strip for parked cars on both sides, metres; less than half a metre is none.
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
             * @description Width of the pavements, metres; less than half a metre is none.
             * @default 2.5
             */
            sidewalk_m: number;
            /**
             * @description Speed bumps before and behind the crosswalk.
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
             * @description Side of the road that traffic keeps to.
             * @default right-hand
             */
            traffic: components["schemas"]["Traffic"];
        };
        /**
         * RoadEdge
         * @description The end of the road's surface.
         */
        RoadEdge: {
            /** @description Unique among road edges. */
            id: string;
            /** @description In order. */
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
         * @description What is at the place.
         *
         *     `lane`: A lane for motor vehicles outside of junctions.
         *
         *     `crosswalk`: A crosswalk over the way of the subject.
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
            /** @description Unique among road lines. */
            id: string;
            /** @description In order. */
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
         * @description What the road must have.
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
            /** @description What is there. */
            feature: components["schemas"]["RoadFeature"];
            /** @description From where the other way comes, as the subject sees it. */
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
            /** @description How the way of the subject turns: from 25 m before the place to 5 m after it, on a lane over all of the way. */
            turn?: components["schemas"]["RoadTurn"] | null;
        };
        /**
         * RoadPattern
         * @description A situation on any map: what the road must have, and who drives or walks there.
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
            /** @description Where the parameters are from. */
            source?: string | null;
            /** @description One sentence. */
            title: string;
            /** @description Road users. The first one is the subject: its goal may stay free. */
            users: components["schemas"]["PatternUser"][];
        };
        /**
         * RoadTurn
         * @description How a way turns.
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
            /** @description What the answers agree upon, the surest first. */
            wishes: components["schemas"]["LearnedWish"][];
        };
        /**
         * RoundCard
         * @description A candidate that is shown.
         */
        RoundCard: {
            /** @description Features of the card; the client returns them with the verdict. */
            features: components["schemas"]["Features"];
            /**
             * Format: double
             * @description The share of the learned wishes that it fulfils; absent while none is known.
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
             * @description 3 to 6 of them, at least 20 degrees apart.
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
             * @description Lanes of the ring.
             * @default 1
             */
            ring_lanes: number;
            /**
             * Format: double
             * @description Speed limit in the ring, km/h.
             * @default 30
             */
            ring_speed_limit_kmh: number;
            /**
             * Format: double
             * @description Width of the pavements, metres; less than half a metre is none.
             * @default 2.5
             */
            sidewalk_m: number;
            /**
             * @description Side of the road that traffic keeps to.
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
             * @description With `scene_id`: refuse when the scene has changed.
             * @default null
             */
            etag?: string | null;
            /**
             * Format: double
             * @description Each of the others plans anew after so many seconds; 1 by default.
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
             * @description Repeats the run; 0 by default.
             * @default null
             */
            seed?: number | null;
            /**
             * @description A snapshot of a run in this scene, base64: the run goes on from there.
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
         * @description What a follower of a run is told: the run first, then each step as it is made, the end when the run is forgotten.
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
         * @description A fault and the road user whose it is.
         */
        RunFault: {
            /** @description Of a collision the one that drove into the other. */
            agent: string;
            /** @description What, when and where. */
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
             * @description Seconds without a request after which the server forgets the run.
             */
            idle_s: number;
            /**
             * Format: double
             * @description Each of the others plans anew after so many seconds.
             */
            plan_interval_s: number;
            /** @description The present. */
            present: components["schemas"]["StepReply"];
            /** @description Id of the run. */
            run: string;
            /**
             * Format: uint64
             * @description Repeats the run.
             */
            seed: number;
            /**
             * Format: double
             * @description Length of a step, seconds.
             */
            step_s: number;
            /**
             * Format: uint64
             * @description Steps that may still be made.
             */
            steps_left: number;
            /**
             * Format: uint64
             * @description Seconds since the last request that used the run; looking at it is no use.
             */
            unused_s: number;
        };
        /**
         * Sample
         * @description One coherent answer for all regenerated road users.
         */
        Sample: {
            /** @description Road user's id to its futures. */
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
         * @description How the numbers of a situation are chosen.
         *
         *     `grid`: Every combination of the values.
         *
         *     `random`: Independent draws.
         *
         *     `latin-hypercube`: Each range has as many strata of equal width as there are draws, and one draw in each.
         *
         *     `sobol`: Scrambled Sobol points, which spread evenly over all ranges at once; best with a power of two of draws.
         *
         *     `search`: Tries that come nearer to `where`: CMA-ES over the ranges, for each seed of its own.
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
            /** @description Of the scene. */
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
             * @description For people.
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
         * @description A scene as lists show it.
         */
        SceneItem: {
            /**
             * Format: uint64
             * @description Size as stored.
             */
            bytes: number;
            /** @description Road users by type. */
            counts: components["schemas"]["Counts"];
            /** @description RFC 3339. */
            created_at: string;
            /** @description With quotes, as in the ETag header. */
            etag: string;
            /** @description Has generated futures. */
            generated: boolean;
            /** @description Id of the scene. */
            id: string;
            /** @description Licence of the content. */
            licence: string | null;
            /** @description Content hash of the map, 64 hex digits. */
            map_sha256: string;
            /** @description For people. */
            name: string;
            /** @description User whose scene it is, on a server whose scenes have owners. */
            owner?: string | null;
            /** @description Scene it is a variant of. */
            parent_id: string | null;
            /** @description Demo scenes and those of the data folder; duplicate one to change it. */
            readonly: boolean;
            /** @description What others may do with it. */
            shared?: components["schemas"]["SceneShare"] | null;
            /** @description Format or tool it came from. */
            source: string;
            /** @description Id in the source. */
            source_id: string | null;
            /**
             * Format: uint
             * @description Steps of 0.1 s.
             */
            steps: number;
            /** @description Words to find it by. */
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
             * @description What others may do with the scene, where scenes have owners; only its owner says so.
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
         *     Lists hold what the log itself shows too, marked `in_log`. Such events are not counted in
         *     `collision_rate` nor with the road users; distances, times and the other shares are measured over all
         *     motion, the recorded too.
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
             * @description Share of road users in any collision that the log does not show.
             */
            collision_rate: number;
            /**
             * Format: double
             * @description Share of road users in any collision, those of the log counted (the paper's scenario collision
             *     rate).
             */
            collision_rate_with_log: number;
            /** @description By time, then by pair. */
            collisions: components["schemas"]["Collision"][];
            /** @description The pairs of the three lists with their measures. By time, then by pair. */
            encounters: components["schemas"]["Encounter"][];
            /** @description Which step counted as the end. */
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
            /** @description Turning harder than the threshold; `worst` in m/s2 sideways. */
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
             *     overlap. People in company are left out where they touch.
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
            /** @description Wheels where the roads of the map have ended; `worst` in metres from the lanes. */
            off_map: components["schemas"]["Stretch"][];
            /** @description Vehicles off the road, but for those over a median. */
            off_road: components["schemas"]["Stretch"][];
            /**
             * Format: double
             * @description Farthest a vehicle's corner goes off the road, metres.
             */
            offroad_max_m: number | null;
            /**
             * Format: double
             * @description Share of vehicle steps with a corner off the road.
             */
            offroad_share: number | null;
            /** @description Pedestrians along a lane, or across lanes beside a crosswalk; `worst` in metres walked. */
            on_carriageway: components["schemas"]["Stretch"][];
            /** @description Vehicles over what divides two roads. */
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
            /** @description Vehicles above the speed limit; `worst` in m/s above it. */
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
         * @description What others than its owner may do with a scene.
         *
         *     `nobody`: Nothing: it is not found.
         *
         *     `read`: See, generate in and copy it.
         *
         *     `edit`: And change it; only its owner deletes it.
         * @enum {string}
         */
        SceneShare: "nobody" | "read" | "edit";
        /**
         * ScoreReply
         * @description Answer to a score request.
         */
        ScoreReply: {
            /** @description Each road user, by id. */
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
             * @description With `scene_id`: refuse when the scene has changed.
             * @default null
             */
            etag?: string | null;
            /**
             * @description `all` or `regenerated`.
             * @default all
             */
            pairs?: components["schemas"]["PairChoice"];
            /** @description The log by default. */
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
             * @description Numbers that decide what counts; those absent have their defaults.
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
            /** @description Motion to score; for the rest the chosen futures, else the log. */
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
         * @description First event: what will be tried.
         */
        SearchAcceptedEvent: {
            /**
             * Format: double
             * @description Since the request was read, milliseconds.
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
             * @description Jobs before this one when it was queued.
             */
            queue_position: number;
            /**
             * Format: uint64
             * @description Revision of the request, when it had one.
             */
            revision?: number;
            /**
             * Format: uint64
             * @description Rises by one an event; a gap shows events that were dropped for a slow reader.
             */
            seq: number;
            /**
             * Format: uint64
             * @description Most tries that are made.
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
             * @description With `scene_id`: refuse when the scene has changed.
             * @default null
             */
            etag?: string | null;
            /**
             * Format: uint64
             * @description Ends the search when so many tries satisfy the condition. Default: all tries are made.
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
             * @description The client's id of the job, to cancel it by.
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
             * @description What is varied: a template with ranges of its figures, or conditions with ranges. A condition for several road
             *     users is searched for each of them.
             * @default {}
             */
            situation?: components["schemas"]["BatchSituation"];
            /**
             * Format: uint64
             * @description Tries for each road user and each seed. All of them together are at most 1000.
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
         *     `found`: As many tries satisfy the condition as were wanted.
         *
         *     `tries`: All tries are made.
         *
         *     `time`: The time of a call is over; the tries so far are there.
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
             * @description Since the request was read, milliseconds.
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
             * @description Revision of the request, when it had one.
             */
            revision?: number;
            /**
             * Format: uint64
             * @description Rises by one an event; a gap shows events that were dropped for a slow reader.
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
            /** @description Names the result, in six characters. */
            code?: string;
            /** @description Drawn numbers by path, such as `goal.speed_mps`. */
            drawn: {
                [key: string]: number;
            };
            /**
             * Format: double
             * @description Since the request was read, milliseconds.
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
             * @description How far it is from the condition, 0 where it holds; absent without a result.
             */
            miss?: number;
            /**
             * Format: uint64
             * @description Rises by one a try, from 0.
             */
            number: number;
            /** @description The road user that the situation affects. */
            other?: string;
            /** @description How it ended. */
            outcome: components["schemas"]["UnitOutcome"];
            /** @description Code of the problem for which there is no result. */
            problem?: string;
            /** @description The body of a `POST /v1/generate` that gives the same result, without its scene; absent without a result. */
            request?: components["schemas"]["TryRequest"];
            /**
             * Format: uint64
             * @description Revision of the request, when it had one.
             */
            revision?: number;
            /**
             * Format: uint64
             * @description Rises by one an event; a gap shows events that were dropped for a slow reader.
             */
            seq: number;
            /** @description What the actor of a template does, in one sentence. */
            what?: string;
        };
        /**
         * SearchTry
         * @description One try.
         */
        SearchTry: {
            /** @description Names the result, in six characters. */
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
             * @description How far it is from the condition, 0 where it holds; absent without a result.
             */
            miss?: number;
            /**
             * Format: uint64
             * @description Rises by one a try, from 0.
             */
            number: number;
            /** @description The road user that the situation affects. */
            other?: string;
            /** @description How it ended. */
            outcome: components["schemas"]["UnitOutcome"];
            /** @description Code of the problem for which there is no result. */
            problem?: string;
            /** @description The body of a `POST /v1/generate` that gives the same result, without its scene; absent without a result. */
            request?: components["schemas"]["TryRequest"];
            /** @description What the actor of a template does, in one sentence. */
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
            /** @description Box centres at every half second after the start, metres; at most 18 count. */
            x_m: number[];
            /** @description As many as `x_m`. */
            y_m: number[];
        };
        /**
         * Signal
         * @description The signal of one lane over the scene.
         */
        Signal: {
            /** @description Lane that obeys it. */
            lane: string;
            /** @description Run-length states; first steps rise. */
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
         * @description A record of a file that is no scene.
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
         * @description A run as a text. Without its scene.
         */
        SnapshotReply: {
            /**
             * Format: uint
             * @description Bytes of the snapshot.
             */
            bytes: number;
            /**
             * Format: uint64
             * @description Steps that it has made.
             */
            number: number;
            /** @description Base64, for `snapshot` of a run that is begun. */
            snapshot: string;
        };
        /**
         * Source
         * @description Where the value of a field came from.
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
         * @description Between which speeds motor vehicles start that move.
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
             * @description Radians, then wrapped; a request takes at most a turn either way, 6.2832.
             */
            heading_rad?: number | null;
            /**
             * Format: double
             * @description m/s.
             */
            speed_mps?: number | null;
            /** @description In place of `speed_mps`; fixes a free heading too. */
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
         * @description Fields of a start; those absent are the scene's: of the conditions there, else of the recording.
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
            /** @description Radians from the heading there. */
            turn_rad?: components["schemas"]["Distribution"] | null;
            /** @description Box centre in the frame of the scene, metres; with `y_m`. */
            x_m?: components["schemas"]["Distribution"] | null;
            /** @description Box centre in the frame of the scene, metres; with `x_m`. */
            y_m?: components["schemas"]["Distribution"] | null;
        };
        /**
         * State
         * @description Place, heading and velocity of a road user at one moment, scene frame.
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
            /** @description Every ego at the end of the step. */
            egos?: components["schemas"]["Ego"][];
            /**
             * Format: uint64
             * @description Number of the step: one more than the last. The last one again gives the same reply again.
             */
            number: number;
        };
        /**
         * StepReply
         * @description What a step came to.
         */
        StepReply: {
            /** @description Who changed its plan because of whom. */
            changes: components["schemas"]["Change"][];
            /** @description Ids of those who came in. */
            entered: string[];
            /** @description Collisions and vehicles off the road that began in this step. */
            faults: components["schemas"]["RunFault"][];
            /** @description Those who left. */
            left: components["schemas"]["Departure"][];
            /**
             * Format: uint64
             * @description Number of the step; 0 for the start.
             */
            number: number;
            /** @description Everybody who is there, egos too, by id. */
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
            /** @description Unique among stop signs. */
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
         * @description What drafts carry.
         *
         *     `chosen`: The chosen future of each road user.
         *
         *     `all`: All alternatives.
         * @enum {string}
         */
        StreamModes: "chosen" | "all";
        /**
         * Stretch
         * @description Something one road user does over a stretch of time.
         */
        Stretch: {
            /** @description The road user. */
            agent: string;
            /** @description Off the road and over a median: the road edge that is driven over, by its id in the map. */
            edge: string | null;
            /**
             * @description The log itself shows it: the motion is the recorded one, or the recording has the same at about
             *     the same time, no less bad.
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
             * @description The worst of it, in the unit of its list: metres off the road, off the map, driven against the traffic or
             *     walked on the carriageway; m/s2 of braking or sideways; share of the limit for turns; m/s above the speed limit
             *     or of running; radians askew.
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
         * @description Last event of a call that a newer revision of its client took over.
         */
        SupersededEvent: {
            /**
             * Format: uint64
             * @description The newer one.
             */
            by_revision: number;
            /**
             * Format: double
             * @description Since the request was read, milliseconds.
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
             * @description Revision of the request, when it had one.
             */
            revision?: number;
            /**
             * Format: uint64
             * @description Rises by one an event; a gap shows events that were dropped for a slow reader.
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
            /** @description Its name for people. */
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
         * @description Numbers that decide what counts. Those absent in a document have their defaults.
         */
        Thresholds: {
            /**
             * Format: double
             * @description Walking along a lane for longer than this is walking on the carriageway, metres.
             * @default 3
             */
            along_lane_m?: number;
            /**
             * Format: double
             * @description Turned by more than this from every lane at its end is askew, radians.
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
             * @description ... or when more than this share of the smaller box is covered: a child under a bus has a
             *     tiny intersection over union. Above 1 turns the rule off (the paper's form).
             * @default 0.5
             */
            covered_share?: number;
            /**
             * Format: double
             * @description Crossing this near beside a crosswalk is walking on the carriageway, metres.
             * @default 15
             */
            crosswalk_m?: number;
            /**
             * Format: double
             * @description Near miss of one that follows another: only when avoiding the collision needs more braking
             *     than this, m/s2 (deceleration rate to avoid a crash, 3.35 in Archer 2005).
             * @default 3.35
             */
            follow_brake_mps2?: number;
            /**
             * Format: double
             * @description Braking above this of another that gives way is forced on it, m/s2.
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
             * @description Slower than this counts as standing, m/s.
             * @default 0.5
             */
            moving_mps?: number;
            /**
             * Format: double
             * @description Off the map: no lane and no road edge within this, metres.
             * @default 5
             */
            off_map_m?: number;
            /**
             * Format: double
             * @description A corner farther outside than this is off the road, metres.
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
             * @description A faster pedestrian runs, m/s.
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
             * @description Near miss: time to collision below this, seconds. None is looked for beyond [`LOOK_AHEAD_S`].
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
         * @description Time spent, milliseconds.
         */
        Timing: {
            /**
             * Format: double
             * @description Joint choice of modes.
             */
            choice_ms: number;
            /**
             * Format: double
             * @description Map and road users.
             */
            encode_ms: number;
            /**
             * Format: double
             * @description First guess.
             */
            initial_ms: number;
            /**
             * Format: double
             * @description Waiting for a worker.
             */
            queue_ms: number;
            /**
             * Format: double
             * @description Scores.
             */
            score_ms: number;
            /** @description Each denoising step. */
            step_ms: number[];
        };
        /**
         * Track
         * @description Recorded states as columns, one value a step from `first_step`.
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
         * @description Side of the road that traffic keeps to.
         * @enum {string}
         */
        Traffic: "right-hand" | "left-hand";
        /**
         * Trait
         * @description Something about a motion that a person can name and wish otherwise.
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
         * @description Motion of one road user as columns, one value a step from `first_step`.
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
         * @description A generation that gives the result of a try again.
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
             * @description Futures that are planned for each road user.
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
         *     `permissive`: They have green with it and give way.
         *
         *     `protected`: They have a phase of their own.
         * @enum {string}
         */
        TurnAcross: "permissive" | "protected";
        /**
         * UnitOutcome
         * @description How a unit ended.
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
         * @description A person's verdict on a card.
         *
         *     `keep`: Good.
         *
         *     `reject`: Not that.
         * @enum {string}
         */
        Verdict: "keep" | "reject";
        /**
         * Via
         * @description A place that a road user passes on its way.
         */
        Via: {
            /**
             * Format: double
             * @description Scene time at which it is passed, seconds, within half a second; when it comes to it where free. Later than
             *     those before it and no later than the goal. Snapped to 0.1.
             */
            time_s?: number | null;
            /**
             * Format: double
             * @description Passed no farther away than this, metres; 1 when absent.
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
         * @description Something unlikely that was done anyway.
         */
        Warning: {
            /** @description The agent that it concerns. */
            agent: string | null;
            /** @description A word that programs can switch on. */
            code: components["schemas"]["WarningCode"];
            /** @description The warning in English. */
            detail: string;
            /** @description The warning as data. */
            message: components["schemas"]["Message"];
        };
        /**
         * WarningCode
         * @description What is unlikely.
         *
         *     `goal-unreachable`: No future within the limits meets the goal.
         *
         *     `goal-off-road`: No lane is near the goal.
         *
         *     `start-off-road`: No lane is near the start.
         *
         *     `start-overlaps`: The start is in another road user's place.
         *
         *     `extrapolated`: A log that ends was carried on.
         *
         *     `via-missed`: The shown future misses a via point.
         *
         *     `nothing-generated`: No road user was named, and none has to continue beyond its known motion.
         * @enum {string}
         */
        WarningCode: "goal-unreachable" | "goal-off-road" | "start-off-road" | "start-overlaps" | "extrapolated" | "via-missed" | "nothing-generated";
        /**
         * WeightsInfo
         * @description Facts about one expert's weights.
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
            /** @description Random weights, for tests. */
            untrained: boolean;
        };
        /**
         * Who
         * @description `"all"` or a list of ids.
         */
        Who: components["schemas"]["All"] | string[];
        /**
         * Wish
         * @description A plain wish: a trait and which way.
         */
        Wish: {
            /** @description Which way. */
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
         * @description Which way of a trait is wished.
         *
         *     `more`: More of it; of an order or a manoeuvre: yes.
         *
         *     `less`: Less of it; of an order or a manoeuvre: no.
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
                /** @description A name of the formats table. */
                format?: string;
                /** @description Which sample of the generated futures; the chosen one when absent. */
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
                /** @description A name of the formats table; recognised from the content when absent or `auto`. */
                format?: string;
                /** @description Records to take, such as `0..9` (both ends), or one number. */
                index?: string;
                /**
                 * @description The part of a map to read: `X,Y,RADIUS` keeps what lies within so many metres (10 to 5000) of a place in the
                 *     coordinates of the file (longitude, latitude where it has degrees).
                 */
                around?: string;
                /** @description Give the scenes back and store nothing. */
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
            /** @description not under way any more */
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
            /** @description what was placed */
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
            /** @description what they would do */
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
            /** @description what the step came to */
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
                /** @description Most scenes of a page, 1 to 200. */
                limit?: number;
                /** @description `next` of the page before. */
                after?: string;
                /** @description Text in the name, case ignored. */
                q?: string;
                /** @description One tag. */
                tag?: string;
                /** @description Scene that the listed ones are variants of. */
                parent?: string;
                /** @description `updated` or `name`, with `-` before it for falling order. */
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
            /** @description made */
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
                /** @description A name of the formats table. */
                format?: string;
                /** @description Which sample of the generated futures; the chosen one when absent. */
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
