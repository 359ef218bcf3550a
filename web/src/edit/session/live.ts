// Motion as it happens: while a road user is driven, the picture shows this in place of the answers.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type { Pose } from '../../model/base/geometry';

export interface LiveMotion {
  readonly isOn: ReadonlySignal<boolean>;
  /** Changes with every frame of it. */
  readonly frames: ReadonlySignal<number>;
  /** Where a road user is now; null where it is not there. */
  poseOf(id: string): Pose | null;
}

export const NOT_LIVE: LiveMotion = { isOn: signal(false), frames: signal(0), poseOf: () => null };
