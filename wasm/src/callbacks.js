import { bad, kindOf } from './arguments.js';

/**
 * Runs f with options whose callbacks, if there are any, C++ can call. An error that the user's callback throws bypasses C++ and is thrown by
 * this call.
 */
export function withCallbacks(options, f) {
  const { progress, rule } = options;
  let thrown;
  const safe = (callback, answerOf) => {
    return (...given) => {
      try {
        return answerOf(callback(...given));
      } catch (error) {
        thrown = { error };
        return null; // which ends the call
      }
    };
  };
  try {
    const safeProgress = progress && safe(progress, (answer) => answer !== false);
    const divides =
      rule?.divides &&
      safe(
        (x0, y0, z0, x1, y1, z1, depth) => rule.divides([x0, y0, z0], [x1, y1, z1], depth),
        (answer) => {
          if (typeof answer === 'boolean') return answer;
          throw bad(`options.rule.divides must give true or false, not ${kindOf(answer)}.`);
        },
      );
    return f({ ...options, progress: safeProgress, ...(divides && { rule: { ...rule, divides } }) });
  } catch (error) {
    throw thrown ? thrown.error : error;
  }
}
