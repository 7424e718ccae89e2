import { useState } from 'preact/hooks';
import type { App } from '../app';
import { asPageError } from '../failure';
import { isMotion, plays, type Play } from '../../model/plays';
import type { Recording } from '../../model/view';
import { Section } from './controls/section';
import { Select } from './controls/select';
import { Slider } from './controls/slider';
import { download } from './download';

const names: Record<Play, string> = {
  wave: 'a wave runs through it',
  turn: 'its parts turn',
  pass: 'one part passes through another',
  slice: 'the slice sweeps through it',
  explode: 'the cells come apart',
  cells: 'from coarse to fine',
};
const options = plays.map((play) => [play, names[play]] as const);

/** What moves by itself; a surface that moves is cut anew in every picture. */
export function MotionPanel({ app }: { app: App }) {
  const { playing } = app.state;
  const { pose } = app.settings;
  const play = app.state.play.value;
  const choose = (next: Play) => {
    app.state.play.value = next;
    if (playing.value) void app.player.play();
  };
  const moveTo = (phase: number) => {
    app.player.pause();
    if (isMotion(play)) void app.setPose({ motion: play, phase });
  };
  const rest = () => {
    app.player.pause();
    void app.setPose(null);
  };
  return (
    <Section app={app} id="motion" title="Motion">
      <Select id="play-what" label="What moves" options={options} value={play} onChange={choose} />
      {isMotion(play) && (
        <Slider
          id="phase"
          label="Moment"
          min={0}
          max={1}
          step={0.002}
          value={pose?.motion === play ? pose.phase % 1 : 0}
          onInput={moveTo}
        />
      )}
      <div class="row">
        <button type="button" id="at-rest" disabled={!pose} onClick={rest}>
          Back to rest
        </button>
        <Film app={app} />
      </div>
    </Section>
  );
}

/** Films the picture, to be saved as a video. */
function Film({ app }: { app: App }) {
  const [recording, setRecording] = useState<Recording | null>(null);
  const begin = () => {
    try {
      setRecording(app.view.files.record());
    } catch (error) {
      app.state.alert(asPageError(error));
    }
  };
  const end = async (film: Recording) => {
    setRecording(null);
    const blob = await film.stop();
    if (app.model) download(blob, app.model, film.type.split('/')[1]);
  };
  return (
    <button type="button" id="film" disabled={!app.model} onClick={() => (recording ? void end(recording) : begin())}>
      {recording ? 'Save the film' : 'Film it'}
    </button>
  );
}
