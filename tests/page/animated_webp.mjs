// Animated pictures: one WebP file of many, each as Chromium encodes it.
// Format: https://developers.google.com/speed/webp/docs/riff_container

/** Of a picture as the page's screenshots are, as WebP. */
export async function toWebp(page, png, quality) {
  const base64 = await page.evaluate(
    async ({ url, quality }) => {
      const picture = await createImageBitmap(await (await fetch(url)).blob());
      const canvas = new OffscreenCanvas(picture.width, picture.height);
      canvas.getContext('2d').drawImage(picture, 0, 0);
      const bytes = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/webp', quality })).arrayBuffer());
      return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
    },
    { url: `data:image/png;base64,${png.toString('base64')}`, quality },
  );
  return Buffer.from(base64, 'base64');
}

/** An endless loop of opaque frames of one size, each shown for so many milliseconds. */
export function animatedWebp(frames, [width, height], duration) {
  const header = Buffer.alloc(10);
  header[0] = 2; // animated
  header.writeUIntLE(width - 1, 4, 3);
  header.writeUIntLE(height - 1, 7, 3);
  const frame = (webp) => {
    const head = Buffer.alloc(16);
    head.writeUIntLE(width - 1, 6, 3);
    head.writeUIntLE(height - 1, 9, 3);
    head.writeUIntLE(duration, 12, 3);
    head[15] = 2; // takes the place of the one before
    return chunk('ANMF', Buffer.concat([head, imageOf(webp)]));
  };
  const body = [Buffer.from('WEBP'), chunk('VP8X', header), chunk('ANIM', Buffer.alloc(6)), ...frames.map(frame)];
  return chunk('RIFF', Buffer.concat(body));
}

function chunk(name, content) {
  const head = Buffer.alloc(8, name, 'latin1');
  head.writeUInt32LE(content.length, 4);
  return Buffer.concat([head, content, Buffer.alloc(content.length % 2)]);
}

/** The chunk of a still picture that holds its pixels. */
function imageOf(webp) {
  for (let at = 12; at < webp.length; ) {
    const end = at + 8 + webp.readUInt32LE(at + 4);
    if (webp.toString('latin1', at, at + 3) === 'VP8' && webp[at + 3] !== 0x58) return webp.subarray(at, end + (end % 2));
    at = end + (end % 2);
  }
  throw new Error('There is no picture in this WebP file.');
}
