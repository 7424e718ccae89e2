/** What is wrong with a file that breaks the rules of its format. */
export function damaged(why: string): Error {
  return new Error(`It is damaged: ${why}.`);
}
