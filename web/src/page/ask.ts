import { isAbort } from '../model/failure';
import { asPageError } from './failure';
import type { About, State } from './state';

/**
 * Resolves to the answer, or to null after an alert. An answer takes back only alerts about the like: many come unasked, and say nothing
 * about the mesh.
 */
export async function ask<T>(state: State, answer: Promise<T>, about: About = 'answer'): Promise<T | null> {
  try {
    const value = await answer;
    state.clearAlerts(about);
    return value;
  } catch (error) {
    if (!isAbort(error)) state.alert(asPageError(error), about);
    return null;
  }
}
