import { pageError } from '../../model/failure';
import type { Recording } from '../../model/view';

/** In frames a second. */
const rate = 30;
const types = ['video/webm;codecs=vp9', 'video/webm', 'video/mp4'];

/** Records what a canvas shows from now on. Throws a PageError where the browser can't. */
export function record(canvas: HTMLCanvasElement): Recording {
  const type = 'MediaRecorder' in window ? types.find((known) => MediaRecorder.isTypeSupported(known)) : undefined;
  if (!type) throw pageError("The picture can't be recorded", 'This browser has no recorder for canvases. Try another browser.');
  const recorder = new MediaRecorder(canvas.captureStream(rate), { mimeType: type, videoBitsPerSecond: 8_000_000 });
  const parts: Blob[] = [];
  recorder.addEventListener('dataavailable', ({ data }) => parts.push(data));
  const plain = type.split(';')[0];
  const done = new Promise<Blob>((resolve) => recorder.addEventListener('stop', () => resolve(new Blob(parts, { type: plain }))));
  recorder.start();
  return {
    type: plain,
    stop: () => {
      recorder.stop();
      for (const track of recorder.stream.getTracks()) track.stop();
      return done;
    },
  };
}
