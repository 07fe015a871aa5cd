// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/reserved_names.hpp"

#include <algorithm>
#include <array>

namespace dalembert {

namespace {

constexpr auto keywords = std::to_array<std::string_view>({
    "alignas",   "alignof",   "and",        "and_eq",       "asm",          "auto",      "bitand",    "bitor",        "bool",
    "break",     "case",      "catch",      "char",         "char8_t",      "char16_t",  "char32_t",  "class",        "compl",
    "concept",   "const",     "consteval",  "constexpr",    "constinit",    "const_cast", "continue", "co_await",     "co_return",
    "co_yield",  "decltype",  "default",    "delete",       "do",           "double",    "dynamic_cast", "else",      "enum",
    "explicit",  "export",    "extern",     "false",        "float",        "for",       "friend",    "goto",         "if",
    "inline",    "int",       "long",       "mutable",      "namespace",    "new",       "noexcept",  "not",          "not_eq",
    "nullptr",   "operator",  "or",         "or_eq",        "private",      "protected", "public",    "register",     "reinterpret_cast",
    "requires",  "return",    "short",      "signed",       "sizeof",       "static",    "static_assert", "static_cast", "struct",
    "switch",    "template",  "this",       "thread_local", "throw",        "true",      "try",       "typedef",      "typeid",
    "typename",  "union",     "unsigned",   "using",        "virtual",      "void",      "volatile",  "wchar_t",      "while",
    "xor",       "xor_eq",
});

/// Macros of the headers that a generated header includes, and of compilers by themselves: no name survives them.
constexpr auto macros = std::to_array<std::string_view>({
    "NULL",
    "NAN",
    "INFINITY",
    "HUGE_VAL",
    "HUGE_VALF",
    "HUGE_VALL",
    "MATH_ERRNO",
    "MATH_ERREXCEPT",
    "FP_NAN",
    "FP_INFINITE",
    "FP_ZERO",
    "FP_SUBNORMAL",
    "FP_NORMAL",
    "FP_FAST_FMA",
    "FP_FAST_FMAF",
    "FP_FAST_FMAL",
    "FP_ILOGB0",
    "FP_ILOGBNAN",
    "M_E",
    "M_LOG2E",
    "M_LOG10E",
    "M_LN2",
    "M_LN10",
    "M_PI",
    "M_PI_2",
    "M_PI_4",
    "M_1_PI",
    "M_2_PI",
    "M_2_SQRTPI",
    "M_SQRT2",
    "M_SQRT1_2",
    "linux",
    "unix",
    "i386",
    "errno",
    "assert",
    "EOF",
    "MAXFLOAT",
    "SNAN",
    "SNANF",
    "SNANL",
    "RAND_MAX",
    "BIG_ENDIAN",
    "LITTLE_ENDIAN",
    "PDP_ENDIAN",
    "BYTE_ORDER",
    "EXIT_SUCCESS",
    "EXIT_FAILURE",
    "MB_CUR_MAX",
    "FD_SETSIZE",
    "NFDBITS",
    "WNOHANG",
    "WUNTRACED",
    "WSTOPPED",
    "WEXITED",
    "WCONTINUED",
    "WNOWAIT",
    "FP_INT_UPWARD",
    "FP_INT_DOWNWARD",
    "FP_INT_TOWARDZERO",
    "FP_INT_TONEAREST",
    "FP_INT_TONEARESTFROMZERO",
    "DOMAIN",
    "SING",
    "OVERFLOW",
    "UNDERFLOW",
    "TLOSS",
    "PLOSS",
});

/// Functions that C headers put outside of every namespace, of mathematics without their endings f and l.
constexpr auto global_functions = std::to_array<std::string_view>({
    "acos",     "acosh",   "asin",      "asinh",     "atan",        "atan2",     "atanh",     "cbrt",     "ceil",    "copysign", "cos",
    "cosh",     "drem",    "erf",       "erfc",      "exp",         "exp10",     "exp2",      "expm1",    "fabs",    "fdim",     "floor",
    "fma",      "fmax",    "fmin",      "fmod",      "frexp",       "gamma",     "hypot",     "ilogb",    "j0",      "j1",       "jn",
    "ldexp",    "lgamma",  "llrint",    "llround",   "log",         "log10",     "log1p",     "log2",     "logb",    "lrint",    "lround",
    "modf",     "nan",     "nearbyint", "nextafter", "nexttoward",  "pow",       "remainder", "remquo",   "rint",    "round",    "scalb",
    "scalbln",  "scalbn",  "signgam",   "signbit",   "significand", "sin",       "sincos",    "sinh",     "sqrt",    "tan",      "tanh",
    "tgamma",   "trunc",   "y0",        "y1",        "yn",          "abs",       "labs",      "llabs",    "div",     "ldiv",     "finite",
    "isinf",    "isnan",   "time",      "clock",     "index",       "link",      "pause",     "pipe",     "random",  "select",   "signal",
    "system",   "wait",    "exit",      "free",      "abort",       "malloc",    "calloc",    "realloc",  "rand",    "srand",    "getenv",
    "setenv",   "atoi",    "atof",      "atol",      "atoll",       "strtod",    "strtof",    "strtold",  "strtol",  "strtoll",  "strtoul",
    "strtoull", "qsort",   "bsearch",   "lldiv",     "size_t",      "double_t",  "float_t",   "div_t",    "ldiv_t",  "lldiv_t",  "int8_t",
    "int16_t",  "int32_t", "int64_t",   "uint",      "ushort",      "ulong",     "timeval",   "timespec", "fd_set",  "locale_t", "realpath",
    "drand48",  "erand48", "lrand48",   "mblen",     "wctomb",      "mbtowc",    "putenv",    "mktemp",   "pselect", "alloca",   "remove",
    "rename",   "printf",  "memcpy",    "memchr",    "memset",      "strlen",    "strcpy",    "strcmp",   "strchr",  "puts",     "read",
    "write",    "open",    "close",     "main",      "System",      "dalembert", "boost",     "Eigen",    "detail",
});

/// What every header defines itself, or takes from <cmath> by a using declaration.
constexpr auto header_names = std::to_array<std::string_view>({
    "System",
    "Parameters",
    "Scalar",
    "Quantity",
    "State",
    "Input",
    "Output",
    "Generalised",
    "MassMatrix",
    "JacobianX",
    "JacobianU",
    "JacobianP",
    "JacobianT",
    "OutputJacobianX",
    "OutputJacobianU",
    "PatternX",
    "PatternU",
    "PatternP",
    "Cached",
    "scalar_type",
    "state",
    "input",
    "output",
    "parameter",
    "name",
    "scene",
    "title",
    "api",
    "api_version",
    "degrees",
    "degrees_of_freedom",
    "state_count",
    "input_count",
    "output_count",
    "parameter_count",
    "start_values",
    "state_quantities",
    "input_quantities",
    "output_quantities",
    "parameter_quantities",
    "jacobian_x_pattern",
    "jacobian_u_pattern",
    "jacobian_p_pattern",
    "detail",
    "pow",
    "rhs",
    "rhs_and_jacobian",
    "jacobian_x",
    "jacobian_u",
    "jacobian_p",
    "jacobian_t",
    "update",
    "parameters",
    "start_state",
    "mode",
    "mass_factors",
    "Guard",
    "Guards",
    "guards",
    "guard",
    "guard_count",
    "guard_list",
    "Mode",
    "Modes",
    "Event",
    "Events",
    "Kinks",
    "kinks",
    "TimeSwitches",
    "time_switches",
    "guard_rates",
    "holds",
    "reset",
    "settle",
    "is_watched",
    "next_modes",
    "after_accumulation",
    "mode_table",
    "event_table",
    "event",
    "event_count",
    "mode_count",
});

}  // namespace

bool is_cpp_keyword(std::string_view name) { return std::find(keywords.begin(), keywords.end(), name) != keywords.end(); }
bool is_cpp_macro(std::string_view name) {
    const auto has = [](std::string_view base) { return std::find(macros.begin(), macros.end(), base) != macros.end(); };
    if (has(name)) return true;
    // Limits of arithmetic, of <float.h>.
    if (name.starts_with("FLT_") || name.starts_with("DBL_") || name.starts_with("LDBL_") || name == "DECIMAL_DIG") return true;
    // M_PI also as M_PIf, M_PIl, M_PIf128, ...
    const auto suffixed = [&](std::string_view base) {
        return base.starts_with("M_") && name.starts_with(base) &&
               name.substr(base.size()).find_first_not_of("flx0123468") == std::string_view::npos &&
               (name[base.size()] == 'f' || name[base.size()] == 'l');
    };
    return std::any_of(macros.begin(), macros.end(), suffixed);
}

bool is_header_name(std::string_view name) { return std::find(header_names.begin(), header_names.end(), name) != header_names.end(); }

bool is_global_function(std::string_view name) {
    const auto has = [](std::string_view base) {
        return std::find(global_functions.begin(), global_functions.end(), base) != global_functions.end();
    };
    return has(name) || ((name.ends_with('f') || name.ends_with('l')) && has(name.substr(0, name.size() - 1)));
}

}  // namespace dalembert
