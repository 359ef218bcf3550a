// The verdict on an imported file.
import type { ImportWarning } from '../../../net/types';
import type { MapCircle } from '../../../net/imports';
import type { Broken } from './broken-file';

export interface ImportedScene {
  readonly id: string;
  readonly name: string;
  /** Road users. */
  readonly count: number;
}

/** The result of one file, and, if it could not be read, what is wrong, where, and what to do. */
export interface FileVerdict {
  readonly file: string;
  /** `saved scene`, `scenario record`, `PDF`. */
  readonly kind: string;
  readonly ok: boolean;
  readonly scenes: readonly ImportedScene[];
  readonly wrong?: string;
  readonly where?: string;
  readonly todo?: string;
  readonly details?: string;
  /** The broken lines of the file, and the number of the first. */
  readonly excerpt?: Broken['excerpt'];
  /** Parts to leave out so that the rest can be imported. */
  readonly without?: readonly string[];
  /** Assumptions, omissions and changes of the reader. */
  readonly notes?: readonly ImportWarning[];
  /** A table with unknown column names: the user assigns them. */
  readonly columns?: readonly string[];
  /** A map of which a part can be read, and the part that was asked for. */
  readonly map?: { readonly file: Blob; readonly around: MapCircle | null };
  /** The server did not answer: a retry may work. */
  readonly again?: File;
}
