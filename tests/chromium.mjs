// Chromium as tests run it: without windows, not even hidden ones, which would draw the browser's own controls for each page; in software.
import { chromium } from 'playwright-core';

const args = [
  '--no-sandbox',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  // Software draws text and boxes far more slowly if it has to act as a GPU.
  '--disable-gpu-rasterization',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

/** Pictures are drawn without multisampling, for which software needs nearly twice the time, unless they are to be smooth. */
export function launchChromium({ smooth = false } = {}) {
  return chromium.launch({
    executablePath: '/usr/bin/chromium-headless-shell',
    args: smooth ? args : [...args, '--webgl-antialiasing-mode=none'],
  });
}
