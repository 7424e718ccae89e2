// The tags of an XML file, one after the other: workers lack the XML parser of a page.

/** The value of an attribute, whatever its prefix. */
export type Attributes = (name: string) => string | undefined;

/** Is told of tags in turn, by their names without prefixes; of one that is empty both. */
export interface TagReader {
  begin(name: string, attribute: Attributes): void;
  end?(name: string): void;
}

const value = `\\s*=\\s*(?:"([^"]*)"|'([^']*)')`;
const anyAttribute = `\\s+[\\w:.-]+\\s*=\\s*(?:"[^"]*"|'[^']*')`;
/** What looks like a tag in a comment is none. A comment that isn't closed goes on to the end. */
const tags = new RegExp(`<!--.*?(?:-->|$)|<(/?)(?:[\\w.-]+:)?([\\w.-]+)((?:${anyAttribute})*)\\s*(/?)>`, 'gs');
const searches = new Map<string, RegExp>();

/** Goes past whole attributes, so that nothing is found inside the value of another. */
function searchFor(name: string): RegExp {
  const search = searches.get(name) ?? new RegExp(`^(?:${anyAttribute})*?\\s+(?:[\\w.-]+:)?${name}${value}`);
  searches.set(name, search);
  return search;
}

export function readTags(text: string, { begin, end }: TagReader): void {
  for (const [, isEnd, name, attributes, isEmpty] of text.matchAll(tags)) {
    if (name === undefined) continue;
    if (!isEnd) {
      begin(name, (wanted) => {
        const found = searchFor(wanted).exec(attributes);
        return found?.[1] ?? found?.[2];
      });
    }
    if (isEnd || isEmpty) end?.(name);
  }
}

/** In UTF-8, or in UTF-16 with the mark that XML requires there. */
export function xmlText(bytes: Uint8Array): string {
  const mark = (bytes[0] << 8) | bytes[1];
  return new TextDecoder(mark === 0xfeff ? 'utf-16be' : mark === 0xfffe ? 'utf-16le' : 'utf-8').decode(bytes);
}
