/** What writes the code of the page's state, loaded when it is first seen, or ahead. */
export const loadCode = () => import('../model/code');
