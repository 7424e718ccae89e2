import type { App } from '../app';
import { real } from '../../model/format';
import { distance, type Measurement } from '../../model/measurement';
import { axes } from '../../model/slices';

/** What is to be done next, or the distance that was measured, on top of the picture. */
export function MeasureLine({ app }: { app: App }) {
  const measurement = app.state.measurement.value;
  return (
    <div class="banner" id="measure-line" hidden={!measurement}>
      <p role="status">{measurement && <Words measurement={measurement} />}</p>
      <button type="button" class="quiet" id="measure-end" aria-label="End measuring" onClick={() => app.measuring.end()}>
        ×
      </button>
    </div>
  );
}

function Words({ measurement: { from, to } }: { measurement: Measurement }) {
  if (!from && !to) return <>Choose two places on the model.</>;
  if (!from || !to) return <>Now the place where the distance {from ? 'ends' : 'begins'}.</>;
  const { length, along } = distance(from.point, to.point);
  return (
    <>
      <strong data-length={length}>{real(length)}</strong>{' '}
      {axes.map((axis, d) => (
        <span key={axis} class={`axis-${axis} along`}>
          {`${axis} ${real(along[d]).replace('-', '−')} `}
        </span>
      ))}
    </>
  );
}
