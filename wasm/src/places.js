// Places in the arguments of a call, as keys from the list of arguments on: [1] is the second one, [0, 'cells'] a member of the first.

const isObject = (value) => typeof value === 'object' && value !== null;

/** What lies at a place; undefined if nothing does. */
export function valueAt(args, place) {
  return place.reduce((value, key) => (isObject(value) ? value[key] : undefined), args);
}

/**
 * The arguments with another value at a place where something lies.
 *
 * @param {any} args
 * @param {(string | number)[]} place
 * @param {unknown} value
 */
export function withValueAt(args, [key, ...rest], value) {
  const inner = rest.length > 0 ? withValueAt(args[key], rest, value) : value;
  return typeof key === 'number' ? args.with(key, inner) : { ...args, [key]: inner };
}
