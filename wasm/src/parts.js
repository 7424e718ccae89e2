/** What a worker's script can start: each makes { host, calls } of its compiled module. */
export const parts = new Map();
