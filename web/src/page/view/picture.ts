// The picture as a PNG file, as fine as wanted.
import type { Scene, WebGLRenderer } from 'three';
import { pageError } from '../../model/failure';
import type { Picture, PictureOptions } from '../../model/view';

/** With what smooth edges need beside its colour, the GPU keeps some 36 bytes for each pixel. */
const mostPixels = 25e6;

/** Draws with so many times the pixels of the screen per side, or as many as there can be, and afterwards leaves the canvas to be drawn anew. */
export function takePicture(
  renderer: WebGLRenderer,
  scene: Scene,
  options: PictureOptions,
  draw: (times: number) => void,
): Promise<Picture> {
  const { background } = scene;
  if (options.isTransparent) {
    scene.background = null;
    renderer.setClearColor(0, 0);
  }
  try {
    const times = drawLarge(renderer, options.times, draw);
    return capture(renderer.domElement, times < options.times);
  } finally {
    scene.background = background;
  }
}

/** What is on the canvas now. */
async function capture(canvas: HTMLCanvasElement, isSmaller: boolean): Promise<Picture> {
  const { width, height } = canvas;
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, 'image/png'));
  if (blob) return { blob, width, height, isSmaller };
  throw pageError("The picture can't be saved", 'The browser could not capture the picture, perhaps because memory ran low.');
}

/** How many times it became. */
function drawLarge(renderer: WebGLRenderer, wanted: number, draw: (times: number) => void): number {
  draw(1);
  if (wanted <= 1) return 1;
  const gl = renderer.getContext();
  const { width, height } = gl.canvas;
  const longest = Math.min(gl.getParameter(gl.MAX_RENDERBUFFER_SIZE), ...gl.getParameter(gl.MAX_VIEWPORT_DIMS));
  const most = Math.min(longest / width, longest / height, Math.sqrt(mostPixels / (width * height)));
  for (let times = Math.min(wanted, most); times > 1; times /= 1.4) {
    draw(times);
    // Where memory runs short, the browser gives a canvas fewer pixels than it was asked for.
    if (gl.drawingBufferWidth === gl.canvas.width && gl.drawingBufferHeight === gl.canvas.height) return times;
  }
  draw(1);
  return 1;
}
