import { bad, kindOf } from './arguments.js';

/**
 * Runs f with the callbacks that there are, as C++ can call them. An error that the user's callback throws bypasses C++ and is thrown by this
 * call.
 */
export function withCallbacks({ progress, rule }, f) {
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
    return f({
      progress: progress && safe(progress, (answer) => answer !== false),
      rule: rule && {
        ...rule,
        divides: safe(
          (x0, y0, z0, x1, y1, z1, depth) => rule.divides([x0, y0, z0], [x1, y1, z1], depth),
          (answer) => {
            if (typeof answer === 'boolean') return answer;
            throw bad(`options.rule.divides must give true or false, not ${kindOf(answer)}.`);
          },
        ),
      },
    });
  } catch (error) {
    throw thrown ? thrown.error : error;
  }
}
