import type { ComponentChildren } from 'preact';

interface Props {
  class?: string;
  list: readonly (readonly [string, ComponentChildren])[];
}

/** Terms and their values. */
export function Terms({ list, class: kind }: Props) {
  return (
    <dl class={kind}>
      {list.map(([term, value]) => (
        <div key={term}>
          <dt>{term}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}
