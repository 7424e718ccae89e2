import { isAbort } from '../model/failure';
import { asPageError } from './failure';
import type { State } from './state';

/** Resolves to the answer, or to null after an alert. */
export async function ask<T>(state: State, answer: Promise<T>): Promise<T | null> {
  try {
    const value = await answer;
    state.clearAlerts();
    return value;
  } catch (error) {
    if (!isAbort(error)) state.alert(asPageError(error));
    return null;
  }
}
