/** What a worker's script can start: modules by their names (see module.js). */
export const parts = new Map();
