// The calls of a table (see calls.js), on a module that has been started.
import { bad, readMembers, readOptions, readStart } from './arguments.js';
import { copierInto } from './buffers.js';
import { named } from './errors.js';
import { Host, isResult } from './host.js';
import { once } from './load.js';
import { makeObject } from './objects.js';
import { withCallbacks } from './callbacks.js';

/** Returns a function that gives the argument once the handles of twins are there. Values that need a handle are added to `inputs`. */
function readArgument(taken, value, name, asInput) {
  if (typeof taken === 'function') {
    const read = taken(value, name);
    return () => read;
  }
  if (taken.kind) return asInput(taken, value) ?? readArgument(taken.otherwise, value, name);
  const readers = Object.entries(taken).map(([key, member]) => [key, (inner) => readArgument(member, inner, key, asInput)]);
  const members = Object.entries(readMembers(value, Object.fromEntries(readers), name));
  return (handles) => Object.fromEntries(members.map(([key, give]) => [key, give(handles)]));
}

/**
 * Keeps the twin that a call returned, and gives the call's outcome without it. Without one, the result is to get it where it is first read,
 * unless the call was told not to keep any. Twins that the call used, by these handles, don't give way to it.
 */
function keepTwin({ value: given, error }, { member }, { origin, host, twins, handles = [] }) {
  if (error) return { error };
  const { value, twin } = given;
  const result = member ? value[member] : value;
  if (origin.keep !== false) host.adopt(result, origin);
  if (twin) twins.keep(result, twin, [...handles, twin]);
  return { value };
}

/** What deletes a handle once it is freed, but not while a method runs, whose callback may free the object. */
function stateOf(handle, isThere) {
  let uses = 0;
  let isFreed = false;
  const deleteUnused = () => {
    if (isFreed && uses === 0 && isThere()) handle.delete();
  };
  return {
    free() {
      isFreed = true;
      deleteUnused();
    },
    use(run) {
      ++uses;
      const answer = run(); // where this throws, the handle is gone with its memory
      --uses;
      deleteUnused();
      return answer;
    },
  };
}

/** The outcome with an object instead of the handle that a call returned: its methods are those of the handle. */
function withObject({ value: handle, error }, { gives }, host, bindings) {
  if (error) return { error };
  const state = stateOf(handle, () => host.isCurrent(bindings));
  const run =
    (method) =>
    (_bindings, ...args) => {
      if (!host.isCurrent(bindings)) throw bad(`The ${gives.type} is gone with the memory that it was in, since a call failed.`);
      return state.use(() => handle[method](...args));
    };
  const calls = Object.entries(gives.methods).map(([method, call]) => [
    method,
    named(call.isCut ? 'input' : method, makeCall(host, method, { ...call, run: run(method) })),
  ]);
  const methods = Object.fromEntries(calls);
  const perform = (method, given, expectState) => {
    named(method, expectState)();
    return methods[method](...given);
  };
  return { value: makeObject(gives, perform, state.free) };
}

/** A call of a table, on the module of a host. */
export function makeCall(host, name, call) {
  const { takes, options, keeps, gives, run = (bindings, ...args) => bindings[name](...args) } = call;
  const parameters = Object.entries(takes);
  return (...given) => {
    const { reuse, ...what } = readOptions(given[parameters.length], options);
    const copy = reuse && copierInto(reuse);
    return withCallbacks(what, (safe) => {
      const inputs = [];
      const asInput = (taken, value) => {
        if (taken.otherwise && !isResult(value) && !taken.fits?.(value)) return undefined;
        const place = inputs.push(host.input(taken, value, safe.progress)) - 1;
        return (handles) => handles[place];
      };
      const readings = parameters.map(([parameter, taken], i) => readArgument(taken, given[i], parameter, asInput));
      return host.runWith(inputs, (bindings, handles, twins) => {
        const args = readings.map((give) => give(handles));
        const outcome = run(bindings, ...args, ...(options ? [{ ...safe, copy }] : []));
        if (gives) return withObject(outcome, call, host, bindings);
        return keeps ? keepTwin(outcome, call, { origin: { kind: keeps, ...what }, host, twins, handles }) : outcome;
      });
    });
  };
}

function makeFileCall(host, name, call, load) {
  const { takes, options, keeps, orIn } = call;
  return async (source, given) => {
    const { name: fileName, bytes } = await takes.source(source, readOptions(given, options));
    const callIn = (one) =>
      one.run((bindings, twins) => {
        const outcome = bindings[name](bytes, fileName);
        return keeps ? keepTwin(outcome, call, { origin: { kind: keeps }, host: one, twins }) : outcome;
      });
    return callIn(host) ?? callIn((await load(orIn)).host);
  };
}

/** { host, calls } of a module that is compiled. `module`: as in module.js; load(name) promises the same of another module. */
export function startModule(module, compiled, load = undefined) {
  const host = new Host(module, compiled);
  const calls = Object.entries(module.calls).map(([name, call]) => {
    const make = call.isFile ? makeFileCall : makeCall;
    return [name, named(call.isCut ? 'input' : name, make(host, name, call, load))];
  });
  return { host, calls: { version: host.start((bindings) => bindings.version()), ...Object.fromEntries(calls) } };
}

/** The same calls of a module that is loaded when the first is made, as promises; load() promises it as startModule() gives it. */
export function laterCalls(module, load) {
  const names = Object.keys(module.calls);
  return Object.fromEntries(names.map((name) => [name, async (...given) => (await load()).calls[name](...given)]));
}

/** init() of a module: it checks its options, of which `own` is for the module, and gives the promise of start(options) that there is. */
export function starter(name, own, start) {
  const started = once(start);
  return (given) => {
    try {
      return started(named(name, readStart)(given, own));
    } catch (error) {
      return Promise.reject(error);
    }
  };
}
