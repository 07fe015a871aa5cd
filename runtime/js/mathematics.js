// SPDX-License-Identifier: BSL-1.0
// What <math.h>, <float.h> and <string.h> have for the C of this runtime, for numbers instead of bytes.
const DBL_EPSILON = Number.EPSILON;
const {sqrt, sin, cos, exp, log, pow, cbrt, ceil} = Math;
const fabs = Math.abs;
const isnan = Number.isNaN;
const isfinite = Number.isFinite;
function isinf(x) { return x === Infinity || x === -Infinity; }
// The other one where one is no number.
function fmax(a, b) { return a > b || b !== b ? a : b; }
function fmin(a, b) { return a < b || b !== b ? a : b; }

function memcpy(to, from, count) {
    for (let i = 0; i < count; ++i) to[i] = from[i];
}
function memcmp(a, b, count) {
    for (let i = 0; i < count; ++i)
        if (!Object.is(a[i], b[i])) return 1;
    return 0;
}
/// Zeros in numbers, or in all numbers of objects and of what is inside of them. `with_it`: what is kept behind an object.
function memset(what, zero, count) {
    if (typeof what[0] === "number") {
        for (let i = 0; i < count; ++i) what[i] = zero;
        return;
    }
    for (const key of Object.keys(what)) {
        if (typeof what[key] === "number" || typeof what[key] === "boolean")
            what[key] = zero;
        else if (what[key] !== null && typeof what[key] === "object")
            memset(what[key], zero, what[key].length);
    }
}
