// What a misspelt name may have meant.

/** How many letters have to be left out, put in, changed or swapped with the next one to make one word of the other. */
function distance(a, b) {
  let before = [];
  let last = Array.from({ length: b.length + 1 }, (_, j) => j); // of the first letters of a from the first j of b
  for (let i = 1; i <= a.length; ++i) {
    const row = [i];
    for (let j = 1; j <= b.length; ++j) {
      row[j] = Math.min(last[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1), last[j] + 1, row[j - 1] + 1);
      if (a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1]) row[j] = Math.min(row[j], before[j - 2] + 1);
    }
    [before, last] = [last, row];
  }
  return last[b.length];
}

const list = (words, last) => words.join(', ').replace(/, ([^,]*)$/, ` ${last} $1`);

/** The rest of a sentence that says that there is no such name, `none` if there are no names at all. */
export function suggestion(given, names, none) {
  if (names.length === 0) return `: ${none}.`;
  const distances = names.map((name) => distance(given.toLowerCase(), name.toLowerCase()));
  const least = Math.min(...distances);
  if (least > Math.max(1, given.length / 3)) return `, only ${list(names, 'and')}.`;
  const nearest = names.filter((_, i) => distances[i] === least);
  return `: did you mean ${list(nearest, 'or')}?`;
}
