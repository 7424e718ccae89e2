import { useRef } from 'preact/hooks';
import type { App } from '../app';
import type { StepRequest } from '../../model/instead';
import { axes } from '../../model/slices';
import { Choice } from './controls/choice';
import { NumberField } from './controls/number_field';
import { Slider } from './controls/slider';

const axisNumbers = [
  ['0', 'x'],
  ['1', 'y'],
  ['2', 'z'],
] as const;

/** Which triangle, plane or grid cell to show, as far as it matters to the step. */
export function StepChoices({ app }: { app: App }) {
  const picture = app.state.step.value;
  /** What was asked for last: the next choice may come before this one's picture. */
  const asked = useRef<{ picture: typeof picture; request: StepRequest } | null>(null);
  if (!picture) return <div id="step-choices" />;
  const { triangles, planes, request: shown } = picture.choices;
  if (asked.current?.picture !== picture) asked.current = { picture, request: shown };
  const latest = () => asked.current?.request ?? shown;
  const ask = (part: Partial<StepRequest>) => {
    asked.current = { picture, request: { ...latest(), ...part } };
    void app.inspector.step(asked.current.request);
  };
  const { triangle, plane, gridCell, axis = 0 } = shown;
  return (
    <div id="step-choices">
      {triangle !== undefined && (
        <NumberSlider
          id="step-triangle"
          label="Triangle"
          value={triangle}
          last={triangles - 1}
          onChange={(value) => ask({ triangle: value })}
        />
      )}
      {plane !== undefined && (
        <div>
          <Choice
            name="step-axis"
            legend="Axis"
            options={axisNumbers}
            value={axisNumbers[axis][0]}
            onChange={(value) => ask({ axis: Number(value) as 0 | 1 | 2, plane: undefined })}
          />
          <NumberSlider id="step-plane" label="Plane" value={plane} last={planes[axis] - 1} onChange={(value) => ask({ plane: value })} />
        </div>
      )}
      {gridCell !== undefined &&
        axes.map((name, d) => (
          <NumberSlider
            key={name}
            id={`step-cell-${name}`}
            label={`Grid cell, ${name}`}
            value={gridCell[d]}
            last={planes[d] - 2}
            onChange={(value) => ask({ gridCell: (latest().gridCell ?? gridCell).map((x, e) => (e === d ? value : x)) })}
          />
        ))}
    </div>
  );
}

interface NumberSliderProps {
  id: string;
  label: string;
  value: number;
  last: number;
  onChange: (value: number) => void;
}

/** A slider from 0 with a number field beside it. */
function NumberSlider({ id, label, value, last, onChange }: NumberSliderProps) {
  return (
    <div class="with-number">
      <Slider id={id} label={label} min={0} max={last} step={1} value={value} onInput={onChange} />
      <NumberField id={`${id}-number`} label={`${label}, number`} hideLabel min={0} max={last} value={value} onChange={onChange} />
    </div>
  );
}
