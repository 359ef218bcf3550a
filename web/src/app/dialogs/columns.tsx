// Assignment of a table's columns: prefilled from their names.
import { useSignal } from '@preact/signals';
import type { FileVerdict } from '../../edit/tools/importing/file-verdict';
import {
  ASKED,
  complete,
  guessed,
  toldColumns,
  type ColumnChoice,
  type ColumnQuantity,
} from '../../edit/tools/outward/table-columns';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/files/imports';

export function Columns({ verdict, of }: { verdict: FileVerdict; of: readonly string[] }) {
  const { importing } = useApp();
  const answers = useSignal(guessed(of));
  const off = !complete(answers.value);
  const put = (field: string, patch: Partial<ColumnChoice>) => {
    answers.value = { ...answers.value, [field]: { ...answers.value[field], ...patch } };
  };
  return (
    <form
      class="columns"
      onSubmit={(e) => {
        e.preventDefault();
        if (!off) void importing.reader?.readColumns(verdict, toldColumns(answers.value));
      }}
    >
      {ASKED.map((a) => (
        <Row key={a.field} asked={a} of={of} answer={answers.value[a.field]} put={(patch) => put(a.field, patch)} />
      ))}
      <p class="mut">{TEXTS.missingColumns}</p>
      <div class="ways">
        <button type="submit" class={`btn pri ${off ? 'off' : ''}`} aria-disabled={off}>
          {TEXTS.readTheTable}
        </button>
      </div>
    </form>
  );
}

interface ColumnRowProps {
  asked: ColumnQuantity;
  of: readonly string[];
  answer: ColumnChoice;
  put: (patch: Partial<ColumnChoice>) => void;
}

function Row({ asked: { field, label, says, needed, units }, of, answer, put }: ColumnRowProps) {
  const missing = needed && !answer.column;
  return (
    <div class={`crow ${missing ? 'missing' : ''}`}>
      <span>
        <b>{label}</b> <small class="mut">{says}</small>
      </span>
      <select
        class="pick"
        aria-label={TEXTS.columnFor(label)}
        data-column={field}
        data-first={field === ASKED[0].field ? '' : undefined}
        value={answer.column ?? ''}
        onChange={(e) => put({ column: e.currentTarget.value || null })}
      >
        <option value="">{needed ? TEXTS.chooseAColumn : TEXTS.notInTheTable}</option>
        {of.map((name) => (
          <option key={name} value={name}>
            {name}
          </option>
        ))}
      </select>
      {units.length && answer.column ? (
        <select
          class="pick"
          aria-label={TEXTS.unitOf(label)}
          data-unit={field}
          value={String(answer.unit)}
          onChange={(e) => put({ unit: Number(e.currentTarget.value) })}
        >
          {units.map((u, i) => (
            <option key={u.label} value={String(i)}>
              {u.label}
            </option>
          ))}
        </select>
      ) : null}
    </div>
  );
}
