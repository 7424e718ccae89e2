// Objects that calls give and that keep a state in a module's memory. A call of a table tells in `gives` what they are called (`type`) and
// what their methods take (`methods`), as calls do.
import { bad } from './arguments.js';

/** Frees the states of objects that can't be reached any more. */
const collected = new FinalizationRegistry((release) => release());

/**
 * An object with these methods: perform(method, arguments, expectState) does the work of one, and throws by expectState() once free() was
 * called. release() lets go of the state. Neither may refer to the object.
 */
export function makeObject({ type, methods }, perform, release) {
  let isFree = false;
  const expectState = () => {
    if (isFree) throw bad(`The ${type} was freed.`);
  };
  const calls = Object.keys(methods).map((method) => [method, (...given) => perform(method, given, expectState)]);
  const object = {
    ...Object.fromEntries(calls),
    free() {
      if (isFree) return;
      isFree = true;
      collected.unregister(object);
      release();
    },
  };
  if (Symbol.dispose) object[Symbol.dispose] = object.free;
  collected.register(object, release, object);
  return object;
}
