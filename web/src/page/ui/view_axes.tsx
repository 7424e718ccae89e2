import { useRef, useState } from 'preact/hooks';
import type { App } from '../app';
import { axes, axisNormal } from '../../model/slices';

/** Half the width of the picture, and the length of an axis in it, in CSS pixels. */
const [half, reach] = [48, 34];
const ends = axes.flatMap((axis, d) => [1, -1].map((sign) => ({ axis, d, sign })));
const steps: Record<string, number> = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };

/** Where the axes point in the picture. Each end, by a click or by Enter, lets the camera look from there; arrow keys go through the ends. */
export function ViewAxes({ app }: { app: App }) {
  const [current, setCurrent] = useState(0);
  const group = useRef<HTMLDivElement>(null);
  const seen = app.state.axesSeen.value;
  if (!seen || !app.model) return null;
  const go = (event: KeyboardEvent) => {
    const step = steps[event.key];
    if (!step) return;
    event.preventDefault();
    const next = (current + step + ends.length) % ends.length;
    group.current?.querySelectorAll('button')[next].focus();
  };
  return (
    <div ref={group} id="axes" class="axes" role="group" aria-label="Look along an axis" onKeyDown={go}>
      <svg viewBox={`${-half} ${-half} ${2 * half} ${2 * half}`} aria-hidden="true">
        {axes.map((axis, d) => (
          <line key={axis} class={`axis-${axis}`} x1="0" y1="0" x2={reach * seen[d][0]} y2={-reach * seen[d][1]} />
        ))}
      </svg>
      {ends.map(({ axis, d, sign }, at) => {
        const [right, up, toViewer] = seen[d].map((part) => sign * part);
        const name = sign > 0 ? axis : `minus ${axis}`;
        return (
          <button
            key={name}
            type="button"
            data-end={name}
            class={sign > 0 ? `axis-${axis}` : `axis-${axis} minus`}
            aria-label={`Look from ${name}`}
            title={`Look from ${name}`}
            tabIndex={at === current ? 0 : -1}
            style={{ left: `${half + reach * right}px`, top: `${half - reach * up}px`, zIndex: Math.round(10 + 9 * toViewer) }}
            onClick={() => app.view.lookFrom(axisNormal(axis, sign))}
            onFocus={() => setCurrent(at)}
          >
            {sign > 0 && axis}
          </button>
        );
      })}
    </div>
  );
}
