// Chromium as tests run it: without a window, drawing in software.
import { chromium } from 'playwright-core';

const args = [
  '--headless',
  '--no-sandbox',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  // Software draws the page's text and boxes far more slowly if it has to act as a GPU: pages would take twice as long to open.
  '--disable-gpu-rasterization',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

export function launchChromium() {
  return chromium.launch({ executablePath: '/usr/bin/chromium', args });
}
