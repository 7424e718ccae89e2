import { readFunction } from './arguments.js';

/** Runs f with a callback that C++ can call: what the user's throws passes by C++, and through this call. */
export function withProgress(progress, f) {
  if (readFunction(progress, 'options.progress') === undefined) return f(undefined);
  let thrown;
  try {
    return f((state) => {
      try {
        return progress(state) !== false;
      } catch (error) {
        thrown = { error };
        return false;
      }
    });
  } catch (error) {
    throw thrown ? thrown.error : error;
  }
}
