/** Three numbers. */
export type Vector3 = readonly number[];
