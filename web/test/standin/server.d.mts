import type { GeneratedJson } from '../../src/model/document/scene-json';
export interface StandInOptions {
  port?: number;
  delay?: number;
  loss?: number;
  shuffle?: boolean;
  away?: boolean;
  hang?: boolean;
  busy?: number;
  collision?: boolean;
  judged?: boolean;
  scenes?: string[];
  /** Folder of the built page; web/dist without it. */
  page?: string;
}
export interface StandIn {
  url: string;
  options: Required<StandInOptions>;
  log: {
    path: string;
    agents: string[] | 'all';
    pinned?: string[];
    react: unknown;
    revision: number;
    client: string;
    scene_id?: string;
    scene?: string;
    conditions: Record<string, { goal?: Record<string, number>; start?: Record<string, number> }>;
  }[];
  scenes: Map<
    string,
    {
      scene: { name: string; agents: { id: string; conditions: unknown }[]; generated?: GeneratedJson | null };
      etag: string;
      rev: number;
      readonly: boolean;
      ref: string;
    }
  >;
  forget(): void;
  close(): Promise<void>;
}
export function startStandIn(options?: StandInOptions): Promise<StandIn>;
