// numbers.js - numbers that name nothing, as the engine has them.

export const NONE = 0xffffffff;

/** A number, or null where it is the one that names nothing. */
export const numberOrNull = (value, none) => (value === none ? null : value);
