import { WebGLRenderer } from 'three';
import { pageError, type PageError } from '../../model/failure';

/** Throws a PageError where there is no WebGL 2. */
export function makeRenderer(canvas: HTMLCanvasElement): WebGLRenderer {
  try {
    const renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance' });
    // Asking for errors would wait for the compiler.
    renderer.debug.checkShaderErrors = import.meta.env.DEV;
    // Transparent objects are drawn last anyway, and to sort them three.js would visit all vertices.
    renderer.sortObjects = false;
    return renderer;
  } catch {
    const why = 'This page draws with WebGL 2, which this browser lacks or has turned off.';
    const detail = `${why} Try another browser, or turn on hardware acceleration in its settings.`;
    throw pageError("This browser can't draw the picture", detail);
  }
}

export function contextLost(): PageError {
  const why = 'The browser dropped the graphics context, perhaps because memory ran low.';
  return pageError('The picture is lost for now', `${why} If the picture does not come back, reload the page.`);
}
