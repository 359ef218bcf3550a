// The parts of a scene that a link contains.
import type { Feedback } from '../../model/document/feedback';
import type { EditorJson, SceneJson } from '../../model/document/scene-json';
import { TEXTS } from '../../texts/editing/keeping';

/** Parts of a scene that a link contains. */
export interface SharedParts {
  /** Goals, and the followed future of each. */
  readonly futures: boolean;
  /** Texts by users: name, tags, notes. */
  readonly words: boolean;
  /** The shown time and place. */
  readonly start: boolean;
}

/** The scene without the parts that stay out of the link; of six futures only the followed one. */
export function reduced(scene: SceneJson, parts: SharedParts): SceneJson {
  const { generated } = scene;
  const sample = generated?.samples[generated.chosen_sample ?? 0];
  const followed =
    parts.futures && generated && sample
      ? {
          ...generated,
          chosen_sample: 0,
          samples: [
            {
              agents: Object.fromEntries(
                Object.entries(sample.agents).map(([id, f]) => [id, { ...f, chosen: 0, modes: [f.modes[f.chosen]] }]),
              ),
            },
          ],
        }
      : null;
  const { picked, variants, feedback, pins, scene_feedback: whole } = scene.x_editor ?? {};
  const one = picked && Object.fromEntries(Object.keys(picked).map((id) => [id, 0]));
  return {
    ...scene,
    id: undefined,
    ...(parts.words ? {} : { name: TEXTS.sharedScene, meta: { ...scene.meta, tags: [], notes: '' } }),
    agents: parts.futures ? scene.agents : scene.agents.map((a) => ({ ...a, conditions: {} })),
    x_editor: {
      ...scene.x_editor,
      picked: parts.futures ? one : undefined,
      pins: parts.futures ? (parts.words ? pins : unnamedPins(pins)) : undefined,
      feedback: parts.futures ? (parts.words ? feedback : unnamed(feedback)) : undefined,
      scene_feedback: parts.futures && whole ? (parts.words ? whole : withoutNames(whole)) : undefined,
      // Their motion is computed again when they are shown.
      variants: parts.futures ? variants?.map((v) => ({ ...v, name: parts.words ? v.name : undefined })) : undefined,
    },
    generated: followed,
  };
}

/** Feedback on futures without their names. */
const withoutNames = (f: Feedback): Feedback => ({ ...f, answers: f.answers.map((a) => ({ ...a, name: '' })) });
const unnamed = (all: EditorJson['feedback']): EditorJson['feedback'] =>
  all && Object.fromEntries(Object.entries(all).map(([id, f]) => [id, withoutNames(f)]));
const unnamedPins = (all: EditorJson['pins']): EditorJson['pins'] =>
  all && Object.fromEntries(Object.entries(all).map(([id, list]) => [id, list.map((p) => ({ ...p, name: '' }))]));
