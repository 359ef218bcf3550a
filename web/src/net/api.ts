// Made from assets/openapi.json by `npm run api`; not to be edited. net/types.ts names what the editor uses.
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
        /** Experts are warm, the store takes writes, the queue has room. */
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
        get?: never;
        put?: never;
        /**
         * Generates futures. The reply is a stream of events (NDJSON or SSE) or the last event alone (JSON),
         *     by Accept. Stores nothing.
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
        /** Stores the scenes of a file. */
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
         *     cyclists on bike lanes or on the right. Boxes keep 0.1 m apart and all centres lie in the region. Fewer
         *     than asked is no error. Stores nothing.
         */
        post: operations["place"];
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
        /** Saves a new scene; the id of the document is ignored. */
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
        /** Renames a scene, or changes its tags or notes (RFC 7396 merge patch). */
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
}
export type webhooks = Record<string, never>;
export interface components {
    schemas: {
        AcceptedEvent: {
            /** @constant */
            event?: "accepted";
            fixed: string[];
            queue_position: number;
            reacting: string[];
            regenerated: string[];
            seed?: number;
            steps: number;
            warnings?: components["schemas"]["Warning"][];
            windows: number;
        } & components["schemas"]["EventBase"];
        /** @description One road user. */
        AgentDoc: {
            /**
             * @description What the user fixed.
             * @default {}
             */
            conditions?: components["schemas"]["ConditionsDoc"];
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
             * @description What was recorded; empty when absent.
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
            track?: components["schemas"]["TrackDoc"];
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
        /** @description The futures of one road user. */
        AgentFuturesDoc: {
            /**
             * Format: uint64
             * @description Index into `modes` of the one that is shown and exported.
             */
            chosen: number;
            /** @description By falling probability. */
            modes: components["schemas"]["FutureDoc"][];
        };
        /** @description The word `all`. */
        All: "all";
        /** @description A crosswalk, speed bump or driveway. */
        AreaDoc: {
            /** @description Unique among areas of the kind. */
            id: string;
            /** @description Open ring. */
            polygon_m: components["schemas"]["Points"];
        };
        /** @description A stretch of a lane's side and the line or edge that bounds it. */
        BoundaryDoc: {
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
        /** @description A circle. */
        CircleDoc: {
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
        /** @description All that a user fixes about one road user. A number fixes a field, null or absence frees it. */
        ConditionsDoc: {
            /**
             * @description Frame of the goal; replies are always in `scene`.
             * @enum {string}
             */
            frame?: "scene" | "agent";
            /** @description Goal fields. */
            goal?: components["schemas"]["GoalDoc"] | null;
            /**
             * Format: double
             * @description Metres.
             */
            length_m?: number | null;
            /** @description Start fields. */
            start?: components["schemas"]["StartDoc"] | null;
            /**
             * @description Expert to use in place of the road user's own type's.
             * @enum {unknown}
             */
            type?: "vehicle" | "pedestrian" | "cyclist" | null;
            /**
             * Format: double
             * @description Metres.
             */
            width_m?: number | null;
        };
        /** @description Road users by type. */
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
        /** @description How many: exactly one of the two. */
        DensityDoc: {
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
        /** @description `initial`: the first guess. `step`: after a denoising step. The futures of a later window begin where it begins. */
        DraftEvent: {
            agents: {
                [key: string]: components["schemas"]["AgentFuturesDoc"];
            };
            /** @enum {unknown} */
            event?: "initial" | "step";
            sample: number;
            step?: number;
            steps: number;
            window: number;
        } & components["schemas"]["EventBase"];
        /** @description A surface that may be driven on. */
        DrivableDoc: {
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
        /** @description How the copy is called. */
        DuplicateRequest: {
            /**
             * @description The original's with "copy" after it when absent.
             * @default null
             */
            name?: string | null;
        };
        ErrorEvent: {
            /** @constant */
            event?: "error";
            problem: components["schemas"]["Problem"];
        } & components["schemas"]["EventBase"];
        /** @description One event of the stream. Exactly one of final, error and superseded ends it. */
        Event: components["schemas"]["AcceptedEvent"] | components["schemas"]["DraftEvent"] | components["schemas"]["FinalEvent"] | components["schemas"]["ErrorEvent"] | components["schemas"]["SupersededEvent"] | components["schemas"]["HeartbeatEvent"];
        EventBase: {
            elapsed_ms: number;
            event: string;
            job: string;
            revision?: number;
            /** @description Rises; a gap shows steps dropped for a slow reader. */
            seq: number;
        };
        /** @description A value as it was used, and where it came from. */
        Field: {
            /** @enum {unknown} */
            from: "user" | "log" | "default" | "model";
            value: number;
        };
        FieldProblem: {
            code: string;
            detail: string;
            got?: number;
            max?: number;
            min?: number;
            /** @description JSON pointer into the body; /query/NAME for a parameter. */
            pointer: string;
        };
        FinalEvent: {
            /** @constant */
            event?: "final";
            /** @description The scene's `generated` member, all but `samples`: put `samples` in and save. */
            generated: Record<string, never>;
            resolved: {
                [key: string]: components["schemas"]["Resolved"];
            };
            samples: components["schemas"]["SampleDoc"][];
            /** @description One a sample; null when none was asked for. */
            scores?: components["schemas"]["ScoreReply"][] | null;
            timing: {
                choice_ms?: number;
                encode_ms?: number;
                initial_ms?: number;
                queue_ms?: number;
                score_ms?: number;
                step_ms?: number[];
            };
            warnings: components["schemas"]["Warning"][];
            /** @description Planning windows that were run. A chosen future runs through all of them; its alternatives are those of the first and end with its plan. */
            windows: number;
        } & components["schemas"]["EventBase"];
        /**
         * @description One possible motion as columns, one value a step from `first_step`, without gaps. Rounded to
         *     0.001 m, 0.0001 rad and 0.001 m/s.
         */
        FutureDoc: {
            /**
             * Format: uint32
             * @description Which of the generator's anchors it follows: the same number while a goal is dragged is the same
             *     idea.
             */
            anchor?: number | null;
            /**
             * Format: uint64
             * @description Scene step of the first value: one after the start.
             */
            first_step: number;
            /** @description Radians. */
            heading_rad: number[];
            /**
             * Format: double
             * @description Share of belief among the road user's futures.
             */
            probability: number;
            /** @description m/s. */
            vx_mps: number[];
            /** @description m/s. */
            vy_mps: number[];
            /** @description Box centre, metres. */
            x_m: number[];
            /** @description Box centre, metres. */
            y_m: number[];
        };
        /** @description Body of a generation. Exactly one of `scene` and `scene_id` is given. */
        GenerateRequest: {
            /**
             * @description Road users put in for this call.
             * @default []
             */
            add_agents?: components["schemas"]["AgentDoc"][];
            /**
             * @description Road users to regenerate.
             * @default all
             */
            agents?: components["schemas"]["Who"];
            /**
             * @description With `revision`: a newer revision of this client takes over.
             * @default null
             */
            client?: string | null;
            /**
             * @description Replace the scene's own conditions of these road users, whole.
             * @default {}
             */
            conditions?: {
                [key: string]: components["schemas"]["ConditionsDoc"];
            };
            /**
             * Format: double
             * @description Scale of the noise, which makes seeds differ; 0 is the best guess, the same for every seed.
             * @default 0.5
             */
            diversity?: number;
            /**
             * @description With `scene_id`: refuse when the scene has changed.
             * @default null
             */
            etag?: string | null;
            /**
             * Format: double
             * @description Seconds to generate. More than 9 is planned window after window.
             * @default 9
             */
            horizon_s?: number;
            /**
             * @description Own id for the job, so that it can be cancelled.
             * @default null
             */
            job?: string | null;
            /**
             * Format: uint64
             * @description Alternatives kept per road user.
             * @default 6
             */
            modes?: number;
            /**
             * @description Who else answers to them.
             * @default false
             */
            react?: components["schemas"]["Reacting"];
            /**
             * @description Road users taken out for this call.
             * @default []
             */
            remove_agents?: string[];
            /**
             * Format: double
             * @description Plan anew, from the states reached, after so many seconds: 3, 6 or 9; null is 9.
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
             * @description Independent joint scenes.
             * @default 1
             */
            samples?: number;
            /**
             * @description The scene itself; its map may be `{"ref":"sha256:HEX"}`.
             * @default null
             */
            scene?: components["schemas"]["SceneDoc"] | null;
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
             * @description The same seed gives the same answer.
             * @default 0
             */
            seed?: number;
            /**
             * Format: double
             * @description Scene time of the start, seconds.
             * @default 0
             */
            start_s?: number;
            /**
             * Format: uint64
             * @description Denoising steps; 0 returns the first guess.
             * @default 5
             */
            steps?: number;
            /**
             * @description What drafts carry.
             * @default chosen
             */
            stream_modes?: components["schemas"]["StreamModes"];
        };
        /** @description What the generator added to a scene. */
        GeneratedDoc: {
            /**
             * Format: uint64
             * @description Index into `samples`.
             * @default 0
             */
            chosen_sample?: number;
            /**
             * @description RFC 3339 time.
             * @default
             */
            created_at?: string;
            /** @description Hash of the user's part that these futures answer. */
            input_sha256: string;
            /**
             * @description The request's options as sent.
             * @default null
             */
            request?: unknown;
            /** @description Independent answers. */
            samples: components["schemas"]["SampleDoc"][];
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
        /** @description Where a road user should be at `time_s`; absent or null is free. */
        GoalDoc: {
            /**
             * Format: double
             * @description Frame `agent`: metres along the start's heading; with `left_m` or not at all.
             */
            ahead_m?: number | null;
            /**
             * Format: double
             * @description Radians, then wrapped.
             */
            heading_rad?: number | null;
            /**
             * Format: double
             * @description Frame `agent`: metres to the left of the start's heading; with `ahead_m` or not at all.
             */
            left_m?: number | null;
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
             * @description Frame `agent`: radians from the start's heading, then wrapped.
             */
            turn_rad?: number | null;
            /** @description In place of `speed_mps`; fixes a free heading too. */
            velocity?: components["schemas"]["VelocityDoc"] | null;
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
        HeartbeatEvent: {
            /** @constant */
            event: "heartbeat";
        };
        ImportReply: {
            format: string;
            scenes: {
                counts: components["schemas"]["Counts"];
                etag?: string;
                id?: string;
                name: string;
                scene?: components["schemas"]["Scene"];
                steps: number;
                warnings: components["schemas"]["Warning"][];
            }[];
            skipped: {
                index: number;
                problem: components["schemas"]["Problem"];
            }[];
        };
        Info: {
            build?: Record<string, never>;
            condition_ranges?: Record<string, never>;
            device?: string;
            formats: Record<string, never>[];
            limits: {
                [key: string]: {
                    value?: number;
                    what?: string;
                };
            };
            name: string;
            notices?: string[];
            placement?: {
                licence?: string;
                numbers?: number;
                sha256?: string;
                trained_on?: string;
            } | null;
            version: string;
            weights: {
                [key: string]: Record<string, never>;
            };
        };
        /** @description One lane. */
        LaneDoc: {
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
            left_boundary?: components["schemas"]["BoundaryDoc"][];
            /**
             * @description Lanes on the left.
             * @default []
             */
            left_neighbors?: components["schemas"]["NeighborDoc"][];
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
            right_boundary?: components["schemas"]["BoundaryDoc"][];
            /**
             * @description Lanes on the right.
             * @default []
             */
            right_neighbors?: components["schemas"]["NeighborDoc"][];
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
        /** @description The word `log`. */
        Log: "log";
        Map: components["schemas"]["MapDoc"];
        /** @description Everything that does not move. */
        MapDoc: {
            /**
             * @description Crosswalks.
             * @default []
             */
            crosswalks?: components["schemas"]["AreaDoc"][];
            /**
             * @description Surfaces that may be driven on.
             * @default []
             */
            drivable?: components["schemas"]["DrivableDoc"][];
            /**
             * @description Driveways.
             * @default []
             */
            driveways?: components["schemas"]["AreaDoc"][];
            /**
             * @description Lanes with their links.
             * @default []
             */
            lanes?: components["schemas"]["LaneDoc"][];
            /**
             * @description Ends of the road's surface.
             * @default []
             */
            road_edges?: components["schemas"]["RoadEdgeDoc"][];
            /**
             * @description Painted lines.
             * @default []
             */
            road_lines?: components["schemas"]["RoadLineDoc"][];
            /**
             * @description Speed bumps.
             * @default []
             */
            speed_bumps?: components["schemas"]["AreaDoc"][];
            /**
             * @description Stop signs.
             * @default []
             */
            stop_signs?: components["schemas"]["StopSignDoc"][];
        };
        /** @description A map, or the hash of one. */
        MapField: components["schemas"]["MapRef"] | components["schemas"]["MapDoc"];
        /** @description One map of the store. */
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
        /** @description Maps of the store. */
        MapList: {
            maps: components["schemas"]["MapItem"][];
        };
        /** @description Names a map by its content. */
        MapRef: {
            /** @description `sha256:` and 64 hex digits, see `scene::LaneMap::hash`. */
            ref: string;
        };
        /** @description Where the scene came from and what people say about it. */
        MetaDoc: {
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
            origin?: components["schemas"]["OriginDoc"];
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
         * @description Words of [`Method`].
         * @enum {string}
         */
        MethodWord: "model" | "lane-sampler";
        /** @description A lane beside this one. */
        NeighborDoc: {
            /** @description Lines between the two, over the other lane's indices. */
            boundaries?: components["schemas"]["BoundaryDoc"][];
            /** @description Id of the other lane. */
            lane: string;
            /** @description First and last point index on the other lane. */
            other: number[];
            /** @description First and last point index on this lane. */
            self: number[];
        };
        /** @description Where the scene lies in its source's frame: `source = rotate(scene, rotation_rad) + (x, y, z)`. */
        OriginDoc: {
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
         * @description Which pairs are looked at.
         * @enum {string}
         */
        PairWord: "all" | "regenerated";
        /** @description Body of a placement. Exactly one of `scene` and `scene_id` is given. */
        PlaceBody: {
            /**
             * Format: double
             * @description Scene time at which they start, seconds.
             * @default 0
             */
            at_s?: number;
            /** @description How many. */
            density?: components["schemas"]["DensityDoc"];
            /**
             * @description Road users of the scene that stay; null keeps all. The others are taken to be gone.
             * @default null
             */
            keep?: string[] | null;
            /**
             * Format: double
             * @description Least room along the lane between those who drive, metres. Everybody else keeps 0.1 m.
             * @default 2
             */
            min_gap_m?: number;
            /** @description Where; null is the whole map. It may reach 50 m beyond the map's box. */
            region?: components["schemas"]["RegionDoc"] | null;
            /**
             * @description The scene itself; its map may be `{"ref":"sha256:HEX"}`.
             * @default null
             */
            scene?: components["schemas"]["SceneDoc"] | null;
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
            /**
             * @description Share of `vehicle`, `pedestrian` and `cyclist`; sums to 1.
             * @default null
             */
            types?: {
                [key: string]: number;
            } | null;
        };
        /** @description What was placed. */
        PlaceReply: {
            /** @description New road users: one state at `at_s`, the same as a fixed start, goals free. */
            agents: components["schemas"]["AgentDoc"][];
            /** @description `model`, or `lane-sampler` where the weights folder has no placement weights. */
            method: components["schemas"]["MethodWord"];
            /** @description Why, in one sentence; null when all were placed. */
            reason?: string | null;
            /**
             * Format: uint
             * @description Road users asked for that found no place.
             */
            unplaced: number;
        };
        /** @description [x, y] or [x, y, z], metres in the scene frame. */
        Point: [
            number,
            number
        ];
        /** @description A line or open ring; all its points have two or all have three numbers. */
        Points: components["schemas"]["Point"][] | unknown | unknown;
        /** @description RFC 9457 problem. Switch on `code`, which never changes. */
        Problem: {
            by_revision?: number;
            /** @enum {string} */
            code: "malformed-json" | "malformed-file" | "bad-header" | "bad-host" | "unauthorized" | "bad-origin" | "cross-site" | "read-only" | "not-found" | "method-not-allowed" | "not-acceptable" | "body-timeout" | "exists" | "superseded" | "stale-revision" | "cancelled" | "stale-etag" | "body-too-large" | "decoded-too-large" | "expansion-too-high" | "uri-too-long" | "unsupported-media-type" | "host-not-allowed" | "invalid-field" | "out-of-range" | "half-position" | "start-missing" | "unknown-agent" | "unknown-map" | "too-many-agents" | "map-too-large" | "reply-too-large" | "unsupported-version" | "format-unknown" | "cannot-represent" | "licence-refused" | "precondition-required" | "headers-too-large" | "internal" | "non-finite-output" | "busy" | "not-ready" | "shutting-down" | "generate-timeout" | "store-full";
            column?: number;
            detail: string;
            errors?: components["schemas"]["FieldProblem"][];
            etag?: string;
            failing?: string[];
            highest_revision?: number;
            instance?: string;
            limit?: number;
            line?: number;
            /** @description Byte of the decoded file. */
            offset?: number;
            request_id?: string;
            retry_after_s?: number;
            status: number;
            title: string;
            /** @description Page about the code, relative to this server. */
            type: string;
            updated_at?: string;
        };
        /** @description Whether the goal was met; `unreachable` gives the nearest state and what it would take. */
        Reach: {
            heading_rad?: number;
            limiting?: string;
            nearest?: {
                heading_rad?: number;
                speed_mps?: number;
                x_m?: number;
                y_m?: number;
            };
            needs?: number | null;
            position_m?: number;
            speed_mps?: number;
            /** @enum {unknown} */
            status: "reached" | "unreachable";
            words?: string;
        };
        /** @description Who else answers: true for everyone near, or ids. */
        Reacting: boolean | string[];
        /** @description What trajectories are compared with. */
        Reference: components["schemas"]["Log"] | {
            [key: string]: components["schemas"]["TrajectoryDoc"];
        };
        /** @description Where centres may lie: exactly one of the two. */
        RegionDoc: {
            /** @description Circle. */
            circle?: components["schemas"]["CircleDoc"] | null;
            /**
             * @description Open ring of corners, metres; even-odd rule.
             * @default null
             */
            polygon_m?: number[][] | null;
        };
        /** @description Every condition field of one road user as it was used. */
        Resolved: {
            goal?: {
                [key: string]: components["schemas"]["Field"];
            };
            /** @description Where windows that ended before the goal was due were sent: states on the way to it. */
            intermediate?: {
                heading_rad: number;
                reached: boolean;
                speed_mps: number;
                time_s: number;
                window: number;
                x_m: number;
                y_m: number;
            }[];
            length_m?: components["schemas"]["Field"];
            reach: components["schemas"]["Reach"];
            start?: {
                [key: string]: components["schemas"]["Field"];
            };
            /** @enum {unknown} */
            type: "vehicle" | "pedestrian" | "cyclist" | "other";
            width_m?: components["schemas"]["Field"];
        };
        /** @description The end of the road's surface. */
        RoadEdgeDoc: {
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
        /** @description A painted line. */
        RoadLineDoc: {
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
        /** @description One coherent answer for all regenerated road users. */
        SampleDoc: {
            /** @description Road user's id to its futures. */
            agents: {
                [key: string]: components["schemas"]["AgentFuturesDoc"];
            };
            /**
             * @description Score as the API gave it.
             * @default null
             */
            score?: unknown;
        };
        /** @description What a change gave. */
        Saved: {
            /** @description As in the ETag header. */
            etag: string;
            id: string;
        };
        /**
         * DragTraffic scene
         * @description A scene document, version 1.
         */
        Scene: {
            /**
             * @description Road users.
             * @default []
             */
            agents?: components["schemas"]["AgentDoc"][];
            /**
             * @description `dragtraffic.scene`.
             * @constant
             */
            format: "dragtraffic.scene";
            /**
             * @description What the generator added.
             * @default null
             */
            generated?: components["schemas"]["GeneratedDoc"] | null;
            /**
             * @description Set by the server.
             * @default null
             */
            id?: string | null;
            /** @description Map, or its hash. */
            map: components["schemas"]["MapField"];
            /**
             * @description Where it came from.
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
            meta?: components["schemas"]["MetaDoc"];
            /**
             * @description For people.
             * @default
             */
            name?: string;
            /**
             * @description Traffic signals.
             * @default []
             */
            signals?: components["schemas"]["SignalDoc"][];
            /** @description Steps. */
            time: components["schemas"]["TimeDoc"];
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
         * DragTraffic scene
         * @description A scene document, version 1.
         */
        SceneDoc: {
            /**
             * @description Road users.
             * @default []
             */
            agents?: components["schemas"]["AgentDoc"][];
            /**
             * @description `dragtraffic.scene`.
             * @constant
             */
            format: "dragtraffic.scene";
            /**
             * @description What the generator added.
             * @default null
             */
            generated?: components["schemas"]["GeneratedDoc"] | null;
            /**
             * @description Set by the server.
             * @default null
             */
            id?: string | null;
            /** @description Map, or its hash. */
            map: components["schemas"]["MapField"];
            /**
             * @description Where it came from.
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
            meta?: components["schemas"]["MetaDoc"];
            /**
             * @description For people.
             * @default
             */
            name?: string;
            /**
             * @description Traffic signals.
             * @default []
             */
            signals?: components["schemas"]["SignalDoc"][];
            /** @description Steps. */
            time: components["schemas"]["TimeDoc"];
            /**
             * Format: uint64
             * @description 1.
             * @constant
             */
            version: 1;
        } & {
            [key: string]: unknown;
        };
        /** @description A scene as lists show it. */
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
            licence?: string | null;
            /** @description Content hash of the map, 64 hex digits. */
            map_sha256: string;
            /** @description For people. */
            name: string;
            /** @description Scene it is a variant of. */
            parent_id?: string | null;
            /** @description Demo scenes and those of the data folder; duplicate one to change it. */
            readonly: boolean;
            /** @description Format or tool it came from. */
            source: string;
            /** @description Id in the source. */
            source_id?: string | null;
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
        /** @description A page of scenes. */
        SceneList: {
            /** @description Send as `after` for the next page; null on the last. */
            next?: string | null;
            scenes: components["schemas"]["SceneItem"][];
        };
        /** @description Merge patch of what people say about a scene. */
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
             * @description New tags; null removes all.
             * @default null
             */
            tags?: string[] | null;
        };
        ScoreReply: {
            agents: {
                [key: string]: Record<string, never>;
            };
            scene: {
                collision_rate?: number;
                collisions?: Record<string, never>[];
                min_distance_m?: number | null;
                min_ttc_s?: number | null;
                near_misses?: Record<string, never>[];
                offroad_share?: number | null;
            };
            thresholds: Record<string, never>;
        };
        /** @description Body of a score. Exactly one of `scene` and `scene_id` is given. */
        ScoreRequest: {
            /**
             * @description `all` or `regenerated`.
             * @default all
             */
            pairs?: components["schemas"]["PairWord"];
            /** @description The log by default. */
            reference?: components["schemas"]["Reference"] | null;
            /**
             * @description The scene itself.
             * @default null
             */
            scene?: components["schemas"]["SceneDoc"] | null;
            /**
             * @description A scene of this server.
             * @default null
             */
            scene_id?: string | null;
            /**
             * @description Numbers that decide what counts; those absent have their defaults.
             * @default {
             *       "closing_speed_mps": 1,
             *       "covered_share": 0.5,
             *       "follow_brake_mps2": 3.35,
             *       "gap_m": 1,
             *       "goal_heading_rad": 0.02,
             *       "goal_position_m": 0.05,
             *       "goal_speed_mps": 0.05,
             *       "harsh_brake_mps2": 4,
             *       "iou": 0.02,
             *       "moving_mps": 0.5,
             *       "offroad_m": 0.1,
             *       "right_on_red": true,
             *       "ttc_s": 1.5
             *     }
             */
            thresholds?: {
                [key: string]: unknown;
            };
            /** @description Motion to score; for the rest the chosen futures, else the log. */
            trajectories?: {
                [key: string]: components["schemas"]["TrajectoryDoc"];
            };
        };
        /** @description The signal of one lane over the scene. */
        SignalDoc: {
            /** @description Lane that obeys it. */
            lane: string;
            /** @description Run-length states; first steps rise. */
            states: components["schemas"]["SignalRun"][];
            /**
             * @description Where to stop.
             * @default null
             */
            stop_m?: components["schemas"]["Point"] | null;
        };
        /** @description [first step, state] */
        SignalRun: [
            number,
            "unknown" | "arrow_stop" | "arrow_caution" | "arrow_go" | "stop" | "caution" | "go" | "flashing_stop" | "flashing_caution"
        ];
        /** @description Where a road user starts; absent or null is free. */
        StartDoc: {
            /**
             * Format: double
             * @description Radians, then wrapped.
             */
            heading_rad?: number | null;
            /**
             * Format: double
             * @description m/s.
             */
            speed_mps?: number | null;
            /** @description In place of `speed_mps`; fixes a free heading too. */
            velocity?: components["schemas"]["VelocityDoc"] | null;
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
        /** @description A stop sign. */
        StopSignDoc: {
            /** @description Unique among stop signs. */
            id: string;
            /**
             * @description Ids of lanes that obey it.
             * @default []
             */
            lanes?: string[];
            /** @description Where it stands. */
            position_m: components["schemas"]["Point"];
        };
        /** @description What drafts carry. */
        StreamModes: "chosen" | "all";
        SupersededEvent: {
            by_revision: number;
            /** @constant */
            event?: "superseded";
        } & components["schemas"]["EventBase"];
        /** @description Steps of the scene. */
        TimeDoc: {
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
             * @description How many steps the scene spans.
             */
            steps: number;
        };
        /** @description Recorded states as columns, one value a step from `first_step`. */
        TrackDoc: {
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
        /** @description Motion of one road user as columns, one value a step from `first_step`. */
        TrajectoryDoc: {
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
         * @description A velocity in place of a speed: `x_mps` and `y_mps`, or, in a goal of frame `agent`,
         *     `ahead_mps` and `left_mps`.
         */
        VelocityDoc: {
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
        Warning: {
            agent?: string | null;
            code: string;
            detail: string;
        };
        /** @description `"all"` or a list of ids. */
        Who: components["schemas"]["All"] | string[];
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
                content?: never;
            };
            /** @description bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host";
                    };
                };
            };
            /** @description cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site";
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
            /** @description bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host";
                    };
                };
            };
            /** @description cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site";
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
                content?: never;
            };
            /** @description bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host";
                    };
                };
            };
            /** @description cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site";
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
            /** @description not-ready */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "not-ready";
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
                /** @description `chosen` futures, or the `log` alone. */
                mode?: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: {
            content: {
                "application/json": components["schemas"]["Scene"];
            };
        };
        responses: {
            /** @description the file */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/octet-stream": number[];
                };
            };
            /** @description bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-timeout";
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
            /** @description invalid-field, out-of-range, half-position, unknown-map, too-many-agents, map-too-large, unsupported-version, format-unknown, cannot-represent */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "unknown-map" | "too-many-agents" | "map-too-large" | "unsupported-version" | "format-unknown" | "cannot-represent";
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
        };
    };
    generate: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: {
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
            /** @description bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site" | "bad-origin";
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
            /** @description body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-timeout";
                    };
                };
            };
            /** @description exists, superseded, stale-revision, cancelled */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "exists" | "superseded" | "stale-revision" | "cancelled";
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
            /** @description invalid-field, out-of-range, half-position, unknown-map, too-many-agents, map-too-large, unsupported-version, start-missing, unknown-agent, reply-too-large */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "unknown-map" | "too-many-agents" | "map-too-large" | "unsupported-version" | "start-missing" | "unknown-agent" | "reply-too-large";
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
    importScenes: {
        parameters: {
            query?: {
                /** @description A name of the formats table; recognised from the content when absent or `auto`. */
                format?: string;
                /** @description Records to take, such as `0..9` (both ends), or one number. */
                index?: string;
                /** @description Give the scenes back and store nothing. */
                dry_run?: boolean;
                /** @description Name of the file, a label only. */
                name?: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/octet-stream": number[];
            };
        };
        responses: {
            /** @description dry run */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ImportReply"];
                };
            };
            /** @description stored */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ImportReply"];
                };
            };
            /** @description bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-timeout";
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
            /** @description invalid-field, out-of-range, half-position, unknown-map, too-many-agents, map-too-large, unsupported-version, format-unknown, licence-refused */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "unknown-map" | "too-many-agents" | "map-too-large" | "unsupported-version" | "format-unknown" | "licence-refused";
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
            /** @description the answer */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Info"];
                };
            };
            /** @description bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host";
                    };
                };
            };
            /** @description cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site";
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
            /** @description bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host";
                    };
                };
            };
            /** @description cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site" | "bad-origin";
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
            /** @description the answer */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["MapList"];
                };
            };
            /** @description bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host";
                    };
                };
            };
            /** @description cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site";
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
            /** @description the answer */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Map"];
                };
            };
            /** @description not changed */
            304: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host";
                    };
                };
            };
            /** @description cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site";
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
        };
    };
    place: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: {
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
            /** @description the answer */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PlaceReply"];
                };
            };
            /** @description bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site" | "bad-origin";
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
            /** @description body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-timeout";
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
            /** @description invalid-field, out-of-range, half-position, unknown-map, too-many-agents, map-too-large, unsupported-version, unknown-agent */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "unknown-map" | "too-many-agents" | "map-too-large" | "unsupported-version" | "unknown-agent";
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
            /** @description the answer */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SceneList"];
                };
            };
            /** @description bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host";
                    };
                };
            };
            /** @description cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site";
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
        };
    };
    createScene: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: {
            content: {
                "application/json": components["schemas"]["Scene"];
            };
        };
        responses: {
            /** @description stored */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Saved"];
                };
            };
            /** @description bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site" | "bad-origin";
                    };
                };
            };
            /** @description body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-timeout";
                    };
                };
            };
            /** @description exists */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "exists";
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
            /** @description invalid-field, out-of-range, half-position, unknown-map, too-many-agents, map-too-large, unsupported-version */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "unknown-map" | "too-many-agents" | "map-too-large" | "unsupported-version";
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
                /** @description The map itself or its hash alone: `inline` or `ref`. */
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
            /** @description the answer */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Scene"];
                };
            };
            /** @description not changed */
            304: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host";
                    };
                };
            };
            /** @description cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site";
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
            /** @description invalid-field */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field";
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
        requestBody?: {
            content: {
                "application/json": components["schemas"]["Scene"];
            };
        };
        responses: {
            /** @description the answer */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Saved"];
                };
            };
            /** @description stored */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Saved"];
                };
            };
            /** @description bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description cross-site, bad-origin, read-only */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site" | "bad-origin" | "read-only";
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
            /** @description body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-timeout";
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
            /** @description invalid-field, out-of-range, half-position, unknown-map, too-many-agents, map-too-large, unsupported-version */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "unknown-map" | "too-many-agents" | "map-too-large" | "unsupported-version";
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
            header?: {
                "If-Match"?: string | null;
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
            /** @description bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host";
                    };
                };
            };
            /** @description cross-site, bad-origin, read-only */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site" | "bad-origin" | "read-only";
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
        };
    };
    renameScene: {
        parameters: {
            query?: never;
            header?: {
                "If-Match"?: string | null;
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
                 *       "name": "left turn, late"
                 *     }
                 */
                "application/merge-patch+json": components["schemas"]["ScenePatch"];
            };
        };
        responses: {
            /** @description the answer */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Saved"];
                };
            };
            /** @description bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description cross-site, bad-origin, read-only */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site" | "bad-origin" | "read-only";
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
            /** @description body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-timeout";
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
            header?: never;
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
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Saved"];
                };
            };
            /** @description bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site" | "bad-origin";
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
            /** @description body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-timeout";
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
                /** @description `chosen` futures, or the `log` alone. */
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
                    "application/octet-stream": number[];
                };
            };
            /** @description bad-host */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host";
                    };
                };
            };
            /** @description cross-site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site";
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
            /** @description format-unknown, cannot-represent, invalid-field, out-of-range */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "format-unknown" | "cannot-represent" | "invalid-field" | "out-of-range";
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
        };
    };
    score: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: {
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
            /** @description the answer */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ScoreReply"];
                };
            };
            /** @description bad-host, malformed-json, malformed-file */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "bad-host" | "malformed-json" | "malformed-file";
                    };
                };
            };
            /** @description cross-site, bad-origin */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "cross-site" | "bad-origin";
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
            /** @description body-timeout */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "body-timeout";
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
            /** @description invalid-field, out-of-range, half-position, unknown-map, too-many-agents, map-too-large, unsupported-version, unknown-agent */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"] & {
                        /** @enum {unknown} */
                        code?: "invalid-field" | "out-of-range" | "half-position" | "unknown-map" | "too-many-agents" | "map-too-large" | "unsupported-version" | "unknown-agent";
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
        };
    };
}
