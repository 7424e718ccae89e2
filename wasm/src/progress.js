/** Runs f with a callback that C++ can call. An error that the user's callback throws bypasses C++ and is thrown by this call. */
export function withProgress(progress, f) {
  if (progress === undefined) return f(undefined);
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
